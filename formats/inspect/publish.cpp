// `report` and `export`: packs for people and programs that read none.
#include <fmt/format.h>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/export/lightmap_texture.h"
#include "formats/export/probes.h"
#include "formats/export/report.h"
#include "formats/export/scene_glb.h"
#include "formats/image/exr.h"
#include "formats/inspect/commands.h"
#include "formats/pack/reader.h"

namespace oriel::inspect {

namespace {

// Whether a file that is to be written is the pack itself; then says so.
bool overwrites(const std::filesystem::path& pack, const std::filesystem::path& output) {
  std::error_code none;
  if (!std::filesystem::equivalent(pack, output, none)) return false;
  report(Error{ErrorCode::kUsage, "found the pack itself, which would be overwritten, expected another file",
               "-o " + output.string()});
  return true;
}

const char* name_of(TexelCoding coding) {
  return coding == TexelCoding::kBc6h ? "BC6H" : "RGB9E5";
}

Status write_texture(const std::filesystem::path& path, const Ktx2Texture& texture) {
  ORIEL_TRY(const Bytes file, ktx2_file(texture));
  return write_file_atomically(path, file);
}

// As EXR and as KTX2.
Status write_lightmap(const LightmapPage& page, const std::filesystem::path& folder, const std::string& stem,
                      std::size_t number, std::optional<TexelCoding> coding) {
  const auto exr = folder / lightmap_file(stem, number, "exr"), ktx2 = folder / lightmap_file(stem, number, "ktx2");
  ORIEL_TRY_VOID(write_exr(exr, rgb_image(page.width, page.height, page.irradiance), {{"oriel:unit", "lux"}}));
  fmt::print("{}\n", exr.string());
  const LightmapTexture light = lightmap_texture(page, coding);
  ORIEL_TRY_VOID(write_texture(ktx2, light.texture));
  fmt::print("{}: {}, {} lux a unit, rounded by {:.2g} %\n", ktx2.string(), name_of(light.texture.coding),
             texture_scale(page), 100 * light.rounding);
  return {};
}

// A cube for each map of a curved reflector, and an index of them.
Status write_probes(const Pack& pack, const std::filesystem::path& folder, TexelCoding coding) {
  if (pack.surround_maps.empty())
    return fail(ErrorCode::kUsage, "--as probes",
                "found no maps of curved reflectors, expected a pack with shiny things");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(ErrorCode::kIo, folder.string(), "cannot be made: {}", error.message());
  Json cubes = Json::array();
  for (std::size_t i = 0; i < pack.surround_maps.size(); ++i) {
    const SurroundMap& map = pack.surround_maps[i];
    const ProbeCube cube = probe_cube(map, coding);
    const std::string name = fmt::format("probe_{:03}.ktx2", i);
    ORIEL_TRY_VOID(write_texture(folder / name, cube.texture));
    const DVec3 centre = pack.mesh.origin + DVec3(map.centre);
    cubes.push_back({{"file", name},
                     {"centre_m", {centre.x, centre.y, centre.z}},
                     {"unit", "cd/m2"},
                     {"scale", cube.scale},
                     {"side", cube.texture.width},
                     {"rounding", cube.rounding}});
    fmt::print("{}: {}, {} cd/m2 a unit, rounded by {:.2g} %\n", (folder / name).string(), name_of(coding), cube.scale,
               100 * cube.rounding);
  }
  ORIEL_TRY_VOID(
      write_file_atomically(folder / "probes.json", bytes_of_text(Json{{"cubes", std::move(cubes)}}.dump(2) + "\n")));
  fmt::print("{}\n", (folder / "probes.json").string());
  return {};
}

Status write_scene(const Pack& pack, const std::filesystem::path& output, const ExportOptions& how) {
  const bool as_lightmap = how.as == "lightmap";
  GlbOptions options;
  options.light = as_lightmap ? LightAs::kLightmap : LightAs::kEmissive;
  options.lightmap_stem = output.stem().string() + "_lightmap";
  ORIEL_TRY(const GlbScene scene, scene_glb(pack, options));
  for (std::size_t i = 0; as_lightmap && i < pack.lightmaps.size(); ++i)
    ORIEL_TRY_VOID(write_lightmap(pack.lightmaps[i], output.parent_path(), options.lightmap_stem, i, how.coding));
  ORIEL_TRY_VOID(write_file_atomically(output, scene.file));
  fmt::print("{}\n", output.string());
  if (!as_lightmap) fmt::print("white: {:.4g} cd/m2\n", scene.white_cd_m2);
  for (const std::string& what : scene.left_out) fmt::print("left out: {}\n", what);
  return {};
}

}  // namespace

int page(const std::filesystem::path& path, const std::filesystem::path& output) {
  if (overwrites(path, output)) return static_cast<int>(ErrorCode::kUsage);
  const auto pack = read_pack(path);
  if (!pack) return report(pack.error());
  const auto file = read_file(path);
  if (!file) return report(file.error());
  const auto index = read_index(*file);
  if (!index) return report(index.error());
  const std::string html = report::page_html(*pack, *index, path.filename().string());
  if (const auto written = write_file_atomically(output, bytes_of_text(html)); !written) return report(written.error());
  fmt::print("{}\n", output.string());
  return 0;
}

int export_pack(const std::filesystem::path& path, const std::filesystem::path& output, const ExportOptions& options) {
  if (overwrites(path, output)) return static_cast<int>(ErrorCode::kUsage);
  const auto pack = read_pack(path);
  if (!pack) return report(pack.error());
  const Status written = options.as == "probes"
                             ? write_probes(*pack, output, options.coding.value_or(TexelCoding::kBc6h))
                             : write_scene(*pack, output, options);
  return written ? 0 : report(written.error());
}

}  // namespace oriel::inspect
