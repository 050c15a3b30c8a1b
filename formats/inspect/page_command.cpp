#include <fmt/format.h>

#include "formats/core/file.h"
#include "formats/inspect/commands.h"
#include "formats/pack/reader.h"
#include "formats/report/report.h"

namespace oriel::inspect {

int page(const std::filesystem::path& path, const std::filesystem::path& output) {
  const auto file = read_file(path);
  if (!file) return report(file.error());
  const auto index = read_index(*file);
  if (!index) return report({index.error().code, index.error().message, path.string() + ": " + index.error().where});
  const auto pack = read_pack(path);
  if (!pack) return report(pack.error());
  const std::string html = report::page_html(*pack, *index, path.filename().string());
  if (const auto written = write_file_atomically(output, bytes_of(html)); !written) return report(written.error());
  fmt::print("{}\n", output.string());
  return 0;
}

}  // namespace oriel::inspect
