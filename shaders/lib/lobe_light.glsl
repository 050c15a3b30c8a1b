// Polygons of light in glossy lobes, in closed form: the twin of formats/query/lobe_light.h. Surface frame: z the normal, x the
// projection of the direction towards the eye on the surface, y = z x x.

// m11, m13, m22, m31 over m33 after the frame has turned by an angle of that cosine and sine: about y, z towards -x.
vec4 turned_lobe(vec4 m, float cosine, float sine) {
  return vec4(m.x * cosine + m.y * sine, m.y * cosine - m.x * sine, m.z, m.w * cosine + sine) / (cosine - m.w * sine);
}

// Inverse matrices in the frame of the mirror direction: between two of them, and back to the surface frame.
vec4 mix_lobes(vec4 a, vec4 b, float share) {
  vec4 m = mix(a, b, share);
  m.z = a.z * b.z / (b.z + (a.z - b.z) * share);
  return m;
}
vec4 lobe_in_surface_frame(vec4 m, float cos_theta) {
  return turned_lobe(m, cos_theta, -sqrt(max(0.0, 1.0 - cos_theta * cos_theta)));
}

// angle / sin(angle) by the cosine, [0, 1]: relative error 5e-7, an interpolation at Chebyshev's points.
float angle_over_sine(float c) {
  float high = -0.648626993 + c * (0.509054596 + c * (-0.323932017 + c * (0.135951283 - c * 0.0266371514)));
  return 1.57079558 + c * (-0.999903565 + c * (0.78329788 + c * high));
}

// Lambert's edge vector: the angle under which the edge a b is seen, along the normal of its plane. |a| |b| follows from the
// products (Lagrange); beyond 90 degrees angle / sine is pi / sine less that of the rest.
vec3 edge_vector(vec3 a, vec3 b) {
  vec3 normal = cross(a, b);
  float sine2 = dot(normal, normal), cosine = dot(a, b);
  float inverse = inversesqrt(max(sine2 + cosine * cosine, 1e-37));
  float acute = inverse * angle_over_sine(min(abs(cosine) * inverse, 1.0));
  return normal * (cosine < 0.0 ? 3.14159265359 * inversesqrt(max(sine2, 1e-37)) - acute : acute);
}

// What the lobe of integral 1 sees of a polygon above the surface, in the frame of its cosine: z is the integral of the lobe over
// it, without Fresnel; the vector points to where that light comes from on average, or the opposite way where z is negative.
// inverse: m11, m13, m22, m31 of LobeFit. v: convex, relative to the point, none of it below the surface, a triangle's last
// corner twice; of a size about 1, so that products of four coordinates are numbers. Counter-clockwise as seen from the point:
// positive, else negative.
// No corner list, which would be indexed by numbers: each edge is clipped to the transformed lobe's hemisphere for itself, and
// where a convex polygon leaves and enters it an edge along the horizon closes what is left.
vec3 reflected_vector(vec4 inverse, vec3 v[4]) {
  vec3 w[4];
  for (int i = 0; i < 4; ++i)
    w[i] = vec3(inverse.x * v[i].x + inverse.y * v[i].z, inverse.z * v[i].y, inverse.w * v[i].x + v[i].z);
  vec3 leaves = vec3(0.0), enters = vec3(0.0), sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 a = w[i], b = w[i == 3 ? 0 : i + 1];
    bool a_above = a.z >= 0.0, b_above = b.z >= 0.0;
    vec3 crossing = vec3(a.xy + (b.xy - a.xy) * (a_above == b_above ? 0.0 : a.z / (a.z - b.z)), 0.0);
    if (a_above && !b_above) leaves = crossing;
    if (!a_above && b_above) enters = crossing;
    vec3 part = edge_vector(a_above ? a : crossing, b_above ? b : crossing);
    sum += a_above || b_above ? part : vec3(0.0);
  }
  return -0.15915494309 * (sum + edge_vector(leaves, enters));
}

float reflected_polygon(vec4 inverse, vec3 v[4]) { return reflected_vector(inverse, v).z; }

// From the frame of the lobe's cosine to the surface's, not unit.
vec3 from_lobe(vec4 inverse, vec3 w) {
  float determinant = inverse.x - inverse.y * inverse.w;
  return vec3((w.x - inverse.y * w.z) / determinant, w.y / inverse.z, (inverse.x * w.z - inverse.w * w.x) / determinant);
}

// The same of a lobe that is one direction, over a square of that angle about it: the share of the square that the polygon covers,
// exact for a rectangle along it; negative where it is the polygon's other side. The angle may be 0: all or nothing.
float polygon_share(vec3 v[4], vec3 direction, float angle) {
  vec3 normal = cross(v[1] - v[0], v[2] - v[0]);
  float facing = dot(normal, v[0]);
  if (facing * dot(normal, direction) <= 0.0) return 0.0;
  float inside[4];  // sine of the angle from each edge to the direction, over the square's, within half of it
  for (int i = 0; i < 4; ++i) {
    vec3 edge = cross(v[i], v[i == 3 ? 0 : i + 1]);
    float size = length(edge), side = dot(edge, direction) * (facing < 0.0 ? -1.0 : 1.0);
    inside[i] = size > 0.0 ? clamp(side / max(size * angle, 1e-30), -0.5, 0.5) : 0.5;  // a triangle's last edge has no length
  }
  float share = max(inside[0] + inside[2], 0.0) * max(inside[1] + inside[3], 0.0);
  if (v[3] == v[2] && angle > 0.0) {  // a triangle's edges have no opposite ones: no more than all of it
    float way = length(v[0] + v[1] + v[2]) / 3.0;
    share = min(share, 0.5 * abs(facing) / (way * way * way * angle * angle));
  }
  return facing > 0.0 ? -share : share;
}
