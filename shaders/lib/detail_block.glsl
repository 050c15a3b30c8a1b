// Where the image of details holds a cell of the lightmap (formats/assets/lightmap.h).
struct DetailBlock {
  vec2 first;  // of its points
  float side;  // steps along a side; 1: the cell has no points of its own
};

DetailBlock detail_block(uint code) {
  return DetailBlock(vec2(code & 0x3fffu, code >> 14u & 0x3fffu), float(1u << (code >> 28u)));
}
