#include "bake/radiosity/radiosity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "bake/radiosity/dilate.h"
#include "bake/radiosity/estimators/cached.h"
#include "bake/radiosity/estimators/detail.h"
#include "bake/radiosity/estimators/first_direct.h"
#include "bake/radiosity/estimators/path_estimator.h"
#include "bake/radiosity/estimators/write_pages.h"
#include "bake/radiosity/held_out_error.h"
#include "bake/radiosity/seams.h"
#include "bake/radiosity/sharp_light.h"
#include "bake/radiosity/stitch.h"
#include "bake/radiosity/texels/fit_texels.h"
#include "bake/radiosity/texels/frame_error.h"
#include "bake/radiosity/texels/seeds.h"
#include "bake/radiosity/texels/texels.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kStitchShare = 0.6;           // of the error requested: limit on changes by stitching
constexpr std::size_t kPixels = 1 << 16;       // for the stated error, and as many held out
constexpr std::uint32_t kDefaultViews = 1024;  // view positions where none is given

constexpr float kAssumed =
    0.5f;  // relative error of light that is that of near texels: rather too much, nothing measures it
constexpr double kMeets = 0.05;  // relative difference of two sides of a seam, half

// Power on the visible parts of all lightmapped surfaces, lm.
DVec3 incident_power(const RadiosityTask& task, const Radiosity& light) {
  DVec3 sum(0);
  for (std::size_t p = 0; p < task.map.size(); ++p)
    for (std::size_t i = 0; i < task.map[p].texel.size(); ++i) {
      const std::uint32_t texel = task.map[p].texel[i];
      if (light.pages[p].state[texel] == TexelState::kValid)
        sum += DVec3(light.pages[p].irradiance[texel]) *
               (light.visible[p][i] * texel_area_m2(task.transport.accel.scene(), task.atlas, task.map[p], i));
    }
  return sum;
}

void summarize(const RadiosityTask& task, Radiosity& light) {
  RadiosityReport& report = light.report;
  DVec3 sum(0);
  for (std::size_t p = 0; p < task.map.size(); ++p)
    for (const std::uint32_t texel : task.map[p].texel) {
      const bool valid = light.pages[p].state[texel] == TexelState::kValid;
      ++(valid ? report.texels : report.buried);
      if (!valid) continue;
      const Vec3& e = light.pages[p].irradiance[texel];
      sum += DVec3(e);
      report.max = glm::max(report.max, e);
    }
  report.incident_lm = incident_power(task, light);
  if (report.texels == 0) return;
  report.mean = Vec3(sum / static_cast<double>(report.texels));
  report.relative_error = stated_error(task.map, task.pixels, light.pages);
}

// Cells at seams with continuous light after stitching. Where the two sides differ anyway, finer light does no harm.
std::vector<std::vector<bool>> cells_at(const Seams& seams, std::span<const LightmapPage> pages) {
  std::vector<std::vector<bool>> at;
  for (const LightmapPage& page : pages) at.emplace_back(page.state.size());
  for (const SeamPoint& point : seams.points) {
    std::array<double, 2> light{};
    for (std::size_t side = 0; side < 2; ++side) {
      const LightmapPage& page = pages[point.page[side]];
      light[side] = luminance(irradiance_at(page, Vec2(point.place[side] / DVec2(page.width, page.height))));
    }
    if (std::fabs(light[0] - light[1]) > kMeets * (light[0] + light[1])) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      const LightmapPage& page = pages[point.page[side]];
      const DVec2 cell = glm::clamp(point.place[side] - 0.5, DVec2(0), DVec2(page.width - 1.0, page.height - 1.0));
      at[point.page[side]][std::size_t(cell.y) * page.width + std::size_t(cell.x)] = true;
    }
  }
  return at;
}

