// Tone curves: linear light, 1 = the luminance that the exposure maps to white, to linear display values in [0,1].

// Plain exposure: clips.
vec3 tonemap_none(vec3 light) { return clamp(light, 0.0, 1.0); }

// Narkowicz 2016, "ACES Filmic Tone Mapping Curve": a fit per channel.
vec3 tonemap_aces(vec3 light) {
  vec3 x = clamp(light, 0.0, 1e4);  // the curve is flat long before, and squares must stay finite
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// Walls lit by a far lamp change by less than a step of the display over a metre: rounded alone they show contours.
// Between -1/2 and 1/2 of a step; Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare".
float dither(vec2 pixel) {
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
}
