// The emitters that a glossy reflector's maps leave out (player/scene/gpu_emitters.h), as a pixel's lobe shows them.

// The share of a lobe of integral 1 that a polygon fills: the pass defines it. corners: relative to the pixel's point, frame as in
// lib/lobe_light.glsl. Positive on the polygon's bright side.
float share_of_polygon(vec4 lobe, vec3 corners[4]);

uniform sampler2D u_polygons;      // a row each: 12 coordinates of corners; light, and the emitter + 1, negative: both sides shine
uniform sampler2D u_visibility;    // by cell and emitter: the shares seen from the cell's corners
uniform usampler2D u_seen;         // by cell, 128 bits: k is set where polygon k is seen from any of its corners
uniform ivec2 u_cells;
uniform vec2 u_lower;              // bounds of the reflector
uniform vec2 u_upper;
uniform mat4 u_emitters_from_pack; // reflector space, in units of the reflector's size

float visible_share(int emitter, ivec2 cell, vec2 t) {
  vec4 nodes = texelFetch(u_visibility, cell + ivec2(0, emitter * u_cells.y), 0);
  vec2 sides = mix(nodes.xz, nodes.yw, t.x);
  return mix(sides.x, sides.y, t.y);
}

vec3 light_of_polygon(int k, vec4 lobe, vec2 place, vec2 x, ivec2 cell, vec2 t) {
  vec4 a = texelFetch(u_polygons, ivec2(0, k), 0), b = texelFetch(u_polygons, ivec2(1, k), 0);
  vec4 c = texelFetch(u_polygons, ivec2(2, k), 0), light = texelFetch(u_polygons, ivec2(3, k), 0);
  vec3 corners[4] = vec3[4](a.xyz, vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw);
  for (int i = 0; i < 4; ++i) {
    vec2 v = corners[i].xy - place;
    corners[i].xy = vec2(dot(v, x), dot(v, vec2(-x.y, x.x)));
  }
  float share = share_of_polygon(lobe, corners);
  float shown = light.a < 0.0 ? abs(share) : max(share, 0.0);
  return visible_share(int(abs(light.a)) - 1, cell, t) * shown * light.rgb;
}

vec3 light_of_emitters(vec4 lobe) {
  vec2 place = (u_emitters_from_pack * vec4(v_position, 1.0)).xy;
  vec2 to_eye = (mat3(u_emitters_from_pack) * (u_eye.xyz - v_position * u_eye.w)).xy;
  vec2 x = dot(to_eye, to_eye) > 0.0 ? normalize(to_eye) : vec2(1.0, 0.0);
  vec2 at = clamp((place - u_lower) / (u_upper - u_lower), 0.0, 1.0) * vec2(u_cells);
  ivec2 cell = min(ivec2(at), u_cells - 1);
  uvec4 words = texelFetch(u_seen, cell, 0);
  vec3 sum = vec3(0.0);
  for (int word = 0; word < 4; ++word) {
    int k = 32 * word;
    for (uint seen = words[word]; seen != 0u; seen >>= 1, ++k)
      if ((seen & 1u) != 0u) sum += light_of_polygon(k, lobe, place, x, cell, at - vec2(cell));
  }
  return sum;
}
