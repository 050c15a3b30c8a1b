#include "player/scene/check.h"

#include <algorithm>

#include "player/images/map_choice.h"
#include "player/scene/gpu_sharp_light.h"

namespace oriel {
namespace {

// Asks whether numbers stay within limits; keeps the first answer that is no.
class Limits {
 public:
  explicit Limits(const gpu::Device& device) : device_(device) {}

  void at_most(const std::string& where, const char* what, std::uint64_t found, std::uint64_t limit) {
    if (status_ && found > limit)
      status_ = fail(ErrorCode::kRuntime, where, "found {} {}, expected at most {} ({})", found, what, limit,
                     device_.renderer);
  }
  // Texels of a side of a texture.
  void side(const std::string& where, std::uint64_t found) { at_most(where, "texels", found, side_limit()); }
  void sides(const std::string& kind, std::size_t i, std::uint64_t width, std::uint64_t height) {
    side(fmt::format("{} {}", kind, i), std::max(width, height));
  }
  std::uint64_t side_limit() const { return static_cast<std::uint64_t>(device_.texture_size); }
  std::uint64_t layer_limit() const { return static_cast<std::uint64_t>(device_.array_layers); }
  const Status& status() const { return status_; }

 private:
  const gpu::Device& device_;
  Status status_;
};

void check_images(const Pack& pack, Limits& limits) {
  const auto each = [&](const char* kind, const auto& images) {
    for (std::size_t i = 0; i < images.size(); ++i) limits.sides(kind, i, images[i].width, images[i].height);
  };
  each("texture", pack.textures);
  each("normal texture", pack.normal_textures);
  each("lightmap", pack.lightmaps);
  each("radiance map", pack.radiance_maps);
  // Levels of a surround map lie side by side with their borders.
  for (std::size_t i = 0; i < pack.surround_maps.size(); ++i)
    limits.side(fmt::format("surround map {}", i), pack.surround_maps[i].size + pack.surround_maps[i].size / 2 + 4);
}

// Kernels have a row of taps a slice, reflectances a row each of one texture.
void check_tables(const Pack& pack, Limits& limits) {
  for (std::size_t i = 0; i < pack.kernels.size(); ++i) {
    const std::string where = fmt::format("kernel {}", i);
    limits.side(where, std::max(pack.kernels[i].size, pack.kernels[i].slice_size));
    limits.at_most(where, "slices", pack.kernels[i].slices.size(), limits.side_limit());
  }
  limits.at_most("Fresnel maps", "of them", pack.fresnel_maps.size(), limits.side_limit());
  for (std::size_t i = 0; i < pack.fresnel_maps.size(); ++i)
    limits.sides("Fresnel map", i, pack.fresnel_maps[i].table.size(), 1);
}

void check_reflectors(const Pack& pack, Limits& limits) {
  const auto check_nodes = [&](const std::string& where, const Reflector& r) {
    limits.side(where, std::max<std::uint64_t>(r.visibility_x, r.visibility_y * std::uint64_t{r.emitters.size()}));
  };
  for (std::size_t i = 0; i < pack.frosted_panes.size(); ++i)
    check_nodes(fmt::format("frosted pane {} '{}'", i, pack.frosted_panes[i].name), pack.frosted_panes[i]);
  for (std::size_t i = 0; i < pack.reflectors.size(); ++i) {
    const Reflector& r = pack.reflectors[i];
    const std::string where = fmt::format("reflector {} '{}'", i, r.name);
    check_nodes(where, r);
    for (const ReflectorElement& element : group_by_element(r, pack.radiance_maps))
      limits.at_most(where, "maps of one element", element.maps.size(), limits.layer_limit());
  }
}

// Four weights a texel, 2048 texels a row.
void check_movers(const Pack& pack, Limits& limits) {
  for (std::size_t i = 0; i < pack.movers.size(); ++i) {
    const CompressedTransfer& t = pack.movers[i].transfer;
    limits.at_most(fmt::format("mover {} '{}'", i, pack.movers[i].name), "texels of weights",
                   t.vertices() * static_cast<std::size_t>(t.components + 3) / 4, 2048 * limits.side_limit());
  }
}

void check_sharp_light(const SharpLight& light, Limits& limits) {
  if (light.empty()) return;
  std::size_t of_triangles = 4 * light.triangles.size();
  for (const LampProfile& profile : light.profiles) of_triangles += profile.candela.size() + kSharpColumns;
  const std::size_t most = std::max(light.words.size() + 2 * kSharpColumns, of_triangles);
  limits.side("sharp light", std::max({kSharpColumns, (most + kSharpColumns - 1) / kSharpColumns, light.lamps.size()}));
}

}  // namespace

Status check_drawable(const Pack& pack, const gpu::Device& device) {
  Limits limits(device);
  check_images(pack, limits);
  check_tables(pack, limits);
  check_reflectors(pack, limits);
  check_movers(pack, limits);
  check_sharp_light(pack.sharp_light, limits);
  return limits.status();
}

}  // namespace oriel
