// The pack reader against any bytes: a pack or a Result that says why not, and the same answer whether images are
// decoded at once or when they are wanted.
#include <cstdint>
#include <cstdio>

#include "formats/core/check.h"
#include "formats/pack/deferred.h"
#include "formats/pack/reader.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oriel;

bool loads(const Result<DeferredPack>& pack) {
  if (!pack) return false;
  const Pack& p = pack->pack;
  const DeferredImages& images = *pack->images;
  const auto all = [](std::size_t count, const auto& load) {
    bool good = true;
    for (std::size_t i = 0; i < count; ++i) good = load(i).has_value() && good;
    return good;
  };
  const bool good = all(p.textures.size(), [&](std::size_t i) { return images.texture(i); }) &&
                    all(p.normal_textures.size(), [&](std::size_t i) { return images.normal_texture(i); }) &&
                    all(p.radiance_maps.size(), [&](std::size_t i) { return images.radiance_map(i); }) &&
                    all(p.surround_maps.size(), [&](std::size_t i) { return images.surround_map(i); }) &&
                    all(images.sections(), [&](std::size_t i) { return images.check(i); });
  return all(p.lightmaps.size(),
             [&](std::size_t i) {
               const auto whole = images.lightmap(i);
               // Light is a part of the page: whole pages have it.
               ORIEL_CHECK(!whole || images.light(i));
               return whole;
             }) &&
         good;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto pack = decode_pack(std::as_bytes(std::span(data, size)));
  if (!pack) ORIEL_CHECK(!pack.error().message.empty() && !pack.error().where.empty());
  static const testing::TemporaryFolder folder;
  static const std::filesystem::path path = folder.path() / "a.oriel";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ORIEL_CHECK(file && std::fwrite(data, 1, size, file) == size && std::fclose(file) == 0);
  ORIEL_CHECK_EQ(loads(open_pack(path)), read_pack(path).has_value());
  return 0;
}
