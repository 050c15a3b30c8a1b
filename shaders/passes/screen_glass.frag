// What is seen through a body of glass, in place of what lies behind it: the eye ray is refracted into it, goes to and fro within
// it, and what leaves it at each surface sees the scene: on the screen where that shows it, else through the window, the face that it
// entered by as seen from the apparent eye (player/passes/glass_window.h), else as it is seen from the body's middle.
// Frosted panes spread it like what they reflect, mirrored at the pane.
#define GLASS_PLANES 24
#include "lib/glass.glsl"
#include "lib/reflectance.glsl"
#include "lib/shading.glsl"

uniform sampler2D u_places;  // of glass_surface
uniform sampler2D u_normals;
uniform sampler2D u_tints;
uniform vec4 u_eye;
uniform sampler2D u_reflectance;
uniform int u_reflectance_row;  // -1: reflects nothing
uniform int u_reflectance_count;
uniform bool u_inside;      // the eye is in the glass
uniform bool u_pane;        // thin and frosted: no body
uniform vec3 u_tint;        // of a surface
uniform vec3 u_absorption;  // 1/m
uniform float u_ior;        // at least 1
uniform float u_width;      // alpha of its facets; 0: clear
uniform int u_looks;        // of a lobe
uniform float u_turn;       // [0, 1): other ones in each of frames that are added up
uniform vec3 u_centre;
uniform float u_radius;
uniform int u_plane_count;  // 0: curved
uniform vec4 u_planes[GLASS_PLANES];
uniform samplerCube u_shape;

uniform mat4 u_clip_from_pack;
uniform sampler2D u_behind;         // the frame: light, a its depth; with levels
uniform bool u_levels;              // its coarser levels are there
uniform vec2 u_behind_size;         // pixels in use
uniform float u_far;                // metres
uniform float u_pixels_per_tangent;
uniform bool u_window;              // there is one
uniform mat4 u_window_from_pack;    // its clip space
uniform sampler2D u_through;        // as u_around, by pixel of the window
uniform vec2 u_window_size;         // pixels
uniform vec4 u_window_tangents;     // of its view: half the size, and the middle
uniform vec3 u_window_depth;        // depth there is x + y / metres along the view; z: 1 / the distance of the sky
uniform float u_window_pixels;      // per tangent
uniform samplerCube u_around;       // light, a 1 / distance, 0 for the sky
uniform vec3 u_around_centre;
uniform float u_around_size;        // texels a side

layout(location = 0) out vec4 o_light;  // a: 1; 2 where the lobe is wider than 4 x 4 pixels (a body's: everywhere)

const int kCrossings = 6;       // surfaces that a clear ray meets within
const int kFrostedCrossings = 3;
const float kLeast = 0.004;     // of the light: what brings less is not followed
const float kSmooth = 1.5;      // pixels between rays
const float kWidestLook = 0.5;  // radians, of one of a pane's: the last ones stand for all of a lobe's tail
const int kDoublings = 8, kPaneDoublings = 12, kNarrowings = 8;
const float kFaint = 0.1;       // of it: less is seen from the body's middle
const int kSteps = 64;          // of a ray over the screen
const int kFrostedSteps = 8;
const float kThickness = 0.05;  // of its distance: a surface this far before a ray is not met
const float kPaneThickness = 0.005;  // a pane's frame is about as near, and covers what is behind it

// How far a ray is beyond what is seen from the middle of the body, in terms of inverse distance: positive behind it.
float beyond_around(vec3 at) { return textureLod(u_around, at, 0.0).a * length(at) - 1.0; }

// As it is seen from the middle of the body: where the ray passes what is seen there. First in steps that double, then by false
// position between the last place before it and the first behind it: what is seen at a small angle is found as well. A ray that starts
// behind what is seen, or passes nothing, leaves the sphere on which that lies.
vec3 light_around(vec3 origin, vec3 direction, float spread) {
  vec3 from = origin - u_around_centre;
  float low = 0.0, high = -1.0, before = beyond_around(from), behind = 0.0;
  int doublings = u_pane ? kPaneDoublings : kDoublings;  // what is behind a pane may be near beside its width
  for (int i = 0; i < doublings && before < 0.0; ++i) {
    float way = 64.0 * u_radius * exp2(float(i - doublings)), beyond = beyond_around(from + way * direction);
    if (beyond >= 0.0) {
      high = way, behind = beyond;
      break;
    }
    low = way, before = beyond;
  }
  vec3 towards = direction;
  if (high > 0.0) {
    for (int i = 0; i < kNarrowings; ++i) {
      float share = i % 2 == 0 ? clamp(before / (before - behind), 0.02, 0.98) : 0.5;
      float way = mix(low, high, share), beyond = beyond_around(from + way * direction);
      if (beyond < 0.0) low = way, before = beyond;
      else high = way, behind = beyond;
    }
    towards = from + mix(low, high, before / (before - behind)) * direction;
  } else {
    float along = dot(from, direction), apart = dot(from, from) - along * along, inverse = 0.0;
    for (int i = 0; i < 3; ++i) {
      float seen = textureLod(u_around, direction + inverse * from, 0.0).a;
      if (seen > 1e-12) inverse = 1.0 / max(sqrt(max(1.0 / (seen * seen) - apart, 0.0)) - along, 1e-3 / seen);
    }
    towards = direction + inverse * from;
  }
  return textureLod(u_around, towards, log2(max(0.5 * spread * u_around_size, 1.0))).rgb;
}

