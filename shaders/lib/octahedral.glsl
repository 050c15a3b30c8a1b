// Directions on a square, the same maths as formats/core/octahedral.h, and the levels of a map of it in one image with borders
// (player/images/surround_pyramid.h).

// The point of [-1, 1]^2 of a direction of any length but 0.
vec2 octahedral_from_direction(vec3 d) {
  vec2 p = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
  if (d.z >= 0.0) return p;
  return (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
}

// Texels of a map of that size in a radian around a unit direction, the mean of both ways.
float octahedral_density(vec3 d, int size) { return 0.5 * float(size) * pow(abs(d.x) + abs(d.y) + abs(d.z), -1.5); }

// Where point p of the map lies at a level of the image.
vec2 pyramid_uv(vec2 p, int size, int level, vec2 image_size) {
  vec2 corner = level == 0 ? vec2(0.0) : vec2(float(size + 2), float(size - (size >> (level - 1)) + 2 * (level - 1)));
  return (corner + 1.0 + (0.5 * p + 0.5) * float(size >> level)) / image_size;
}

// Light from a direction, between two levels.
vec3 pyramid_light(sampler2D light, int size, vec3 direction, float level) {
  vec2 p = octahedral_from_direction(direction), image_size = vec2(textureSize(light, 0));
  float at = clamp(level, 0.0, log2(float(size)));
  int low = int(at);
  vec3 fine = textureLod(light, pyramid_uv(p, size, low, image_size), 0.0).rgb;
  if (at <= float(low)) return fine;
  return mix(fine, textureLod(light, pyramid_uv(p, size, low + 1, image_size), 0.0).rgb, at - float(low));
}
