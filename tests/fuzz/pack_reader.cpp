// The pack reader against any bytes: a pack or a Result that says why not.
#include <cstdint>

#include "formats/core/check.h"
#include "formats/pack/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto pack = oriel::decode_pack(std::as_bytes(std::span(data, size)));
  if (!pack) ORIEL_CHECK(!pack.error().message.empty() && !pack.error().where.empty());
  return 0;
}
