// A place on a page of the lightmap, interpolated at the centroid of what a triangle covers of a pixel: at its middle,
// beside the triangle, lies another chart's light. A driver may take the point's 1/w from the middle all the same (Mesa
// 22's llvmpipe does), which scales all that it interpolates there: the third component, 1 everywhere, tells by how
// much.
vec2 lightmap_uv(vec3 v) {
  return v.xy / v.z;
}

// Where the image of details holds a cell of the page (formats/assets/lightmap.h).
struct DetailBlock {
  vec2 first;  // of its points
  float side;  // steps along a side; 1: the cell has no points of its own
};

DetailBlock detail_block(uint code) {
  return DetailBlock(vec2(code & 0x3fffu, code >> 14u & 0x3fffu), float(1u << (code >> 28u)));
}
