#include "formats/export/shown_page.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/assets/bilinear.h"
#include "formats/core/color.h"
#include "formats/image/texel_centres.h"

namespace oriel {
namespace {

constexpr std::uint32_t kFinest = 4;  // times the page
constexpr std::uint32_t kGutter = 2;  // texels of the page that are filled around surfaces

Vec3 texture_color(const Texture& texture, const Vec2& uv) {
  const TexelsAround around = texels_around(uv, texture.width, texture.height, texture.wrap_s, texture.wrap_t);
  Vec3 color(0);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint8_t* texel = &texture.texels[4 * around.texel[i]];
    color +=
        around.weight[i] * Vec3(linear_from_srgb8(texel[0]), linear_from_srgb8(texel[1]), linear_from_srgb8(texel[2]));
  }
  return color;
}

Vec3 vertex_color(const Mesh& mesh, std::uint32_t vertex) {
  if (mesh.colors.empty()) return Vec3(1);
  const std::uint32_t c = mesh.colors[vertex];
  return Vec3(c & 255, c >> 8 & 255, c >> 16 & 255) / 255.0f;
}

// R of a material as if light came and went evenly: its mean over the hemisphere by the cosine.
Vec3 mean_reflectance(const Pack& pack, const Material& material) {
  if (material.fresnel_map < 0) return Vec3(0);
  const FresnelMap& map = pack.fresnel_maps[static_cast<std::size_t>(material.fresnel_map)];
  constexpr int kSteps = 256;  // of sin²: each has the same share of the projected hemisphere
  Vec3 sum(0);
  for (int i = 0; i < kSteps; ++i)
    sum += lookup_by_cosine(map.table, std::sqrt((static_cast<float>(i) + 0.5f) / kSteps));
  return sum / float{kSteps};
}

class PageRaster {
 public:
  PageRaster(const Pack& pack, std::size_t page, std::uint32_t scale)
      : pack_(pack), page_(pack.lightmaps[page]), width_(page_.width * scale), height_(page_.height * scale) {
    light_.resize(std::size_t{width_} * height_);
    covered_.resize(light_.size());
    for (const Material& m : pack.materials) reflectance_.push_back(mean_reflectance(pack, m));
  }

  void draw(const MeshPart& part) {
    for (std::uint32_t t = 0; t + 2 < part.index_count; t += 3)
      draw_triangle(part.material, &pack_.mesh.indices[part.first_index + t]);
  }

  // A ring of texels further out: the mean of the neighbours that have light.
  void widen() {
    const std::vector<std::uint8_t> before = covered_;
    for (std::uint32_t y = 0; y < height_; ++y)
      for (std::uint32_t x = 0; x < width_; ++x) {
        const std::size_t at = std::size_t{y} * width_ + x;
        if (before[at] != 0) continue;
        Vec3 sum(0);
        float count = 0;
        for (std::uint32_t j = y - (y > 0); j <= std::min(y + 1, height_ - 1); ++j)
          for (std::uint32_t i = x - (x > 0); i <= std::min(x + 1, width_ - 1); ++i)
            if (before[std::size_t{j} * width_ + i] != 0) sum += light_[std::size_t{j} * width_ + i], ++count;
        if (count > 0) light_[at] = sum / count, covered_[at] = 1;
      }
  }

  FloatImage image() const { return rgb_image(width_, height_, light_); }

 private:
  void draw_triangle(std::uint32_t material, const std::uint32_t* v) {
    std::array<Vec2, 3> uv;
    for (std::size_t c = 0; c < 3; ++c) uv[c] = pack_.mesh.lightmap_uvs[v[c]];
    for_texel_centres(uv, width_, height_, [&](std::uint32_t x, std::uint32_t y, const Vec3& b) {
      const std::size_t to = std::size_t{y} * width_ + x;
      light_[to] = radiance(material, v, b);
      covered_[to] = 1;
    });
  }

  // The player's shading equation without images: wide lobes of the mean reflectance.
  Vec3 radiance(std::uint32_t number, const std::uint32_t* v, const Vec3& b) const {
    const Mesh& mesh = pack_.mesh;
    const Material& material = pack_.materials[number];
    const Vec3& r = reflectance_[number];
    Vec2 uv(0), page_uv(0);
    Vec3 color(0);
    for (int c = 0; c < 3; ++c) {
      uv += b[c] * mesh.uvs[v[c]];
      page_uv += b[c] * mesh.lightmap_uvs[v[c]];
      color += b[c] * vertex_color(mesh, v[c]);
    }
    Vec3 albedo = glm::clamp(material.base_color, Vec3(0), Vec3(1)) * color * (1 - material.metallic);
    if (material.base_color_texture >= 0)
      albedo *= texture_color(pack_.textures[static_cast<std::size_t>(material.base_color_texture)], uv);
    return (albedo * (1 - max_component(r)) + r) * irradiance_at(page_, page_uv) / kPi + material.emission;
  }

  const Pack& pack_;
  const LightmapPage& page_;
  std::uint32_t width_, height_;
  std::vector<Vec3> reflectance_;  // by material
  std::vector<Vec3> light_;
  std::vector<std::uint8_t> covered_;
};

}  // namespace

FloatImage shown_page(const Pack& pack, std::size_t page, std::uint32_t scale) {
  PageRaster raster(pack, page, scale);
  for (const MeshPart& part : pack.mesh.parts)
    if (part.lightmap_page == static_cast<std::int32_t>(page)) raster.draw(part);
  for (std::uint32_t ring = 0; ring < kGutter * scale; ++ring) raster.widen();
  return raster.image();
}

std::uint32_t fitting_scale(const Pack& pack, std::size_t page, std::uint32_t longest) {
  const LightmapPage& p = pack.lightmaps[page];
  const bool textured = std::any_of(pack.mesh.parts.begin(), pack.mesh.parts.end(), [&](const MeshPart& part) {
    return part.lightmap_page == static_cast<std::int32_t>(page) &&
           pack.materials[part.material].base_color_texture >= 0;
  });
  return textured ? std::clamp(longest / std::max(p.width, p.height), 1u, kFinest) : 1;
}

}  // namespace oriel
