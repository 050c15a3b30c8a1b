// A binary glTF file in the making (glTF 2.0 §4.4): JSON, and one buffer for everything.
#pragma once

#include <cstdint>
#include <span>

#include "formats/core/bytes.h"
#include "formats/core/json.h"
#include "formats/core/result.h"
#include "formats/core/vec.h"

namespace oriel {

class Glb {
 public:
  Json json = {{"asset", {{"version", "2.0"}, {"generator", "oriel-inspect"}}}};

  // Accessors by their number. Positions get the bounds that glTF wants of them.
  std::size_t add_positions(std::span<const Vec3> values);
  std::size_t add_vectors(std::span<const Vec3> values);
  std::size_t add_vectors(std::span<const Vec2> values);
  std::size_t add_colors(std::span<const std::uint32_t> rgba8);
  std::size_t add_indices(std::span<const std::uint32_t> values);
  // An image by its number.
  std::size_t add_png(const std::string& name, std::span<const std::byte> png);
  // Appends to a top-level array; the number of the element.
  std::size_t add(const char* array, Json element);
  // Names the extension as used.
  void uses(const char* extension);

  // Errors: kInvalid where the file would be 4 GiB or more, which its header cannot say.
  Result<Bytes> file() const;

 private:
  std::size_t add_view(std::span<const std::byte> bytes, int target);
  std::size_t add_accessor(std::span<const std::byte> bytes, int target, int component, std::size_t count,
                           const char* type);
  ByteWriter binary_;
};

}  // namespace oriel
