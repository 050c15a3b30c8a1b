#include "trade/store.h"

#include "formats/core/file.h"
#include "formats/core/hash.h"
#include "formats/core/json.h"

namespace oriel::trade {
namespace {
namespace fs = std::filesystem;

std::string hash_text(const std::string& text) {
  return hash128_hex(std::as_bytes(std::span(text)));
}

// Buffers and images that a .gltf keeps in files of their own. What is broken in it the bake will tell.
std::vector<fs::path> named_files(const fs::path& scene, std::span<const std::byte> bytes) {
  if (scene.extension() != ".gltf") return {};
  const auto json = Json::parse(bytes).value_or(Json());
  std::vector<fs::path> files;
  for (const char* kind : {"buffers", "images"}) {
    if (!json.is_object() || !json.contains(kind) || !json[kind].is_array()) continue;
    for (const auto& item : json[kind])
      if (item.is_object() && item.contains("uri") && item["uri"].is_string())
        files.push_back(scene.parent_path() / item["uri"].get<std::string>());
  }
  return files;
}

}  // namespace

std::string Store::key(const std::vector<std::string>& what) const {
  std::string text = inputs_;
  for (const std::string& part : what) text += '\n' + part;
  return hash_text(text);
}

fs::path Store::file(const std::string& key, const std::string& ending) const {
  return folder_ / (key + ending);
}

std::optional<Measures> Store::find(const std::string& key) const {
  const auto bytes = read_file(file(key, ".json"));
  if (!bytes) return {};
  auto measures = measures_from_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!measures) return {};  // a broken file is work that is not finished
  return std::move(*measures);
}

Status Store::keep(const std::string& key, const Measures& measures) const {
  const std::string text = as_json(measures).dump(1) + "\n";
  return write_text_atomically(file(key, ".json"), text);
}

Result<std::string> hash_of(const fs::path& scene, const std::vector<std::string>& options,
                            const std::vector<fs::path>& programs) {
  ORIEL_TRY(const Bytes bytes, read_file(scene));
  std::string all = hash128_hex(bytes);
  std::vector<fs::path> files = named_files(scene, bytes);
  for (const std::string& option : options) {
    all += '\n' + option;
    const std::size_t equals = option.find('=');
    files.push_back(equals == std::string::npos ? option : option.substr(equals + 1));
  }
  for (const fs::path& file : files)
    if (const auto content = read_file(file)) all += hash128_hex(*content);
  for (const fs::path& program : programs) {
    ORIEL_TRY(const Bytes code, read_file(program));
    all += hash128_hex(code);
  }
  return hash_text(all);
}

}  // namespace oriel::trade
