// Light of a vertex from its transfer (formats/assets/transfer.h) and the table of its mover's light
// (player/movers/mover_light.h): irradiance over pi.
const int kWeightsWidth = 2048;  // texels a row

// q: where the vertex is in its mover's box, [-1,1].
vec3 transferred_light(isampler2D weights, sampler2D table, int components, int vertex, int cluster, vec3 q) {
  vec4 red = texelFetch(table, ivec2(0, cluster), 0);
  vec4 green = texelFetch(table, ivec2(1, cluster), 0);
  vec4 blue = texelFetch(table, ivec2(2, cluster), 0);
  int first = vertex * ((components + 3) / 4);
  for (int k = 0; k < components; k += 4) {
    int at = first + k / 4;
    vec4 w = vec4(texelFetch(weights, ivec2(at % kWeightsWidth, at / kWeightsWidth), 0)) / 32767.0;
    for (int i = 0; i < 4; ++i) {
      int texel = 3 * (k + i + 1);
      if (k + i >= components) break;
      red += w[i] * texelFetch(table, ivec2(texel, cluster), 0);
      green += w[i] * texelFetch(table, ivec2(texel + 1, cluster), 0);
      blue += w[i] * texelFetch(table, ivec2(texel + 2, cluster), 0);
    }
  }
  vec4 at = vec4(1.0, q);
  return vec3(dot(red, at), dot(green, at), dot(blue, at));
}
