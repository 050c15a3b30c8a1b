// The shading equation of docs/notes/conventions.md: L = kd (1 - max R) / pi E + S + emission.
const float kPi = 3.14159265358979323846;

float max_channel(vec3 v) { return max(v.r, max(v.g, v.b)); }

// The diffuse part kd * D, cd/m2. irradiance in lux.
vec3 diffuse_light(vec3 kd, vec3 reflectance, vec3 irradiance) {
  return kd * (1.0 - max_channel(reflectance)) * irradiance / kPi;
}

// What a wide lobe shows where there is no image to reflect: the light around, without direction.
vec3 ambient_reflection(vec3 reflectance, vec3 irradiance) { return reflectance * irradiance / kPi; }

// Cosine between a surface's normal, as its map tilted it, and the direction to the eye: 0 where it turns away from an eye
// that sees the surface from the side of `normal` or of its opposite. Normals of any length. eye: a point (w = 1), or the
// direction to it (w = 0, orthographic).
float view_cosine(vec3 tilted, vec3 normal, vec3 position, vec4 eye) {
  vec3 to_eye = eye.xyz - position * eye.w;
  float length2 = dot(tilted, tilted) * dot(to_eye, to_eye);
  float side = dot(normal, to_eye) < 0.0 ? -1.0 : 1.0;
  return length2 > 0.0 ? clamp(side * dot(tilted, to_eye) * inversesqrt(length2), 0.0, 1.0) : 1.0;
}
