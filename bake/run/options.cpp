#include "bake/run/options.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/core/file.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

const char* directional_name(Directional directional) {
  return directional == Directional::kAuto ? "auto" : directional == Directional::kOn ? "on" : "off";
}

const char* visible_sets_name(VisibleSetsWanted wanted) {
  return wanted == VisibleSetsWanted::kAuto ? "auto" : wanted == VisibleSetsWanted::kOn ? "on" : "off";
}

const char* eye_source_name(EyeSource source) {
  return source == EyeSource::kWalk ? "walk" : source == EyeSource::kBox ? "box" : "file";
}

nlohmann::ordered_json eye_points(const EyeOptions& eyes) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const DVec3& p : eyes.points) points.push_back({p.x, p.y, p.z});
  return points;
}

}  // namespace

Result<float> parse_length(const std::string& text) {
  static constexpr Unit kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"km", 1000}};
  ORIEL_TRY(const double metres, parse_quantity(text, kUnits, "length", "10cm, 0.1m or 100mm"));
  return static_cast<float>(metres);
}

Result<double> parse_unit(const std::string& text) {
  constexpr std::pair<const char*, double> kUnits[] = {{"auto", 1},    {"mm", 0.001}, {"cm", 0.01}, {"in", 0.0254},
                                                       {"ft", 0.3048}, {"m", 1},      {"km", 1000}};
  for (const auto& [name, metres] : kUnits)
    if (text == name) return metres;
  return fail(ErrorCode::kUsage, "", "found '{}', expected auto, mm, cm, in, ft, m or km", text);
}

Result<float> parse_texel(const std::string& text) {
  if (text == "auto") return 0.0f;
  return parse_length(text);
}

Result<double> parse_duration(const std::string& text) {
  static constexpr Unit kUnits[] = {{"s", 1}, {"min", 60}, {"h", 3600}};
  return parse_quantity(text, kUnits, "time", "30s, 10min or 2h");
}

Result<double> parse_fraction(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (error == std::errc() && std::isfinite(value) && value > 0 && (unit.empty() || unit == "%"))
    return unit.empty() ? value : value / 100;
  return fail(ErrorCode::kUsage, "", "found '{}', expected a share such as 2% or 0.02", text);
}

Result<double> parse_verify(const std::string& text) {
  if (text == "off") return 0.0;
  if (const auto share = parse_fraction(text)) return *share;
  return fail(ErrorCode::kUsage, "", "found '{}', expected a share such as 10% or 0.1, or off", text);
}

