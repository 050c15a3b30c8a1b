// A texture whose pixels are ready, so that who draws only has to hand them over: at once, or some rows at a time.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "player/gpu/texture.h"

namespace oriel {

struct TextureData {
  // Whole rows from the left edge of a layer's level.
  struct Block {
    int level = 0, layer = 0, row = 0, width = 0, height = 0;
    std::shared_ptr<const void> pixels{};
  };
  gpu::TextureFormat format;
  int width = 1, height = 1;
  int layers = 0;  // of an array; 0: a plain texture, whose blocks are as wide as their levels
  gpu::TextureOptions options;
  std::vector<Block> blocks;

  // `block` without its pixels, and those.
  template <class T>
  void add(Block block, std::vector<T> pixels) {
    auto kept = std::make_shared<const std::vector<T>>(std::move(pixels));
    const void* first = kept->data();
    block.pixels = {std::move(kept), first};
    blocks.push_back(std::move(block));
  }
  // On the device.
  std::size_t bytes() const;
};

// Hands TextureData over.
class TextureUpload {
 public:
  // Allocates the texture; its contents are undefined until step() says that all is there.
  explicit TextureUpload(TextureData data);
  // Some more rows, of at most `bytes` and at least one; true once all is there.
  bool step(std::size_t bytes);

  gpu::Texture2d texture;   // of data with layers 0
  gpu::TextureArray array;  // else

 private:
  TextureData data_;
  std::size_t block_ = 0;
  int row_ = 0;  // of the block
};

}  // namespace oriel
