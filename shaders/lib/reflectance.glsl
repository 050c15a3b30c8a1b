// R: the directional albedo of a material's specular lobe (formats/assets/fresnel_map.h).

// Linear between the entries of row `row`; entry i of count is at cos theta = (i / (count - 1))^2.
vec3 reflectance_from_table(sampler2D tables, int row, int count, float cos_theta) {
  float at = sqrt(clamp(cos_theta, 0.0, 1.0)) * float(count - 1);
  int low = min(int(at), max(count - 2, 0));
  vec3 a = texelFetch(tables, ivec2(low, row), 0).rgb;
  vec3 b = texelFetch(tables, ivec2(min(low + 1, count - 1), row), 0).rgb;
  return mix(a, b, at - float(low));
}
