// A radiance map's light on its triangles.
uniform sampler2DArray u_light;      // of the maps, over u_light_scale
uniform sampler2DArray u_disparity;
uniform vec2 u_size;                 // of the map, pixels
uniform float u_layer;
uniform float u_light_scale;
uniform vec4 u_depth_row;  // view-space -z of a mirrored point = dot(row, point)
uniform float u_ortho;     // 1: distances run along the view direction
uniform float u_closest;   // 1 / distance is never stored smaller: marks the sky as seen
in vec3 v_place;
in vec4 v_point;
layout(location = 0) out vec4 o_light;

// Of disparity, in pixels of shift seen from as far away as the element is wide: beside another surface, whose light is not mixed in.
const float kOfCodes = 65535.0 / 32767.0;  // 16 bits hold a disparity as a share of it
const float kMixed = 0.5;

// The nearest of the pixels around that lies on the same plane (its disparity's slope by pixel); x < 0: none does.
vec2 own_pixel(vec2 at, float disparity, vec2 slope) {
  ivec2 middle = ivec2(floor(at));
  vec2 best = vec2(-1.0);
  float least = 1e30;
  for (int i = 0; i < 9; ++i) {
    ivec2 pixel = clamp(middle + ivec2(i % 3, i / 3) - 1, ivec2(0), ivec2(u_size) - 1);
    vec2 away = vec2(pixel) + 0.5 - at;
    float off = kOfCodes * texelFetch(u_disparity, ivec3(pixel, int(u_layer)), 0).r - disparity - dot(slope, away);
    if (abs(off) * max(u_size.x, u_size.y) <= kMixed && dot(away, away) < least) {
      least = dot(away, away);
      best = vec2(pixel) + 0.5;
    }
  }
  return best;
}

void main() {
  vec3 dx = dFdx(v_place), dy = dFdy(v_place);
  float area = dx.x * dy.y - dx.y * dy.x;
  vec2 slope = vec2(dx.z * dy.y - dy.z * dx.y, dy.z * dx.x - dx.z * dy.x) / (abs(area) < 1e-12 ? 1e-12 : area);
  vec2 at = v_place.xy;
  vec2 inside = clamp(at, vec2(0.5), u_size - 0.5);
  float mixed = kOfCodes * textureLod(u_disparity, vec3(inside / vec2(textureSize(u_disparity, 0).xy), u_layer), 0.0).r;
  if (abs(mixed - v_place.z) * max(u_size.x, u_size.y) > kMixed) {
    at = own_pixel(at, v_place.z, slope);
    if (at.x < 0.0) discard;  // nothing the map saw tells of it
  }
  // Of a pixel that is long in the map, half way between its sides.
  float level = 0.25 * log2(max(dot(dx.xy, dx.xy), 1e-12) * max(dot(dy.xy, dy.xy), 1e-12));
  float coarsest = floor(log2(max(u_size.x, u_size.y)) + 1e-3);
  level = clamp(level, 0.0, coarsest);
  float texel = exp2(ceil(level));  // beyond the map's own texels of a level lies nothing
  vec2 last = (max(floor(u_size / texel), 1.0) - 0.5) * texel;
  vec3 uv = vec3(clamp(at, vec2(0.5 * texel), last) / vec2(textureSize(u_light, 0).xy), u_layer);
  float away = u_ortho > 0.5 ? dot(u_depth_row, v_point) : length(v_point.xyz);
  float inverse = v_point.w / max(away, 1e-30);
  o_light = vec4(textureLod(u_light, uv, level).rgb * u_light_scale, clamp(inverse, u_closest, 1e18));
}
