#include "formats/query/live_bounces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/core/color.h"
#include "formats/core/low_discrepancy.h"
#include "formats/core/parallel.h"

namespace oriel {
namespace {

constexpr std::uint32_t kNoRow = BouncedLight::kNone;
constexpr std::uint32_t kMostRays = 64, kFewestRays = 8;  // of a texel
constexpr std::size_t kMostInAll = std::size_t{1} << 25;  // of 4 bytes each
constexpr std::uint32_t kPlaces = 8;                      // of a texel, whose reflectance is the mean
constexpr int kFarthest = 2;                              // texels, from where light was met to one that has some
constexpr float kSamePlane = 0.95f;                       // cosine between normals of neighbours
constexpr float kAlike = 0.5f;     // cosine between normals of the place where a ray ends and of a texel beside it
constexpr float kOffPlane = 0.1f;  // of their distance

void for_rows(std::size_t rows, const std::atomic<bool>* stop, const std::function<void(std::size_t)>& each) {
  for_each_run(rows, core_count(), [&](std::size_t first, std::size_t end) {
    for (std::size_t row = first; row < end && !(stop != nullptr && *stop); ++row) each(row);
  });
}

}  // namespace

LiveBounces::LiveBounces(const LampScene& scene, std::span<const LightmapPage> pages,
                         std::span<const std::vector<PagePoint>> points)
    : scene_(&scene), pages_(pages) {
  const auto add = [&](std::uint32_t page, std::size_t k) {
    row_of_[page][k] = static_cast<std::uint32_t>(rows_.size());
    rows_.push_back({page, points[page][k].index, &points[page][k]});
  };
  const auto is_texel = [&](std::uint32_t page, std::size_t k) {
    return points[page][k].index < pages_[page].irradiance.size();
  };
  for (std::uint32_t p = 0; p < pages.size(); ++p) {
    row_at_.emplace_back(pages[p].irradiance.size(), kNoRow);
    row_of_.emplace_back(points[p].size(), kNoRow);
    for (std::size_t k = 0; k < points[p].size(); ++k) {
      if (!is_texel(p, k)) continue;
      row_at_[p][points[p][k].index] = static_cast<std::uint32_t>(rows_.size());
      add(p, k);
    }
  }
  texels_ = rows_.size();
  for (std::uint32_t p = 0; p < pages.size(); ++p)
    for (std::size_t k = 0; k < points[p].size(); ++k) {
      if (is_texel(p, k)) continue;
      const TexelsAround around = texels_around(pages[p], points[p][k]);
      if (std::ranges::all_of(around.texel, [&](std::size_t t) { return row_at_[p][t] == kNoRow; })) add(p, k);
    }
  look_again(scene);
}

void LiveBounces::look_again(const LampScene& scene) {
  scene_ = &scene;
  reflectance_.resize(texels_);
  // At places of each texel's square by chance: at middles a floor's joints, as far apart as some texels, were all
  // there is.
  for_rows(texels_, nullptr, [&](std::size_t row) {
    const PagePoint& point = *rows_[row].point;
    const LightmapPage& page = pages_[rows_[row].page];
    Vec3 sum(0);
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
      const Vec2 off = (shifted_r2(i, static_cast<std::uint32_t>(row)) - 0.5f) / Vec2(page.width, page.height);
      sum += scene.reflectance(point.part, point.first_index, shares_beside(scene.mesh(), point, off));
    }
    reflectance_[row] = sum / static_cast<float>(kPlaces);
  });
}

std::uint32_t LiveBounces::wanted_rays() const {
  const std::size_t each = kMostInAll / std::max<std::size_t>(rows_.size(), 1);
  return std::clamp(static_cast<std::uint32_t>(std::min<std::size_t>(each, kMostRays)), kFewestRays, kMostRays);
}

void LiveBounces::trace(std::uint32_t rays, const std::atomic<bool>* stop) {
  while (this->rays() < rays && !(stop != nullptr && *stop)) {
    std::vector<std::uint32_t> round(rows_.size() * kRound);
    const std::uint32_t first = this->rays();
    for_rows(rows_.size(), stop, [&](std::size_t row) {
      for (std::uint32_t i = 0; i < kRound; ++i) round[row * kRound + i] = met(row, first + i);
    });
    if (stop == nullptr || !*stop) rounds_.push_back(std::move(round));
  }
}

std::uint32_t LiveBounces::met(std::size_t row, std::uint32_t ray) const {
  const PagePoint& point = *rows_[row].point;
  const Vec3 direction = cosine_direction(shifted_r2(ray, static_cast<std::uint32_t>(row)), point.normal);
  const auto lit = scene_->lit_place(point.position + scene_->offset_m() * point.normal, direction);
  return lit && lit->page < pages_.size() ? row_near(*lit) : kNoRow;
}

bool LiveBounces::in_plane(const PagePoint& point, const Vec3& position, const Vec3& normal) const {
  const Vec3 way = point.position - position;
  return glm::dot(point.normal, normal) >= kSamePlane &&
         std::abs(glm::dot(way, normal)) <= kOffPlane * glm::length(way);
}

