#include "formats/core/file.h"
#include "formats/core/hash.h"
#include "formats/core/json.h"
#include "formats/inspect/commands.h"

namespace oriel::inspect {

// The first input is the scene itself, whatever it is called now; the others lie beside it. Skies and profiles are
// known by their names alone and are looked for there too.
Result<std::vector<std::string>> changed_inputs(const Pack& pack, const std::filesystem::path& scene) {
  const Json provenance = Json::parse(pack.provenance).value_or(Json());
  const Json inputs = provenance.is_object() ? provenance.value("inputs", Json()) : Json();
  if (!inputs.is_array() || inputs.empty())
    return invalid("provenance", "found no hashes of inputs, expected a list: nothing is known of what was baked");
  std::vector<std::string> changed;
  for (const Json& input : inputs) {
    const auto text = [&](const char* key) {
      return input.is_object() && input.contains(key) && input[key].is_string() ? input[key].get<std::string>() : "";
    };
    const std::string name = text("name"), expected = text("xxh3_128");
    const auto path = &input == &inputs.front() ? scene : scene.parent_path() / name;
    const auto bytes = read_file(path);
    if (!bytes && &input == &inputs.front()) return tl::unexpected(bytes.error());
    const std::string found = bytes ? hash128_hex(*bytes) : bytes.error().message;
    if (found != expected)
      changed.push_back(fmt::format("{}: found {}, when it was baked {}", path.string(), found, expected));
  }
  return changed;
}

}  // namespace oriel::inspect
