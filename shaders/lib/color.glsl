// Colour: linear Rec. 709 everywhere; sRGB only at the screen. The same as formats/core/color.h.

float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }

// IEC 61966-2-1, per channel, [0,1] to [0,1].
vec3 srgb_from_linear(vec3 linear) {
  vec3 low = 12.92 * linear;
  vec3 high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(high, low, vec3(lessThanEqual(linear, vec3(0.0031308))));
}

vec3 linear_from_srgb(vec3 shown) {
  vec3 low = shown / 12.92;
  vec3 high = pow((max(shown, vec3(0.04045)) + 0.055) / 1.055, vec3(2.4));
  return mix(high, low, vec3(lessThanEqual(shown, vec3(0.04045))));
}
