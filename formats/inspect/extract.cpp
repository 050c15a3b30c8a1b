#include <fmt/format.h>

#include "formats/core/json.h"
#include "formats/inspect/commands.h"
#include "formats/inspect/extraction.h"
#include "formats/pack/reader.h"

namespace oriel::inspect {
namespace {

// A surface white, sky grey, nothing usable black.
ByteImage validity_image(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& valid) {
  ByteImage image{width, height, 1, valid};
  for (auto& v : image.pixels) v = v == 1 ? 255 : v == 2 ? 128 : 0;
  return image;
}

}  // namespace

Status Extraction::lightmaps() {
  for (std::size_t i = 0; i < pack_.lightmaps.size(); ++i) {
    const auto& page = pack_.lightmaps[i];
    const std::string name = fmt::format("lightmap_{:03}", i);
    Json entry{{"kind", "lightmap"}, {"number", i}, {"width", page.width}, {"height", page.height}, {"unit", "lux"}};
    ORIEL_TRY_VOID(exr(entry, "irradiance", name + ".exr", rgb_image(page.width, page.height, page.irradiance), "lux"));
    ORIEL_TRY_VOID(exr(entry, "standard_error", name + "_error.exr",
                       rgb_image(page.width, page.height, page.standard_error), "lux"));
    if (!page.direction.empty())
      ORIEL_TRY_VOID(
          exr(entry, "direction", name + "_direction.exr", rgb_image(page.width, page.height, page.direction), "1"));
    ByteImage states{page.width, page.height, 1, {}};
    for (const TexelState state : page.state) states.pixels.push_back(static_cast<std::uint8_t>(state));
    ORIEL_TRY_VOID(png(entry, "valid", name + "_valid.png", states));
    index_.push_back(std::move(entry));
  }
  return {};
}

Status Extraction::radiance_maps() {
  for (std::size_t i = 0; i < pack_.radiance_maps.size(); ++i) {
    const auto& map = pack_.radiance_maps[i];
    const std::string name = fmt::format("radiance_map_{:04}", i);
    Json entry{{"kind", "radiance_map"},
               {"number", i},
               {"width", map.width},
               {"height", map.height},
               {"unit", "cd/m2"},
               {"reflector", map.reflector},
               {"eye", {map.eye.x, map.eye.y, map.eye.z}},
               {"lower", {map.lower.x, map.lower.y}},
               {"upper", {map.upper.x, map.upper.y}},
               {"has_emission", map.has_emission}};
    ORIEL_TRY_VOID(exr(entry, "radiance", name + ".exr", rgb_image(map.width, map.height, map.radiance), "cd/m2"));
    ORIEL_TRY_VOID(exr(entry, "disparity", name + "_disparity.exr", {map.width, map.height, 1, map.disparity}, "1"));
    ORIEL_TRY_VOID(png(entry, "valid", name + "_valid.png", validity_image(map.width, map.height, map.valid)));
    index_.push_back(std::move(entry));
  }
  return {};
}

Status Extraction::surround_maps() {
  for (std::size_t i = 0; i < pack_.surround_maps.size(); ++i) {
    const auto& map = pack_.surround_maps[i];
    const std::string name = fmt::format("surround_map_{:03}", i);
    Json entry{{"kind", "surround_map"}, {"number", i},     {"width", map.size},
               {"height", map.size},     {"unit", "cd/m2"}, {"centre", {map.centre.x, map.centre.y, map.centre.z}}};
    ORIEL_TRY_VOID(exr(entry, "radiance", name + ".exr", rgb_image(map.size, map.size, map.radiance), "cd/m2"));
    ORIEL_TRY_VOID(exr(entry, "inverse_distance", name + "_inverse_distance.exr",
                       {map.size, map.size, 1, map.inverse_distance}, "1/m"));
    ORIEL_TRY_VOID(png(entry, "valid", name + "_valid.png", validity_image(map.size, map.size, map.valid)));
    index_.push_back(std::move(entry));
  }
  return {};
}

Status Extraction::textures() {
  ORIEL_TRY_VOID(images("texture", "color", pack_.textures));
  return images("normal_texture", "normal", pack_.normal_textures);
}

Status Extraction::images(const char* kind, const char* role, const std::vector<Texture>& textures) {
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const auto& texture = textures[i];
    Json entry{
        {"kind", kind}, {"number", i}, {"name", texture.name}, {"width", texture.width}, {"height", texture.height}};
    ORIEL_TRY_VOID(
        png(entry, role, fmt::format("{}_{:03}.png", kind, i), {texture.width, texture.height, 4, texture.texels}));
    index_.push_back(std::move(entry));
  }
  return {};
}

