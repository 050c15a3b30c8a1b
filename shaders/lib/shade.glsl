// Light that movers take from the scene, of lights that stand for all that comes from everywhere: what the lightmap holds of it is
// not there where a mover is nearer to the light, and nothing else is (Barczak 2006, section 4.3.2). What a light sees is half of
// an octahedron that fills a square: the same maths as player/movers/hemisphere_map.h.
#include "lib/lit_surface.glsl"

uniform sampler2D u_lights;
uniform usampler2D u_list;  // numbers, row by row
uniform sampler2DArrayShadow u_mover_depth;  // by light
uniform sampler2DArrayShadow u_still_depth;
uniform vec4 u_movers[16];  // spheres; far away: none

// A light that stands for surfaces (formats/query/scattered_lights.h), and its maps.
struct ShadeLight {
  vec3 from;
  float disk;      // m²/π of what it stands for
  vec3 intensity;  // cd along its normal; to all sides of the sky's
  bool sky;
  vec3 across, along;
  float squeeze, nearest, farthest;
};

ShadeLight fetch_light(sampler2D lights, int index) {
  vec4 a = texelFetch(lights, ivec2(0, index), 0), b = texelFetch(lights, ivec2(1, index), 0);
  vec4 c = texelFetch(lights, ivec2(2, index), 0), d = texelFetch(lights, ivec2(3, index), 0);
  return ShadeLight(a.xyz, abs(a.w), b.xyz, a.w < 0.0, c.xyz, d.xyz, b.w, c.w, d.w);
}

vec3 local_of(ShadeLight light, vec3 point) {
  vec3 p = point - light.from;
  return vec3(dot(light.across, p), dot(cross(light.along, light.across), p), light.squeeze * dot(light.along, p));
}

float height_of(vec3 local) { return abs(local.x) + abs(local.y) + local.z; }

// In [0, 1]² of the map and its depth there.
vec3 map_place(ShadeLight light, vec3 local) {
  float height = height_of(local);
  vec2 at = vec2(local.x + local.y, local.x - local.y) / height;
  float depth = light.farthest / (light.farthest - light.nearest) * (1.0 - light.nearest / max(height, light.nearest));
  return vec3(0.5 + 0.5 * at, min(depth, 1.0));
}

// Lux of a surface of that unit normal, as if nothing were between (formats/query/live_lights.h, unshadowed()).
vec3 unshadowed(ShadeLight light, vec3 point, vec3 normal) {
  vec3 to = light.from - point;
  float d2 = max(dot(to, to), 1e-20), inverse = inversesqrt(d2);
  float cosines = max(dot(normal, to) * inverse, 0.0) * (light.sky ? 1.0 : max(-dot(light.along, to) * inverse, 0.0));
  return light.intensity * (cosines / max(d2 + light.disk, 1e-8));
}

// Share of the light that a map lets through.
float passes(sampler2DArrayShadow map, int layer, ShadeLight light, vec3 local) {
  vec3 place = map_place(light, local);
  if (local.z <= 0.0 || min(place.x, place.y) < 0.0 || max(place.x, place.y) > 1.0) return 1.0;
  return texture(map, vec4(place.xy, float(layer), place.z));
}

float distance_to_mover(vec3 point) {
  float nearest = 1e30;
  for (int i = 0; i < 16; ++i) nearest = min(nearest, distance(point, u_movers[i].xyz));
  return nearest;
}

// Share of the light that movers take. The maps are of movers alone, so that no surface shades itself in them. A light stands for a
// disk: from some points of it, by what a mover that is so far away (metres) moves in the map.
float taken_of(int layer, ShadeLight light, LitSurface surface, float mover) {
  vec3 local = local_of(light, surface.position);
  float away = distance(light.from, surface.position);
  float wide = sqrt(light.disk) * min(mover / max(away - mover, 1e-6), 1.0);
  float angle = 2.4 * float(layer);
  vec2 x = 0.7 * wide * vec2(cos(angle), sin(angle)), y = vec2(-x.y, x.x);
  float open = passes(u_mover_depth, layer, light, local) + passes(u_mover_depth, layer, light, local + vec3(x, 0.0)) +
               passes(u_mover_depth, layer, light, local - vec3(x, 0.0)) + passes(u_mover_depth, layer, light, local + vec3(y, 0.0)) +
               passes(u_mover_depth, layer, light, local - vec3(y, 0.0));
  float taken = 1.0 - 0.2 * open;
  return taken > 0.0 ? taken * passes(u_still_depth, layer, light, local) : 0.0;
}

int list_at(int place) {
  int width = textureSize(u_list, 0).x;
  return int(texelFetch(u_list, ivec2(place % width, place / width), 0).x);
}

// Of so many lights in the list from there on, lux.
vec3 taken_light(int first, int count, LitSurface surface) {
  vec3 sum = vec3(0.0);
  float mover = distance_to_mover(surface.position);
  for (int i = 0; i < count; ++i) {
    int index = list_at(first + i);
    ShadeLight light = fetch_light(u_lights, index);
    vec3 lux = unshadowed(light, surface.position, surface.normal);
    if (max(lux.r, max(lux.g, lux.b)) > 0.0) sum += taken_of(index, light, surface, mover) * lux;
  }
  return sum;
}
