// The direction that an eye ray is reflected into, about a normal of any length; normal: what the eye sees of it, unit.
vec3 mirrored(vec3 tilted, vec3 view, out vec3 normal, out float cos_theta) {
  float length2 = dot(tilted, tilted);
  normal = length2 > 0.0 ? tilted * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
  cos_theta = -dot(normal, view);
  if (cos_theta < 0.0) {  // it turns away at the silhouette: bent back until the view grazes it
    normal = normalize(normal + (cos_theta - 1e-4) * view);
    cos_theta = 0.0;
  }
  return normalize(reflect(view, normal));
}

// How far neighbouring pixels' directions part, radians.
float spread_of(vec3 mirror) { return min(0.5 * (length(dFdx(mirror)) + length(dFdy(mirror))), 2.0); }
