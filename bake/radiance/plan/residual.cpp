#include "bake/radiance/plan/residual.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "bake/jobs/parallel.h"
#include "bake/radiance/reproject.h"

namespace oriel {
namespace {

constexpr int kMaxHidden = 16;         // surfaces in front of a missing one
constexpr float kSameSurface = 0.03f;  // relative distance from a missing sample's tangent plane

bool is_in_window(const RadianceMap& map, const ReflectedSample& s) {
  const Vec2 pixel = map_pixel(map, Vec3(s.image));
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < static_cast<float>(map.width) &&
         pixel.y < static_cast<float>(map.height);
}

bool same_element(const RadianceMap& a, const RadianceMap& b) {
  return a.lower == b.lower && a.upper == b.upper;
}

bool sees(const Surroundings& surroundings, const RadianceMap& map, const ReflectedSample& s) {
  return std::isfinite(needed_resolution(surroundings, map.reflector, map.eye, {map.lower, map.upper}, s));
}

// The map of the reflector in whose window most of the samples' weight lies; null where none has any.
const RadianceMap* best_host(std::span<const RadianceMap> maps, std::span<const ReflectedSample> missing) {
  const RadianceMap* best = nullptr;
  double most = 0;
  for (const RadianceMap& map : maps) {
    double weight = 0;
    for (const ReflectedSample& s : missing) weight += is_in_window(map, s) ? s.weight : 0;
    if (weight > most) best = &map, most = weight;
  }
  return best;
}

class ResidualCapture {
 public:
  ResidualCapture(const Surroundings& surroundings, const OutgoingRadiance& outgoing,
                  std::span<const RadianceMap> others, RadianceMap& map)
      : surroundings_(surroundings),
        reflector_(surroundings.reflectors()[map.reflector].reflector),
        outgoing_(outgoing),
        others_(others),
        map_(map) {}

  // The samples by pixel: each pixel's own first, then those of neighbours, ring by ring.
  std::vector<const ReflectedSample*> aims(std::span<const ReflectedSample> missing, std::uint32_t spread) const {
    std::vector<const ReflectedSample*> aim(map_.valid.size());
    for (int ring = 0; ring <= static_cast<int>(spread); ++ring)
      for (const ReflectedSample& s : missing) {
        if (!is_in_window(map_, s)) continue;
        const IVec2 centre(map_pixel(map_, Vec3(s.image)));
        for (int y = std::max(centre.y - ring, 0); y <= std::min(centre.y + ring, static_cast<int>(map_.height) - 1);
             ++y)
          for (int x = std::max(centre.x - ring, 0); x <= std::min(centre.x + ring, static_cast<int>(map_.width) - 1);
               ++x)
            if (auto& at = aim[static_cast<std::size_t>(y) * map_.width + static_cast<std::size_t>(x)]; !at) at = &s;
      }
    return aim;
  }

  // The surface along the pixel's ray that lies where the sample's goes on, if there is one that no other map sees.
  void capture(std::size_t at, const ReflectedSample& aim) {
    const Vec3 q(map_point(map_, Vec2(at % map_.width, at / map_.width) + 0.5f), 0);
    const Vec3 along = glm::normalize(q - map_.eye);
    const float expected = glm::dot(Vec3(aim.image) - q, aim.normal) / glm::dot(along, aim.normal);
    if (!(expected > 0) || !std::isfinite(expected)) return;
    const Vec3 direction = glm::normalize(Mat3(reflector_.pack_from_reflector) * along);
    Vec3 from = pack_from_reflector(reflector_, q);
    float passed = 0;
    for (int hidden = 0; hidden < kMaxHidden && passed < expected * (1 + kSameSurface); ++hidden) {
      const SeenLight seen = see(surroundings_, outgoing_, map_.reflector, from, direction);
      const float step = glm::length(seen.sight.offset);
      if (!(step > 0)) return;
      passed += step;
      if (seen.sight.state == Sight::kSurface && std::abs(passed - expected) <= kSameSurface * expected) {
        ReflectedSample found = aim;
        found.image = Vec4(q + passed * along, 1);
        const auto shown = [&](const RadianceMap& map) { return sees(surroundings_, map, found); };
        if (std::any_of(others_.begin(), others_.end(), shown)) return;
        map_.radiance[at] = seen.radiance;
        map_.disparity[at] = disparity_of(map_, found.image.z);
        map_.valid[at] = 1;
        return;
      }
      from += direction * (step * (1 + 1e-5f));
      passed += step * 1e-5f;
    }
  }

