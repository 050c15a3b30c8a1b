#include "bake/radiosity/estimators/point_light.h"

#include <algorithm>

#include "bake/jobs/units.h"
#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/group_filter.h"
#include "bake/radiosity/gather/gather.h"
#include "bake/radiosity/texels/seeds.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint32_t kFirstOfPoint = 2, kMostOfPoint = 8;  // samples a half, point and light; by fours
constexpr float kUncertainPoint = 0.02f;                 // relative error of direct light: points above it get more
constexpr double kUsualPointError = 0.02;                // requested error, at which a point and half gets
constexpr std::uint32_t kGather = 16, kMostGather = 64;  // gather rays; at a smaller error more, at most

// While it lives, random numbers and units of work are separate from those of texels.
class OwnNumbers {
 public:
  OwnNumbers(Context& context, const DetailPoints& points)
      : context_(context), seed_(context.seed), inputs_(inputs_of(context, points)) {
    context_.seed = mix64(context_.seed + seeds::kDetail + points.side);
  }
  ~OwnNumbers() { context_.seed = seed_; }
  OwnNumbers(const OwnNumbers&) = delete;
  OwnNumbers& operator=(const OwnNumbers&) = delete;

 private:
  static StageInputs inputs_of(Context& context, const DetailPoints& points) {
    std::vector<std::vector<std::uint32_t>> places;
    for (const TexelMapPage& page : points.map) places.push_back(page.texel);
    return StageInputs(context, context.inputs, points.side, places);
  }

  Context& context_;
  std::uint64_t seed_;
  StageInputs inputs_;
};

// list: in coherent order.
Status light_directly(const RadiosityTask& task, const DirectLight& light, std::vector<std::uint32_t> list,
                      const TexelGraph& graph, DirectSums& sums) {
  for (std::uint32_t per_half = kFirstOfPoint; per_half <= kMostOfPoint; per_half *= 4) {
    ORIEL_TRY_VOID(light.estimate(list, per_half, task.quick, sums));
    keep_uncertain(sums, graph, per_half == kFirstOfPoint ? 0 : kUncertainPoint, task.context, list);
  }
  return {};
}

std::uint32_t gathered_rays(const RadiosityOptions& options) {
  const double finer = options.error > 0 ? kUsualPointError / options.error : 1;
  const double rays = double{kGather} * std::max(1.0, finer * finer);
  return static_cast<std::uint32_t>(std::min(rays, double{kMostGather}));
}

// Interpolation at points between the visible ones of a coarser grid: texels (1 step), or first points (2 steps), whose
// pages have a border of a texel.
class Between {
 public:
  Between(const Texels& coarse, std::uint32_t steps, const Texels& points, std::uint32_t side)
      : coarse_(coarse),
        points_(points),
        scale_(static_cast<float>(steps) / static_cast<float>(side)),
        border_(steps == 1 ? 1.0f : 0.0f) {}

  // Calls body(number in the grid, share) for those around point i. Shares sum to 1; false if there are none.
  template <class Body>
  bool visit(std::size_t i, const Body& body) const {
    const Vec2 at = Vec2(points_.x[i], points_.y[i]) * scale_ - border_;
    const IVec2 low(glm::floor(at));
    std::array<std::pair<std::uint32_t, float>, 4> around{};
    float weights = 0;
    std::size_t count = 0;
    for (const IVec2& step : {IVec2(0, 0), IVec2(1, 0), IVec2(0, 1), IVec2(1, 1)}) {
      const std::uint32_t number = coarse_.at(points_.page[i], low.x + step.x, low.y + step.y);
      if (number == kNoTexel || coarse_.visible[number] == 0) continue;
      const Vec2 share = 1.0f - glm::abs(at - Vec2(low + step));
      around[count++] = {number, share.x * share.y}, weights += share.x * share.y;
    }
    for (std::size_t k = 0; weights > 0 && k < count; ++k) body(around[k].first, around[k].second / weights);
    return weights > 0;
  }

