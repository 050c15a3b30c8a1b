// What a light sees, as half of an octahedron that fills a square: the same maths as player/movers/hemisphere_map.h.

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
