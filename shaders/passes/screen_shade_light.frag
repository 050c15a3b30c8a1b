// Light that movers take, of the lights of the cell of space that each pixel's surface lies in.
#include "lib/shade.glsl"

uniform usampler2D u_surfaces;
uniform sampler2D u_mask;  // 0: nothing is wanted here
uniform bool u_masked;
uniform sampler2D u_tree;  // of cells: the axis along which one is parted, where, the first of its parts; axis -1: a leaf
layout(location = 0) out vec4 o_lux;

const int kDeepest = 64;

int cell_at(vec3 p) {
  int cell = 0, width = textureSize(u_tree, 0).x;
  for (int depth = 0; depth < kDeepest; ++depth) {
    vec4 node = texelFetch(u_tree, ivec2(cell % width, cell / width), 0);
    if (node.x < 0.0) break;
    float place = node.x == 0.0 ? p.x : node.x == 1.0 ? p.y : p.z;
    cell = int(node.z) + (place >= node.y ? 1 : 0);
  }
  return cell;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (u_masked && texelFetch(u_mask, pixel, 0).r < 0.5) discard;
  LitSurface surface = unpack_surface(texelFetch(u_surfaces, pixel, 0));
  if (surface.id != 0) discard;
  int cell = cell_at(surface.position);
  o_lux = vec4(taken_light(list_at(2 * cell), list_at(2 * cell + 1), surface), 0.0);
}
