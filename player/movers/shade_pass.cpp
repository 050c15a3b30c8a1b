#include "player/movers/shade_pass.h"

#include <algorithm>
#include <chrono>

namespace oriel {
namespace {

// Where a frame is timed, waits for what was drawn.
class Stopwatch {
 public:
  explicit Stopwatch(bool on) : on_(on), start_(now()) {}
  void add_to(double& milliseconds) {
    if (!on_) return;
    const auto end = now();
    milliseconds += std::chrono::duration<double, std::milli>(end - std::exchange(start_, end)).count();
  }

 private:
  std::chrono::steady_clock::time_point now() const {
    if (on_) glFinish();
    return std::chrono::steady_clock::now();
  }
  bool on_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace

struct ShadePass::Work {
  ShadeMaker maker;
  std::atomic<bool> stop{false};
  std::future<ShadeScene> done;  // last: it uses the others

  Work(ShadeMaker begun, std::vector<Vec4> movers, std::uint32_t lights, bool in_background) : maker(std::move(begun)) {
    done = std::async(in_background ? std::launch::async : std::launch::deferred,
                      [this, movers = std::move(movers), lights] { return maker.finish(movers, lights, &stop); });
  }
  ~Work() { stop = true; }
};

ShadePass::~ShadePass() = default;
ShadePass::ShadePass(ShadePass&&) noexcept = default;
ShadePass& ShadePass::operator=(ShadePass&&) noexcept = default;
ShadePass::ShadePass() = default;

Result<ShadePass> ShadePass::create(gpu::Dialect dialect) {
  ShadePass pass;
  pass.dialect_ = dialect;
  return pass;
}

// Packs without movers need none of it.
Status ShadePass::make_programs() {
  if (made_) return {};
  ORIEL_TRY(maps_, ShadeMaps::create(dialect_));
  ORIEL_TRY(light_, ShadeDraw::create(dialect_));
  ORIEL_TRY(few_, FewPixels::create(dialect_));
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers_);
  made_ = true;
  return {};
}

bool ShadePass::is_done() const {
  return work_ && work_->done.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

bool ShadePass::has_news() const {
  return late_ > 0 || is_done();
}

Result<bool> ShadePass::prepare(const FrameContext& context, std::span<const PlacedMover> movers) {
  late_ = 0;
  if (context.options.shade.lights == 0 || movers.empty() || context.scene.pack().lightmaps.empty()) {
    work_.reset(), blocked_.reset(), scene_.reset();
    geometry_ = 0;
    return false;
  }
  ORIEL_TRY_VOID(make_programs());
  const std::uint32_t lights = std::min(context.options.shade.lights, static_cast<std::uint32_t>(layers_));
  const GpuScene& scene = context.scene;
  const bool in_background = scene.images().in_background();
  std::vector<Vec4> spheres;
  for (const PlacedMover& placed : movers) spheres.push_back(placed.sphere);
  if (geometry_ != scene.geometry_serial() || wanted_lights_ != lights) {
    work_.reset(), blocked_.reset(), scene_.reset();
    if (in_background && scene.images().state().busy) return false;
    ORIEL_TRY(ShadeMaker maker, ShadeMaker::begin(scene.pack(), scene.images().source(), scene.baked_lamps()));
    work_ = std::make_unique<Work>(std::move(maker), spheres, lights, in_background);
    geometry_ = scene.geometry_serial(), wanted_lights_ = lights;
  }
  if (!work_ && scene_ && !holds(scene_->places, spheres))
    work_ = std::make_unique<Work>(ShadeMaker::again(*scene_), spheres, lights, in_background);
  if (work_ && (!in_background || is_done())) {
    ShadeScene made = work_->done.get();
    work_.reset();
    ORIEL_TRY_VOID(take(std::move(made), context));
  }
  if (!scene_ || !blocked_) return false;
  const int side = static_cast<int>(context.options.shade.map_side);
  if (maps_.wanted_side() != side) ORIEL_TRY_VOID(maps_.begin(*scene_, scene.pack().movers, side));
  if (serial_ != scene.serial()) ORIEL_TRY_VOID(set_intensities(context));
  return true;
}

Status ShadePass::take(ShadeScene scene, const FrameContext& context) {
  scene_ = std::make_shared<const ShadeScene>(std::move(scene));
  blocked_.reset();
  spheres_.clear();
  serial_ = 0;
  if (scene_->lights.empty()) return {};
  blocked_.emplace(scene_->cells, scene_->shade_lights(),
                   [scene = scene_](std::uint32_t light, const Bounds& box) { return scene->hides(light, box); });
  ORIEL_TRY_VOID(light_.set_scene(*scene_));
  return maps_.begin(*scene_, context.scene.pack().movers, static_cast<int>(context.options.shade.map_side));
}

Status ShadePass::set_intensities(const FrameContext& context) {
  const GpuScene& scene = context.scene;
  ORIEL_TRY(intensities_, scene_->shine(scene.images().source(), scene.pack().materials, scene.pack().sky));
  serial_ = scene.serial();
  ++version_;
  return light_.set_lights(*scene_, intensities_);
}

void ShadePass::move(std::span<const PlacedMover> movers) {
  for (std::size_t m = movers.size(); m < spheres_.size(); ++m) blocked_->remove(static_cast<std::uint32_t>(m));
  spheres_.resize(movers.size(), Vec4(0, 0, 0, -1));
  for (std::uint32_t m = 0; m < movers.size(); ++m)
    if (spheres_[m] != movers[m].sphere) blocked_->move(m, spheres_[m] = movers[m].sphere);
  light_.set_movers(spheres_);
}

Status ShadePass::draw(const FrameContext& context, std::span<const PlacedMover> movers, const LitTarget& target) {
  ShadeStats& stats = context.stats.shade;
  stats.lights = static_cast<std::uint32_t>(scene_->lights.size());
  stats.prepare_s = scene_->seconds;
  Stopwatch watch(context.options.timed);
  const auto known = movers.first(std::min<std::size_t>(movers.size(), BlockedLights::kMostMovers));
  move(known);
  const std::vector<CellLights> lists = lights_in_view(*scene_, *blocked_, make_frustum(context.view.clip_from_pack));
  stats.cells = static_cast<std::uint32_t>(lists.size());
  for (const CellLights& one : lists) stats.pairs += one.lights.size();
  watch.add_to(stats.cells_ms);
  late_ = maps_.refresh(context, lists, intensities_, known);
  if (late_ > 0) ++version_;
  stats.late = static_cast<std::uint32_t>(late_);
  watch.add_to(stats.maps_ms);
  if (lists.empty()) return {};
  ORIEL_TRY_VOID(light_.set_lists(lists));
  ORIEL_TRY_VOID(few_.draw(target, [&](const LitPixels& pixels) { light_.draw(maps_, pixels, context.stats); }));
  watch.add_to(stats.light_ms);
  return {};
}

}  // namespace oriel
