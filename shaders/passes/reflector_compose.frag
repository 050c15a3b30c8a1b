// M R on a mirror (Bastos et al. 1999, section 8.2.2).
#include "lib/color.glsl"
#include "passes/reflector_reflectance.glsl"

uniform sampler2D u_image;       // M
uniform vec2 u_image_size;       // pixels in use
uniform vec2 u_origin;           // of the image in the frame, pixels
uniform vec3 u_missing;          // light where no map shows anything
uniform bool u_smooth;           // its edges
uniform bool u_with_distance;     // a: the image's 1 / distance; else the kind of light
layout(location = 0) out vec4 o_light;

const float kContrast = 0.25;  // of the brightest of five pixels: less is no edge
const float kLevel = 0.25;    // of an edge's step: where the mean of its sides departs by more, it ends
const int kReach = 16;        // pixels along an edge

ivec2 on_image(ivec2 at) { return clamp(at, ivec2(0), ivec2(u_image_size) - 1); }
float bright(ivec2 at) { return luminance(texelFetch(u_image, on_image(at), 0).rgb); }

// The image has a sample a pixel: its edges are stairs. A pixel beside one takes as much of the other side's light as a
// straight line between the ends of its step covers (Lottes 2009, "FXAA").
vec4 without_stairs(ivec2 at) {
  vec4 own = texelFetch(u_image, at, 0);
  if (!u_smooth) return own;
  float c = bright(at), n = bright(at + ivec2(0, 1)), s = bright(at - ivec2(0, 1)), e = bright(at + ivec2(1, 0)),
        w = bright(at - ivec2(1, 0));
  float most = max(c, max(max(n, s), max(e, w))), least = min(c, min(min(n, s), min(e, w)));
  if (most - least <= kContrast * most) return own;
  float ne = bright(at + 1), sw = bright(at - 1), nw = bright(at + ivec2(-1, 1)), se = bright(at + ivec2(1, -1));
  bool level = 2.0 * abs(n + s - 2.0 * c) + abs(ne + se - 2.0 * e) + abs(nw + sw - 2.0 * w) >=
               2.0 * abs(e + w - 2.0 * c) + abs(ne + nw - 2.0 * n) + abs(se + sw - 2.0 * s);
  ivec2 along = level ? ivec2(1, 0) : ivec2(0, 1), over = ivec2(1) - along;
  float other = level ? n : e, opposite = level ? s : w;
  if (abs(opposite - c) > abs(other - c)) over = -over, other = opposite;
  float middle = 0.5 * (c + other), step_over = abs(c - other);
  vec2 ends = vec2(0.0), departs = vec2(0.0);  // pixels to both ends; by how much the mean of the sides departs there
  int i = 0;
  do {
    ++i;
    ivec2 to = at + i * along, back = at - i * along;
    vec2 mean = 0.5 * vec2(bright(to) + bright(to + over), bright(back) + bright(back + over)) - middle;
    bvec2 goes_on = lessThan(abs(departs), vec2(kLevel * step_over));
    departs = mix(departs, mean, goes_on), ends = mix(ends, vec2(float(i)), goes_on);
  } while (i < kReach && any(lessThan(abs(departs), vec2(kLevel * step_over))));
  bool first = ends.x < ends.y;
  float nearer = first ? departs.x : departs.y;
  bool covered = step_over > 0.0 && abs(nearer) >= kLevel * step_over && (nearer < 0.0) != (c < middle);
  if (!covered) return own;
  float share = 0.5 - (min(ends.x, ends.y) - 0.5) / (ends.x + ends.y - 1.0);  // the ends are half a pixel beyond the step's
  return vec4(mix(own.rgb, texelFetch(u_image, on_image(at + over), 0).rgb, share), own.a);
}

void main() {
  vec4 image = without_stairs(on_image(ivec2(floor(gl_FragCoord.xy - u_origin))));
  vec3 light = image.a > 0.0 ? image.rgb : u_missing;
  o_light = vec4(light * reflector_reflectance(reflector_cosine()), u_with_distance ? image.a : 1.0);
}