Status parse_views(const std::string& text, BakeOptions& options) {
  const std::size_t colon = text.find(':');
  const std::string scheme = text.substr(0, colon);
  std::uint32_t count = scheme == "planned" ? options.planned.choice.max_maps : options.views.views_per_element;
  if (colon != std::string::npos) {
    const auto [end, error] = std::from_chars(text.data() + colon + 1, text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size()) count = 0;
  }
  if ((scheme != "planned" && scheme != "hemisphere") || count < 1 || count > 4096)
    return fail(ErrorCode::kUsage, "",
                "found '{}', expected planned or hemisphere with a number from 1 to 4096, such as planned:8", text);
  options.view_scheme = scheme == "planned" ? ViewScheme::kPlanned : ViewScheme::kHemisphere;
  (scheme == "planned" ? options.planned.choice.max_maps : options.views.views_per_element) = count;
  return {};
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

Result<SkyChoice> parse_sky(const std::string& text) {
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
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    return fail(ErrorCode::kUsage, "", "found '{}', expected NODE=FILE such as lamp=downlight.ies", text);
  return std::pair{text.substr(0, equals), std::filesystem::path(text.substr(equals + 1))};
}

std::string options_json(const BakeOptions& o, std::uint64_t seed) {
  nlohmann::ordered_json ies = nlohmann::ordered_json::object();
  for (const auto& [node, file] : o.import.ies) ies[node] = file.filename().string();
  const bool planned = o.view_scheme == ViewScheme::kPlanned;
  const nlohmann::ordered_json json = {
      {"seed", seed},
      {"reproducible", o.reproducible},
      {"scene_index", o.import.scene},
      {"double_sided", o.import.double_sided},
      {"sky_cd_m2", {o.import.sky.r, o.import.sky.g, o.import.sky.b}},
      {"sky_file", o.import.sky_file.filename().string()},
      {"sky_scale", o.import.sky_scale},
      {"sky_rotation_deg", o.import.sky_rotation_deg},
      {"sun_angle_deg", o.import.sun_angle_deg ? nlohmann::ordered_json(*o.import.sun_angle_deg) : nullptr},
      {"ies", ies},
      {"atlas", o.atlas.source == AtlasOptions::Source::kUv1 ? "uv1" : "auto"},
      {"unit_m", o.guess_unit ? nlohmann::ordered_json("auto") : nlohmann::ordered_json(o.import.unit_m)},
      {"texel_m", o.choose_texel ? nlohmann::ordered_json("auto") : nlohmann::ordered_json(o.atlas.texel_m)},
      {"resolution", o.atlas.resolution},
      {"max_page", o.atlas.max_page},
      {"padding", o.atlas.padding},
      {"memory_limit", o.memory_given ? o.memory_bytes : 0},
      {"atlas_time_limit_s", o.atlas.time_limit_s},
      {"estimator", o.radiosity.estimator == Estimator::kCached ? "cached" : "reference"},
      {"samples", o.radiosity.samples},
      {"error", o.radiosity.error},
      {"most_rays", o.radiosity.most_rays},
      {"time_s", o.time_s},
      {"verify", o.radiosity.verify},
      {"reuse_error", o.radiosity.reuse_error},
      {"filter_scales", o.radiosity.filter.scales},
      {"filter_strength", o.radiosity.filter.strength},
      {"bounces", o.radiosity.bounces},
      {"hidden", o.radiosity.hidden == Hidden::kBlack ? "black" : "left out"},
      {"texel_values", o.radiosity.fit_texels ? "fitted" : "means"},
      {"detail", o.radiosity.detail},
      {"dilation", o.radiosity.dilation},
      {"directional", directional_name(o.directional)},
      {"radiance", o.with_radiance},
      {"material", o.with_material},
      {"max_reflectors", o.reflectors.max_reflectors},
      {"max_reflector_roughness", o.reflectors.max_roughness},
      {"min_reflector_area_m2", o.reflectors.min_area_m2},
      {"element_m", planned ? o.planned.element_m : o.views.element_m},
      {"views", planned ? "planned" : "hemisphere"},
      {"views_per_element", planned ? o.planned.choice.max_maps : o.views.views_per_element},
      {"eyes", eye_source_name(o.eyes.source)},
      {"eye_points", eye_points(o.eyes)},
      {"visible_sets", visible_sets_name(o.visible_sets)},
      {"orders", o.sight.orders},
      {"map_resolution", planned ? o.planned.map_resolution : o.views.map_resolution},
      {"map_price", planned ? o.planned.pixel_price : 0},
      {"map_memory", planned ? o.planned.memory_bytes : o.views.memory_bytes},
      {"movers", o.import.movers},
      {"transfer", o.with_transfer},
      {"sh_bands", o.transfer.bands},
      {"transfer_shadowed", o.transfer.shadowed},
      {"transfer_bounces", o.transfer.bounces},
      {"transfer_samples", o.transfer.samples},
      {"clusters", o.compress.clusters},
      {"probe_m", o.probes.spacing_m},
  };
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);  // names may hold any bytes
}

// 1024 at 2 %: what is noisier than that is a handful of texels in the dark, on which half of all rays would go, for
// nothing that people see.
std::uint32_t most_texel_rays(const RadiosityOptions& radiosity) {
  constexpr std::uint32_t kLeast = 256;
  constexpr double kNoisiest = 0.64;  // texel: of one gathered ray, relative, after the filter
  if (radiosity.estimator == Estimator::kReference) return kMostTexelRays;
  const double wanted = std::min(1e6, std::pow(kNoisiest / std::max(radiosity.error, 1e-6), 2));
  return std::bit_ceil(std::clamp(static_cast<std::uint32_t>(wanted), kLeast, kMostTexelRays));
}

}  // namespace oriel
