#include "trade/measures.h"

#include <cmath>

#include "formats/analysis/error_bands.h"
#include "formats/image/display.h"

namespace oriel::trade {
namespace {

// Whatever `read` takes out of the text; what is missing or of another type is an Error instead of an exception.
template <class Read>
auto parsed(const std::string& text, const char* what, const Read& read) -> Result<decltype(read(Json()))> {
  try {
    ORIEL_TRY(const Json json, Json::parse(text, what));
    return read(json);
  } catch (const JsonError& error) {
    return invalid(what, "{}", error.what());
  }
}

// All pages as one row of texels, which is what formats/image takes.
FloatImage as_row(const std::vector<LightmapPage>& pages, std::vector<Vec3> LightmapPage::*values) {
  FloatImage row{0, 1, 3, {}};
  for (const LightmapPage& page : pages)
    for (const Vec3& v : page.*values) row.pixels.insert(row.pixels.end(), {v.r, v.g, v.b});
  row.width = static_cast<std::uint32_t>(row.pixels.size() / 3);
  return row;
}

double without(double square, double noise_square) {
  return std::sqrt(std::max(0.0, square - noise_square));
}

Json frame_json(const CameraError& f) {
  Json json = {{"camera", f.camera}, {"sum", f.sum}};
  if (std::isfinite(f.diffuse)) json["D"] = f.diffuse;
  if (f.specular) json["S"] = *f.specular;
  json["noise"] = f.noise;
  json["flip"] = f.flip;
  json["mse"] = f.mse;
  return json;
}

double number(const Json& of, const char* name) {
  return of.at(name).get<double>();
}

CameraError frame_from(const Json& json) {
  CameraError f{json.at("camera").get<std::string>(),
                number(json, "sum"),
                json.value("D", std::numeric_limits<double>::quiet_NaN()),
                {},
                number(json, "noise"),
                number(json, "flip"),
                number(json, "mse")};
  if (json.contains("S")) f.specular = json["S"].get<double>();
  return f;
}

Measures measures_from(const Json& json) {
  Measures m;
  if (json.contains("bake")) {
    const Json& bake = json["bake"];
    m.bake = BakeCost{number(bake, "seconds"), number(bake, "cpu_seconds"), bake.at("bytes").get<std::uint64_t>()};
  }
  if (json.contains("frame_ms")) m.frame_ms = json["frame_ms"].get<double>();
  m.renderer = json.value("renderer", "");
  if (json.contains("texels")) {
    const Json& texels = json["texels"];
    m.texels = TexelError{texels.at("count").get<std::uint64_t>(),
                          number(texels, "relRMSE"),
                          number(texels, "nRMSE"),
                          number(texels, "bias"),
                          number(texels, "noise"),
                          number(texels, "clouds"),
                          number(texels, "visible")};
  }
  if (json.contains("frames"))
    for (const Json& frame : json["frames"]) m.frames.push_back(frame_from(frame));
  return m;
}

}  // namespace

std::optional<double> frame_error(const Measures& measures, double CameraError::*error) {
  if (measures.frames.empty()) return {};
  double squares = 0;
  for (const CameraError& frame : measures.frames) squares += frame.*error * (frame.*error);
  const double mean = std::sqrt(squares / static_cast<double>(measures.frames.size()));
  return std::isfinite(mean) ? std::optional(mean) : std::nullopt;
}

std::optional<double> specular_error(const Measures& measures) {
  double squares = 0, count = 0;
  for (const CameraError& frame : measures.frames)
    if (frame.specular) squares += *frame.specular * *frame.specular, ++count;
  if (count == 0) return {};
  return std::sqrt(squares / count);
}

std::optional<double> mean_flip(const Measures& measures) {
  if (measures.frames.empty()) return {};
  double sum = 0;
  for (const CameraError& frame : measures.frames) sum += frame.flip;
  return sum / static_cast<double>(measures.frames.size());
}

std::optional<double> psnr(const Measures& measures) {
  if (measures.frames.empty()) return {};
  double sum = 0;
  for (const CameraError& frame : measures.frames) sum += frame.mse;
  return psnr_db(sum / static_cast<double>(measures.frames.size()));
}

namespace {

template <double CameraError::*kError>
std::optional<double> of_frames(const Measures& m) {
  return frame_error(m, kError);
}
template <auto kError>
std::optional<double> of_texels(const Measures& m) {
  return m.texels ? std::optional(static_cast<double>((*m.texels).*kError)) : std::nullopt;
}
template <auto kCost>
std::optional<double> of_bake(const Measures& m) {
  return m.bake ? std::optional(static_cast<double>((*m.bake).*kCost)) : std::nullopt;
}

constexpr Quantity kQuantities[] = {
    {"bake_s", "bake s", "{:.2f}", 1, "frames_by_bake", of_bake<&BakeCost::seconds>},
    {"bake_cpu_s", "bake CPU s", "{:.2f}", 1, "", of_bake<&BakeCost::cpu_seconds>},
    {"bytes", "pack MB", "{:.2f}", 1e-6, "frames_by_bytes",
     [](const Measures& m) { return m.bake && m.bake->bytes > 0 ? of_bake<&BakeCost::bytes>(m) : std::nullopt; }},
    {"frame_ms", "frame ms", "{:.1f}", 1, "frames_by_ms", [](const Measures& m) { return m.frame_ms; }},
    {"texels", "", "", 1, "", of_texels<&TexelError::texels>},
    {"texel_relRMSE", "texels relRMSE %", "{:.2f}", 100, "texels_by_bake", of_texels<&TexelError::rel_rmse>},
    {"texel_nRMSE", "texels nRMSE %", "{:.2f}", 100, "", of_texels<&TexelError::n_rmse>},
    {"texel_bias", "texels bias %", "{:+.2f}", 100, "", of_texels<&TexelError::bias>},
    {"texel_noise", "texels noise %", "{:.2f}", 100, "", of_texels<&TexelError::noise>},
    {"texel_clouds", "clouds %", "{:.2f}", 100, "", of_texels<&TexelError::clouds>},
    {"texel_visible", "visible", "{:.1f}", 1, "", of_texels<&TexelError::visible>},
    {"frame_sum", "frames relRMSE %", "{:.2f}", 100, "", of_frames<&CameraError::sum>},
    {"frame_D", "D %", "{:.2f}", 100, "", of_frames<&CameraError::diffuse>},
    {"frame_S", "S %", "{:.2f}", 100, "", specular_error},
    {"frame_noise", "frames noise %", "{:.2f}", 100, "", of_frames<&CameraError::noise>},
    {"flip", "FLIP", "{:.4f}", 1, "", mean_flip},
    {"psnr_db", "PSNR dB", "{:.1f}", 1, "", psnr},
};

}  // namespace

std::span<const Quantity> quantities() {
  return kQuantities;
}

Result<TexelError> texel_error(const Pack& pack, const Pack& reference) {
  const auto& pages = pack.lightmaps;
  if (!same_texels(pack, reference))
    return invalid("lightmaps", "found texels that are not those of the reference, expected the same atlas");
  std::vector<std::uint8_t> baked;
  for (std::size_t p = 0; p < pages.size(); ++p)
    for (std::size_t i = 0; i < pages[p].state.size(); ++i)
      baked.push_back(pages[p].state[i] == TexelState::kValid && reference.lightmaps[p].state[i] == TexelState::kValid);
  TexelError e;
  for (const std::uint8_t b : baked) e.texels += b;
  if (e.texels == 0) return invalid("lightmaps", "found no texel that both packs baked");
  const FloatImage light = as_row(pages, &LightmapPage::irradiance);
  const FloatImage truth = as_row(reference.lightmaps, &LightmapPage::irradiance);
  const FloatImage noise = as_row(reference.lightmaps, &LightmapPage::standard_error);
  FloatImage shifted = truth;  // by one standard error: how far that is tells the noise in the mean's measure
  for (std::size_t i = 0; i < shifted.pixels.size(); ++i) shifted.pixels[i] += noise.pixels[i];
  ORIEL_TRY(const RelativeError all, relative_error(light, truth, noise, baked));
  ORIEL_TRY(const RelativeError own, relative_error(shifted, truth, {}, baked));
  e.rel_rmse = all.net();
  e.n_rmse = without(all.n_rmse * all.n_rmse, own.n_rmse * own.n_rmse);
  e.bias = all.bias;
  e.noise = all.noise;
  if (const auto bands = error_bands(reference, pack)) {
    constexpr std::size_t kFirst = 2, kEnd = 5;  // 4 to 32 texels
    for (std::size_t k = kFirst; k < kEnd; ++k) e.clouds += bands->all.band[k] * bands->all.band[k];
    e.clouds = std::sqrt(e.clouds);
    e.visible = bands->all.visible;
  }
  return e;
}

CameraError frame_error_of(const std::string& camera, const Comparison& comparison) {
  CameraError e;
  e.camera = camera;
  for (const RegionComparison& region : comparison.regions) {
    if (region.name == "frame") {
      e.sum = region.total.net();
      e.diffuse = region.diffuse.net();
      e.noise = region.total.noise;
      e.flip = region.flip;
      e.mse = region.mse;
    }
    if (region.name == "reflectors" && region.specular) e.specular = region.specular->net();
  }
  return e;
}

Result<CameraError> read_comparison(const std::string& camera, const std::string& json) {
  return parsed(json, "oriel-play --json", [&](const Json& all) {
    const Json& frame = all.at("regions").at("frame");
    CameraError e{camera,
                  number(frame.at("sum"), "net"),
                  number(frame.at("D"), "net"),
                  {},
                  number(frame.at("sum"), "noise"),
                  number(frame, "flip"),
                  number(frame, "mse")};
    if (all["regions"].contains("reflectors")) e.specular = number(all["regions"]["reflectors"].at("S"), "net");
    return e;
  });
}

Status read_frame_times(const std::string& json, Measures& measures) {
  ORIEL_TRY(measures.frame_ms, parsed(json, "oriel-play --stats", [](const Json& all) {
              double sum = 0;
              for (const Json& frame : all.at("frames")) sum += number(frame, "ms");
              return sum / static_cast<double>(std::max<std::size_t>(all["frames"].size(), 1));
            }));
  ORIEL_TRY(measures.renderer,
            parsed(json, "oriel-play --stats", [](const Json& all) { return all.at("renderer").get<std::string>(); }));
  return {};
}

Result<PreviewTimes> read_preview_times(const std::string& json) {
  return parsed(json, "oriel-preview --stats", [](const Json& all) {
    return PreviewTimes{number(all, "drawn_s"), number(all, "cpu_s"), 1000 * number(all.at("last_pass"), "total_s")};
  });
}

Result<double> read_bake_seconds(const std::string& json) {
  return parsed(json, "oriel-bake --report", [](const Json& all) {
    double sum = 0;
    for (const Json& stage : all.at("stages")) sum += number(stage, "seconds");
    return sum;
  });
}

Json as_json(const Measures& m) {
  Json json = Json::object();
  if (m.bake)
    json["bake"] = {{"seconds", m.bake->seconds}, {"cpu_seconds", m.bake->cpu_seconds}, {"bytes", m.bake->bytes}};
  if (m.frame_ms) json["frame_ms"] = *m.frame_ms;
  if (!m.renderer.empty()) json["renderer"] = m.renderer;
  if (m.texels)
    json["texels"] = {{"count", m.texels->texels},   {"relRMSE", m.texels->rel_rmse}, {"nRMSE", m.texels->n_rmse},
                      {"bias", m.texels->bias},      {"noise", m.texels->noise},      {"clouds", m.texels->clouds},
                      {"visible", m.texels->visible}};
  for (const CameraError& frame : m.frames) json["frames"].push_back(frame_json(frame));
  return json;
}

Result<Measures> measures_from_json(const std::string& text) {
  return parsed(text, "measures", measures_from);
}

}  // namespace oriel::trade
