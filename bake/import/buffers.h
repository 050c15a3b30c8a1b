// The bytes behind buffers and buffer views.
#pragma once

#include <filesystem>

#include "bake/import/container.h"
#include "bake/import/document.h"

namespace oriel::gltf {

using InputHashes = std::vector<std::pair<std::string, std::string>>;

// Counts what an import holds in memory, so that a small hostile file cannot ask for all of it.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t bytes) : left_(bytes) {}
  // Error kInvalid where more than the rest is asked for.
  Status take(std::uint64_t bytes, const std::string& where);
  std::uint64_t left() const { return left_; }

 private:
  std::uint64_t left_;
};

class BufferStore {
 public:
  // Reads data URIs and files beside `folder`, and decompresses EXT_meshopt_compression. `binary` must outlive the
  // store. Error kInvalid where a buffer is missing, unreadable or shorter than it says, or a compressed view is
  // corrupt. The hashes of files read are appended to `inputs`.
  static Result<BufferStore> load(const Document& document, const Container& container,
                                  const std::filesystem::path& folder, MemoryBudget& budget, InputHashes& inputs);

  // The bytes of a view: exactly ViewDesc::length of them.
  std::span<const std::byte> view(int index) const { return views_[static_cast<std::size_t>(index)]; }

 private:
  std::vector<Bytes> storage_;
  std::vector<std::span<const std::byte>> views_;
};

// A file that the scene refers to; its hash is appended to `inputs`. Error kInvalid: the scene is at fault.
Result<Bytes> read_external(const std::string& uri, const std::filesystem::path& folder, const std::string& where,
                            MemoryBudget& budget, InputHashes& inputs);

}  // namespace oriel::gltf