// Of the nearest pixel: between near and far ones there is nothing.
float depth_at(bool window, vec2 ndc) {
  vec2 size = window ? u_window_size : u_behind_size;
  ivec2 pixel = clamp(ivec2((0.5 * ndc + 0.5) * size), ivec2(0), ivec2(size) - 1);
  if (!window) return 2.0 * texelFetch(u_behind, pixel, 0).a - 1.0;
  float inverse = texelFetch(u_through, pixel, 0).a;
  vec2 tangent = u_window_tangents.zw + u_window_tangents.xy * (2.0 * (vec2(pixel) + 0.5) / size - 1.0);
  return inverse <= u_window_depth.z ? 1.0 : u_window_depth.x + u_window_depth.y * inverse * length(vec3(tangent, 1.0));
}

// The sky is met behind everything.
bool is_near(float depth, float surface, float thickness) {
  return surface >= 1.0 || depth - surface <= thickness * max(1.0 - surface, 1e-7);
}

// Along the screen, or the window, from a to b, normalised device coordinates: the share of the way at which the ray meets what is seen there; -1
// where it leaves the screen without, -2 where something nearer hides it there. Steps of a pixel; frosted: few, that
// grow with the way.
float meet(bool window, vec3 a, vec3 b, bool frosted) {
  vec2 way = b.xy - a.xy;
  float end = 1.0;
  for (int c = 0; c < 2; ++c)
    if (abs(way[c]) > 1e-9) end = min(end, max((sign(way[c]) - a[c]) / way[c], 0.0));
  int steps = clamp(int(0.5 * length(end * way * (window ? u_window_size : u_behind_size))), 2, frosted ? kFrostedSteps : kSteps);
  float before = 0.0;
  float start = depth_at(window, a.xy);
  bool in_front = a.z <= start;
  float thickness = u_pane ? kPaneThickness : kThickness;
  if (!in_front && is_near(a.z, start, thickness)) return 0.0;  // the glass stands on it
  for (int i = 1; i <= steps; ++i) {
    float share = float(i) / float(steps), at = end * (frosted ? share * share : share);
    vec3 p = mix(a, b, at);
    float surface = depth_at(window, p.xy);
    bool behind = p.z >= surface;
    if (behind && !in_front && is_near(p.z, surface, thickness)) return at;
    if (behind && in_front) {
      float low = before, high = at;
      for (int k = 0; k < 6; ++k) {
        float middle = 0.5 * (low + high);
        vec3 m = mix(a, b, middle);
        if (m.z >= depth_at(window, m.xy)) high = middle;
        else low = middle;
      }
      // What begins nearer than the ray was in front is beside it.
      if (is_near(mix(a, b, low).z, depth_at(window, mix(a, b, high).xy), kThickness)) return high;
    }
    in_front = !behind;
    before = at;
  }
  return in_front ? -1.0 : -2.0;
}

// Coarser levels are means of near and far: as far as a level's depth is not that of what was met, a finer one tells.
vec3 light_behind(vec2 ndc, float depth, float pixels) {
  float level = u_levels ? log2(max(0.7 * pixels, 1.0)) : 0.0, left = 1.0;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 5 && left > 0.02; ++i) {
    float margin = 0.5 * exp2(level);
    vec2 at = clamp((0.5 * ndc + 0.5) * u_behind_size, min(vec2(margin), 0.5 * u_behind_size),
                    max(u_behind_size - margin, 0.5 * u_behind_size));
    vec4 found = textureLod(u_behind, at / vec2(textureSize(u_behind, 0)), level);
    float off = abs(2.0 * found.a - 1.0 - depth) / (kThickness * max(1.0 - depth, 1e-7));
    float share = level <= 0.0 ? 1.0 : 1.0 - smoothstep(0.3, 1.5, off);
    sum += left * share * found.rgb;
    left *= 1.0 - share;
    level = i < 3 ? max(level - 1.5, 0.0) : 0.0;
  }
  return sum / max(1.0 - left, 1e-3);
}

