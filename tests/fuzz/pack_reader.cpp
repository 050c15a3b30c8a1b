// The pack reader against any bytes: a pack or a Result that says why not, and the same answer whether maps are decoded
// at once or when they are wanted.
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
  for (std::size_t i = 0; i < pack->pack.radiance_maps.size(); ++i)
    if (const auto map = pack->maps->load(i); !map) return false;
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto pack = decode_pack(std::as_bytes(std::span(data, size)));
  if (!pack) ORIEL_CHECK(!pack.error().message.empty() && !pack.error().where.empty());
  static const testing::TemporaryFolder folder;
  static const std::filesystem::path path = folder.path() / "a.oriel";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ORIEL_CHECK(file && std::fwrite(data, 1, size, file) == size && std::fclose(file) == 0);
  ORIEL_CHECK_EQ(loads(read_pack_deferred(path)), read_pack(path).has_value());
  return 0;
}
