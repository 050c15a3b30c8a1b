#include "player/passes/image_budget.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace oriel {
namespace {

constexpr float kCoarseBudget = 0.125f;  // of a whole frame's: 25 ms for 200, of the 67 that pace gives a frame
constexpr float kBudgetPixels = 1280 * 720;

}  // namespace

float ImagePrices::of(std::uint64_t parts, std::uint64_t triangles, std::uint64_t pixels) const {
  return image_ms + 1e-3f * (part_us * static_cast<float>(parts) + triangle_us * static_cast<float>(triangles) +
                             pixel_us * static_cast<float>(pixels));
}

bool is_software(const std::string& renderer) {
  return renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos ||
         renderer.find("SwiftShader") != std::string::npos;
}

ImagePrices image_prices(const std::string& renderer) {
  // docs/notes/frame.md, "What an image costs".
  if (is_software(renderer)) return {1, 30, 0.15f, 0.2f};
  return {0.008f, 1, 0.0013f, 0.00046f};
}

float device_budget_ms(const std::string& renderer) {
  return is_software(renderer) ? 200 : 8;
}

float frame_budget_ms(float budget_ms, int width, int height, bool coarse) {
  if (coarse) return kCoarseBudget * budget_ms;
  return budget_ms * std::max(static_cast<float>(width) * static_cast<float>(height) / kBudgetPixels, 1.0f);
}

std::vector<ImageAllowance> afford_images(std::span<const PricedImage> images, float budget_ms) {
  std::vector<std::size_t> order(images.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (images[a].needed != images[b].needed) return images[a].needed;
    return images[a].worth * images[b].price_ms > images[b].worth * images[a].price_ms;
  });
  std::vector<ImageAllowance> out(images.size());
  float left = budget_ms, worth = 0;
  for (const std::size_t i : order) {
    if (!images[i].needed && images[i].price_ms > left) continue;
    out[i].drawn = true;
    left -= images[i].price_ms;
    worth += images[i].worth;
  }
  for (std::size_t i = 0; i < images.size(); ++i)
    if (out[i].drawn && images[i].worth > 0) out[i].within_ms = std::max(left, 0.0f) * (images[i].worth / worth);
  return out;
}

float reflectance_of(const Pack& pack, std::uint32_t material) {
  const std::int32_t row = pack.materials[material].fresnel_map;
  if (row < 0) return 0;
  const auto& table = pack.fresnel_maps[static_cast<std::size_t>(row)].table;
  return table.empty() ? 0.0f : max_component(table[table.size() / 2]);
}

float image_gain(const GpuScene& scene, const View& view, const GpuReflector& reflector, const NdcRect& screen) {
  const Material& material = scene.pack().materials[reflector.material];
  const float usual = reflectance_of(scene.pack(), reflector.material);
  if (!(usual > 0)) return 0;
  const Vec4 seen = glm::inverse(view.clip_from_pack) * Vec4(0.5f * (screen.lower + screen.upper), 0, 1);
  const Vec3 along = normalize_or(Vec3(seen) * view.eye.w - Vec3(view.eye) * seen.w, Vec3(0));
  const float cosine = std::abs(glm::dot(along, Vec3(reflector.pack_from_reflector[2])));
  const auto& table = scene.pack().fresnel_maps[static_cast<std::size_t>(material.fresnel_map)].table;
  const float at = std::sqrt(std::min(cosine, 1.0f)) * static_cast<float>(table.size() - 1);
  return max_component(table[static_cast<std::size_t>(at)]) / usual * (1 - material.roughness);
}

}  // namespace oriel
