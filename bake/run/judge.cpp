#include "bake/run/judge.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "bake/jobs/parallel.h"
#include "bake/radiance/reproject.h"
#include "bake/visibility/view_shares.h"

namespace oriel {
namespace {

constexpr std::uint32_t kCameraSamples = 2048;
constexpr std::size_t kMostBacks = 4;  // named

// Mean of the pixels around a place that hold the same surface, by their bilinear weights; none where none does.
std::optional<Vec3> colour_at(const RadianceMap& map, const ReflectedSample& s) {
  const Vec2 pixel = map_pixel(map, s.image.w == 0 ? map.eye + Vec3(s.image) : Vec3(s.image)) - 0.5f;
  const Vec2 corner = glm::floor(pixel);
  const float disparity = s.image.w == 0 ? 0 : disparity_of(map, s.image.z);
  Vec3 sum(0);
  float weight = 0;
  for (const Vec2& step : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)}) {
    const Vec2 at = corner + step;
    if (at.x < 0 || at.y < 0 || at.x >= static_cast<float>(map.width) || at.y >= static_cast<float>(map.height))
      continue;
    const std::size_t i = static_cast<std::size_t>(at.y) * map.width + static_cast<std::size_t>(at.x);
    if (map.valid[i] == 0 || std::abs(map.disparity[i] - disparity) > kSameDisparity * std::max(disparity, 1e-3f))
      continue;
    const Vec2 near = 1.0f - glm::abs(at - pixel);
    const float w = std::max(near.x, 0.0f) * std::max(near.y, 0.0f) + 1e-6f;
    sum += w * map.radiance[i], weight += w;
  }
  if (weight == 0) return {};
  return sum / weight;
}

// What the maps show of a sample: that which is sharpest there first.
std::optional<Vec3> shown(const ReflectedSurroundings& surroundings, std::span<const RadianceMap> maps,
                          const ReflectedSample& s) {
  std::optional<Vec3> best;
  float sharpest = std::numeric_limits<float>::infinity();
  for (const RadianceMap& map : maps) {
    const float needed = needed_resolution(surroundings, map.reflector, map.eye, {map.lower, map.upper}, s) /
                         static_cast<float>(std::max(map.width, map.height));
    if (!(needed < sharpest)) continue;
    if (const auto colour = colour_at(map, s)) best = colour, sharpest = needed;
  }
  return best;
}

struct Judged {
  Vec3 traced{0};
  std::optional<Vec3> shown;
};

}  // namespace

Result<ReflectedError> judge_light(const LitSurroundings& lit, std::uint32_t reflector,
                                   std::span<const RadianceMap> maps, std::span<const ReflectedSample> samples,
                                   const Stage& stage) {
  const Reflector& r = lit.around.reflectors()[reflector].reflector;
  std::vector<Judged> judged(samples.size());
  ORIEL_TRY_VOID(parallel_for(stage, "", samples.size(), [&](std::size_t i) {
    const ReflectedSample& s = samples[i];
    const Vec3 along = glm::normalize(s.on_plane - Vec3(s.eye.x, s.eye.y, -s.eye.z));
    const SeenLight seen =
        see(lit, reflector, pack_from_reflector(r, s.on_plane), glm::normalize(Mat3(r.pack_from_reflector) * along));
    stage.count(seen.rays);
    judged[i] = {seen.radiance, shown(lit.around, maps, s)};
  }));
  ReflectedError e;
  DVec3 mean(0);
  double total = 0, with_image = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) mean += double{samples[i].weight} * DVec3(judged[i].traced);
  for (const ReflectedSample& s : samples) total += s.weight;
  e.samples = samples.size();
  if (!(total > 0)) return e;
  mean /= total;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const DVec3 truth(judged[i].traced), image(judged[i].shown.value_or(Vec3(0))), off = image - truth;
    const DVec3 brighter = glm::max(truth, image), scale = brighter * brighter + 1e-4 * mean * mean;
    double square = 0;
    for (int c = 0; c < 3; ++c) square += scale[c] > 0 ? off[c] * off[c] / scale[c] / 3 : 0;
    e.relative_error += samples[i].weight * square / total;
    if (!judged[i].shown) continue;
    with_image += samples[i].weight;
    e.seen_error += samples[i].weight * square;
  }
  e.seen = with_image / total;
  e.relative_error = std::sqrt(e.relative_error);
  e.seen_error = with_image > 0 ? std::sqrt(e.seen_error / with_image) : 0;
  return e;
}

void tell_dropped(const Accel& accel, std::vector<Warning>& findings) {
  const DroppedSamples& dropped = accel.dropped();
  if (dropped.count() == 0) return;
  std::string place = "far from any surface";
  if (const std::uint32_t t = dropped.first_triangle(); t != DroppedSamples::kNowhere) {
    const Surface& surface = accel.scene().surfaces[accel.scene().triangle_surface[t]];
    place = fmt::format("first at triangle {} of '{}', material '{}'", t - surface.first_triangle, surface.name,
                        accel.scene().materials[surface.material].name);
  }
  findings.push_back({fmt::format("{} samples of light are left out, which are no numbers: {}", dropped.count(), place),
                      "dropped-samples"});
}

void tell_backs(const Accel& accel, std::span<const Vec3> eyes, std::uint64_t seed, std::vector<Warning>& findings) {
  const Scene& scene = accel.scene();
  std::vector<SeenBack> backs = seen_backs(scene, look_around(accel, eyes, seed));
  if (backs.empty()) return;
  std::stable_sort(backs.begin(), backs.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  const std::size_t told = std::min(backs.size(), kMostBacks);
  std::string names;
  for (std::size_t i = 0; i < told; ++i)
    names += fmt::format("{}'{}' ({:.2g} %)", i == 0 ? "" : ", ", scene.surfaces[backs[i].surface].name,
                         100 * backs[i].share);
  if (backs.size() > told) names += fmt::format(" and {} more", backs.size() - told);
  findings.push_back({fmt::format("of what people see are backs of one-sided surfaces: {}; nothing is drawn there and "
                                  "light ends there: turn them over, mark their materials double-sided, or bake with "
                                  "--double-sided",
                                  names),
                      "backs-seen"});
}

Result<double> worst_seen(const ReflectedSurroundings& surroundings, std::uint32_t reflector,
                          std::span<const RadianceMap> own, std::span<const Vec3> cameras, Context& context) {
  double worst = 1;
  for (const Vec3& camera : cameras) {
    ORIEL_TRY(const auto samples,
              sample_reflections(surroundings, reflector, {{&camera, 1}, kCameraSamples, context.seed + 4}, context));
    if (!samples.empty()) worst = std::min(worst, judge_maps(surroundings, own, samples, context).seen);
  }
  return worst;
}

}  // namespace oriel
