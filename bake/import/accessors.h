// Accessors as numbers.
#pragma once

#include "bake/import/buffers.h"

namespace oriel::gltf {

// Decodes on demand and keeps the result, as many primitives may share one accessor.
class AccessorReader {
 public:
  AccessorReader(const Document& document, const BufferStore& buffers, MemoryBudget& budget)
      : document_(document), buffers_(buffers), budget_(budget), cache_(document.accessors.size()) {}

  const AccessorDesc& desc(int accessor) const { return document_.accessors[static_cast<std::size_t>(accessor)]; }

  MemoryBudget& budget() { return budget_; }

  // count * components floats, matrices column by column; normalised integers as glTF 2.0 §3.11 maps them; sparse
  // elements substituted. Error kInvalid where a float is not finite, or zeros without bytes are asked for without
  // measure.
  Result<std::span<const float>> floats(int accessor);
  // Scalars of an unsigned type. Error kInvalid for other types.
  Result<std::vector<std::uint32_t>> indices(int accessor);
  // Error kInvalid where an accessor that nobody has read holds a float that is not finite.
  Status check_unread();

 private:
  std::string where(int accessor) const { return fmt::format("{}: accessors[{}]", document_.file, accessor); }
  // Calls element(i, bytes) for each stored element and then for each sparse one.
  template <class Element>
  Status for_each(int accessor, const Element& element);
  Result<std::vector<float>> decode(int accessor);

  const Document& document_;
  const BufferStore& buffers_;
  MemoryBudget& budget_;
  std::vector<std::optional<std::vector<float>>> cache_;
};

}  // namespace oriel::gltf
