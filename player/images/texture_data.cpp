#include "player/images/texture_data.h"

#include <algorithm>

namespace oriel {
namespace {

std::size_t row_bytes(const TextureData& data, const TextureData::Block& block) {
  return static_cast<std::size_t>(block.width) * static_cast<std::size_t>(data.format.bytes_per_texel);
}

}  // namespace

std::size_t TextureData::bytes() const {
  std::size_t sum = 0;
  for (int level = 0; level < options.levels; ++level)
    sum +=
        static_cast<std::size_t>(std::max(1, width >> level)) * static_cast<std::size_t>(std::max(1, height >> level));
  return sum * static_cast<std::size_t>(std::max(layers, 1) * format.bytes_per_texel);
}

TextureUpload::TextureUpload(TextureData data) : data_(std::move(data)) {
  if (data_.layers > 0)
    array = {data_.format, data_.width, data_.height, data_.layers, data_.options};
  else
    texture = {data_.format, data_.width, data_.height, nullptr, data_.options};
}

bool TextureUpload::step(std::size_t bytes) {
  for (std::size_t done = 0; block_ < data_.blocks.size();) {
    TextureData::Block& block = data_.blocks[block_];
    const std::size_t of_row = row_bytes(data_, block);
    const auto fitting = static_cast<int>(
        std::min<std::size_t>((bytes - std::min(done, bytes)) / of_row, static_cast<std::size_t>(block.height - row_)));
    if (fitting == 0 && done > 0) return false;
    const int rows = std::max(fitting, 1);
    const auto* pixels = static_cast<const std::byte*>(block.pixels.get()) + of_row * static_cast<std::size_t>(row_);
    if (data_.layers > 0)
      array.upload(block.level, block.layer, block.row + row_, {block.width, rows}, pixels);
    else
      texture.upload(block.level, block.row + row_, rows, pixels);
    done += of_row * static_cast<std::size_t>(rows);
    row_ += rows;
    if (row_ < block.height) continue;
    block.pixels.reset();
    row_ = 0;
    ++block_;
  }
  return true;
}

}  // namespace oriel
