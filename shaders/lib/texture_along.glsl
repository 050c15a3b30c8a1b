// A texture as a pixel sees it on a slanted surface: places in a row along the pixel's longer side, each as wide as its shorter one.
// Not a device's own anisotropic filter: llvmpipe's takes ten times the frame of a panelled staircase.
const float kMostPlaces = 8.0;

vec4 texture_along(sampler2D image, vec2 uv) {
  vec2 size = vec2(textureSize(image, 0)), dx = dFdx(uv), dy = dFdy(uv);
  float x = length(dx * size), y = length(dy * size);
  vec2 longer = x > y ? dx : dy;
  float most = max(x, y), places = floor(clamp(most / max(min(x, y), 1e-6) + 0.5, 1.0, min(kMostPlaces, max(most, 1.0))));
  float level = log2(max(most / places, 1e-6));
  if (places < 1.5) return textureLod(image, uv, level);
  vec4 sum = vec4(0.0);
  for (float i = 0.5; i < places; ++i) sum += textureLod(image, uv + (i / places - 0.5) * longer, level);
  return sum / places;
}
