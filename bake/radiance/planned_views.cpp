#include "bake/radiance/planned_views.h"

#include <algorithm>
#include <limits>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "bake/radiance/reproject.h"

namespace oriel {
namespace {

constexpr double kWholeView_sr = 1;           // of a screen of 60 degrees
constexpr std::uint32_t kTrialSamples = 512;  // that tell whether a reflector is seen at all
constexpr double kWorthDividing = 0.02;       // by which all must be worth more, of the samples' weight
constexpr double kPriceStep = 1.1;            // by which the price rises until maps fit memory,
constexpr double kLeastPrice = 1e-12;         // from this at least
constexpr std::uint32_t kMostShares = 4;      // of options.samples for one reflector

std::vector<Vec3> candidates_for(const Scene& scene, const Reflector& r, const Element& window,
                                 std::span<const ReflectedSample> samples, const PlannedViewOptions& options) {
  const Vec3 centre(0.5f * (window.lower + window.upper), 0);
  const float radius = 0.5f * glm::length(window.upper - window.lower);
  std::vector<Vec3> out;
  for (const Vec3& direction : hemisphere_directions(options.hemisphere)) {
    const Vec3 eye = centre + radius * direction;
    if (is_inside(scene, pack_from_reflector(r, mirrored(eye)), radius)) out.push_back(eye);
  }
  for (const float nearer : {0.5f, 0.25f, 0.125f})
    for (const Vec3& direction : hemisphere_directions(16)) out.push_back(centre + nearer * radius * direction);
  const std::size_t hemisphere = out.size();
  for (const ReflectedSample& s : samples) {
    if (out.size() >= hemisphere + options.mirrored_eyes) break;
    if (std::find(out.begin(), out.end(), mirrored(s.eye)) == out.end()) out.push_back(mirrored(s.eye));
  }
  return out;
}

bool is_inside(const Element& window, const ReflectedSample& s) {
  return glm::all(glm::greaterThanEqual(Vec2(s.on_plane), window.lower)) &&
         glm::all(glm::lessThanEqual(Vec2(s.on_plane), window.upper));
}

double pixels_of(const Element& window, std::uint32_t resolution) {
  return static_cast<double>(map_bytes(window, resolution) / kMapBytesPerPixel);
}

// Of a pixel, in weight of the reflector's samples.
double price_for(const FoundReflector& found, double price) {
  return found.reflectance > 0 ? price / double{found.reflectance} : std::numeric_limits<double>::infinity();
}

class Planner {
 public:
  Planner(const ReflectedSurroundings& surroundings, const PlannedViewOptions& options, Context& context)
      : surroundings_(surroundings), asked_(options), options_(options), context_(context) {
    if (options.map_resolution > 0) options_.choice.resolutions = {options.map_resolution};
  }

  Result<ReflectorPlan> find_or_plan(std::uint32_t reflector) {
    ReflectorPlan made;
    ORIEL_TRY_VOID(one_unit(
        context_, "views",
        [&](Archive& key) {
          key(reflector, asked_.eyes, asked_.choice, asked_.element_m, asked_.samples, asked_.hemisphere,
              asked_.mirrored_eyes, asked_.max_elements, asked_.map_resolution, asked_.pixel_price);
        },
        [&]() -> Status {
          ORIEL_TRY(made, plan(reflector));
          return {};
        },
        [&](Archive& archive) { archive(made); }));
    return made;
  }

 private:
  Result<ReflectorPlan> plan(std::uint32_t reflector) {
    const Reflector& r = surroundings_.reflectors()[reflector].reflector;
    ORIEL_TRY(const auto samples, samples_of(reflector));
    const double price = price_for(surroundings_.reflectors()[reflector], options_.pixel_price);
    ReflectorPlan best;
    ElementGrid grid;
    for (;;) {
      ORIEL_TRY(ReflectorPlan plan, plan_on(reflector, grid, samples));
      if (!best.elements.empty() && !(plan.value(price) > best.value(price) + kWorthDividing * plan.weight()))
        return best;
      best = std::move(plan);
      const double most = kMostGain * best.weight();
      if (most - best.value(price) <= kWorthDividing * best.weight() || 2 * grid.x * grid.y > options_.max_elements)
        return best;
      const Vec2 side = (r.upper - r.lower) / Vec2(grid.x, grid.y);
      (side.x >= side.y ? grid.x : grid.y) *= 2;
    }
  }