Status stitch_lightmap(const RadiosityTask& task, Radiosity& light) {
  const auto over = [&] { return task.options.left_of_all() <= 0; };
  Seams seams;
  ORIEL_TRY(const bool found,
            done_in_time(task.context, task.options.left_of_all ? over : std::function<bool()>(), [&]() -> Status {
              ORIEL_TRY(seams, find_seams(task.transport, task.atlas, light.pages, task.quick));
              leave_out_sharp_ends(task, seams);
              return {};
            }));
  if (found && seams.points.empty()) return {};
  const auto power = [&] { return luminance(Vec3(incident_power(task, light))); };
  const double before = power(), error = task.options.error;
  const double at_most = error > 0 ? kStitchShare * error : std::numeric_limits<double>::infinity();
  if (found) light.report.seams = stitch(seams, task.map, at_most, light.pages, task.options.left_of_all);
  if (!found || light.report.seams.late)
    task.context.warning(
        "time-over",
        "the seams of the lightmap are not stitched: --time left none for that; a longer one stitches them");
  light.at_seam = cells_at(seams, light.pages);
  if (before > 0) light.report.seams.energy_change = power() / before - 1;
  return {};
}

void darken_hidden(const TexelMapPage& map, const std::vector<float>& visible, LightmapPage& page) {
  for (std::size_t i = 0; i < map.texel.size(); ++i) {
    page.irradiance[map.texel[i]] *= visible[i];
    page.standard_error[map.texel[i]] *= visible[i];
  }
}

bool is_dark(const Transport& transport) {
  return transport.lights.empty() && luminance(transport.accel.scene().sky) <= 0;
}

// The estimator of scenes without light: black is exact, and only visibility is computed.
class DarkEstimator : public LightEstimator {
 public:
  explicit DarkEstimator(Texels texels) : texels_(std::move(texels)) {}
  Status refine(double) override { return {}; }
  void write(Radiosity& light) const override {
    for (std::size_t i = 0; i < texels_.count(); ++i) {
      LightmapPage& page = light.pages[texels_.page[i]];
      page.state[std::size_t{texels_.y[i]} * page.width + texels_.x[i]] =
          texels_.visible[i] > 0 ? TexelState::kValid : TexelState::kBuried;
      light.visible[texels_.page[i]][texels_.index[i]] = texels_.visible[i];
    }
  }

 private:
  Texels texels_;
};

Result<std::unique_ptr<LightEstimator>> make_estimator(const RadiosityTask& task) {
  if (is_dark(task.transport)) {
    ORIEL_TRY(Texels texels, list_texels(task, task.quick, {.seconds = points_seconds(task)}));
    return std::make_unique<DarkEstimator>(std::move(texels));
  }
  if (task.options.estimator == Estimator::kCached) return make_cached_estimator(task);
  return make_path_estimator(task);
}

// Frame pixels from given view positions; where these see nothing, or none is given, from sampled ones.
Result<std::vector<FramePixel>> pixels_of(const LightmapScene& scene, std::vector<Vec3> eyes, std::uint64_t seed,
                                          Context& context) {
  for (;; eyes.clear()) {
    const bool given = !eyes.empty();
    if (!given) eyes = sample_view_positions(scene.transport, kDefaultViews, seed);
    if (eyes.empty()) return std::vector<FramePixel>();
    const auto directions_per_view = static_cast<std::uint32_t>(std::max<std::size_t>(1, kPixels / eyes.size()));
    ORIEL_TRY(std::vector<FramePixel> pixels,
              find_frame_pixels(scene.transport, scene.atlas, {eyes, directions_per_view}, mix64(seed), context));
    if (!given || !pixels.empty()) return pixels;
  }
}

// True for a day, whose hours are shown one at a time: rescaling to the filtered sum would show one hour's shadow edges
// in another's light. All light is then the sum of the groups.
bool groups_lead(const RadiosityTask& task, const Radiosity& light) {
  return !task.transport.accel.scene().day.empty() && !light.groups.empty();
}

