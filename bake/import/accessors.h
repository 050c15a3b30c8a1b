// Accessors as numbers.
#pragma once

#include "bake/import/buffers.h"

namespace oriel::gltf {

// Decodes on demand and keeps the result, as many primitives may share one accessor.
class AccessorReader {
 public:
  AccessorReader(const Document& document, const BufferStore& buffers, MemoryBudget& budget)
      : document_(document),
        buffers_(buffers),
        budget_(budget),
        cache_(document.accessors.size()),
        not_finite_(document.accessors.size()) {}

  const AccessorDesc& desc(int accessor) const { return document_.accessors[static_cast<std::size_t>(accessor)]; }

  MemoryBudget& budget() { return budget_; }

  // count * components floats, matrices column by column; normalised integers as glTF 2.0 §3.11 maps them; sparse
  // elements substituted. Error kInvalid where a float is not finite, or zeros without bytes are asked for without
  // measure.
  Result<std::span<const float>> floats(int accessor);
  // The same with 0 for what is not finite. not_finite() tells how much that was.
  Result<std::span<const float>> finite_or_zero(int accessor);
  struct NotFinite {
    std::uint64_t count = 0, first = 0;  // components, and the element of the first
  };
  const NotFinite& not_finite(int accessor) const { return not_finite_[static_cast<std::size_t>(accessor)]; }
  // Scalars of an unsigned type. Error kInvalid for other types.
  Result<std::vector<std::uint32_t>> indices(int accessor);

 private:
  std::string where(int accessor) const { return fmt::format("{}: accessors[{}]", document_.file, accessor); }
  // Calls element(i, bytes) for each stored element and then for each sparse one.
  template <class Element>
  Status for_each(int accessor, const Element& element);
  Result<std::vector<float>> decode(int accessor, NotFinite& bad);

  const Document& document_;
  const BufferStore& buffers_;
  MemoryBudget& budget_;
  std::vector<std::optional<std::vector<float>>> cache_;
  std::vector<NotFinite> not_finite_;  // by accessor that was read
};

}  // namespace oriel::gltf
