// A vertex of a mover with its light.
#include "lib/transfer.glsl"

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_uv;
layout(location = 4) in vec4 a_color;
layout(location = 5) in vec2 a_normal_uv;
layout(location = 6) in vec4 a_tangent;
layout(location = 7) in float a_cluster;
uniform mat4 u_clip_from_pack;  // from the object, as passes/depth.vert takes it
uniform mat4 u_pack_from_object;
uniform vec3 u_box_center;
uniform vec3 u_box_scale;  // one over half its size, 0 where flat
uniform isampler2D u_codes;
uniform sampler2D u_table;
uniform int u_components;
invariant gl_Position;
out vec3 v_position;
centroid out vec3 v_normal;
out vec2 v_uv;
out vec4 v_color;
out vec2 v_normal_uv;
out vec4 v_tangent;
out vec3 v_light;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = (u_pack_from_object * vec4(a_position, 1.0)).xyz;
  v_normal = mat3(u_pack_from_object) * a_normal;
  v_uv = a_uv;
  v_color = a_color;
  v_normal_uv = a_normal_uv;
  v_tangent = vec4(mat3(u_pack_from_object) * a_tangent.xyz, a_tangent.w);
  vec3 q = (a_position - u_box_center) * u_box_scale;
  v_light = transferred_light(u_codes, u_table, u_components, gl_VertexID, int(a_cluster + 0.5), q);
}