void add_up_groups(std::vector<Vec3> LightmapPage::*values, std::size_t page, Radiosity& light) {
  std::vector<Vec3>& all = light.pages[page].*values;
  std::ranges::fill(all, Vec3(0));
  for (const auto& pages : light.groups)
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += (pages[page].*values)[i];
}

// What texels show for want of time counts, with an error.
void settle_assumed(Radiosity& light) {
  for (std::size_t p = 0; p < light.assumed.size(); ++p)
    for (const std::uint32_t texel : light.assumed[p]) {
      LightmapPage& page = light.pages[p];
      page.state[texel] = TexelState::kValid;
      page.standard_error[texel] = kAssumed * page.irradiance[texel];
      ++light.report.assumed;
    }
}

// Fills hidden texels and those beyond charts from their neighbours, and makes light continuous across seams.
Status fill_and_stitch(const RadiosityTask& task, Radiosity& light) {
  if (task.options.hidden == Hidden::kBlack) return {};
  for (std::size_t p = 0; p < task.map.size(); ++p) {
    std::vector<LightmapPage*> groups;
    for (auto& pages : light.groups) groups.push_back(&pages[p]);
    if (task.options.fit_texels)
      fit_texels({task.atlas, task.map[p], light.reach.empty() ? std::span<const Reach>() : light.reach[p]},
                 light.pages[p], groups);
    if (groups_lead(task, light)) add_up_groups(&LightmapPage::irradiance, p, light);
    groups.push_back(&light.pages[p]);
    if (!light.sharp.empty()) light.sharp[p].state = light.pages[p].state, groups.push_back(&light.sharp[p]);
    for (LightmapPage* page : groups) {
      fill_buried(task.atlas, task.map[p], *page);
      dilate(task.options.dilation, *page);
    }
  }
  settle_assumed(light);
  if (!task.options.stitch || is_dark(task.transport)) return {};
  return stitch_lightmap(task, light);
}

// Writes the estimator's light by light group.
void write_groups(const RadiosityTask& task, const LightEstimator& estimator, Radiosity& light) {
  const std::size_t groups = task.transport.accel.scene().light_groups.size();
  if (groups == 0 || task.options.hidden == Hidden::kBlack) return;
  light.groups.assign(groups, empty_radiosity(task.map, false).pages);
  if (!estimator.write_groups(light.groups)) light.groups.clear();
  for (auto& pages : light.groups)
    for (std::size_t p = 0; p < pages.size(); ++p) pages[p].state = light.pages[p].state;
}

// Scales the groups to the stitched, clamped and refined sum.
void rescale_light_groups(Radiosity& light) {
  for (std::size_t p = 0; p < light.pages.size() && !light.groups.empty(); ++p)
    rescale_page_groups(light.pages[p], p, light.groups);
}

// Adds finer light unless there is no time for it.
Status add_detail_in_time(const RadiosityTask& task, const LightEstimator& estimator, Radiosity& light) {
  const RadiosityOptions& options = task.options;
  if (options.detail < 2 || options.hidden == Hidden::kBlack) return {};
  const auto texel_light = estimator.texel_light();
  if (!texel_light) return {};
  task.context.foretell("detail", 0);
  const Interruptible until(task.context, options.enough);
  const Status added =
      options.late() ? fail(ErrorCode::kStopped, "radiosity", "late") : add_detail(task, *texel_light, light);
  if (added || task.context.stop || added.error().code != ErrorCode::kStopped) return added;
  light.report.detail = {.left_out = true};
  return {};
}

