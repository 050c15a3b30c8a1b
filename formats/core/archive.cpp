#include "formats/core/archive.h"

#include <cstring>

namespace oriel {

void Archive::raw(void* data, std::size_t size) {
  const std::span<const std::byte> bytes(static_cast<const std::byte*>(data), size);
  if (to_) to_->insert(to_->end(), bytes.begin(), bytes.end());
  if (hasher_) hasher_->add(bytes);
  if (!reading_) return;
  ok_ = ok_ && size <= from_.size();
  if (!ok_) return;
  if (size > 0) std::memcpy(data, from_.data(), size);
  from_ = from_.subspan(size);
}

std::uint64_t Archive::length(std::uint64_t count) {
  raw(&count, sizeof(count));
  return count;
}

}  // namespace oriel
