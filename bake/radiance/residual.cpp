#include "bake/radiance/residual.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "bake/radiance/reproject.h"

namespace oriel {
namespace {

constexpr std::uint32_t kLeastResolution = 16;
constexpr int kMaxHidden = 16;         // surfaces in front of a missing one
constexpr float kSameSurface = 0.03f;  // relative distance from a missing sample's tangent plane

bool is_in_window(const RadianceMap& map, const ReflectedSample& s) {
  const Vec2 pixel = map_pixel(map, s);
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < static_cast<float>(map.width) &&
         pixel.y < static_cast<float>(map.height);
}

// Where a residual is taken from.
struct Host {
  Vec3 eye{0};
  Element element;
  std::uint32_t resolution = 0;
  bool has_emission = false;
};

Host host_of(const RadianceMap& map) {
  return {map.eye, {map.lower, map.upper, map.element}, std::max(map.width, map.height), map.has_emission};
}

bool has_room(std::span<const RadianceMap> maps, std::uint32_t element) {
  const auto of_it = [&](const RadianceMap& map) { return map.element == element; };
  return std::count_if(maps.begin(), maps.end(), of_it) < std::ptrdiff_t{kMostMapsPerElement};
}

// The map of the reflector in whose window most of the samples' weight lies; none where none has any.
std::optional<Host> best_host(std::span<const RadianceMap> maps, std::span<const ReflectedSample> missing) {
  std::optional<Host> best;
  double most = 0;
  for (const RadianceMap& map : maps) {
    double weight = 0;
    for (const ReflectedSample& s : missing) weight += is_in_window(map, s) ? s.weight : 0;
    if (weight > most && has_room(maps, map.element)) best = host_of(map), most = weight;
  }
  return best;
}

// The mirror image of the eye of these samples, before the element in which most of their weight lies.
std::optional<Host> camera_host(std::span<const RadianceMap> maps, std::span<const ReflectedSample> missing) {
  std::optional<Host> best;
  double most = 0;
  for (const RadianceMap& map : maps) {
    double weight = 0;
    for (const ReflectedSample& s : missing)
      weight += glm::all(glm::greaterThanEqual(Vec2(s.on_plane), map.lower)) &&
                        glm::all(glm::lessThanEqual(Vec2(s.on_plane), map.upper))
                    ? s.weight
                    : 0;
    if (map.residual || !(weight > most) || !has_room(maps, map.element)) continue;
    best = host_of(map), most = weight;
    best->eye = missing[0].eye * Vec3(1, 1, -1);
  }
  return best;
}

class ResidualCapture {
 public:
  ResidualCapture(const LitSurroundings& lit, std::span<const RadianceMap> others, const Stage& stage, RadianceMap& map)
      : lit_(lit),
        reflector_(lit.around.reflectors()[map.reflector].reflector),
        others_(others),
        map_(map),
        stage_(stage) {}

  // The samples by pixel: each pixel's own first, then those of neighbours, ring by ring.
  std::vector<const ReflectedSample*> aims(std::span<const ReflectedSample> missing, std::uint32_t spread) const {
    std::vector<const ReflectedSample*> aim(map_.valid.size());
    for (int ring = 0; ring <= static_cast<int>(spread); ++ring)
      for (const ReflectedSample& s : missing) {
        if (!is_in_window(map_, s)) continue;
        const IVec2 centre(map_pixel(map_, s));
        for (int y = std::max(centre.y - ring, 0); y <= std::min(centre.y + ring, static_cast<int>(map_.height) - 1);
             ++y)
          for (int x = std::max(centre.x - ring, 0); x <= std::min(centre.x + ring, static_cast<int>(map_.width) - 1);
               ++x)
            if (auto& at = aim[static_cast<std::size_t>(y) * map_.width + static_cast<std::size_t>(x)]; !at) at = &s;
      }
    return aim;
  }

