// Light within hollow and branched glass: a ray that leaves it may enter it again. To be included after look() and reflected_at().
#include "lib/glass_tree.glsl"

const int kTreeCrossings = 6;     // times that a clear ray leaves the glass or is reflected within
const int kFrostedTreeCrossings = 4;
const float kTreeLeast = 1e-5;    // of the radius: what is nearer is where the ray is

float leave(vec3 p, vec3 d, out vec3 normal) {
  vec3 flat_normal;
  return max(meet_tree(p, d, kTreeLeast * u_radius, true, flat_normal, normal), 0.0);
}

// What stands on the way between two surfaces of the glass, as far as the screen shows it; a: 0 where nothing does.
vec4 light_between(vec3 p, vec3 d, float gap, float spread, bool frosted) {
  float metres;
  vec4 met = meet_in(false, p, d, frosted, metres);
  if (met.a < 0.0 || metres >= gap) return vec4(0.0);
  return vec4(light_behind(met.xy, met.z, pixels_apart(false, p + metres * d, metres, spread)), 1.0);
}

// As of other bodies. A ray that enters again is followed, and what stays within is taken to go on as it was going. What surfaces
// reflect that it enters by is drawn over them.
vec4 light_within(vec3 p, vec3 d, vec2 at, float spread) {
  vec3 sum = vec3(0.0), weight = vec3(1.0), out_of = d, flat_normal, normal;
  float known = 1.0, least = kTreeLeast * u_radius;
  bool frosted = u_width > 0.0;
  for (int i = 0; i < (frosted ? kFrostedTreeCrossings : kTreeCrossings) && max_channel(weight) > kLeast; ++i) {
    float metres = meet_tree(p, d, least, true, flat_normal, normal);
    if (metres < 0.0) break;
    p += metres * d;
    weight *= exp(-u_absorption * metres);
    vec3 facet = frosted ? visible_facet(-normal, -d, u_width, fract(at + 0.38 * float(i))) : -normal;
    float beyond = refracted_cosine(1.0 / u_ior, clamp(-dot(d, facet), 0.0, 1.0));
    vec3 back = beyond < 0.0 ? vec3(1.0) : reflected_at(beyond), kept = on_side(reflect(d, facet), -flat_normal);
    float through = beyond < 0.0 ? 0.0 : 1.0 - max_channel(back), left = through * max_channel(weight);
    if (left > kLeast) {
      out_of = on_side(refracted(-d, facet, 1.0 / u_ior, beyond), flat_normal);
      float gap = meet_tree(p, out_of, least, false, flat_normal, normal);
      vec4 seen = vec4(0.0);
      if (gap >= 0.0) seen = light_between(p, out_of, gap, spread, frosted);
      else seen = left < kFaint ? vec4(light_around(p, out_of, spread), 1.0) : look(p, out_of, spread, frosted);
      if (gap >= 0.0 && seen.a == 0.0) {
        if (max_channel(weight * back) > kLeast) sum += weight * back * u_tint * light_around(p, kept, max(spread, 0.1));
        p += gap * out_of;
        facet = frosted ? visible_facet(normal, -out_of, u_width, fract(at + 0.38 * float(i) + 0.19)) : normal;
        float cos_theta = clamp(-dot(out_of, facet), 0.0, 1.0);
        weight *= through * u_tint * u_tint * (1.0 - max_channel(reflected_at(cos_theta)));
        d = on_side(refracted(-out_of, facet, u_ior, refracted_cosine(u_ior, cos_theta)), -flat_normal);
        continue;
      }
      sum += weight * through * u_tint * seen.rgb;
      known -= left * (1.0 - seen.a);
    }
    weight *= back;
    d = out_of = kept;
  }
  if (max_channel(weight) > kLeast) sum += weight * u_tint * light_around(p, out_of, max(spread, 0.1));
  return vec4(sum, max(known, 0.0));
}
