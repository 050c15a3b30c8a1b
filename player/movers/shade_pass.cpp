#include "player/movers/shade_pass.h"

#include <algorithm>
#include <chrono>

#include "player/scene/surface.h"

namespace oriel {
namespace {

constexpr int kStep = 4;          // of the frame's pixels one is drawn along each side
constexpr int kListWidth = 1024;  // numbers in a row
enum { kFewerUnit = 2, kFewerLightUnit = 3 };

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

// Where a pixel of a picture of fewer is the middle of the pixel that it stands for: scale and offset, in the whole
// view's coordinates from -1 to 1.
Vec4 view_of_fewer(const gpu::Texture2d& all, const gpu::Texture2d& fewer) {
  const Vec2 whole(all.width(), all.height()), few(fewer.width(), fewer.height());
  const Vec2 scale = whole / (static_cast<float>(kStep) * few);
  const float off = static_cast<float>(kStep / 2) + 0.5f - 0.5f * static_cast<float>(kStep);
  return {scale, scale - 2 * off / (static_cast<float>(kStep) * few) - 1.0f};
}

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
  if (no_vertices_) return {};
  ORIEL_TRY(maps_, ShadeMaps::create(dialect_));
  ORIEL_TRY(light_, ShadeDraw::create(dialect_));
  ORIEL_TRY(fewer_, gpu::Program::create("screen_shade_fewer", dialect_));
  ORIEL_TRY(between_, gpu::Program::create("screen_shade_between", dialect_));
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers_);
  no_vertices_ = gpu::make_vertex_array();
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

std::vector<LightPass> ShadePass::all_lights() const {
  LightPass pass;
  pass.cells = {static_cast<std::uint32_t>(scene_->cells.size())};
  for (std::uint32_t l = 0; l < scene_->lights.size(); ++l) pass.lights.push_back(l);
  return {pass};
}

std::vector<LightPass> ShadePass::passes(const FrameContext& context) const {
  const ShadeSettings& settings = context.options.shade;
  ShadeStats& stats = context.stats.shade;
  std::vector<LightPass> elements;
  const Frustum frustum = make_frustum(context.view.clip_from_pack);
  for (std::uint32_t c = 0; c < scene_->cells.size(); ++c) {
    const ShadeCell& cell = scene_->cells[c];
    if (cell.child != 0 || cell.content.empty() || !may_be_visible(frustum, cell.content)) continue;
    std::vector<std::uint32_t> lights = blocked_->lights_of(c);
    if (lights.empty()) continue;
    ++stats.cells, stats.pairs += lights.size();
    elements.push_back({{c}, std::move(lights)});
  }
  if (settings.work == ShadeWork::kEachLight) elements = all_lights();
  stats.unmerged = static_cast<std::uint32_t>(count_passes(elements, settings.lights_a_pass));
  Stopwatch watch(context.options.timed);
  if (settings.work == ShadeWork::kMerged) elements = merge_passes(std::move(elements), settings.lights_a_pass);
  watch.add_to(stats.merge_ms);
  stats.passes = settings.work == ShadeWork::kLists
                     ? (elements.empty() ? 0 : 1)
                     : static_cast<std::uint32_t>(count_passes(elements, settings.lights_a_pass));
  return elements;
}

Status ShadePass::make_fewer(const ShadeTarget& target) {
  const int width = (target.light.width() + kStep - 1) / kStep, height = (target.light.height() + kStep - 1) / kStep;
  if (few_.of == target.serial) return {};
  few_.surfaces = gpu::Texture2d(gpu::kRgba32ui, width, height, nullptr);
  few_.light = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
  few_.mask = gpu::Texture2d(gpu::kR8, target.light.width(), target.light.height(), nullptr);
  ORIEL_TRY(few_.surfaces_target, gpu::Framebuffer::create("few surfaces", &few_.surfaces, nullptr));
  ORIEL_TRY(few_.light_target, gpu::Framebuffer::create("few lights", &few_.light, nullptr));
  const std::array<const gpu::Texture2d*, 2> both{&target.light, &few_.mask};
  ORIEL_TRY(few_.between_target, gpu::Framebuffer::create("light between", both));
  few_.of = target.serial;
  return gpu::check_gl("making the pictures of the shade of movers");
}

// Light at few pixels, and between them; what is left is marked.
void ShadePass::draw_fewer(const FrameContext& context, const ShadeTarget& target) const {
  constexpr GLfloat kNothing[] = {0, 0, 0, 0};
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  few_.surfaces_target.bind();
  glViewport(0, 0, few_.light.width(), few_.light.height());
  fewer_.use();
  fewer_.set("u_surfaces", kSurfaceUnit);
  fewer_.set("u_step", kStep);
  target.surfaces.bind(kSurfaceUnit);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  few_.light_target.bind();
  glClearBufferfv(GL_COLOR, 0, kNothing);
  light_.draw(context.view, maps_, {few_.surfaces, nullptr, view_of_fewer(target.light, few_.light)}, context.stats);
  few_.between_target.bind();
  glViewport(0, 0, target.light.width(), target.light.height());
  gpu::RasterState state;
  state.blend = gpu::Blend::kAdd;
  gpu::apply(state);
  glClearBufferfv(GL_COLOR, 1, kNothing);
  between_.use();
  between_.set("u_surfaces", kSurfaceUnit);
  between_.set("u_fewer", kFewerUnit);
  between_.set("u_light", kFewerLightUnit);
  between_.set("u_step", kStep);
  target.surfaces.bind(kSurfaceUnit);
  few_.surfaces.bind(kFewerUnit);
  few_.light.bind(kFewerLightUnit);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

// Of the lights that movers may block anywhere in view.
std::size_t ShadePass::refresh_maps(const FrameContext& context, std::span<const PlacedMover> movers,
                                    std::span<const LightPass> passes) {
  std::vector<std::uint8_t> wanted(scene_->lights.size(), 0);
  for (const LightPass& pass : passes)
    for (const std::uint32_t l : pass.lights) wanted[l] = 1;
  std::vector<ShadeMaps::Wanted> maps;
  for (std::uint32_t l = 0; l < wanted.size(); ++l)
    if (wanted[l] != 0) maps.push_back({l, max_component(intensities_[l])});
  return maps_.refresh(context, maps, movers);
}

Status ShadePass::draw(const FrameContext& context, std::span<const PlacedMover> movers, const ShadeTarget& target) {
  const ShadeSettings& settings = context.options.shade;
  ShadeStats& stats = context.stats.shade;
  stats.lights = static_cast<std::uint32_t>(scene_->lights.size());
  stats.prepare_s = scene_->seconds;
  Stopwatch watch(context.options.timed);
  const std::size_t known = std::min<std::size_t>(movers.size(), BlockedLights::kMostMovers);
  for (std::size_t m = known; m < spheres_.size(); ++m) blocked_->remove(static_cast<std::uint32_t>(m));
  spheres_.resize(known, Vec4(0, 0, 0, -1));
  for (std::uint32_t m = 0; m < known; ++m)
    if (spheres_[m] != movers[m].sphere) blocked_->move(m, spheres_[m] = movers[m].sphere);
  light_.set_movers(spheres_);
  std::vector<LightPass> drawn = passes(context);
  watch.add_to(stats.cells_ms);
  stats.cells_ms -= stats.merge_ms;
  late_ = refresh_maps(context, movers.first(known), drawn);
  if (late_ > 0) ++version_;
  stats.late = static_cast<std::uint32_t>(late_);
  watch.add_to(stats.maps_ms);
  if (drawn.empty()) return {};
  ORIEL_TRY_VOID(light_.set_passes(std::move(drawn), settings.work == ShadeWork::kLists, settings.lights_a_pass));
  const bool few = settings.work >= ShadeWork::kFewPixels;
  if (few) {
    ORIEL_TRY_VOID(make_fewer(target));
    draw_fewer(context, target);
  }
  target.framebuffer.bind();
  glViewport(0, 0, target.light.width(), target.light.height());
  light_.draw(context.view, maps_, {target.surfaces, few ? &few_.mask : nullptr}, context.stats);
  watch.add_to(stats.light_ms);
  return gpu::check_gl("drawing the shade of movers");
}

}  // namespace oriel