  // The surface along the pixel's ray that lies where the sample's goes on, or the sky that it shows, if there is one
  // that no other map sees.
  void capture(std::size_t at, const ReflectedSample& aim) {
    const Vec3 q(map_point(map_, Vec2(at % map_.width, at / map_.width) + 0.5f), 0);
    const Vec3 along = glm::normalize(q - map_.eye);
    const bool sky = aim.image.w == 0;
    const float expected = sky ? std::numeric_limits<float>::max()
                               : glm::dot(Vec3(aim.image) - q, aim.normal) / glm::dot(along, aim.normal);
    if (!(expected > 0) || !std::isfinite(expected)) return;
    const Vec3 direction = glm::normalize(Mat3(reflector_.pack_from_reflector) * along);
    Vec3 from = pack_from_reflector(reflector_, q);
    float passed = 0;
    for (int hidden = 0; hidden < kMaxHidden && passed < expected * (1 + kSameSurface); ++hidden) {
      const SeenLight seen = see(lit_, map_.reflector, from, direction);
      stage_.count(seen.rays);
      if (sky && seen.sight.state == Sight::kSky) {
        ReflectedSample found = aim;
        found.on_plane = q;
        found.image = Vec4(along, 0);
        if (!is_shown(found)) map_.radiance[at] = seen.radiance, map_.valid[at] = 2;
        return;
      }
      const float step = glm::length(seen.sight.offset);
      if (!(step > 0)) return;
      passed += step;
      if (!sky && seen.sight.state == Sight::kSurface && seen.sight.backdrop == aim.sky &&
          std::abs(passed - expected) <= kSameSurface * expected) {
        ReflectedSample found = aim;
        found.image = Vec4(q + passed * along, 1);
        if (is_shown(found)) return;
        map_.radiance[at] = seen.radiance;
        map_.disparity[at] = disparity_of(map_, found.image.z);
        map_.valid[at] = 1;
        return;
      }
      if (seen.sight.mirrored) return;  // straight on is the room behind the mirror
      from += direction * (step * (1 + 1e-5f));
      passed += step * 1e-5f;
    }
  }

  // What the pixel's ray meets first, if no other map shows it.
  void capture_first(std::size_t at) {
    const Vec3 q(map_point(map_, Vec2(at % map_.width, at / map_.width) + 0.5f), 0);
    const Vec3 along = glm::normalize(q - map_.eye);
    const Vec3 from = pack_from_reflector(reflector_, q);
    const Vec3 direction = glm::normalize(Mat3(reflector_.pack_from_reflector) * along);
    const Sight sight = lit_.around.look(map_.reflector, from, direction, [](const SeenSurface&) { return false; });
    stage_.count(sight.rays);
    if (sight.state == Sight::kNothing) return;
    const bool sky = sight.state == Sight::kSky;
    ReflectedSample found;
    found.on_plane = q;
    found.image = sky ? Vec4(along, 0) : Vec4(q + glm::length(sight.offset) * along, 1);
    found.normal = glm::transpose(Mat3(reflector_.pack_from_reflector)) * sight.normal;
    found.spacing = 1;
    found.sky = sky || sight.backdrop;
    if (is_shown(found)) return;
    const SeenLight seen = see(lit_, map_.reflector, from, direction);
    stage_.count(seen.rays);
    map_.radiance[at] = seen.radiance;
    map_.disparity[at] = sky ? 0 : disparity_of(map_, found.image.z);
    map_.valid[at] = static_cast<std::uint8_t>(sight.state);
  }

 private:
  bool is_shown(const ReflectedSample& found) const {
    return std::any_of(others_.begin(), others_.end(),
                       [&](const RadianceMap& map) { return shows(lit_.around, map, found); });
  }

  const LitSurroundings lit_;
  const Reflector& reflector_;
  std::span<const RadianceMap> others_;
  RadianceMap& map_;
  const Stage stage_;
};

// The longer side of a map of the element that takes no more than those bytes, halved from `wanted` until it does; 0:
// none worth having.
std::uint32_t fitting_resolution(const Element& element, std::uint32_t wanted, std::uint64_t bytes) {
  for (std::uint32_t resolution = wanted; resolution >= kLeastResolution; resolution /= 2)
    if (map_bytes(element, resolution) <= bytes) return resolution;
  return 0;
}

struct Residual {
  std::vector<RadianceMap> maps;
  std::uint32_t reduced = 0;  // had to be smaller or left out
  std::uint64_t rays = 0;
};

class ResidualMaker {
 public:
  ResidualMaker(const LitSurroundings& lit, const ResidualOptions& options, Context& context)
      : lit_(lit), options_(options), context_(context) {}

  // Of one reflector, as a unit of work.
  Result<Residual> find_or_make(std::uint32_t reflector, std::span<const RadianceMap> maps, std::uint64_t bytes) {
    Residual made;
    const auto inputs = [&](Archive& key) {
      // More memory than the largest map takes changes nothing.
      key(reflector, options_.eyes, std::min(bytes, map_bytes(options_.max_resolution, options_.max_resolution)),
          options_.samples, options_.spread, options_.max_resolution, options_.least_missing, options_.cameras,
          options_.most_missing, options_.camera_samples);
      for (const RadianceMap& map : maps) key(frame_of(map));
    };
    const auto compute = [&]() -> Status {
      rays_ = reduced_ = 0;
      ORIEL_TRY(made.maps, make(reflector, maps, bytes));
      made.reduced = reduced_, made.rays = rays_;
      return {};
    };
    ORIEL_TRY_VOID(one_unit(context_, "residual", inputs, compute,
                            [&](Archive& archive) { archive(made.maps, made.reduced, made.rays); }));
    return made;
  }

