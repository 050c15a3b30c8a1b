// Boxes around cells of space, whatever lies beyond the near and far planes.
uniform mat4 u_clip_from_pack;
uniform usampler2D u_list;  // numbers, row by row
uniform int u_first_cell;   // of this pass, into the list
uniform sampler2D u_cells;  // by row: the cell's lower and upper corner, its box's
uniform vec4 u_view;        // scale and offset of the picture's place in the view
flat out vec3 v_lower;
flat out vec3 v_upper;

// Two triangles for each face, counter-clockwise from outside.
const int kCorners[36] = int[36](0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3,
                                 7, 1, 7, 5);

void main() {
  int at = u_first_cell + gl_InstanceID, width = textureSize(u_list, 0).x;
  int cell = int(texelFetch(u_list, ivec2(at % width, at / width), 0).x);
  v_lower = texelFetch(u_cells, ivec2(0, cell), 0).xyz;
  v_upper = texelFetch(u_cells, ivec2(1, cell), 0).xyz;
  int corner = kCorners[gl_VertexID];
  vec3 upper = vec3(corner & 1, corner >> 1 & 1, corner >> 2);
  gl_Position = u_clip_from_pack * vec4(mix(texelFetch(u_cells, ivec2(2, cell), 0).xyz, texelFetch(u_cells, ivec2(3, cell), 0).xyz, upper), 1.0);
  gl_Position.xy = u_view.xy * gl_Position.xy + u_view.zw * gl_Position.w;
  gl_Position.z = 0.0;
}