  Vec3 of(const std::vector<Vec3>& light, std::size_t i) const {
    Vec3 sum(0);
    if (!light.empty()) visit(i, [&](std::uint32_t number, float share) { sum += share * light[number]; });
    return sum;
  }
  void add_groups(const GroupedLight& light, std::size_t i, GroupedLight& sum) const {
    if (light.empty()) return;
    visit(i, [&](std::uint32_t number, float share) {
      for (std::size_t g = 0; g < light.groups; ++g) sum.of(i)[g] += share * light.of(number)[g];
    });
  }
  bool any(std::size_t i) const {
    return visit(i, [](auto...) {});
  }

 private:
  const Texels& coarse_;
  const Texels& points_;
  float scale_, border_;
};

// Hides points that a wall separates from their texel, which has the light of the other side.
void hide_separated(const TexelLight& texel_light, const DetailPoints& points, Texels& texels) {
  for (std::size_t i = 0; i < texels.count(); ++i) {
    if (texels.visible[i] == 0) continue;
    const TexelPoint at = sample_texel(points.atlas, points.map[texels.page[i]], texels.index[i], Vec3(0.5f));
    if (texel_light.texels.parts(at.triangle, at.barycentric)) texels.visible[i] = 0;
  }
}

// Per point, 1 if a cell that it belongs to gathers.
std::vector<char> which_gather(const DetailPoints& points, const Texels& texels,
                               std::span<const std::vector<char>> gathers) {
  std::vector<char> which(texels.count());
  for (std::size_t i = 0; i < which.size(); ++i) {
    const std::uint32_t width = points.atlas.pages[texels.page[i]].width / points.side - 2;
    const std::vector<char>& cells = gathers[texels.page[i]];
    // A point on a cell's side belongs to the previous cell, too.
    for (const std::uint32_t y : {texels.y[i], texels.y[i] - 1})
      for (const std::uint32_t x : {texels.x[i], texels.x[i] - 1}) {
        const std::size_t place = std::size_t{y / points.side - 1} * width + x / points.side - 1;
        if (x >= points.side && y >= points.side && place < cells.size() && cells[place]) which[i] = 1;
      }
  }
  return which;
}

// What lighting points has at hand.
struct Points {
  const RadiosityTask& task;
  const CoarserLight& coarser;
  const DetailPoints& points;
  const Texels& texels;
  const ExtraSamplePoints& sample_points;
  const TexelGraph& graph;
  std::span<const std::uint32_t> order;
  Between between_texels{coarser.of_texels.texels, 1, texels, points.side};
};

// First points gather; those of cells that do not take the texels' reflected light, which the filter sees, too.
Status gather_reflected(const Points& p, PointLight& result) {
  const TexelLight& of_texels = p.coarser.of_texels;
  Context& context = p.task.context;
  const std::size_t n = p.texels.count(), groups = of_texels.query.groups();
  const std::vector<char> gathers = which_gather(p.points, p.texels, p.coarser.gathers);
  // Gather rays leave out what particles bring.
  std::vector<Vec3> additional(n);
  GroupedLight additional_grouped(groups > 0 ? n : 0, groups), taken = additional_grouped;
  HalfSums gathered(n, false, groups);
  for (std::size_t i = 0; i < n; ++i) {
    if (p.texels.visible[i] == 0) continue;
    additional[i] = p.between_texels.of(of_texels.additional, i);
    p.between_texels.add_groups(of_texels.additional_grouped, i, additional_grouped);
    if (gathers[i]) continue;
    p.between_texels.add_groups(of_texels.reflected_grouped, i, taken);
    for (std::size_t g = 0; g < taken.groups; ++g) taken.of(i)[g] -= additional_grouped.of(i)[g];
    gathered.set_assumed(i, p.between_texels.of(of_texels.reflected.value, i) - additional[i], 0, taken);
  }
  std::vector<std::uint32_t> list(p.order.begin(), p.order.end());
  std::erase_if(list, [&](std::uint32_t i) { return !gathers[i]; });
  const FinalGather final_gather{p.sample_points, of_texels.query, of_texels.cached};
  ORIEL_TRY_VOID(final_gather.run(list, gathered_rays(p.task.options), p.task.paths, gathered));
  result.reflected = filter(p.texels, p.graph, halves_of(gathered, context), p.task.options.filter, context);
  result.reflected_grouped =
      filter_groups(p.texels, p.graph, {gathered.grouped_halves(), false}, p.task.options.filter, context);
  for (std::size_t i = 0; i < n; ++i) result.reflected.value[i] += additional[i];
  result.reflected_grouped.add(additional_grouped);
  return {};
}

