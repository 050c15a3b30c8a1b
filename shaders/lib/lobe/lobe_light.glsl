// Polygons of light in glossy lobes, in closed form: the twin of formats/lobes/lobe_light.h. Surface frame: z the normal, x the
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

const int kMostCorners = 6;  // four, and one more for each of two clips

// What of a polygon lies above z = 0.
void clip_to_horizon(inout vec3 v[kMostCorners], inout int count) {
  vec3 kept[kMostCorners];
  int n = 0;
  for (int i = 0; i < count; ++i) {
    vec3 a = v[i], b = v[i + 1 == count ? 0 : i + 1];
    if (a.z >= 0.0 && n < kMostCorners) kept[n++] = a;
    if (((a.z > 0.0 && b.z < 0.0) || (a.z < 0.0 && b.z > 0.0)) && n < kMostCorners)
      kept[n++] = a + (b - a) * (a.z / (a.z - b.z));
  }
  v = kept;
  count = n;
}

// The z of Lambert's edge vector, the angle under which the edge a b is seen along the normal of its plane. atan of the sine
// over the cosine: the arc cosine has no digits for short edges.
float edge_z(vec3 a, vec3 b) {
  vec3 normal = cross(a, b);
  float sine = length(normal);
  return sine > 0.0 ? normal.z * (atan(sine, dot(a, b)) / sine) : 0.0;
}

// The integral of the lobe over the part of a polygon above the surface: what it reflects of a radiance of 1, without Fresnel.
// inverse: m11, m13, m22, m31 of LobeFit. v: `count` corners (3 or 4), convex, relative to the point; counter-clockwise as seen
// from it: positive, else negative.
float reflected_polygon(vec4 inverse, float amplitude, vec3 v[kMostCorners], int count) {
  clip_to_horizon(v, count);
  for (int i = 0; i < count; ++i) {
    vec3 w = vec3(inverse.x * v[i].x + inverse.y * v[i].z, inverse.z * v[i].y, inverse.w * v[i].x + v[i].z);
    float size = length(w);
    v[i] = size > 0.0 ? w / size : vec3(0.0);
  }
  clip_to_horizon(v, count);
  if (count < 3) return 0.0;
  float sum = 0.0;
  for (int i = 0; i < count; ++i) sum += edge_z(v[i], v[i + 1 == count ? 0 : i + 1]);
  return -amplitude * 0.15915494309 * sum;
}

// The same of a lobe that is one direction: 1 where a ray along it meets the polygon's bright side, -1 the other, 0 none.
float polygon_met(vec3 v[kMostCorners], int count, vec3 direction) {
  float least = 0.0, most = 0.0;
  for (int i = 0; i < count; ++i) {
    float side = dot(cross(v[i], v[i + 1 == count ? 0 : i + 1]), direction);
    least = min(least, side);
    most = max(most, side);
  }
  vec3 normal = cross(v[1] - v[0], v[2] - v[0]);
  bool ahead = dot(normal, v[0]) * dot(normal, direction) > 0.0;
  if (!ahead || least * most < 0.0) return 0.0;
  return most > 0.0 ? -1.0 : 1.0;
}