 private:
  const Surroundings& surroundings_;
  const Reflector& reflector_;
  const OutgoingRadiance& outgoing_;
  std::span<const RadianceMap> others_;
  RadianceMap& map_;
};

Result<std::optional<RadianceMap>> residual_of(const Surroundings& surroundings, const OutgoingRadiance& outgoing,
                                               std::uint32_t reflector, std::span<const Vec3> eyes,
                                               std::span<const RadianceMap> maps, const ResidualOptions& options,
                                               Context& context) {
  ORIEL_TRY(const auto samples,
            sample_reflections(surroundings, reflector, eyes, options.samples, context.seed + 2, context));
  std::vector<std::uint8_t> is_missing(samples.size());
  ORIEL_TRY_VOID(parallel_for(context, "", samples.size(), [&](std::size_t i) {
    is_missing[i] = samples[i].image.w != 0 && std::none_of(maps.begin(), maps.end(), [&](const RadianceMap& map) {
                      return sees(surroundings, map, samples[i]);
                    });
  }));
  std::vector<ReflectedSample> missing;
  double total = 0, lost = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    total += samples[i].weight;
    if (is_missing[i]) missing.push_back(samples[i]), lost += samples[i].weight;
  }
  const RadianceMap* host = lost > options.least_missing * total ? best_host(maps, missing) : nullptr;
  if (!host) return std::nullopt;
  const UVec2 size =
      map_size({host->lower, host->upper}, std::min(options.max_resolution, std::max(host->width, host->height)));
  RadianceMap map;
  map.reflector = reflector;
  map.eye = host->eye;
  map.lower = host->lower;
  map.upper = host->upper;
  map.width = size.x;
  map.height = size.y;
  map.has_emission = host->has_emission;
  map.residual = true;
  const std::size_t pixels = std::size_t{size.x} * size.y;
  map.radiance.assign(pixels, Vec3(0));
  map.disparity.assign(pixels, 0);
  map.valid.assign(pixels, 0);
  ResidualCapture capture(surroundings, outgoing, maps, map);
  const auto aims = capture.aims(missing, options.spread);
  ORIEL_TRY_VOID(parallel_for(context, "", pixels, [&](std::size_t i) {
    if (aims[i]) capture.capture(i, *aims[i]);
  }));
  if (std::find(map.valid.begin(), map.valid.end(), 1) == map.valid.end()) return std::nullopt;
  return map;
}

}  // namespace

Status add_residuals(const Surroundings& surroundings, const OutgoingRadiance& outgoing, std::span<const Vec3> eyes,
                     const ResidualOptions& options, Context& context, std::vector<FoundReflector>& reflectors,
                     std::vector<RadianceMap>& maps) {
  std::vector<std::optional<RadianceMap>> residuals;
  for (std::uint32_t r = 0; r < reflectors.size(); ++r) {
    const Reflector& reflector = reflectors[r].reflector;
    const auto own = std::span<const RadianceMap>(maps).subspan(reflector.first_map, reflector.map_count);
    ORIEL_TRY(auto residual, residual_of(surroundings, outgoing, r, eyes, own, options, context));
    residuals.push_back(std::move(residual));
  }
  std::vector<RadianceMap> all;
  for (std::uint32_t r = 0; r < reflectors.size(); ++r) {
    Reflector& reflector = reflectors[r].reflector;
    const auto first = maps.begin() + reflector.first_map;
    reflector.first_map = static_cast<std::uint32_t>(all.size());
    for (auto map = first; map != first + reflector.map_count; ++map) {
      const bool ends_element = map + 1 == first + reflector.map_count || !same_element(*map, *(map + 1));
      all.push_back(std::move(*map));
      if (residuals[r] && ends_element && same_element(all.back(), *residuals[r]))
        all.push_back(std::move(*residuals[r])), residuals[r].reset();
    }
    reflector.map_count = static_cast<std::uint32_t>(all.size()) - reflector.first_map;
  }
  maps = std::move(all);
  return {};
}

}  // namespace oriel
