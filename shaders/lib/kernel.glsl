// K as taps of equal energy by incidence (player/scene/kernel_taps.h): where a glossy lobe goes around the mirror direction.

// Where a cosine lies among the rows, row i of which is at cos theta = (i / (rows - 1))^2: the row below, and the share of the
// next.
vec2 kernel_row(float cos_theta, int rows) {
  float at = sqrt(clamp(cos_theta, 0.0, 1.0)) * float(rows - 1);
  float row = min(floor(at), float(max(rows - 2, 0)));
  return vec2(row, at - row);
}

// A tap between two rows: xy mirror coordinates, z width, w how much its light counts.
vec4 kernel_tap(sampler2D taps, int tap, vec2 row) {
  vec4 below = texelFetch(taps, ivec2(tap, int(row.x)), 0);
  return row.y > 0.0 ? mix(below, texelFetch(taps, ivec2(tap, int(row.x) + 1), 0), row.y) : below;
}

// The direction at mirror coordinates u, stereographic: |u| = 2 tan(gamma / 2). mirror, across and along are an orthonormal
// frame.
vec3 lobe_direction(vec3 mirror, vec3 across, vec3 along, vec2 u) {
  float q = 0.25 * dot(u, u);
  return ((1.0 - q) * mirror + u.x * across + u.y * along) / (1.0 + q);
}
