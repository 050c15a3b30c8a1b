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

// Irradiance over 2 pi m under an even hemisphere and a lamp in direction `towards`, whose length is its share. The part of
// a tilted lobe that is below the surface counts above it.
float light_on(vec3 normal, vec3 g, float lamp, vec3 towards) {
  vec3 mirrored = normal - 2.0 * dot(normal, g) * g;
  return 1.0 - lamp + 2.0 * (max(dot(towards, normal), 0.0) + max(dot(towards, mirrored), 0.0));
}

// E(n) / E(g) of a directional lightmap's d (formats/assets/lightmap.h).
float directional_ratio(vec3 d, vec3 n, vec3 g) {
  vec3 off = d - 0.5 * g;
  float h = 0.5 - dot(d, g);
  float lamp = clamp((sqrt(h * h + 3.0 * dot(off, off)) - h) / 1.5, 0.0, 1.0);
  vec3 towards = off + 0.5 * lamp * g;
  float untilted = light_on(g, g, lamp, towards);
  return max(1.0 + (light_on(n, g, lamp, towards) - untilted) / max(untilted, 0.1), 0.0);
}