float g_least_pixels = 1e9;  // between rays of the lobe where they meet something
float g_near = 0.0;          // rays that are no farther apart than that allows for pixels beside each other

// Where along the screen or the window a ray meets something, and how far it has come: xyz, metres. a: of meet(), -3 where the ray
// does not begin there or goes towards the eye.
vec4 meet_in(bool window, vec3 origin, vec3 direction, bool frosted, out float metres) {
  mat4 clip = window ? u_window_from_pack : u_clip_from_pack;
  vec4 from = clip * vec4(origin, 1.0), way = clip * vec4(direction, 0.0);
  bool perspective = window || u_eye.w > 0.0;
  bool away = perspective ? from.w > 0.0 && way.w > 1e-3 : way.z > 0.0;
  vec3 a = from.xyz / from.w;
  metres = 0.0;
  if (!away || any(greaterThan(abs(a.xy), vec2(1.0)))) return vec4(0.0, 0.0, 0.0, -3.0);
  vec3 b = perspective ? way.xyz / way.w : (from + u_far * way).xyz;
  float at = meet(window, a, b, frosted);
  metres = perspective ? at / max(1.0 - at, 1e-6) * from.w / way.w : at * u_far;
  return vec4(mix(a, b, max(at, 0.0)), at);
}

// Pixels between rays of a bundle of `spread` radians that far away.
float pixels_apart(bool window, vec3 point, float metres, float spread) {
  vec4 there = (window ? u_window_from_pack : u_clip_from_pack) * vec4(point, 1.0);
  return spread * metres * (window ? u_window_pixels : u_pixels_per_tangent) / (window || u_eye.w > 0.0 ? there.w : 1.0);
}

// Light from along a ray that has left the glass; a: 0 where something hides what a frosted ray would see, so that others tell.
// spread: of the bundle, radians.
vec4 look(vec3 origin, vec3 direction, float spread, bool frosted) {
  float metres, pixels;
  vec4 met = meet_in(false, origin, direction, frosted, metres);
  if (met.a >= 0.0) {
    pixels = pixels_apart(false, origin + metres * direction, metres, spread);
    g_least_pixels = min(g_least_pixels, pixels);
    if (pixels <= kSmooth) g_near += 1.0;
    return vec4(light_behind(met.xy, met.z, pixels), 1.0);
  }
  if (u_window) {
    vec4 through = meet_in(true, origin, direction, frosted, metres);
    if (through.a >= 0.0) {
      pixels = pixels_apart(true, origin + metres * direction, metres, spread);
      g_least_pixels = min(g_least_pixels, pixels);
      return vec4(textureLod(u_through, 0.5 * through.xy + 0.5, u_levels ? log2(max(0.7 * pixels, 1.0)) : 0.0).rgb, 1.0);
    }
  }
  if (met.a == -2.0 && frosted && !u_pane) return vec4(0.0);
  return vec4(light_around(origin, direction, spread), 1.0);
}

// The largest channel of R along the ray that has this cosine outside.
vec3 reflected_at(float cos_theta) {
  if (u_reflectance_row < 0) return vec3(0.0);
  return reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta);
}

#ifdef TREE
#include "passes/screen_glass_tree.glsl"
#else
float leave(vec3 p, vec3 d, out vec3 normal) {
  if (u_plane_count > 0) return leave_planes(u_planes, u_plane_count, p, d, normal);
  return leave_shape(u_shape, u_radius, p - u_centre, d, normal);
}

// Light that comes out of the glass within, along -d at p; a: the share of it that is known. at: of the facets that are met.
vec4 light_within(vec3 p, vec3 d, vec2 at, float spread) {
  vec3 sum = vec3(0.0), weight = vec3(1.0), out_of = d;
  float known = 1.0;
  bool frosted = u_width > 0.0;
  for (int i = 0; i < (frosted ? kFrostedCrossings : kCrossings) && max_channel(weight) > kLeast; ++i) {
    vec3 normal;
    float metres = leave(p, d, normal);
    p += metres * d;
    weight *= exp(-u_absorption * metres);
    vec3 facet = -normal;
    if (frosted) facet = visible_facet(-normal, -d, u_width, fract(at + 0.38 * float(i)));
    float cos_within = clamp(-dot(d, facet), 0.0, 1.0), beyond = refracted_cosine(1.0 / u_ior, cos_within);
    vec3 back = beyond < 0.0 ? vec3(1.0) : reflected_at(beyond);
    float through = beyond < 0.0 ? 0.0 : 1.0 - max_channel(back), left = through * max_channel(weight);
    if (left > kLeast) {
      out_of = on_side(refracted(-d, facet, 1.0 / u_ior, beyond), normal);
      vec4 seen = left < kFaint ? vec4(light_around(p, out_of, spread), 1.0) : look(p, out_of, spread, frosted);
      sum += weight * through * u_tint * seen.rgb;
      known -= left * (1.0 - seen.a);
    }
    weight *= back;
    d = on_side(reflect(d, facet), -normal);
    out_of = d;
  }
  // What is still to and fro goes where it was going, so that nothing is lost of an even light.
  if (max_channel(weight) > kLeast) sum += weight * u_tint * light_around(p, out_of, max(spread, 0.1));
  return vec4(sum, max(known, 0.0));
}
#endif