 private:
  // What is missing in the reflector's maps, in no more than `bytes`; none where that is little. Counts what it had to
  // make smaller or leave out.
  Result<std::vector<RadianceMap>> make(std::uint32_t reflector, std::span<const RadianceMap> own,
                                        std::uint64_t bytes) {
    std::vector<RadianceMap> maps(own.begin(), own.end()), made;
    const auto add = [&](const std::optional<Host>& host, std::span<const ReflectedSample> missing) -> Result<bool> {
      if (!host) return false;
      ORIEL_TRY(auto map, map_of(reflector, maps, *host, missing, bytes));
      if (!map) return false;
      bytes -= std::min(bytes, map_bytes(map->width, map->height));
      maps.push_back(*map);
      made.push_back(std::move(*map));
      return true;
    };
    ORIEL_TRY(const auto missing, find_missing(reflector, maps));
    if (!missing.empty()) ORIEL_TRY_VOID(add(best_host(maps, missing), missing));
    ORIEL_TRY(auto cameras, see_by_camera(reflector));
    while (!cameras.empty()) {
      ORIEL_TRY_VOID(leave_unseen(maps, cameras));
      if (cameras.empty()) break;
      const std::vector<ReflectedSample> worst = std::move(cameras.front());
      cameras.erase(cameras.begin());
      ORIEL_TRY_VOID(add(camera_host(maps, worst), {}));
    }
    return made;
  }

  // Of samples that no map shows; without any, of all from there that none does.
  Result<std::optional<RadianceMap>> map_of(std::uint32_t reflector, std::span<const RadianceMap> maps,
                                            const Host& host, std::span<const ReflectedSample> missing,
                                            std::uint64_t bytes) {
    const std::uint32_t wanted = std::min(options_.max_resolution, host.resolution);
    const std::uint32_t resolution = fitting_resolution(host.element, wanted, bytes);
    reduced_ += resolution < wanted;
    if (resolution == 0) return std::nullopt;
    RadianceMap map = blank_map(reflector, host.eye, host.element, resolution);
    map.has_emission = host.has_emission;
    map.residual = true;
    const std::size_t pixels = std::size_t{map.width} * map.height;
    map.radiance.assign(pixels, Vec3(0));
    map.disparity.assign(pixels, 0);
    map.valid.assign(pixels, 0);
    ResidualCapture capture(lit_, maps, {context_, &rays_}, map);
    const auto aims = capture.aims(missing, options_.spread);
    ORIEL_TRY_VOID(parallel_for(context_, "", pixels, [&](std::size_t i) {
      if (missing.empty())
        capture.capture_first(i);
      else if (aims[i])
        capture.capture(i, *aims[i]);
    }));
    if (std::all_of(map.valid.begin(), map.valid.end(), [](std::uint8_t v) { return v == 0; })) return std::nullopt;
    return map;
  }

  // What each camera sees in the reflector, of weights that add up to 1; none of those that see nothing.
  Result<std::vector<std::vector<ReflectedSample>>> see_by_camera(std::uint32_t reflector) {
    std::vector<std::vector<ReflectedSample>> seen;
    for (const Vec3& camera : options_.cameras) {
      ORIEL_TRY(auto samples, sample_reflections(lit_.around, reflector,
                                                 {{&camera, 1}, options_.camera_samples, context_.seed + 3}, context_));
      float total = 0;
      for (const ReflectedSample& s : samples) total += s.weight;
      if (!(total > 0)) continue;
      for (ReflectedSample& s : samples) s.weight /= total;
      seen.push_back(std::move(samples));
    }
    return seen;
  }

