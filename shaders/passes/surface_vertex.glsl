// A vertex of a surface that is shaded: opaque or see-through.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_uv;
layout(location = 3) in vec2 a_lightmap_uv;
layout(location = 4) in vec4 a_color;
layout(location = 5) in vec2 a_normal_uv;
layout(location = 6) in vec4 a_tangent;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;
centroid out vec3 v_normal;
out vec2 v_uv;
centroid out vec3 v_lightmap_uv;  // lib/lightmap_uv.glsl
#ifdef SHARP
centroid out vec3 v_lit_position;  // likewise
#endif
out vec4 v_color;
out vec2 v_normal_uv;
out vec4 v_tangent;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = a_position;
  v_normal = a_normal;
  v_uv = a_uv;
  v_lightmap_uv = vec3(a_lightmap_uv, 1.0 + float(min(gl_VertexID, 0)));  // 1 that no driver takes for a constant
#ifdef SHARP
  v_lit_position = a_position;
#endif
  v_color = a_color;
  v_normal_uv = a_normal_uv;
  v_tangent = a_tangent;
}