// The direction in the glass of an eye ray, and the first one beyond it: how far those of neighbouring pixels part.
float pixel_spread(vec3 p, vec3 d) {
  vec3 normal;
  leave(p, d, normal);
  float beyond = refracted_cosine(1.0 / u_ior, clamp(dot(d, normal), 0.0, 1.0));
  vec3 direction = beyond < 0.0 ? reflect(d, normal) : refracted(-d, -normal, 1.0 / u_ior, beyond);
  return min(0.5 * (length(dFdx(direction)) + length(dFdy(direction))), 1.0);
}

// A facet that the eye sees. i: of the lobe's looks; turn: other ones by pixel.
vec3 facet_of(vec3 normal, vec3 to_eye, int i, float turn) {
  float share = (float(i) + fract(turn * 7.0 + 1.0 / 32.0)) / float(u_looks);
  return visible_facet(normal, to_eye, u_width, vec2(fract(0.618034 * float(i) + turn), share));
}

// Light that a thin pane lets through, for each of u_looks; a: how many of them are known.
vec4 light_through(vec3 p, vec3 normal, vec3 to_eye, float turn) {
  if (u_width <= 0.0) return look(p, -to_eye, 0.0, false);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < u_looks; ++i) {
    vec3 facet = facet_of(normal, to_eye, i, turn), mirrored = reflect(-to_eye, facet);
    vec3 d = on_side(mirrored - 2.0 * dot(mirrored, normal) * normal, -normal);
    sum += look(p, d, min(3.0 * facet_step(u_width, dot(facet, normal), float(u_looks)), kWidestLook), true);
  }
  return sum;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 place = texelFetch(u_places, pixel, 0);
  vec3 normal = texelFetch(u_normals, pixel, 0).xyz, to_eye = normalize(u_eye.xyz - place.xyz * u_eye.w);
  normal = dot(normal, normal) > 0.0 ? normalize(normal) : to_eye;
  if (u_pane && dot(normal, to_eye) < 0.0) normal = -normal;
  float rise = dot(normal, to_eye);
  if (rise < 1e-4) normal = normalize(normal + (1e-4 - rise) * to_eye);
  float cos_theta = dot(normal, to_eye);
  vec3 origin = u_inside ? u_eye.xyz : place.xyz;
  vec3 clear = u_inside ? -to_eye : refracted(to_eye, normal, u_ior, refracted_cosine(u_ior, cos_theta));
  float spread = u_pane ? 0.0 : pixel_spread(origin, clear);
  if (place.a == 0.0) discard;
  vec4 sum = vec4(0.0);
  // Each of 4 x 4 neighbours looks elsewhere in the lobe.
  float turn = fract(float(pixel.x % 4 * 4 + pixel.y % 4) / 16.0 + u_turn);
  if (u_pane) sum = light_through(origin, normal, to_eye, turn);
  for (int i = 0; i < u_looks && !u_pane; ++i) {
    float wide = spread;
    vec3 d = clear;
    if (u_width > 0.0 && !u_inside) {
      vec3 facet = facet_of(normal, to_eye, i, turn);
      d = on_side(refracted(to_eye, facet, u_ior, refracted_cosine(u_ior, dot(to_eye, facet))), -normal);
      wide = max(spread, 1.5 * (u_ior - 1.0) * facet_step(u_width, dot(facet, normal), float(u_looks)));
    }
    sum += light_within(origin, d, fract(vec2(0.754878, 0.569840) * float(i) + vec2(turn, 5.0 * turn)), wide);
  }
  // Radiance is n^2 times as dense in glass.
  vec3 entered = u_inside ? vec3(u_ior * u_ior)
                          : u_tint * texelFetch(u_tints, pixel, 0).rgb * (1.0 - max_channel(reflected_at(cos_theta)));
  vec3 light = sum.a > 0.02 * float(u_looks) ? sum.rgb / sum.a : light_around(origin, -to_eye, 0.5);
  bool wide = u_pane ? g_near < 0.5 * float(u_looks) : g_least_pixels > kSmooth;
  o_light = vec4(entered * light, u_width > 0.0 && wide ? 2.0 : 1.0);
}
