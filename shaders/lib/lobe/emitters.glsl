// The share of emitters that a point of a reflector sees, from a grid of nodes over its bounds (formats/assets/radiance_map.h).

// grids: one above the other, each `nodes` large. place: of the point in the bounds, [0,1].
float visible_share(sampler2D grids, ivec2 nodes, int emitter, vec2 place) {
  vec2 at = clamp(place, 0.0, 1.0) * vec2(nodes - 1);
  ivec2 low = min(ivec2(at), nodes - 2);
  vec2 t = at - vec2(low);
  ivec2 node = low + ivec2(0, emitter * nodes.y);
  float a = texelFetch(grids, node, 0).r, b = texelFetch(grids, node + ivec2(1, 0), 0).r;
  float c = texelFetch(grids, node + ivec2(0, 1), 0).r, d = texelFetch(grids, node + ivec2(1, 1), 0).r;
  return mix(mix(a, b, t.x), mix(c, d, t.x), t.y);
}
