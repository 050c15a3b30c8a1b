// Marks the triangles of which a sample is seen, over the depth of the scene. Desktop OpenGL with storage buffers.
#extension GL_ARB_shader_image_load_store : require
#extension GL_ARB_shader_storage_buffer_object : require
layout(early_fragment_tests) in;
layout(std430) buffer Seen { uint b_seen[]; };
uniform int u_first;  // triangle of the draw

void main() { b_seen[u_first + gl_PrimitiveID] = 1u; }
