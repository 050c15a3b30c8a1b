// What `oriel-inspect validate` does with any bytes. A pack that it calls valid can be written, read again, and written
// to the same bytes.
#include <cstdint>

#include "formats/core/check.h"
#include "formats/pack/reader.h"
#include "formats/pack/writer.h"

namespace {

bool has_errors(const std::vector<oriel::Issue>& issues) {
  for (const auto& issue : issues)
    if (issue.severity == oriel::Severity::kError) return true;
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto checked = oriel::check_pack(std::as_bytes(std::span(data, size)));
  if (!checked || has_errors(checked->issues)) return 0;
  const auto written = oriel::encode_pack(*checked->pack);
  ORIEL_CHECK(written);
  const auto read = oriel::decode_pack(*written);
  ORIEL_CHECK(read);
  const auto again = oriel::encode_pack(*read);
  ORIEL_CHECK(again && *again == *written);
  return 0;
}
