// Normal maps: how a texel tilts a surface's normal, the same as formats/assets/normal_map.h.

// The tangent of a surface with unit normal n from two steps on it and the changes of the texture coordinates over them.
// xyz along dp/du, any length; w: the side of the bitangent w cross(n, xyz), which is that of -dp/dv (v down).
vec4 tangent_of_steps(vec3 n, vec3 step_a, vec3 step_b, vec2 uv_a, vec2 uv_b) {
  float turn = sign(uv_a.x * uv_b.y - uv_a.y * uv_b.x);
  vec3 along_u = turn * (uv_b.y * step_a - uv_a.y * step_b);
  vec3 along_v = turn * (uv_a.x * step_b - uv_b.x * step_a);
  return vec4(along_u, dot(cross(n, along_u), along_v) > 0.0 ? -1.0 : 1.0);
}

// The unit normal that the texel makes of the unit normal n; n itself where the tangent or the texel says nothing.
vec3 tilted_normal(vec3 n, vec4 tangent, vec3 texel, float scale) {
  vec3 size = abs(tangent.xyz);
  vec3 unit = tangent.xyz / max(max(size.x, max(size.y, size.z)), 1e-30);
  vec3 across = unit - dot(n, unit) * n;
  float across_length = length(across);
  if (!(across_length > 1e-6)) return n;
  vec3 t = across / across_length;
  vec3 b = tangent.w * cross(n, t);
  vec3 local = 2.0 * texel - 1.0;
  vec3 tilted = scale * (local.x * t + local.y * b) + max(local.z, 0.0) * n;
  float size2 = dot(tilted, tilted);
  return size2 > 1e-12 ? tilted / sqrt(size2) : n;
}

// E(n) / E(g) of a directional lightmap's d (formats/assets/lightmap.h).
float directional_ratio(vec3 d, vec3 n, vec3 g) {
  return max(1.0 + 2.0 * dot(d, n - g) / max(1.0 + 2.0 * dot(d, g), 1.0), 0.0);
}