// Of the texel there, or of the nearest that faces alike: texels of other charts lie beside.
std::uint32_t LiveBounces::row_near(const LampScene::LitPlace& place) const {
  const LightmapPage& page = pages_[place.page];
  const IVec2 size(static_cast<int>(page.width), static_cast<int>(page.height));
  const IVec2 at = glm::clamp(IVec2(glm::floor(place.uv * Vec2(size))), IVec2(0), size - 1);
  const auto row_of_texel = [&](int x, int y) {
    return row_at_[place.page][static_cast<std::size_t>(y) * page.width + static_cast<std::size_t>(x)];
  };
  if (const std::uint32_t row = row_of_texel(at.x, at.y); row != kNoRow) return row;
  std::uint32_t best = kNoRow;
  float least = std::numeric_limits<float>::infinity();
  for (int y = std::max(at.y - kFarthest, 0); y <= std::min(at.y + kFarthest, size.y - 1); ++y)
    for (int x = std::max(at.x - kFarthest, 0); x <= std::min(at.x + kFarthest, size.x - 1); ++x) {
      const std::uint32_t row = row_of_texel(x, y);
      if (row == kNoRow || glm::dot(rows_[row].point->normal, place.normal) < kAlike) continue;
      const float distance = glm::length(rows_[row].point->position - place.position);
      if (distance < least) best = row, least = distance;
    }
  return best;
}

LiveBounces::Light LiveBounces::gathered(std::size_t row, std::span<const Light> light) const {
  Light sum;
  for (const std::vector<std::uint32_t>& round : rounds_)
    for (std::uint32_t i = 0; i < kRound; ++i) {
      const std::uint32_t met = round[row * kRound + i];
      if (met != kNoRow) sum.now += light[met].now, sum.baked += light[met].baked;
    }
  const float each = 1 / static_cast<float>(std::max(rays(), 1u));
  return {sum.now * each, sum.baked * each};
}

// The same with what a regression wants of the rays: as many as they are, like lights (LiveSum).
LiveSum LiveBounces::summed(std::size_t row, std::span<const Light> light) const {
  LiveSum sum;
  const float count = static_cast<float>(std::max(rays(), 1u));
  for (const std::vector<std::uint32_t>& round : rounds_)
    for (std::uint32_t i = 0; i < kRound; ++i) {
      const std::uint32_t met = round[row * kRound + i];
      if (met == kNoRow) continue;
      const Vec3 now = light[met].now / count, baked = light[met].baked / count;
      sum.now += now, sum.baked += baked;
      const double x = luminance(now), y = luminance(baked);
      sum.products += count * x * y, sum.squares += count * y * y;
    }
  return sum;
}

// Neighbours have other rays: together they have the noise of nine times as many.
LiveSum LiveBounces::smoothed(std::size_t row, std::span<const LiveSum> sums) const {
  const auto& [page, index, point] = rows_[row];
  const int width = static_cast<int>(pages_[page].width), height = static_cast<int>(pages_[page].height);
  const int x = static_cast<int>(index) % width, y = static_cast<int>(index) / width;
  LiveSum mean;
  float total = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
      const std::uint32_t other = row_at_[page][static_cast<std::size_t>(v) * pages_[page].width + u];
      if (other == kNoRow) continue;
      if (!in_plane(*rows_[other].point, point->position, point->normal)) continue;
      const float weight = static_cast<float>((2 - std::abs(u - x)) * (2 - std::abs(v - y)));
      add_share(mean, weight, sums[other]);
      total += weight;
    }
  LiveSum out;
  add_share(out, 1 / total, mean);
  return out;
}

BouncedLight LiveBounces::bounced(std::span<const std::vector<LiveSum>> direct, std::uint32_t bounces,
                                  const std::atomic<bool>* stop) const {
  BouncedLight out;
  out.row_of = row_of_;
  if (bounces == 0) {
    out.sums.resize(rows_.size());
    return out;
  }
  // What texels reflect of the lamp's light, then with what each bounce adds.
  std::vector<Light> reflected(texels_), next(texels_);
  const auto direct_of = [&](std::size_t row) -> const LiveSum& { return direct[rows_[row].page][rows_[row].index]; };
  const auto reflect = [&](std::size_t row, const Light& more) {
    const LiveSum& lamp = direct_of(row);
    return Light{reflectance_[row] * (lamp.now + more.now), reflectance_[row] * (lamp.baked + more.baked)};
  };
  for (std::size_t row = 0; row < texels_; ++row) reflected[row] = reflect(row, {});
  for (std::uint32_t bounce = 1; bounce < bounces; ++bounce) {
    for_rows(texels_, stop, [&](std::size_t row) { next[row] = reflect(row, gathered(row, reflected)); });
    reflected.swap(next);
  }
  std::vector<LiveSum> sums(rows_.size());
  for_rows(rows_.size(), stop, [&](std::size_t row) { sums[row] = summed(row, reflected); });
  double last = 0, all = 0;
  for (std::size_t row = 0; row < texels_; ++row) {
    last += luminance(reflectance_[row] * (direct_of(row).now + sums[row].now)) - luminance(reflected[row].now);
    all += luminance(direct_of(row).now + sums[row].now);
  }
  out.left = all > 0 ? last / all : 0;
  out.sums = sums;
  for_rows(texels_, stop, [&](std::size_t row) { out.sums[row] = smoothed(row, sums); });
  return out;
}

}  // namespace oriel