// Measures the held-out error; nothing where there is no time.
Result<HeldOutError> verify(const RadiosityTask& task, const Radiosity& light) {
  const RadiosityOptions& options = task.options;
  if (options.verify <= 0 || options.estimator != Estimator::kCached || is_dark(task.transport)) return HeldOutError();
  task.context.foretell("verification", 0);
  const auto late = [&] { return options.late(); };
  const Interruptible until(task.context, late);
  const auto measured = [&]() -> Result<HeldOutError> {
    ORIEL_TRY(const std::vector<FramePixel> held_out,
              pixels_of(task, options.held_out.empty() ? options.eyes : options.held_out,
                        mix64(task.context.seed + seeds::kHeldOutPixels), task.context));
    const auto at_most = static_cast<std::uint64_t>(options.verify * static_cast<double>(task.work()));
    const double goal = options.error > 0 ? options.error : light.report.relative_error;
    return measure_held_out_error(task, light.pages, held_out, {goal, at_most, &light.sharp_light}, task.context);
  }();
  if (measured) task.paths.count(measured->rays);
  if (measured || task.context.stop || !late()) return measured;
  return HeldOutError();
}

void darken_all_hidden(const RadiosityTask& task, Radiosity& light) {
  for (std::size_t p = 0; p < task.map.size(); ++p) {
    darken_hidden(task.map[p], light.visible[p], light.pages[p]);
    std::fill(light.visible[p].begin(), light.visible[p].end(), 1.0f);
    dilate(task.options.dilation, light.pages[p]);
  }
}

}  // namespace

Radiosity empty_radiosity(std::span<const TexelMapPage> map, bool directional) {
  Radiosity light;
  for (const TexelMapPage& page : map) {
    const std::size_t size = static_cast<std::size_t>(page.width) * page.height;
    light.pages.push_back(
        {page.width, page.height, std::vector<Vec3>(size), std::vector<Vec3>(size), std::vector<TexelState>(size)});
    if (directional) light.pages.back().direction.resize(size);
    light.visible.emplace_back(page.texel.size());
  }
  return light;
}

Result<Radiosity> bake_radiosity(const LightmapScene& scene, const RadiosityOptions& options, Context& context) {
  std::atomic<std::uint64_t> rays{0}, quick_rays{0};
  context.foretell("first light", 0);
  ORIEL_TRY(const std::vector<FramePixel> pixels,
            pixels_of(scene, options.eyes, mix64(context.seed + seeds::kFramePixels), context));
  RadiosityTask task{scene, pixels, options, context, {context, &rays}, {context, &quick_rays}};
  SharpCharts charts;
  ShadowLists shadows;
  if (finds_sharp_light(options)) {
    charts = find_sharp_charts(scene.transport.accel.scene(), scene.atlas);
    if (!charts.lights.empty()) ORIEL_TRY_VOID(find_sharp_light(task, charts, shadows));
    if (!shadows.light.empty()) task.sharp = &charts;
  }
  ORIEL_TRY(const std::unique_ptr<LightEstimator> estimator, make_estimator(task));
  ORIEL_TRY_VOID(estimator->refine(options.error));
  if (context.stopped()) return fail(ErrorCode::kStopped, "radiosity", "stopped");
  Radiosity light = empty_radiosity(scene.map, options.directional);
  if (task.sharp) light.sharp = empty_radiosity(scene.map, false).pages;
  estimator->write(light);
  write_groups(task, *estimator, light);
  ORIEL_TRY_VOID(fill_and_stitch(task, light));
  rescale_light_groups(light);
  ORIEL_TRY_VOID(add_detail_in_time(task, *estimator, light));
  for (std::size_t p = 0; p < light.pages.size() && groups_lead(task, light); ++p)
    add_up_groups(&LightmapPage::detail, p, light);
  rescale_light_groups(light);
  light.sharp_light = std::move(shadows.light);
  add_sharp_light(shadows, light);
  summarize(task, light);
  ORIEL_TRY(light.report.held_out_error, verify(task, light));
  light.report.rays = rays + quick_rays + light.report.detail.rays;
  if (light.report.assumed > 0)
    context.warning(
        "time-over",
        fmt::format("{} of {} texels show the light of near ones: --time left none for their own; more time, "
                    "or a larger --texel, gives it",
                    light.report.assumed, light.report.texels));
  if (options.hidden == Hidden::kBlack) darken_all_hidden(task, light);
  return light;
}

}  // namespace oriel
