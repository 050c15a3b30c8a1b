#include "bake/import/opacity.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/assets/opacity.h"

namespace oriel {
namespace {

// The texels of an image that do not reach an alpha: counts of all above and to the left of each.
class SheerTexels {
 public:
  SheerTexels(const Image& image, float least) : width_(image.width), height_(image.height) {
    const auto sheer = [&](std::size_t texel) { return static_cast<float>(image.texels[4 * texel + 3]) < 255 * least; };
    std::size_t first = 0;
    while (4 * first < image.texels.size() && !sheer(first)) ++first;
    if (4 * first >= image.texels.size()) return;  // none: no counts
    sums_.assign((std::size_t{width_} + 1) * (height_ + 1), 0);
    for (std::uint32_t y = 0; y < height_; ++y)
      for (std::uint32_t x = 0; x < width_; ++x) {
        const std::uint32_t one = sheer(std::size_t{y} * width_ + x) ? 1 : 0;
        at(x + 1, y + 1) = at(x, y + 1) + at(x + 1, y) - at(x, y) + one;
      }
  }

  // Whether there are any where a triangle with such texture coordinates reads the image.
  bool any(const DVec2 (&corners)[3], const TextureSlot& slot) {
    if (sums_.empty()) return false;
    const DVec2 size(width_, height_), low = glm::min(glm::min(corners[0], corners[1]), corners[2]) * size,
                                       high = glm::max(glm::max(corners[0], corners[1]), corners[2]) * size;
    const Span columns = span_of(low.x, high.x, width_, slot.wrap_s, slot.nearest),
               rows = span_of(low.y, high.y, height_, slot.wrap_t, slot.nearest);
    for (std::uint32_t y = rows.first, down = rows.count; down > 0;) {
      const std::uint32_t bottom = std::min(y + down, height_);
      for (std::uint32_t x = columns.first, across = columns.count; across > 0;) {
        const std::uint32_t right = std::min(x + across, width_);
        if (at(right, bottom) + at(x, y) != at(x, bottom) + at(right, y)) return true;
        across -= right - x, x = 0;
      }
      down -= bottom - y, y = 0;
    }
    return false;
  }

 private:
  struct Span {
    std::uint32_t first = 0, count = 0;  // may go on at 0
  };

  // Of texels that are read between two places, in texels. A mirrored image is taken whole beyond its sides.
  static Span span_of(double low, double high, std::uint32_t size, Wrap wrap, bool nearest) {
    const double n = size, reach = nearest ? 0 : 0.5;
    if (!std::isfinite(high - low)) return {0, size};
    double first = std::floor(low - reach), last = std::max(first, std::ceil(high + reach) - 1);
    if (wrap == Wrap::kClamp || (wrap == Wrap::kMirror && low >= 0 && high <= n))
      first = std::clamp(first, 0.0, n - 1), last = std::clamp(last, 0.0, n - 1);
    else if (wrap == Wrap::kMirror || !(last - first + 1 < n))
      return {0, size};
    const double start = first - std::floor(first / n) * n;
    return {static_cast<std::uint32_t>(std::min(start, n - 1)), static_cast<std::uint32_t>(last - first + 1)};
  }

  std::uint32_t& at(std::uint32_t x, std::uint32_t y) { return sums_[std::size_t{y} * (width_ + 1) + x]; }

  std::uint32_t width_, height_;
  std::vector<std::uint32_t> sums_;  // empty: there are none
};

class OpaqueSurfaces {
 public:
  explicit OpaqueSurfaces(const Scene& scene) : scene_(scene) {}

  bool is_opaque(const Surface& surface) {
    const SceneMaterial& m = scene_.materials[surface.material];
    if (m.alpha_mode == AlphaMode::kOpaque) return true;
    float factor = m.alpha;
    for (std::uint32_t v = 0; v < surface.vertex_count && !scene_.colors.empty(); ++v)
      factor = std::min(factor, m.alpha * static_cast<float>(scene_.colors[surface.first_vertex + v] >> 24) / 255);
    const float least = m.alpha_mode == AlphaMode::kMask ? m.alpha_cutoff : kOpaqueAlpha;
    if (factor < least || m.base_color_texture.image < 0) return factor >= least;
    return !any_sheer(surface, m.base_color_texture, factor > 0 ? least / factor : 0);
  }

 private:
  bool any_sheer(const Surface& surface, const TextureSlot& slot, float least) {
    const auto image = static_cast<std::size_t>(slot.image);
    SheerTexels& texels = known_.try_emplace({image, least}, scene_.images[image], least).first->second;
    const std::vector<Vec2>& uvs = slot.texcoord == 0 ? scene_.uv0 : scene_.uv1;
    for (std::uint32_t i = 0; i < surface.triangle_count; ++i) {
      DVec2 corners[3];
      for (int k = 0; k < 3; ++k)
        corners[k] = DMat3(slot.image_from_uv) * DVec3(uvs[scene_.triangles[surface.first_triangle + i][k]], 1);
      if (texels.any(corners, slot)) return true;
    }
    return false;
  }

  const Scene& scene_;
  std::map<std::pair<std::size_t, float>, SheerTexels> known_;
};

}  // namespace

void find_opaque(Scene& scene) {
  OpaqueSurfaces surfaces(scene);
  std::vector<char> opaque(scene.surfaces.size()), all(scene.materials.size(), 1);
  for (std::size_t s = 0; s < opaque.size(); ++s) {
    opaque[s] = surfaces.is_opaque(scene.surfaces[s]) ? 1 : 0;
    if (opaque[s] == 0) all[scene.surfaces[s].material] = 0;
  }
  std::map<std::uint32_t, std::uint32_t> copies;  // of materials that are opaque on some surfaces only
  for (std::size_t s = 0; s < opaque.size(); ++s) {
    std::uint32_t& material = scene.surfaces[s].material;
    if (opaque[s] == 0 || scene.materials[material].alpha_mode == AlphaMode::kOpaque) continue;
    if (all[material] == 0) {
      const auto [copy, is_new] = copies.try_emplace(material, scene.materials.size());
      if (is_new) scene.materials.push_back(SceneMaterial(scene.materials[material]));
      material = copy->second;
    }
    scene.materials[material].alpha_mode = AlphaMode::kOpaque;
  }
}

}  // namespace oriel
