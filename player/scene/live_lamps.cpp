#include "player/scene/live_lamps.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "formats/core/color.h"
#include "formats/core/parallel.h"

namespace oriel {
namespace {

constexpr std::size_t kRun = 128;  // points that a thread takes at once

struct Totals {
  double now = 0, missing = 0, kept = 0, points = 0;
};

// What is added at a point. own: what the bake knows of the lamp there.
Vec3 added_light(const LiveSum& sum, LiveMode mode, const Vec3& own) {
  switch (mode) {
    case LiveMode::kDifferential:
      return sum.now - sum.baked;
    case LiveMode::kOnly:
      return sum.now - own;
    case LiveMode::kFitted:
      break;
  }
  return sum.now - sum.kept * sum.baked - (1 - sum.kept) * own;
}

}  // namespace

std::string text_of(const LiveReport& report) {
  std::string text = fmt::format(
      "lamp \"{}\": {} live lights, {} on it, at {} points in {:.2f} s; {:.2f} % of its light is cut near lights, {:.1f} "
      "% of its flux was not followed; {:.0f} % of the bake kept",
      report.lamp, report.lights, report.direct, report.points, report.seconds, 100 * report.missing,
      100 * report.left, 100 * report.kept);
  if (!report.through.empty()) text += fmt::format("; it goes through \"{}\"", report.through);
  if (report.reaches_nothing) text += "; its light reaches no surface: is it inside something?";
  return text;
}

LiveLamps::LiveLamps(const Pack& pack) : lights_(pack.light_field.lights) {
  for (const Material& material : pack.materials) emission_.push_back(material.emission);
}

Result<bool> LiveLamps::place(const Pack& pack, const ImageSource& images, std::span<const MoverPose> poses,
                              const LiveSettings& settings) {
  bool changed = false;
  const bool other_settings = settings_ != settings;
  settings_ = settings;
  for (std::size_t group = 0; group < pack.light_groups.size(); ++group) {
    const MoverPose pose = group < poses.size() ? poses[group] : MoverPose{};
    auto& lamp = lamps_[group];
    if (!lamp && is_rest(pose)) continue;
    if (lamp && lamp->pose == pose && (is_rest(pose) || !other_settings)) continue;
    if (!lamp) {
      ORIEL_TRY(lamp, begin(pack, images, group));
    }
    changed = true;
    lamp->pose = pose;
    lamp->added.clear();
    if (is_rest(pose)) continue;
    LiveReport report;
    report.lamp = pack.light_groups[group].name;
    ORIEL_TRY_VOID(compute(images, group, settings, *lamp, report));
    reports_.push_back(std::move(report));
  }
  return changed;
}

Result<std::unique_ptr<LiveLamps::Lamp>> LiveLamps::begin(const Pack& pack, const ImageSource& images,
                                                          std::size_t group) const {
  const LampShape shape = shape_of_lamp(pack, pack.light_groups[group]);
  auto lamp = std::make_unique<Lamp>();
  LiveLamp live{shape.parts, {}, {}};
  for (const std::uint32_t part : shape.parts) live.radiance.push_back(emission_[pack.mesh.parts[part].material]);
  for (const std::uint32_t light : shape.lights) live.points.push_back(lights_[light]);
  lamp->scene = std::make_unique<LiveScene>(
      LiveSurfaces{pack.mesh, pack.materials, pack.textures, pack.fresnel_maps}, std::move(live));
  for (std::uint32_t p = 0; p < pack.lightmaps.size(); ++p) {
    ORIEL_TRY(LightmapPage page, images.whole_page(p));
    lamp->points.push_back(page_points(pack.mesh, shape.parts, p, page));
    page.standard_error.clear(), page.direction.clear();
    lamp->pages.push_back(std::move(page));
  }
  return lamp;
}

Status LiveLamps::compute(const ImageSource& images, std::size_t group, const LiveSettings& settings, Lamp& lamp,
                          LiveReport& report) const {
  const auto start = std::chrono::steady_clock::now();
  const PosedLights now = pose_lights(*lamp.scene, settings.lights, lamp.pose),
                    baked = pose_lights(*lamp.scene, settings.lights, {});
  Totals totals;
  for (std::size_t p = 0; p < lamp.points.size(); ++p) {
    const std::vector<PagePoint>& points = lamp.points[p];
    const LightmapPage& page = lamp.pages[p];
    PageChange own;
    if (settings.mode != LiveMode::kDifferential) {
      ORIEL_TRY(own, images.light_of_group(static_cast<std::uint32_t>(p), group));
    }
    const std::size_t texels = page.irradiance.size();
    PageChange change{std::vector<Vec3>(texels, Vec3(0)), std::vector<Vec3>(page.detail.size(), Vec3(0))};
    std::vector<Totals> of_run((points.size() + kRun - 1) / kRun);
    for_each_parallel(of_run.size(), core_count(), [&](std::size_t run) {
      for (std::size_t i = run * kRun; i < std::min((run + 1) * kRun, points.size()); ++i) {
        const PagePoint& point = points[i];
        const bool detail = point.index >= texels;
        const std::size_t at = detail ? point.index - texels : point.index;
        const LiveSum sum = live_sum(*lamp.scene, now, baked, point.position, point.normal);
        const std::vector<Vec3>& known = detail ? own.detail : own.light;
        (detail ? change.detail : change.light)[at] =
            added_light(sum, settings.mode, known.empty() ? Vec3(0) : known[at]);
        of_run[run].now += double{luminance(sum.now)}, of_run[run].missing += double{luminance(sum.missing)};
        of_run[run].kept += double{sum.kept}, of_run[run].points += 1;
      }
    });
    for (const Totals& t : of_run)
      totals.now += t.now, totals.missing += t.missing, totals.kept += t.kept, totals.points += t.points;
    std::vector<std::uint8_t> known(texels, 0);
    for (const PagePoint& point : points)
      if (point.index < texels) known[point.index] = 1;
    fill_from_neighbours(page, known, change.light);
    lamp.added.push_back(std::move(change));
  }
  report.lights = now.of.lights.size(), report.direct = now.of.direct;
  report.points = static_cast<std::size_t>(totals.points);
  report.missing = totals.now > 0 ? static_cast<float>(totals.missing / totals.now) : 0.0f;
  report.kept = totals.points > 0 ? static_cast<float>(totals.kept / totals.points) : 0.0f;
  report.left = luminance(now.of.left) / std::max(luminance(now.of.flux), 1e-30f);
  report.through = lamp.scene->passes_through(lamp.pose);
  report.reaches_nothing = !now.of.lights.empty() && !(totals.now > 0);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {};
}

std::shared_ptr<const PageChanges> LiveLamps::changes(std::span<const Vec3> factors) const {
  auto sum = std::make_shared<PageChanges>();
  for (const auto& [group, lamp] : lamps_) {
    if (!lamp) continue;
    const Vec3 factor = group < factors.size() ? factors[group] : Vec3(1);
    if (lamp->added.size() > sum->size()) sum->resize(lamp->added.size());
    for (std::size_t p = 0; p < lamp->added.size(); ++p) {
      const auto add = [&](std::vector<Vec3>& to, const std::vector<Vec3>& from) {
        to.resize(from.size(), Vec3(0));
        for (std::size_t i = 0; i < from.size(); ++i) to[i] += factor * from[i];
      };
      add((*sum)[p].light, lamp->added[p].light), add((*sum)[p].detail, lamp->added[p].detail);
    }
  }
  if (sum->empty()) return nullptr;
  return sum;
}

}  // namespace oriel
