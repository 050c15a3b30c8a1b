#include "formats/export/web_folder.h"

#include <fmt/format.h>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/core/text.h"
#include "formats/export/pieces.h"
#include "formats/export/sha256.h"
#include "formats/export/viewer_files.h"

namespace oriel {
namespace {

// Every {{name}} of a text.
std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
  for (const auto& [name, value] : values) {
    const std::string mark = "{{" + name + "}}";
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += value.size())
      text.replace(at, mark.size(), value);
  }
  return text;
}

class FolderWriter {
 public:
  explicit FolderWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Status put(const std::string& name, std::span<const std::byte> bytes) {
    ORIEL_TRY_VOID(write_file_atomically(folder_ / name, bytes));
    out.files.push_back({name, bytes.size()});
    out.all_bytes += bytes.size();
    return {};
  }
  Status put(const std::string& name, std::string_view text) { return put(name, bytes_of_text(text)); }

  WebFolder out;

 private:
  std::filesystem::path folder_;
};

std::string short_hash(std::span<const std::byte> bytes) {
  std::string name;
  const auto digest = sha256(bytes);
  for (std::size_t i = 0; i < 8; ++i) name += fmt::format("{:02x}", digest[i]);
  return name;
}

Status make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(ErrorCode::kIo, folder.string(), "cannot be made: {}", error.message());
  return {};
}

// The pieces, and the manifest that names them.
Result<std::string> put_pieces(FolderWriter& writer, const Pack& pack, const WebOptions& options) {
  Json pieces = Json::array();
  const auto put = [&](WebPiece piece) -> Status {
    const std::string name = fmt::format("pieces/{}-{}.oriel", piece.kind, short_hash(piece.bytes));
    pieces.push_back({{"kind", piece.kind},
                      {"index", piece.index},
                      {"file", name},
                      {"bytes", piece.bytes.size()},
                      {"integrity", integrity_of(piece.bytes)}});
    ORIEL_TRY_VOID(writer.put(name, piece.bytes));
    if (piece.kind == "scene") writer.out.first_bytes = writer.out.all_bytes;
    return {};
  };
  ORIEL_TRY_VOID(make_pieces(pack, put));
  return Json({{"version", kWebVersion}, {"title", options.title}, {"pieces", pieces}}).dump(1) + "\n";
}

}  // namespace

Result<WebFolder> write_web_folder(const std::filesystem::path& folder, const Pack& pack, const WebOptions& options) {
  ORIEL_TRY_VOID(make_folder(folder / "pieces"));
  FolderWriter writer(folder);
  ORIEL_TRY(const std::string manifest, put_pieces(writer, pack, options));
  const Bytes script = bytes_of_text(viewer_file("app.js")), style = bytes_of_text(viewer_file("style.css"));
  const std::string number = short_hash(bytes_of_text(manifest));
  const std::string manifest_name = fmt::format("pieces-{}.json", number);
  const std::string script_name = fmt::format("app-{}.js", short_hash(script));
  const std::string style_name = fmt::format("style-{}.css", short_hash(style));
  const std::uint64_t before = writer.out.all_bytes;
  ORIEL_TRY_VOID(writer.put(script_name, script));
  ORIEL_TRY_VOID(writer.put(style_name, style));
  ORIEL_TRY_VOID(writer.put(manifest_name, manifest));
  std::string picture;
  if (!options.picture.empty()) {
    ORIEL_TRY_VOID(writer.put("picture.png", options.picture));
    picture = "<img src=\"picture.png\" alt=\"" + escaped(options.title) + "\">";
  }
  ORIEL_TRY_VOID(writer.put("licences.txt", viewer_file("licences.txt")));
  ORIEL_TRY_VOID(writer.put("icon.svg", viewer_file("icon.svg")));
  ORIEL_TRY_VOID(writer.put("offline.js", filled(std::string(viewer_file("offline.js")), {{"number", number}})));
  const std::string page =
      filled(std::string(viewer_file("index.html")), {{"picture", picture},
                                                      {"script", script_name},
                                                      {"script-integrity", integrity_of(script)},
                                                      {"style", style_name},
                                                      {"style-integrity", integrity_of(style)},
                                                      {"pieces", manifest_name},
                                                      {"pieces-integrity", integrity_of(bytes_of_text(manifest))},
                                                      {"title", escaped(options.title)}});
  ORIEL_TRY_VOID(writer.put("index.html", page));
  writer.out.first_bytes += writer.out.all_bytes - before - options.picture.size();
  return writer.out;
}

}  // namespace oriel