// Further points interpolate between first ones, or between texels where none of these is near.
void interpolate_reflected(const Points& p, PointLight& result) {
  const std::size_t n = p.texels.count(), groups = p.coarser.of_texels.query.groups();
  const Between between_first{p.coarser.first->texels, 2, p.texels, p.points.side};
  result.reflected.value.resize(n), result.reflected.variance.resize(n);
  result.reflected_grouped = GroupedLight(groups > 0 ? n : 0, groups);
  const auto take = [&](const Between& between, const auto& light, std::size_t i) {
    result.reflected.value[i] = between.of(light.reflected.value, i);
    between.add_groups(light.reflected_grouped, i, result.reflected_grouped);
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (p.texels.visible[i] == 0) continue;
    if (between_first.any(i))
      take(between_first, *p.coarser.first, i);
    else
      take(p.between_texels, p.coarser.of_texels, i);
  }
}

}  // namespace

Result<PointLight> light_points(const RadiosityTask& task, const CoarserLight& coarser, const DetailPoints& points) {
  Context& context = task.context;
  const TexelLight& of_texels = coarser.of_texels;
  const OwnNumbers own(context, points);
  const LightmapScene scene{task.transport, points.atlas, points.map};
  PointLight result;
  ORIEL_TRY(result.texels,
            list_texels(scene, task.quick,
                        {.eyes = of_texels.texels.eyes, .coarse = &of_texels.texels, .side = points.side}));
  hide_separated(of_texels, points, result.texels);
  const Texels& texels = result.texels;
  const std::size_t n = texels.count();
  const ExtraSamplePoints sample_points(scene, texels, context.seed);
  const std::vector<std::uint32_t> order = coherent_order(texels);
  ORIEL_TRY(const TexelGraph graph, find_neighbours(task.transport, texels, task.paths));
  DirectSums direct(n, false, of_texels.query.groups());
  ORIEL_TRY_VOID(light_directly(task, {task.transport, texels, sample_points, context.seed, {task.sharp, true}}, order,
                                graph, direct));
  const Points all{task, coarser, points, texels, sample_points, graph, order};
  if (coarser.first)
    interpolate_reflected(all, result);
  else
    ORIEL_TRY_VOID(gather_reflected(all, result));
  const Estimate lit =
      filter(texels, graph, halves_of(direct, result.reflected.value), narrow(task.options.filter), context);
  result.grouped = result.reflected_grouped;
  const GroupHalves of_groups{direct.grouped_halves(), true, &result.reflected_grouped};
  result.grouped.add(filter_groups(texels, graph, of_groups, narrow(task.options.filter), context));
  if (context.stopped()) return fail(ErrorCode::kStopped, "radiosity", "stopped");  // the filter was interrupted
  result.light.resize(n), result.variance.resize(n), result.uneven.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (texels.visible[i] == 0) continue;
    result.light[i] = glm::max(lit.value[i] + result.reflected.value[i], Vec3(0));
    result.variance[i] = lit.variance[i] + result.reflected.variance[i];
    result.uneven[i] = luminance(direct.uneven[i]);
  }
  return result;
}

}  // namespace oriel
