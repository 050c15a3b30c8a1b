#include "formats/export/pieces.h"

#include <algorithm>

#include <fmt/format.h>

#include "formats/pack/sections.h"
#include "formats/pack/stream.h"

namespace oriel {
namespace {

constexpr std::uint32_t kCoarseStep = 4;

// One section after another, into a file in memory.
class PieceWriter {
 public:
  template <class T>
  void one(std::uint32_t kind, const T& element) {
    list(kind, std::vector<T>{element});
  }
  template <class T>
  void list(std::uint32_t kind, const std::vector<T>& elements) {
    if (elements.empty()) return;
    ByteWriter out;
    for (const T& element : elements) encode(out, element);
    sections_.push_back({kind, elements.size(), out.take()});
  }
  Result<Bytes> file() const {
    Bytes file;
    PackStream stream(sections_.size(), [&](std::uint64_t offset, std::span<const std::byte> bytes) -> Status {
      if (file.size() < offset + bytes.size()) file.resize(offset + bytes.size());
      std::copy(bytes.begin(), bytes.end(), file.begin() + static_cast<std::ptrdiff_t>(offset));
      return {};
    });
    for (const Section& s : sections_) ORIEL_TRY_VOID(stream.add(s.kind, s.count, s.raw));
    ORIEL_TRY_VOID(stream.finish());
    return file;
  }

 private:
  struct Section {
    std::uint32_t kind;
    std::uint64_t count;
    Bytes raw;
  };
  std::vector<Section> sections_;
};

// What lights surfaces: who walks asks for no standard errors and no texels of sharp light, and zeros take no room.
LightmapPage without_errors(const LightmapPage& page) {
  LightmapPage out = page;
  out.irradiance = without_sharp(page);
  std::fill(out.sharp.begin(), out.sharp.end(), Vec3(0));
  std::fill(out.standard_error.begin(), out.standard_error.end(), Vec3(0));
  std::fill(out.state.begin(), out.state.end(), TexelState::kValid);
  return out;
}

// At most a megabyte and a half.
SkyMap small_sky(SkyMap sky) {
  constexpr std::uint32_t kMost = 1024;  // texels around: a third of a degree
  while (sky.width > kMost && sky.width % 2 == 0 && sky.height % 2 == 0) {
    SkyMap half{sky.width / 2, sky.height / 2, {}};
    for (std::size_t y = 0; y < half.height; ++y)
      for (std::size_t x = 0; x < half.width; ++x) {
        const Vec3* const upper = &sky.texels[2 * y * sky.width + 2 * x];
        const Vec3* const lower = upper + sky.width;
        half.texels.push_back(0.25f * (upper[0] + upper[1] + lower[0] + lower[1]));
      }
    sky = std::move(half);
  }
  return sky;
}

std::vector<Reflector> without_maps(std::vector<Reflector> reflectors) {
  for (Reflector& r : reflectors) r.elements_x = r.elements_y = r.first_map = r.map_count = 0;
  return reflectors;
}

Result<Bytes> scene_piece(const Pack& pack) {
  PieceWriter out;
  out.one(kSceneSection, pack.sky);
  out.one(kMeshSection, pack.mesh);
  out.list(kMaterialSection, pack.materials);
  out.list(kEmissionTextureSection, pack.emission_textures);
  out.list(kMetalnessSection, pack.metalness);
  for (const LightmapPage& page : pack.lightmaps) out.one(kLightmapSection, coarse_page(page));
  out.list(kReflectorSection, without_maps(pack.reflectors));
  out.list(kCurvedReflectorSection, pack.curved_reflectors);
  out.list(kEmitterSection, pack.emitters);
  out.list(kKernelSection, pack.kernels);
  out.list(kFresnelSection, pack.fresnel_maps);
  out.list(kCameraSection, pack.cameras);
  out.list(kPathSection, pack.paths);
  out.list(kWalkSection, pack.walk_grids);
  out.list(kLightGroupSection, pack.light_groups);
  if (!pack.day.empty()) out.one(kDaySection, pack.day);
  return out.file();
}

template <class T>
Status each(const char* name, std::uint32_t kind, const std::vector<T>& elements,
            const std::function<Status(WebPiece)>& take) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    PieceWriter out;
    out.one(kind, elements[i]);
    ORIEL_TRY(Bytes file, out.file());
    ORIEL_TRY_VOID(take({name, i, std::move(file)}));
  }
  return {};
}

}  // namespace

