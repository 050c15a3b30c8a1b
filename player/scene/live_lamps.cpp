#include "player/scene/live_lamps.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <limits>

#include "formats/core/parallel.h"
#include "player/scene/lights.h"
#include "player/scene/live_page.h"

namespace oriel {
namespace {

constexpr float kSlack = 0.01f;                                 // metres: a lamp may lie on the ceiling
constexpr std::uint32_t kCoarseShare = 16, kFewestCoarse = 16;  // of the lights, while a lamp is on its way

// Polygons that stand for a point or a spot are made for one reflector each.
std::int64_t first_that_lists(std::span<const Reflector> reflectors, std::uint32_t emitter) {
  const auto lists = [&](const Reflector& r) { return std::ranges::find(r.emitters, emitter) != r.emitters.end(); };
  return std::ranges::find_if(reflectors, lists) - reflectors.begin();
}

}  // namespace

std::string text_of(const LiveReport& report) {
  std::string text = fmt::format("lamp \"{}\": {} live lights at {} points, {} of them between others, in {:.2f} s; ",
                                 report.lamp, report.lights, report.points, report.between, report.seconds);
  if (report.rays > 0)
    text +=
        fmt::format("bounced by {} rays a texel, one bounce more would add {:.1f} %; ", report.rays, 100 * report.last);
  text += fmt::format("{:.0f} % of the bake kept", 100 * report.kept);
  if (!report.through.empty()) text += fmt::format("; it goes through \"{}\"", report.through);
  if (report.outside) text += "; it is outside of all that was baked";
  if (report.reaches_nothing) text += "; its light reaches no surface: is it inside something?";
  return text;
}

struct LiveLamps::Lamp {
  std::unique_ptr<LampScene> scene;
  std::vector<std::vector<PagePoint>> points;  // by page
  std::vector<LightmapPage> pages;             // what LivePage wants of them
  std::unique_ptr<LiveBounces> bounces;
  std::vector<std::int64_t> shown_by;  // as EmitterQuestion::of, by LightGroup::emitters
  std::vector<EmitterView> views;      // of `told`
  MoverPose wanted;
  MoverPose told;           // that `added` is for
  bool whole = true;        // it is of all lights
  bool outdated = false;    // the scene does not know all texels
  std::uint64_t stale = 0;  // calls since it was told otherwise than wanted
  PageChanges added;        // with its light as it was baked
};

// One lamp's light at one pose.
struct LiveLamps::Job {
  std::size_t group = 0;
  Lamp* lamp = nullptr;  // the job alone changes its bounces
  MoverPose pose;
  LiveSettings settings;
  bool coarse = false;
  PosedLights now, baked;
  std::vector<Emitter> emitters;  // at the pose
  std::vector<LiveLight> points;  // likewise, of those that stand for points and spots
  std::atomic<bool> stop{false};
  // What comes of it.
  PageChanges added;
  std::vector<EmitterView> views;
  LiveReport report;
  Status status;
  std::future<void> done;  // last: what it writes outlives it

