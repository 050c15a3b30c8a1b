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
constexpr float kNoisy = 0.05f;            // relative error of a point's gathered light: above it there are
constexpr std::uint32_t kNoisyGather = 4;  // times as many rays

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

// Interpolates a quantity of the visible texels around point i.
template <class OfTexel>
Vec3 between_texels(const TexelLight& texel_light, const Texels& points, std::size_t i, std::uint32_t side,
                    const OfTexel& of_texel) {
  const float x = static_cast<float>(points.x[i]) / static_cast<float>(side) - 1;
  const float y = static_cast<float>(points.y[i]) / static_cast<float>(side) - 1;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  Vec3 sum(0);
  float weights = 0;
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const std::uint32_t texel = texel_light.texels.at(points.page[i], x0 + dx, y0 + dy);
      if (texel == kNoTexel || texel_light.texels.visible[texel] == 0) continue;
      const float weight =
          (1 - std::fabs(x - static_cast<float>(x0 + dx))) * (1 - std::fabs(y - static_cast<float>(y0 + dy)));
      sum += weight * of_texel(texel), weights += weight;
    }
  return weights > 0 ? sum / weights : Vec3(0);
}

// Light that gather rays leave out.
Vec3 additional_at(const TexelLight& texel_light, const Texels& points, std::size_t i, std::uint32_t side) {
  if (texel_light.additional.empty()) return Vec3(0);
  return between_texels(texel_light, points, i, side,
                        [&](std::uint32_t texel) { return texel_light.additional[texel]; });
}

// Adds additional light to the filtered light of points by group.
GroupedLight add_additional(const TexelLight& texel_light, const Texels& points, std::uint32_t side,
                            GroupedLight grouped) {
  for (std::size_t i = 0; i < points.count() && !texel_light.additional_grouped.empty(); ++i)
    for (std::size_t g = 0; g < grouped.groups; ++g)
      grouped.of(i)[g] += between_texels(texel_light, points, i, side, [&](std::uint32_t texel) {
        return texel_light.additional_grouped.of(texel)[g];
      });
  return grouped;
}

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

// The texels' reflected light at a point, without additional light.
Vec3 texel_reflected(const TexelLight& texel_light, const Texels& points, std::size_t i, std::uint32_t side) {
  return between_texels(texel_light, points, i, side,
                        [&](std::uint32_t texel) { return texel_light.reflected.value[texel]; }) -
         additional_at(texel_light, points, i, side);
}

// Sets the texels' reflected light at points that do not gather.
void set_texel_light(const TexelLight& texel_light, const Texels& points, std::uint32_t side,
                     std::span<const char> gathers, HalfSums& gathered) {
  const std::size_t groups = texel_light.reflected_grouped.groups;
  GroupedLight grouped(groups > 0 ? points.count() : 0, groups);
  for (std::size_t i = 0; i < points.count(); ++i) {
    if (gathers[i] || points.visible[i] == 0) continue;
    for (std::size_t g = 0; g < groups; ++g)
      grouped.of(i)[g] = between_texels(texel_light, points, i, side, [&](std::uint32_t texel) {
        const Vec3 additional =
            texel_light.additional_grouped.empty() ? Vec3(0) : texel_light.additional_grouped.of(texel)[g];
        return texel_light.reflected_grouped.of(texel)[g] - additional;
      });
    gathered.set_assumed(i, texel_reflected(texel_light, points, i, side), 0, grouped);
  }
}

void keep_noisy(const Estimate& gathered, const std::vector<Vec3>& direct, std::vector<std::uint32_t>& list) {
  std::erase_if(list, [&](std::uint32_t i) {
    const float light = luminance(gathered.value[i] + direct[i]);
    return !(luminance(gathered.variance[i]) > kNoisy * kNoisy * light * light);
  });
}

}  // namespace

Result<PointLight> light_points(const RadiosityTask& task, const TexelLight& texel_light, const DetailPoints& points,
                                std::span<const std::vector<char>> gathers) {
  Context& context = task.context;
  const OwnNumbers own(context, points);
  const LightmapScene scene{task.transport, points.atlas, points.map};
  PointLight result;
  ORIEL_TRY(result.texels,
            list_texels(scene, task.quick,
                        {.eyes = texel_light.texels.eyes, .coarse = &texel_light.texels, .side = points.side}));
  hide_separated(texel_light, points, result.texels);
  const Texels& texels = result.texels;
  const std::size_t n = texels.count();
  const ExtraSamplePoints sample_points(scene, texels, context.seed);
  const std::vector<std::uint32_t> order = coherent_order(texels);
  ORIEL_TRY(const TexelGraph graph, find_neighbours(task.transport, texels, task.paths));
  DirectSums direct(n, false, texel_light.query.groups());
  ORIEL_TRY_VOID(light_directly(task, {task.transport, texels, sample_points, context.seed, {task.sharp, true}}, order,
                                graph, direct));
  HalfSums gathered(n, false, texel_light.query.groups());
  Estimate indirect;
  const std::vector<char> which = which_gather(points, texels, gathers);
  set_texel_light(texel_light, texels, points.side, which, gathered);
  std::vector<std::uint32_t> list = order;
  std::erase_if(list, [&](std::uint32_t i) { return !which[i]; });
  const FinalGather final_gather{sample_points, texel_light.query, texel_light.cached};
  const std::uint32_t first = gathered_rays(task.options);
  for (std::uint32_t rays = first; rays <= kNoisyGather * first; rays *= kNoisyGather) {
    ORIEL_TRY_VOID(final_gather.run(list, rays, task.paths, gathered));
    indirect = filter(texels, graph, halves_of(gathered, context), task.options.filter, context);
    keep_noisy(indirect, direct.value, list);
    if (list.empty()) break;
  }
  const Estimate lit = filter(texels, graph, halves_of(direct, indirect.value), narrow(task.options.filter), context);
  GroupedLight grouped = filter_groups(texels, graph, LightSums{direct, gathered}, task.options.filter, context);
  result.grouped = add_additional(texel_light, texels, points.side, std::move(grouped));
  if (context.stopped()) return fail(ErrorCode::kStopped, "radiosity", "stopped");  // the filter was interrupted
  result.light.resize(n), result.variance.resize(n), result.uneven.resize(n);
  result.reflected_change.resize(n), result.reflected_noise.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (texels.visible[i] == 0) continue;
    result.light[i] =
        glm::max(lit.value[i] + indirect.value[i] + additional_at(texel_light, texels, i, points.side), Vec3(0));
    result.variance[i] = lit.variance[i] + indirect.variance[i];
    result.uneven[i] = luminance(direct.uneven[i]);
    if (!which[i]) continue;
    result.reflected_change[i] = luminance(indirect.value[i] - texel_reflected(texel_light, texels, i, points.side));
    const Vec3 of_texels = between_texels(texel_light, texels, i, points.side,
                                          [&](std::uint32_t texel) { return texel_light.reflected.variance[texel]; });
    result.reflected_noise[i] = luminance(indirect.variance[i] + of_texels);
  }
  return result;
}

}  // namespace oriel