  Result<std::vector<ReflectedSample>> samples_of(std::uint32_t reflector) {
    const Reflector& r = surroundings_.reflectors()[reflector].reflector;
    const ElementGrid shares = element_grid(r.upper - r.lower, options_.element_m, kMostShares);
    return sample_reflections(surroundings_, reflector,
                              {options_.eyes, options_.samples * shares.x * shares.y, context_.seed}, context_);
  }

  Result<ReflectorPlan> plan_on(std::uint32_t reflector, const ElementGrid& grid,
                                std::span<const ReflectedSample> samples) {
    const FoundReflector& found = surroundings_.reflectors()[reflector];
    ReflectorPlan plan{grid, {}};
    for (const Element& window : covered_elements(surroundings_.accel().scene(), found, grid)) {
      std::vector<ReflectedSample> inside;
      for (const ReflectedSample& s : samples)
        if (is_inside(window, s)) inside.push_back(s);
      if (inside.empty()) continue;
      ORIEL_TRY(ElementPlan element, plan_element(reflector, window, inside));
      plan.elements.push_back(std::move(element));
    }
    return plan;
  }

  Result<ElementPlan> plan_element(std::uint32_t reflector, const Element& window,
                                   const std::vector<ReflectedSample>& samples) {
    const Scene& scene = surroundings_.accel().scene();
    const Reflector& r = surroundings_.reflectors()[reflector].reflector;
    ElementPlan element{window, candidates_for(scene, r, window, samples, options_), {}, {}, 0};
    NeedTable table;
    for (const ReflectedSample& s : samples) {
      table.weights.push_back(s.weight);
      element.weight += s.weight;
    }
    table.needed.resize(element.candidates.size() * samples.size());
    ORIEL_TRY_VOID(parallel_for(context_, "", element.candidates.size(), [&](std::size_t c) {
      for (std::size_t s = 0; s < samples.size() && !context_.stopped(); ++s)
        table.needed[c * samples.size() + s] =
            needed_resolution(surroundings_, reflector, element.candidates[c], window, samples[s]);
    }));
    const ElementGrid grid = element_grid(window.upper - window.lower, options_.element_m, options_.max_elements);
    constexpr std::uint32_t kMost = kMostMapsPerElement;
    const std::uint32_t most = std::min(std::min(options_.choice.max_maps, kMost) * grid.x * grid.y, kMost);
    const double price = price_for(surroundings_.reflectors()[reflector], options_.pixel_price);
    for (const std::uint32_t resolution : options_.choice.resolutions)
      element.choices.push_back(choose_views(table, most, resolution, pixels_of(window, resolution), price));
    element.choice = best_value(element.choices, price);
    return element;
  }