// Eyes rather than floors: what a script that places cameras asks for.
Status Extraction::walk_grids() {
  for (std::size_t i = 0; i < pack_.walk_grids.size(); ++i) {
    const auto& grid = pack_.walk_grids[i];
    Json entry{{"kind", "walk_grid"}, {"number", i}, {"cell_m", grid.cell_m}, {"eye_height_m", grid.eye_height_m}};
    std::string text = "x,y,z\n";
    for (std::size_t cell = 0; cell < grid.floor_y.size(); ++cell) {
      if (!grid.walkable(cell)) continue;
      const Vec3 eye = grid.eye(cell);
      text += fmt::format("{:.6g},{:.6g},{:.6g}\n", eye.x, eye.y, eye.z);
    }
    ORIEL_TRY_VOID(csv(entry, "eyes_csv", fmt::format("walk_grid_{:02}_eyes.csv", i), text));
    index_.push_back(std::move(entry));
  }
  return {};
}

Status Extraction::sky_map() {
  const SkyMap& sky = pack_.sky_map;
  if (sky.width == 0) return {};
  Json entry{{"kind", "sky_map"}, {"sky_cd_m2", {pack_.sky.r, pack_.sky.g, pack_.sky.b}}};
  ORIEL_TRY_VOID(exr(entry, "radiance", "sky_map.exr", rgb_image(sky.width, sky.height, sky.texels), "sky_cd_m2"));
  index_.push_back(std::move(entry));
  return {};
}

Status Extraction::finish(const std::filesystem::path& source) {
  const Json out{{"schema", kJsonSchema}, {"source", source.filename().string()}, {"entries", index_}};
  ORIEL_TRY_VOID(write_file_atomically(folder_ / "index.json", bytes_of_text(out.dump(2) + "\n")));
  fmt::print("{}\n", (folder_ / "index.json").string());
  return {};
}

namespace {

struct Kind {
  const char* name;
  Status (Extraction::*write)();
};
constexpr Kind kKinds[] = {{"lightmap", &Extraction::lightmaps},         {"radiance_map", &Extraction::radiance_maps},
                           {"surround_map", &Extraction::surround_maps}, {"brdf_kernel", &Extraction::kernels},
                           {"fresnel_map", &Extraction::fresnel_maps},   {"texture", &Extraction::textures},
                           {"walk_grid", &Extraction::walk_grids},       {"sky_map", &Extraction::sky_map}};

}  // namespace

const std::string& extract_kinds() {
  static const std::string names = [] {
    std::string text;
    for (const auto& kind : kKinds) text += std::string(kind.name) + ", ";
    return text + "all";
  }();
  return names;
}

int extract(const std::filesystem::path& path, const ExtractOptions& options) {
  bool known = options.kind == "all";
  for (const auto& kind : kKinds) known = known || options.kind == kind.name;
  if (!known)
    return report(
        {ErrorCode::kUsage, fmt::format("found '{}', expected one of {}", options.kind, extract_kinds()), "--kind"});
  const auto pack = read_pack(path);
  if (!pack) return report(pack.error());
  std::error_code ec;
  std::filesystem::create_directories(options.folder, ec);
  if (ec) return report({ErrorCode::kIo, "cannot be made: " + ec.message(), options.folder.string()});
  Extraction extraction(*pack, options.folder);
  for (const auto& kind : kKinds) {
    if (options.kind != "all" && options.kind != kind.name) continue;
    if (const auto status = (extraction.*kind.write)(); !status) return report(status.error());
  }
  if (const auto status = extraction.finish(path); !status) return report(status.error());
  return 0;
}

}  // namespace oriel::inspect
