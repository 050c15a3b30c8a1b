#include "bake/run/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "formats/core/file.h"
#include "formats/core/text.h"

namespace oriel {

BakeOptions::BakeOptions() = default;
BakeOptions::~BakeOptions() = default;
BakeOptions::BakeOptions(const BakeOptions&) = default;
BakeOptions::BakeOptions(BakeOptions&&) noexcept = default;
BakeOptions& BakeOptions::operator=(const BakeOptions&) = default;
BakeOptions& BakeOptions::operator=(BakeOptions&&) noexcept = default;
Result<double> parse_duration(const std::string& text) {
  static constexpr Unit kUnits[] = {{"s", 1}, {"min", 60}, {"h", 3600}};
  return parse_quantity(text, kUnits, "time", "30s, 10min or 2h");
}

Result<double> parse_verify(const std::string& text) {
  if (text == "off") return 0.0;
  return parse_share(text);
}

Result<EyeOptions> parse_eye_source(const std::string& text) {
  EyeOptions eyes;
  if (text == "walk") return eyes;
  if (text == "box") {
    eyes.source = EyeSource::kBox;
    return eyes;
  }
  ORIEL_TRY(const Bytes file, read_file(text));
  eyes.source = EyeSource::kFile;
  ORIEL_TRY(eyes.points, parse_eyes({reinterpret_cast<const char*>(file.data()), file.size()}, text));
  return eyes;
}

Result<Vec3> parse_color(const std::string& text) {
  Vec3 color(0);
  const char* at = text.data();
  const char* end = text.data() + text.size();
  int count = 0;
  while (count < 3) {
    const auto [next, error] = std::from_chars(at, end, color[count]);
    if (error != std::errc() || !std::isfinite(color[count]) || color[count] < 0) break;
    ++count;
    at = next;
    if (at == end || *at != ',') break;
    ++at;
  }
  if (at == end && count == 1) return Vec3(color.x);
  if (at == end && count == 3) return color;
  return fail(ErrorCode::kUsage, "",
              "found '{}', expected one value or three with commas, none negative, such as 100 or 90,95,100", text);
}

Result<LightScale> parse_light_scale(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const bool named = equals != std::string::npos;
  LightScale scale{named ? text.substr(0, equals) : "", 0};
  const char *at = text.data() + (named ? equals + 1 : 0), *end = text.data() + text.size();
  const auto [next, error] = std::from_chars(at, end, scale.factor);
  constexpr double kMost = 1e30;  // as of a sky
  if (equals == 0 || error != std::errc() || next != end || !(scale.factor >= 0 && scale.factor <= kMost))
    return fail(ErrorCode::kUsage, "", "found '{}', expected a factor or NAME=FACTOR, as 683 or \"bulb*=0.02\"", text);
  return scale;
}

Result<SkyChoice> parse_sky(const std::string& text) {
  if (text == "auto" || text == "none") return SkyChoice{Vec3(0), {}, text == "auto"};
  std::filesystem::path file(text);
  const std::string extension = lower_case(file.extension().string());
  if (extension == ".hdr" || extension == ".exr") return SkyChoice{Vec3(0), std::move(file)};
  const auto color = parse_color(text);
  if (!color)
    return fail(ErrorCode::kUsage, "",
                "found '{}', expected a radiance such as 2000 or 1800,2000,2400, or a .hdr or .exr file", text);
  return SkyChoice{*color, {}};
}

Result<std::pair<std::string, std::filesystem::path>> parse_ies_option(const std::string& text) {
  // Both may hold a '=': it is split at the last one with a file behind it, or else at the last.
  std::size_t equals = text.rfind('=');
  for (std::size_t at = equals; at != std::string::npos && at > 0; at = text.rfind('=', at - 1))
    if (std::filesystem::exists(text.substr(at + 1))) {
      equals = at;
      break;
    }
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    return fail(ErrorCode::kUsage, "", "found '{}', expected NODE=FILE such as lamp=downlight.ies", text);
  return std::pair{text.substr(0, equals), std::filesystem::path(text.substr(equals + 1))};
}

}  // namespace oriel
