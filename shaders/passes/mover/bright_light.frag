// What movers change of one bright light, lux: on a mover, the light that reaches it; on the scene around, the light that movers
// take from it, which its lightmap holds.
#include "lib/light_samples.glsl"
#include "lib/shadow_shaft.glsl"

const int kSamples = 16;
const int kMovers = 16;
const float kMapSize = 512.0;  // texels of a layer, shared by the samples

uniform sampler2D u_base_texture;
uniform float u_alpha;
uniform float u_alpha_cutoff;  // negative: no cut-outs
uniform vec4 u_at[kSamples];   // LightSamples
uniform int u_samples;
uniform int u_side;            // maps beside each other in a layer
uniform vec3 u_intensity;
uniform vec3 u_axis;
uniform vec2 u_cones;
uniform bool u_cosine;
uniform vec3 u_center;
uniform float u_radius;
uniform vec4 u_spheres[kMovers];  // around movers, by layer of the maps
uniform int u_movers;
uniform float u_reach;  // metres: Shaft's scene_range
uniform int u_receiver;  // layer of the mover that is drawn; -1: the scene; -2: a mover without shadows
uniform vec4 u_share;    // of the light, linear over the mover's box
uniform sampler2DArrayShadow u_mover_depth;
uniform sampler2DArrayShadow u_scene_depth;

in vec3 v_position;
in vec3 v_normal;
in vec3 v_in_box;
in vec2 v_uv;
in float v_alpha;
layout(location = 0) out vec4 o_lux;

// Whether the mover can stand between p and a part of the light.
bool may_block(vec4 sphere, vec3 p) {
  bool parallel = u_at[0].w == 0.0;
  vec3 to = parallel ? u_center : u_center - p;
  vec3 along = to / max(length(to), 1e-12);
  float t = max(dot(sphere.xyz - p, along), 0.0);
  if (!parallel) t = min(t, length(to));
  float wide = sphere.w + u_radius * (parallel ? t : 1.0);
  vec3 off = sphere.xyz - p - t * along;
  return dot(off, off) <= wide * wide;
}

// Share of the light that passes what a map holds; 1 outside of it.
float passes(sampler2DArrayShadow map, int layer, int i, int side, Shaft shaft, vec2 range, vec3 place) {
  if (max(abs(place.x), abs(place.y)) >= 1.0 || place.z <= range.x) return 1.0;
  float tile = kMapSize / float(side);
  vec2 corner = tile * vec2(float(i % side), float(i / side));
  vec2 texel = clamp((0.5 + 0.5 * place.xy) * tile, 0.5, tile - 0.5);
  return texture(map, vec4((corner + texel) / kMapSize, float(layer), shaft_depth(shaft, range, place.z)));
}

void main() {
  if (u_alpha_cutoff >= 0.0 && texture(u_base_texture, v_uv).a * u_alpha * v_alpha < u_alpha_cutoff) discard;
  o_lux = vec4(0.0);
  int blockers[kMovers];
  int count = 0;
  for (int m = 0; m < u_movers; ++m)
    if (m == u_receiver || may_block(u_spheres[m], v_position)) blockers[count++] = m;
  float length2 = dot(v_normal, v_normal);
  if ((u_receiver == -1 && count == 0) || length2 == 0.0) return;
  if (u_receiver == -2) count = 0;
  vec3 normal = v_normal * inversesqrt(length2);
  if (!gl_FrontFacing) normal = -normal;
  float sum = 0.0;
  for (int i = 0; i < u_samples; ++i) {
    vec3 towards;
    float lux = facing_irradiance(u_at[i], u_axis, u_cones, u_cosine, v_position, towards);
    float cosine = dot(normal, towards);
    if (!(cosine > 0.0 && lux > 0.0)) continue;
    float scene = 1.0, movers = 1.0;
    for (int k = 0; k < count; ++k) {
      int m = blockers[k];
      Shaft shaft = make_shaft(u_at[i], u_spheres[m]);
      // Texels of the map are that wide here: p leaves its surface by as much.
      float along = dot(v_position - shaft.from, shaft.frame[2]);
      float texel = 2.0 * shaft_width(shaft, along) * float(u_side) / kMapSize;
      vec3 place = in_shaft(shaft, v_position + texel * (normal * (2.0 - cosine) + towards));
      float blocked = passes(u_mover_depth, m, i, u_side, shaft, mover_range(shaft, u_spheres[m].w), place);
      if (u_receiver == m || (u_receiver == -1 && blocked < movers))
        scene = passes(u_scene_depth, m, i, u_side, shaft, scene_range(shaft, u_reach), place);
      movers = min(movers, blocked);
    }
    sum += lux * cosine * scene * (u_receiver == -1 ? 1.0 - movers : movers);
  }
  float share = u_receiver == -1 ? 1.0 : clamp(dot(u_share, vec4(1.0, v_in_box)), 0.0, 1.0);
  o_lux = vec4(u_intensity * (share * sum / float(u_samples)), 0.0);
}