  const ReflectedSurroundings& surroundings_;
  PlannedViewOptions asked_, options_;  // the latter with map_resolution among the choices
  Context& context_;
};

std::size_t map_count(std::span<const ReflectorPlan> plans) {
  std::size_t count = 0;
  for (const ReflectorPlan& plan : plans)
    for (const ElementPlan& e : plan.elements) count += e.choice.picks.size();
  return count;
}

std::uint64_t total_bytes(std::span<const ReflectorPlan> plans) {
  std::uint64_t bytes = 0;
  for (const ReflectorPlan& plan : plans)
    for (const ElementPlan& e : plan.elements)
      bytes += map_bytes(e.window, e.choice.resolution) * e.choice.picks.size();
  return bytes;
}

std::string memory_line(std::uint64_t wanted, std::uint64_t allowed) {
  return fmt::format("radiance maps would take {:.1f} MiB of {:.1f} MiB allowed: ",
                     static_cast<double>(wanted) / (1 << 20), static_cast<double>(allowed) / (1 << 20));
}

// Pixels get dearer until all fit: what is worth least for its pixels is left out or gets coarser first.
void fit_memory(std::span<const FoundReflector> reflectors, std::uint64_t limit, double price,
                std::vector<ReflectorPlan>& plans, std::vector<std::string>& omitted) {
  const std::uint64_t wanted = total_bytes(plans);
  const std::size_t maps = map_count(plans);
  if (wanted <= limit) return;
  while (total_bytes(plans) > limit) {
    price = std::max(price, kLeastPrice) * kPriceStep;
    for (std::size_t r = 0; r < plans.size(); ++r)
      for (ElementPlan& e : plans[r].elements) e.choice = best_value(e.choices, price_for(reflectors[r], price));
  }
  omitted.push_back(memory_line(wanted, limit) +
                    fmt::format("{} of {} maps, some of them coarser", map_count(plans), maps));
}

void append_maps(std::uint32_t reflector, const ReflectorPlan& plan, std::vector<RadianceMap>& maps) {
  for (const ElementPlan& e : plan.elements)
    for (const Pick& pick : e.choice.picks)
      maps.push_back(blank_map(reflector, e.candidates[pick.candidate], e.window, e.choice.resolution));
}

// That a reflector fills for the eyes of the samples, as far as it fits into a view.
float solid_angle_shown(float area_m2, std::span<const ReflectedSample> samples) {
  double sum = 0;
  for (const ReflectedSample& s : samples) {
    const double away = glm::distance(s.eye, s.on_plane);
    sum += std::min(area_m2 * double{s.eye.z} / (away * away * away), kWholeView_sr);
  }
  return samples.empty() ? 0.0f : static_cast<float>(sum / static_cast<double>(samples.size()));
}

}  // namespace

Status keep_seen_reflectors(const Accel& accel, std::span<const Vec3> eyes, std::uint32_t limit, Context& context,
                            FoundReflectors& found) {
  const std::vector<FoundReflector> all = std::move(found.reflectors);
  const ReflectedSurroundings surroundings(accel, all, {});
  std::vector<std::pair<double, std::uint32_t>> seen;
  std::vector<float> shown(all.size());
  for (std::uint32_t r = 0; r < all.size(); ++r) {
    double angle = 0;
    const auto samples = sample_reflections(surroundings, r, {eyes, kTrialSamples, context.seed}, context);
    if (!samples && context.stop) return tl::unexpected(samples.error());
    if (!samples) {  // the most important ones come first
      found.omitted.push_back({fmt::format("{} reflectors: --time was over before them", all.size() - r), "time-over"});
      break;
    }
    for (const ReflectedSample& s : *samples) angle += s.weight;
    shown[r] = solid_angle_shown(all[r].reflector.area_m2, *samples);
    if (angle > 0)
      seen.emplace_back(-angle * all[r].reflectance, r);
    else
      found.omitted.push_back(
          fmt::format("'{}' ({:.3g} m²): no radiance maps, from nowhere where people walk is anything "
                      "seen in it; --eyes tells of other places",
                      all[r].reflector.name, all[r].reflector.area_m2));
  }
  std::sort(seen.begin(), seen.end());
  found.reflectors.clear();
  for (const auto& [worth, r] : seen) {
    found.reflectors.push_back(all[r]);
    found.reflectors.back().shown_sr = shown[r];
  }
  keep_first(limit, "reflectors", found.reflectors, found.omitted);
  return {};
}

Result<ViewPlan> plan_views_for_eyes(const ReflectedSurroundings& surroundings, const PlannedViewOptions& options,
                                     Context& context, std::vector<FoundReflector>& reflectors) {
  Planner planner(surroundings, options, context);
  ViewPlan out;
  std::vector<ReflectorPlan> plans;
  for (std::uint32_t r = 0; r < reflectors.size(); ++r) {
    if (reflectors[r].way == ReflectorWay::kGeometry) {
      plans.emplace_back();
      continue;
    }
    ORIEL_TRY(ReflectorPlan plan, planner.find_or_plan(r));
    if (map_count({&plan, 1}) == 0 && !plan.elements.empty())
      out.omitted.push_back(fmt::format("'{}' ({:.3g} m²): shows too little to be worth a map",
                                        reflectors[r].reflector.name, reflectors[r].reflector.area_m2));
    plans.push_back(std::move(plan));
    context.report("views", static_cast<double>(r + 1) / static_cast<double>(reflectors.size()));
  }
  fit_memory(reflectors, options.memory_bytes, options.pixel_price, plans, out.omitted);
  for (std::uint32_t r = 0; r < reflectors.size(); ++r) {
    Reflector& reflector = reflectors[r].reflector;
    reflector.elements_x = plans[r].grid.x;
    reflector.elements_y = plans[r].grid.y;
    reflector.first_map = static_cast<std::uint32_t>(out.maps.size());
    append_maps(r, plans[r], out.maps);
    reflector.map_count = static_cast<std::uint32_t>(out.maps.size()) - reflector.first_map;
  }
  return out;
}

}  // namespace oriel
