// A binary glTF file in the making (glTF 2.0 §4.4): JSON, and one buffer for everything.
#pragma once

#include <cstdint>
#include <span>

#include "formats/core/bytes.h"
#include "formats/core/json.h"
#include "formats/core/result.h"
#include "formats/core/vec.h"

namespace oriel {

// The words of its header and of its chunks' headers: "glTF", "JSON", "BIN\0".
enum GlbWord : std::uint32_t { kGlbMagic = 0x46546C67, kGlbJson = 0x4E4F534A, kGlbBinary = 0x004E4942 };

class Glb {
 public:
  // glTF 2.0, 3.6.2.2 and 5.11.5.
  enum Component { kBytes = 5121, kUint16 = 5123, kUint32 = 5125, kFloats = 5126 };
  enum Target { kNoTarget = 0, kVertices = 34962, kIndices = 34963 };

  Json json = {{"asset", {{"version", "2.0"}, {"generator", "oriel-inspect"}}}};

  // Accessors by their number. Positions get the bounds that glTF wants of them.
  std::size_t add_positions(std::span<const Vec3> values);
  std::size_t add_vectors(std::span<const Vec3> values);
  std::size_t add_vectors(std::span<const Vec2> values);
  std::size_t add_colors(std::span<const std::uint32_t> rgba8);
  std::size_t add_indices(std::span<const std::uint32_t> values);
  std::size_t add_accessor(std::span<const std::byte> bytes, int target, int component, std::size_t count,
                           const char* type);
  // An image by its number; a PNG unless told.
  std::size_t add_image(const std::string& name, std::span<const std::byte> bytes, const char* type = "image/png");
  // Appends to a top-level array; the number of the element.
  std::size_t add(const char* array, Json element);
  // Names the extension as used.
  void uses(const char* extension);

  // Errors: kInvalid where the file would be 4 GiB or more, which its header cannot say.
  Result<Bytes> file() const;

 private:
  std::size_t add_view(std::span<const std::byte> bytes, int target);
  ByteWriter binary_;
};

}  // namespace oriel