  // Leaves each camera those samples that none of the maps shows, and those cameras that miss too much: the worst
  // first.
  Status leave_unseen(std::span<const RadianceMap> maps, std::vector<std::vector<ReflectedSample>>& cameras) {
    const auto missed = [](const std::vector<ReflectedSample>& samples) {
      double weight = 0;
      for (const ReflectedSample& s : samples) weight += s.weight;
      return weight;
    };
    for (std::vector<ReflectedSample>& samples : cameras) {
      std::vector<std::uint8_t> unseen(samples.size());
      ORIEL_TRY_VOID(parallel_for(context_, "", samples.size(), [&](std::size_t i) {
        unseen[i] = std::none_of(maps.begin(), maps.end(),
                                 [&](const RadianceMap& map) { return shows(lit_.around, map, samples[i]); });
      }));
      std::size_t i = 0;
      std::erase_if(samples, [&](const ReflectedSample&) { return unseen[i++] == 0; });
    }
    std::erase_if(cameras, [&](const auto& samples) { return missed(samples) <= options_.most_missing; });
    std::stable_sort(cameras.begin(), cameras.end(),
                     [&](const auto& a, const auto& b) { return missed(a) > missed(b); });
    return {};
  }

  // Samples of surfaces and the sky that no map sees; none where they are not worth a map.
  Result<std::vector<ReflectedSample>> find_missing(std::uint32_t reflector, std::span<const RadianceMap> maps) {
    ORIEL_TRY(const auto samples, sample_reflections(lit_.around, reflector,
                                                     {options_.eyes, options_.samples, context_.seed + 2}, context_));
    std::vector<std::uint8_t> is_missing(samples.size());
    ORIEL_TRY_VOID(parallel_for(context_, "", samples.size(), [&](std::size_t i) {
      is_missing[i] = std::none_of(maps.begin(), maps.end(),
                                   [&](const RadianceMap& map) { return shows(lit_.around, map, samples[i]); });
    }));
    std::vector<ReflectedSample> missing;
    double total = 0, lost = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      total += samples[i].weight;
      if (is_missing[i]) missing.push_back(samples[i]), lost += samples[i].weight;
    }
    if (!(lost > options_.least_missing * total)) missing.clear();
    return missing;
  }

  const LitSurroundings lit_;
  const ResidualOptions& options_;
  Context& context_;
  std::uint32_t reduced_ = 0;
  std::atomic<std::uint64_t> rays_{0};
};

// The reflector's maps with the residuals behind those of their elements.
void append_with_residuals(std::span<RadianceMap> maps, std::vector<RadianceMap> residuals,
                           std::vector<RadianceMap>& all) {
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const std::uint32_t element = maps[i].element;
    const bool ends_element = i + 1 == maps.size() || element != maps[i + 1].element;
    all.push_back(std::move(maps[i]));
    for (RadianceMap& residual : residuals)
      if (ends_element && residual.element == element) all.push_back(std::move(residual));
  }
}

}  // namespace

Status add_residuals(const LitSurroundings& lit, const ResidualOptions& options, const Stage& stage,
                     std::vector<FoundReflector>& reflectors, ViewPlan& plan) {
  ResidualMaker maker(lit, options, stage.context);
  std::uint64_t used = 0;
  std::uint32_t reduced = 0;
  for (const RadianceMap& map : plan.maps) used += map_bytes(map.width, map.height);
  std::vector<Residual> residuals;
  for (std::uint32_t r = 0; r < reflectors.size(); ++r) {
    const Reflector& reflector = reflectors[r].reflector;
    const auto own = std::span<const RadianceMap>(plan.maps).subspan(reflector.first_map, reflector.map_count);
    if (own.empty()) {
      residuals.emplace_back();
      continue;
    }
    const std::uint64_t left = options.memory_bytes - std::min(options.memory_bytes, used);
    ORIEL_TRY(Residual made, maker.find_or_make(r, own, left));
    for (const RadianceMap& map : made.maps) used += map_bytes(map.width, map.height);
    reduced += made.reduced;
    stage.count(made.rays);
    residuals.push_back(std::move(made));
  }
  if (reduced > 0)
    plan.omitted.push_back(fmt::format("radiance maps: {} residuals are smaller or left out to stay within {:.1f} MiB",
                                       reduced, static_cast<double>(options.memory_bytes) / (1 << 20)));
  std::vector<RadianceMap> all;
  for (std::uint32_t r = 0; r < reflectors.size(); ++r) {
    Reflector& reflector = reflectors[r].reflector;
    const auto own = std::span(plan.maps).subspan(reflector.first_map, reflector.map_count);
    reflector.first_map = static_cast<std::uint32_t>(all.size());
    append_with_residuals(own, std::move(residuals[r].maps), all);
    reflector.map_count = static_cast<std::uint32_t>(all.size()) - reflector.first_map;
  }
  plan.maps = std::move(all);
  return {};
}

}  // namespace oriel
