#include "player/navigation/path_file.h"

#include <algorithm>
#include <limits>

#include "formats/core/file.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

constexpr int kVersion = 1;
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 28;

// The three finite numbers of a member.
Result<DVec3> vector_of(const Json& key, const char* member, const std::string& where) {
  const Json* found = key.find(member);
  DVec3 out(0);
  bool good = found && found->is_array() && found->size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    good = (*found)[i].is_number();
    if (good) out[static_cast<int>(i)] = (*found)[i].get<double>();
  }
  if (!good) return invalid(where, "has no \"{}\" of three numbers", member);
  return out;
}

Result<double> number_of(const Json& object, const char* member, const std::string& where) {
  const Json* found = object.find(member);
  if (!found || !found->is_number()) return invalid(where, "has no number \"{}\"", member);
  return found->get<double>();
}

Result<CameraKey> read_key(const Json& json, const DVec3& origin, float last_time_s, const std::string& where) {
  CameraKey key;
  ORIEL_TRY(const double time, number_of(json, "t", where));
  ORIEL_TRY(const DVec3 eye, vector_of(json, "eye", where));
  ORIEL_TRY(const DVec3 forward, vector_of(json, "forward", where));
  key.time_s = static_cast<float>(time);
  key.eye = Vec3(eye - origin);
  key.forward = normalize_or(Vec3(forward), Vec3(0));
  if (!std::isfinite(key.time_s) || key.time_s < last_time_s)
    return invalid(where, "found a time of {} s, expected at least {} s", time, last_time_s);
  if (!is_finite(key.eye)) return invalid(where, "the eye is too far away");
  if (key.forward == Vec3(0)) return invalid(where, "\"forward\" has no direction");
  return key;
}

Json as_json(const DVec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

Status write_path(const std::filesystem::path& file, const CameraPath& path, const DVec3& origin) {
  Json json{{"oriel_path", kVersion},
            {"name", path.name},
            {"vertical_fov_deg", double{path.vertical_fov_rad} * 180 / kPi},
            {"keys", Json::array()}};
  for (const CameraKey& key : path.keys)
    json["keys"].push_back({{"t", double{key.time_s}},
                            {"eye", as_json(DVec3(key.eye) + origin)},
                            {"forward", as_json(DVec3(key.forward))}});
  return write_text_atomically(file, json.dump(1) + "\n");
}

Result<CameraPath> read_path(const std::filesystem::path& file, const DVec3& origin) {
  ORIEL_TRY(const Bytes bytes, read_file(file, kMostBytes));
  const auto parsed = Json::parse(bytes);
  const std::string where = file.string();
  if (!parsed) return invalid(where, "is no JSON");
  const Json& json = *parsed;
  ORIEL_TRY(const double version, number_of(json, "oriel_path", where));
  if (version != kVersion) return invalid(where, "found version {}, expected {}", version, kVersion);
  ORIEL_TRY(const double fov_deg, number_of(json, "vertical_fov_deg", where));
  if (!(fov_deg > 0 && fov_deg < 180))
    return invalid(where, "found a field of view of {} degrees, expected 0 to 180, both excluded", fov_deg);
  CameraPath path{file.stem().string(), static_cast<float>(fov_deg * kPi / 180), {}};
  if (json["name"].is_string()) path.name = json["name"].get<std::string>();
  const Json& keys = json["keys"];
  if (!keys.is_array() || keys.empty()) return invalid(where, "has no \"keys\"");
  for (const Json& key : keys) {
    const float last = path.keys.empty() ? std::numeric_limits<float>::lowest() : path.keys.back().time_s;
    ORIEL_TRY(const CameraKey read, read_key(key, origin, last, fmt::format("{}: key {}", where, path.keys.size())));
    path.keys.push_back(read);
  }
  return path;
}

Result<CameraPath> choose_path(const std::string& text, std::span<const CameraPath> paths, const DVec3& origin) {
  if (std::filesystem::path(text).extension() == ".json") return read_path(text, origin);
  const auto path = std::find_if(paths.begin(), paths.end(), [&](const auto& p) { return p.name == text; });
  if (path != paths.end()) return *path;
  return fail(ErrorCode::kUsage, "--path " + text,
              "found no path of that name, expected one that --list shows or a .json file");
}

}  // namespace oriel
