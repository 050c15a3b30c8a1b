// `report` and `export`: packs for people and programs that read none.
#include <fmt/format.h>

#include "formats/core/file.h"
#include "formats/export/ktx2.h"
#include "formats/export/scene_glb.h"
#include "formats/image/exr.h"
#include "formats/inspect/commands.h"
#include "formats/pack/reader.h"
#include "formats/report/report.h"

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

// As EXR and as KTX2.
Status write_lightmap(const LightmapPage& page, const std::filesystem::path& folder, const std::string& stem,
                      std::size_t number) {
  const auto exr = folder / lightmap_file(stem, number, "exr"), ktx2 = folder / lightmap_file(stem, number, "ktx2");
  ORIEL_TRY_VOID(write_exr(exr, rgb_image(page.width, page.height, page.irradiance), {{"oriel:unit", "lux"}}));
  fmt::print("{}\n", exr.string());
  ORIEL_TRY(const Bytes texture, lightmap_ktx2(page));
  ORIEL_TRY_VOID(write_file_atomically(ktx2, texture));
  fmt::print("{}: {} lux a unit, rounded by {:.2g} %\n", ktx2.string(), ktx2_scale(page), 100 * ktx2_rounding(page));
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

int export_scene(const std::filesystem::path& path, const std::filesystem::path& output, bool as_lightmap) {
  if (overwrites(path, output)) return static_cast<int>(ErrorCode::kUsage);
  const auto pack = read_pack(path);
  if (!pack) return report(pack.error());
  GlbOptions options;
  options.light = as_lightmap ? LightAs::kLightmap : LightAs::kEmissive;
  options.lightmap_stem = output.stem().string() + "_lightmap";
  const auto scene = scene_glb(*pack, options);
  if (!scene) return report(scene.error());
  for (std::size_t i = 0; as_lightmap && i < pack->lightmaps.size(); ++i)
    if (const Status written = write_lightmap(pack->lightmaps[i], output.parent_path(), options.lightmap_stem, i);
        !written)
      return report(written.error());
  if (const auto written = write_file_atomically(output, scene->file); !written) return report(written.error());
  fmt::print("{}\n", output.string());
  if (!as_lightmap) fmt::print("white: {:.4g} cd/m2\n", scene->white_cd_m2);
  for (const std::string& what : scene->left_out) fmt::print("left out: {}\n", what);
  return 0;
}

}  // namespace oriel::inspect
