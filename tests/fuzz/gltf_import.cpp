// The glTF importer against any bytes, .gltf or .glb. The mutator changes the JSON or the binary chunk of a .glb and
// puts the lengths right, so that mutations get past the container.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>

#include "bake/import/container.h"
#include "bake/import/import.h"
#include "formats/core/check.h"
#include "tests/bake/import/gltf_maker.h"
#include "tests/support/temporary_folder.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace oriel;

// Enough for every seed; a file that asks for more is refused and costs the fuzzer no time.
constexpr std::uint64_t kMaxBytes = std::uint64_t{64} << 20;

Bytes mutated(std::span<const std::byte> from) {
  Bytes bytes(from.begin(), from.end());
  bytes.resize(from.size() + 256);
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), from.size(), bytes.size()));
  return bytes;
}

void put_chunk(ByteWriter& out, std::uint32_t type, const Bytes& content, std::byte padding) {
  Bytes padded = content;
  padded.resize((content.size() + 3) / 4 * 4, padding);
  out.put(static_cast<std::uint32_t>(padded.size()));
  out.put(type);
  out.put_array(std::span<const std::byte>(padded));
}

Bytes glb(const Bytes& json, const std::optional<Bytes>& binary) {
  ByteWriter chunks;
  put_chunk(chunks, 0x4E4F534A, json, std::byte{' '});
  if (binary) put_chunk(chunks, 0x004E4942, *binary, std::byte{0});
  ByteWriter out;
  out.put(std::uint32_t{0x46546C67});
  out.put(std::uint32_t{2});
  out.put(static_cast<std::uint32_t>(12 + chunks.bytes().size()));
  out.put_array(std::span<const std::byte>(chunks.bytes()));
  return out.take();
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  std::minstd_rand random(seed);
  const auto parts = gltf::split_container(std::as_bytes(std::span(data, size)), "fuzz");
  if (!parts || data[0] != 'g' || random() % 16 == 0) return LLVMFuzzerMutate(data, size, max_size);
  Bytes json(parts->json.begin(), parts->json.end());
  std::optional<Bytes> binary;
  if (parts->binary) binary.emplace(parts->binary->begin(), parts->binary->end());
  if (binary && random() % 4 == 0)
    binary = mutated(*binary);
  else
    json = mutated(json);
  const Bytes result = glb(json, binary);
  if (result.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, result.data(), result.size());
  return result.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const testing::TemporaryFolder folder;
  static const std::filesystem::path path = folder.path() / "scene.glb";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ORIEL_CHECK(file && std::fwrite(data, 1, size, file) == size && std::fclose(file) == 0);
  Context context;
  context.threads = 1;
  ImportOptions options;
  options.max_bytes = kMaxBytes;
  const auto scene = import_gltf(path, options, context);
  if (scene)
    ORIEL_CHECK_EQ(test::broken_promise(scene->scene), "");
  else
    ORIEL_CHECK(!scene.error().message.empty());
  return 0;
}