LightmapPage coarse_page(const LightmapPage& page) {
  LightmapPage out;
  out.width = (page.width + kCoarseStep - 1) / kCoarseStep;
  out.height = (page.height + kCoarseStep - 1) / kCoarseStep;
  const std::size_t texels = std::size_t{out.width} * out.height;
  out.irradiance.assign(texels, Vec3(0));
  out.standard_error.assign(texels, Vec3(0));
  out.state.assign(texels, TexelState::kValid);
  std::vector<std::uint32_t> count(texels, 0);
  for (std::uint32_t y = 0; y < page.height; ++y)
    for (std::uint32_t x = 0; x < page.width; ++x) {
      const std::size_t from = std::size_t{y} * page.width + x;
      const std::size_t to = std::size_t{y / kCoarseStep} * out.width + x / kCoarseStep;
      if (page.state[from] == TexelState::kEmpty) continue;
      out.irradiance[to] += page.irradiance[from];
      ++count[to];
    }
  for (std::size_t i = 0; i < texels; ++i)
    if (count[i] > 0) out.irradiance[i] /= static_cast<float>(count[i]);
  return out;
}

std::vector<std::string> left_out_of_pieces(const Pack& pack) {
  std::vector<std::string> lines;
  const auto add = [&](std::size_t number, const char* one, const char* many, const char* why) {
    if (number > 0) lines.push_back(fmt::format("{} {}: {}", number, number == 1 ? one : many, why));
  };
  add(pack.radiance_maps.size(), "radiance map", "radiance maps", "the viewer draws the mirrored scene instead");
  if (pack.light_field.bands > 0)
    add(pack.movers.size(), "mover", "movers", "shown without the shadows that bright lamps throw");
  else
    add(pack.movers.size(), "mover", "movers", "not shown, as the pack has no light for them");
  return lines;
}

Status make_pieces(const Pack& pack, const std::function<Status(WebPiece)>& take) {
  ORIEL_TRY(Bytes scene, scene_piece(pack));
  ORIEL_TRY_VOID(take({"scene", 0, std::move(scene)}));
  if (!pack.sharp_light.empty())
    ORIEL_TRY_VOID(each("sharp", kSharpLightSection, std::vector<SharpLight>{pack.sharp_light}, take));
  std::vector<LightmapPage> pages;
  for (const LightmapPage& page : pack.lightmaps) pages.push_back(without_errors(page));
  ORIEL_TRY_VOID(each("light", kLightmapSection, pages, take));
  ORIEL_TRY_VOID(each("texture", kTextureSection, pack.textures, take));
  ORIEL_TRY_VOID(each("normal", kNormalTextureSection, pack.normal_textures, take));
  if (pack.sky_map.width > 0)
    ORIEL_TRY_VOID(each("sky", kSkyMapSection, std::vector<SkyMap>{small_sky(pack.sky_map)}, take));
  if (!pack.movers.empty() && pack.light_field.bands > 0) {
    ORIEL_TRY_VOID(each("field", kLightFieldSection, std::vector<LightField>{pack.light_field}, take));
    ORIEL_TRY_VOID(each("mover", kMoverSection, pack.movers, take));
  }
  ORIEL_TRY_VOID(each("surround", kSurroundMapSection, pack.surround_maps, take));
  return each("lamps", kPageGroupsSection, pack.page_groups, take);
}

}  // namespace oriel