  // alphas: of the reflectors' lobes.
  void run(const ImageSource& images, std::span<const Reflector> reflectors, std::span<const float> alphas);
};

void LiveLamps::Job::run(const ImageSource& images, std::span<const Reflector> reflectors,
                         std::span<const float> alphas) {
  const auto start = std::chrono::steady_clock::now();
  const LiveWork work{*lamp->scene, {now, baked}, coarse, &stop};
  std::vector<LivePage> pages;
  std::vector<std::vector<LiveSum>> direct;
  for (std::uint32_t p = 0; p < lamp->points.size() && !stop; ++p) {
    pages.emplace_back(work, p, lamp->pages[p], lamp->points[p]);
    direct.push_back(pages.back().direct());
  }
  std::optional<BouncedLight> bounced;
  if (!stop && settings.lights.bounces > 0) {
    LiveBounces& bounces = *lamp->bounces;
    bounces.trace(coarse ? 1 : bounces.wanted_rays(), &stop);
    bounced = bounces.bounced(direct, settings.lights.bounces, &stop);
    report.rays = bounces.rays(), report.last = static_cast<float>(bounced->left);
  }
  LiveTotals totals;
  for (std::uint32_t p = 0; p < pages.size() && !stop; ++p) {
    const Result<PageChange> own = images.light_of_group(p, group);
    if (!own) {
      status = tl::unexpected<Error>(own.error());
      return;
    }
    const std::vector<Vec3> sharp = images.sharp_of_group(lamp->pages[p], lamp->points[p], group);
    added.push_back(pages[p].change(std::move(direct[p]), {*own, sharp}, bounced ? &*bounced : nullptr, totals));
  }
  if (!coarse) views = emitter_views({reflectors, alphas, emitters, lamp->shown_by, points}, *lamp->scene, pose, &stop);
  report.lights = now.lights.size();
  report.points = static_cast<std::size_t>(totals.points), report.between = static_cast<std::size_t>(totals.between);
  report.kept = totals.points > 0 ? static_cast<float>(totals.kept / totals.points) : 0.0f;
  report.through = lamp->scene->passes_through(pose);
  report.reaches_nothing = !now.lights.empty() && !(totals.now > 0);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

LiveLamps::LiveLamps(const Pack& pack, const ImageSource& images)
    : pack_(pack),
      images_(images),
      lights_(pack.light_field.lights),
      emitters_(pack.emitters),
      least_(std::numeric_limits<float>::max()),
      most_(std::numeric_limits<float>::lowest()) {
  for (const Material& material : pack.materials) emission_.push_back(material.emission);
  for (const Reflector& r : pack.reflectors) {
    const std::int32_t kernel = pack.materials[r.material].kernel;
    const bool has_lobe = kernel >= 0 && !pack.kernels[static_cast<std::size_t>(kernel)].fits.empty();
    alphas_.push_back(has_lobe ? pack.kernels[static_cast<std::size_t>(kernel)].alpha : 0.0f);
  }
  shown_by_.resize(emitters_.size(), -1);
  for (const LightGroup& group : pack.light_groups)
    for (const std::uint32_t e : group.emitters)
      if (stands_for_point(pack, group, emitters_[e].corners)) shown_by_[e] = first_that_lists(pack.reflectors, e);
  for (const Vec3& p : pack.mesh.positions) least_ = glm::min(least_, p), most_ = glm::max(most_, p);
}

LiveLamps::~LiveLamps() {
  if (job_) job_->stop = true;
}

std::unique_ptr<LampScene> LiveLamps::scene_of(std::size_t group) const {
  const LampShape shape = shape_of_lamp(pack_, pack_.light_groups[group]);
  LiveLamp live{shape.parts, {}, {}};
  for (const std::uint32_t part : shape.parts) live.radiance.push_back(emission_[pack_.mesh.parts[part].material]);
  for (const std::uint32_t light : shape.lights) live.points.push_back(lights_[light]);
  return std::make_unique<LampScene>(LiveSurfaces{pack_.mesh, pack_.materials, pack_.textures, pack_.fresnel_maps},
                                     std::move(live));
}

// Made when first moved.
Result<LiveLamps::Lamp*> LiveLamps::lamp_of(std::size_t group) {
  if (const auto known = lamps_.find(group); known != lamps_.end()) return known->second.get();
  const LampShape shape = shape_of_lamp(pack_, pack_.light_groups[group]);
  auto lamp = std::make_unique<Lamp>();
  lamp->scene = scene_of(group);
  for (std::uint32_t p = 0; p < pack_.lightmaps.size(); ++p) {
    ORIEL_TRY(LightmapPage page, images_.whole_page(p));
    lamp->points.push_back(page_points(pack_.mesh, shape.parts, p, page));
    page.standard_error = {}, page.direction = {}, page.sharp = {};
    lamp->pages.push_back(std::move(page));
  }
  for (const std::uint32_t e : pack_.light_groups[group].emitters) lamp->shown_by.push_back(shown_by_[e]);
  return (lamps_[group] = std::move(lamp)).get();
}

// The group's point or spot there, moved; none: black.
LiveLight LiveLamps::point_of(const LightGroup& group, const Vec3& baked, const Mat4& pack_from_lamp) const {
  LiveLight out;
  float nearest = std::numeric_limits<float>::infinity();
  for (const std::uint32_t b : group.bright_lights) {
    const BrightLight& light = lights_[b];
    const bool is_spot = light.kind == BrightLightKind::kSpot;
    const float distance = glm::distance(light.position, baked);
    if ((!is_spot && light.kind != BrightLightKind::kPoint) || !(distance < nearest)) continue;
    nearest = distance;
    out = {Vec3(pack_from_lamp * Vec4(light.position, 1)), Vec3(0), light.intensity};
    if (!is_spot) continue;
    out.cos_inner = std::cos(light.inner_cone_rad), out.cos_outer = std::cos(light.outer_cone_rad);
    out.axis = Mat3(pack_from_lamp) * light.direction;
  }
  return out;
}

void LiveLamps::look_again() {
  for (auto& [group, lamp] : lamps_) lamp->outdated = true, lamp->whole = is_rest(lamp->wanted);
}

// What texels reflect looks at textures, which come while the job runs: they are made here.
std::unique_ptr<LiveLamps::Job> LiveLamps::begin(std::size_t group, const LiveSettings& settings, bool coarse) {
  auto job = std::make_unique<Job>();
  Lamp& lamp = *lamps_[group];
  if (std::exchange(lamp.outdated, false)) {
    lamp.scene = scene_of(group);
    if (lamp.bounces) lamp.bounces->look_again(*lamp.scene);
  }
  if (!lamp.bounces) lamp.bounces = std::make_unique<LiveBounces>(*lamp.scene, lamp.pages, lamp.points);
  job->group = group, job->lamp = &lamp;
  job->pose = lamp.wanted;
  job->settings = settings;
  job->coarse = coarse;
  std::uint32_t lights = settings.lights.lights;
  if (coarse) lights = std::min(lights, std::max(lights / kCoarseShare, kFewestCoarse));
  job->now = pose_lights(*lamp.scene, lights, lamp.wanted);
  job->baked = pose_lights(*lamp.scene, lights, {});
  const Mat4 pack_from_lamp(pack_from_object(lamp.wanted));
  for (const std::uint32_t e : pack_.light_groups[group].emitters) {
    Emitter& emitter = job->emitters.emplace_back(emitters_[e]);
    const Vec3 middle = middle_of(emitter.corners), moved(pack_from_lamp * Vec4(middle, 1));
    job->points.push_back(point_of(pack_.light_groups[group], middle, pack_from_lamp));
    for (Vec3& corner : emitter.corners)
      corner = shown_by_[e] < 0 ? Vec3(pack_from_lamp * Vec4(corner, 1)) : moved + (corner - middle);
  }
  job->report.lamp = pack_.light_groups[group].name;
  const Vec3 at(pack_from_object(lamp.wanted) * DVec4(shape_of_lamp(pack_, pack_.light_groups[group]).centre, 1));
  job->report.outside = at != glm::clamp(at, least_ - kSlack, most_ + kSlack);
  return job;
}

// Whether it changed anything.
bool LiveLamps::finish(Job& job) {
  if (job.stop || !job.status) return false;
  Lamp& lamp = *lamps_[job.group];
  lamp.added = std::move(job.added), lamp.views = std::move(job.views);
  lamp.told = job.pose;
  lamp.whole = !job.coarse && !lamp.outdated && job.settings == settings_;
  lamp.stale = 0;
  if (lamp.whole) reports_.push_back(std::move(job.report));
  return true;
}

Result<bool> LiveLamps::place(std::span<const MoverPose> poses, const LiveSettings& settings) {
  bool changed = false;
  const bool other_settings = settings_ != settings;
  settings_ = settings;
  for (std::size_t group = 0; group < poses.size(); ++group) {
    if (is_rest(poses[group]) && !lamps_.contains(group)) continue;
    ORIEL_TRY(Lamp* const lamp, lamp_of(group));
    lamp->wanted = poses[group];
    if (other_settings) lamp->whole = false;
    if (is_rest(poses[group])) {
      changed = changed || !lamp->added.empty();
      lamp->added.clear(), lamp->views.clear();
      if (!job_ || job_->lamp != lamp) lamp->bounces.reset();  // many lamps may have been moved once
      lamp->told = poses[group], lamp->whole = true;
    } else if (!settings.in_background && (lamp->told != lamp->wanted || !lamp->whole)) {
      const auto job = begin(group, settings, false);
      job->run(images_, pack_.reflectors, alphas_);
      ORIEL_TRY_VOID(job->status);
      changed = finish(*job) || changed;
    }
  }
  if (!settings.in_background) return changed;
  ORIEL_TRY(const bool more, step_in_background(settings));
  return changed || more;
}

Result<bool> LiveLamps::step_in_background(const LiveSettings& settings) {
  bool changed = false;
  if (job_) {
    const Lamp& lamp = *lamps_[job_->group];
    // Few lights are told though the lamp has gone on; many are not waited for.
    if (is_rest(lamp.wanted) || (!job_->coarse && lamp.wanted != job_->pose)) job_->stop = true;
    if (job_->done.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    const auto job = std::exchange(job_, nullptr);
    try {
      job->done.get();
    } catch (const std::exception& e) {
      return fail(ErrorCode::kRuntime, pack_.light_groups[job->group].name, "light of the moved lamp: {}", e.what());
    }
    ORIEL_TRY_VOID(job->status);
    changed = finish(*job);
  }
  std::optional<std::size_t> next;
  double most = -1;
  for (auto& [group, lamp] : lamps_) {
    const bool late = lamp->told != lamp->wanted;
    if (!late && lamp->whole) continue;
    // What has not followed at all comes before what is coarse.
    const double rank = (late ? 1e12 : 1) * double{lamp->scene->luminous_flux()} * static_cast<double>(++lamp->stale);
    if (rank > most) most = rank, next = group;
  }
  if (!next) return changed;
  const bool coarse = lamps_[*next]->told != lamps_[*next]->wanted;
  job_ = begin(*next, settings, coarse);
  job_->done =
      std::async(std::launch::async, [job = job_.get(), this] { job->run(images_, pack_.reflectors, alphas_); });
  return changed;
}

std::span<const EmitterView> LiveLamps::views(std::size_t group) const {
  const auto lamp = lamps_.find(group);
  if (lamp == lamps_.end() || lamp->second->told != lamp->second->wanted) return {};
  return lamp->second->views;
}

bool LiveLamps::has_changed(std::size_t group) const {
  const auto lamp = lamps_.find(group);
  return lamp != lamps_.end() && !lamp->second->added.empty();
}

bool LiveLamps::ready() const {
  return job_ && job_->done.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::shared_ptr<const PageChanges> LiveLamps::changes(std::span<const Vec3> factors) const {
  auto sum = std::make_shared<PageChanges>();
  for (const auto& [group, lamp] : lamps_) {
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
