// Light that movers take from the scene, from a picture of half the frame's size: from the pixels around that are of the
// same surface.

// Lux. at: place in the picture, pixels. surfaces: LitSurface. p, n: position and unit normal here.
vec3 taken_light(sampler2D change, usampler2D surfaces, vec2 at, vec3 p, vec3 n) {
  vec2 first = floor(at - 0.5), part = at - 0.5 - first;
  ivec2 last = textureSize(change, 0) - 1;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 step = ivec2(i & 1, i >> 1);
    ivec2 texel = clamp(ivec2(first) + step, ivec2(0), last);
    vec2 near = mix(1.0 - part, part, vec2(step));
    vec3 off = uintBitsToFloat(texelFetch(surfaces, texel, 0).xyz) - p;
    float out_of_plane = dot(off, n);  // as the sine of an angle: 0 on the same plane
    float same = max(1.0 - 8.0 * out_of_plane * out_of_plane / max(dot(off, off), 1e-20), 1e-3);
    sum += near.x * near.y * same * vec4(texelFetch(change, texel, 0).rgb, 1.0);
  }
  return sum.rgb / max(sum.a, 1e-20);
}
