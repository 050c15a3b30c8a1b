#include "study/udeshi1999/ray_check.h"

#include <chrono>
#include <map>

#include "preview/frame/lamp_rays.h"

namespace oriel::study {
namespace {

constexpr std::size_t kBlock = 8;
enum Found : std::uint8_t { kShone = 1, kShaded = 2 };

// By lamp, what its points so far do to each block.
class Regions {
 public:
  Regions(std::size_t width, std::size_t height)
      : across_((width + kBlock - 1) / kBlock), count_(across_ * ((height + kBlock - 1) / kBlock)) {}
  void tell(std::uint32_t lamp, std::size_t x, std::size_t y, bool lit) {
    std::vector<std::uint8_t>& blocks = lamps_[lamp];
    if (blocks.empty()) blocks.resize(count_);
    blocks[y / kBlock * across_ + x / kBlock] |= lit ? kShone : kShaded;
  }
  std::array<std::size_t, 3> counts() const {
    std::array<std::size_t, 3> out{};
    for (const auto& [lamp, blocks] : lamps_)
      for (const std::uint8_t found : blocks)
        if (found != 0) ++out[found - 1u];
    return out;
  }

 private:
  std::size_t across_, count_;
  std::map<std::uint32_t, std::vector<std::uint8_t>> lamps_;
};

// rays: by pixel as lamps_by_rays() of one point; dark: by pixel, as volumes have it.
void compare(const SeenPoints& seen, const std::vector<Vec4>& rays, const std::vector<std::uint8_t>& counts,
             RayCheck& out) {
  const auto width = static_cast<std::size_t>(seen.width), height = static_cast<std::size_t>(seen.height);
  const auto passes = [&](std::size_t i) { return rays[i].x + rays[i].y + rays[i].z > 0; };
  for (std::size_t y = 1; y + 1 < height; ++y)
    for (std::size_t x = 1; x + 1 < width; ++x) {
      const std::size_t i = y * width + x;
      if (!(rays[i].w > 0)) continue;
      bool edge = false;
      for (std::size_t row = i - width; row <= i + width; row += width)
        for (std::size_t j = row - 1; j <= row + 1; ++j) edge |= passes(j) != passes(i) || !(rays[j].w > 0);
      ++(passes(i) ? out.lit : out.dark);
      out.silhouettes += edge ? 1 : 0;
      if ((counts[i] == 0) != passes(i)) ++(edge ? out.wrong_on_silhouettes : out.wrong);
    }
}

// Volumes are of facets: a rounded body's facet that is turned away from the light lies in its own.
void leave_out_turned_away(const SeenPoints& seen, const LampPoint& lamp, std::vector<Vec4>& rays) {
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (glm::dot(Vec3(seen.face[i]), Vec3(lamp.place) - lamp.place.w * Vec3(seen.place[i])) <= 0) rays[i] = Vec4(0);
}

}  // namespace

Result<RayCheck> check_by_rays(HybridRenderer& renderer, const PreviewScene& scene, std::span<const LampPoint> lamps,
                               std::uint32_t cap_rays, Context& context, bool forget_eye) {
  RayCheck out;
  const SeenPoints seen = renderer.seen(0);
  const auto width = static_cast<std::size_t>(seen.width);
  Regions regions(width, static_cast<std::size_t>(seen.height));
  out.reached.resize(seen.place.size());
  for (const LampPoint& point : lamps) {
    std::vector<std::uint8_t> counts = renderer.count_volumes(point, cap_rays);
    if (forget_eye)
      for (std::uint8_t& count : counts) count = static_cast<std::uint8_t>(count - renderer.volumes_around_eye(point));
    ORIEL_TRY(std::vector<Vec4> rays, lamps_by_rays(seen, {&point, 1}, *scene.accel, {}, context));
    leave_out_turned_away(seen, point, rays);
    compare(seen, rays, counts, out);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (!(rays[i].w > 0)) continue;
      if (counts[i] == 0) out.reached[i] += 1 / static_cast<float>(lamps.size());
      regions.tell(point.lamp, i % width, i / width, counts[i] == 0);
    }
  }
  out.blocks = regions.counts();
  const auto start = std::chrono::steady_clock::now();
  ORIEL_TRY_VOID(lamps_by_rays(seen, lamps, *scene.accel, {}, context));
  out.rays_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace oriel::study
