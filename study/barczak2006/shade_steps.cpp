#include "study/barczak2006/shade_steps.h"

#include <algorithm>
#include <chrono>

#include "player/scene/surface.h"

namespace oriel::study {
namespace {

constexpr int kSceneId = 0, kNothingId = 1023;  // LitSurface::id of shaders/lib/lit_surface.glsl
constexpr GLuint kNoSurface[] = {0, 0, 0, ~0u};

double milliseconds_since(std::chrono::steady_clock::time_point& start) {
  glFinish();
  const auto now = std::chrono::steady_clock::now();
  return std::chrono::duration<double, std::milli>(now - std::exchange(start, now)).count();
}

std::vector<LightPass> passes_of(ShadeStep step, const ShadeScene& scene, const std::vector<CellLights>& lists) {
  std::vector<LightPass> out;
  if (step == ShadeStep::kEachLight) {
    LightPass& all = out.emplace_back(LightPass{{static_cast<std::uint32_t>(scene.cells.size())}, {}});
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) all.lights.push_back(l);
  } else {
    for (const CellLights& one : lists) out.push_back({{one.cell}, one.lights});
  }
  return out;
}

}  // namespace

const char* name_of(ShadeStep step) {
  constexpr const char* kNames[] = {"each light at each pixel", "cells", "few pixels", "merged", "lists (the player)"};
  return kNames[static_cast<std::size_t>(step)];
}

Result<ShadeSteps> ShadeSteps::create(gpu::Dialect dialect) {
  ShadeSteps out;
  ORIEL_TRY(out.surface_, gpu::Program::create("mover_surface", dialect));
  ORIEL_TRY(out.maps_, ShadeMaps::create(dialect));
  ORIEL_TRY(out.lists_, ShadeDraw::create(dialect));
  ORIEL_TRY(out.boxes_, CellBoxes::create(dialect));
  ORIEL_TRY(out.few_, FewPixels::create(dialect));
  return out;
}

Status ShadeSteps::begin(GpuScene& scene, const FrameOptions& options) {
  scene_ = &scene;
  blocked_.reset();
  std::vector<Vec4> spheres;
  for (const PlacedMover& placed : place_movers(scene, options)) spheres.push_back(placed.sphere);
  ORIEL_TRY(ShadeMaker maker, ShadeMaker::begin(scene.pack(), scene.images().source(), scene.baked_lamps()));
  shade_ = std::make_shared<const ShadeScene>(maker.finish(spheres, options.shade.lights, nullptr));
  blocked_.emplace(shade_->cells, shade_->shade_lights(),
                   [shade = shade_](std::uint32_t light, const Bounds& box) { return shade->hides(light, box); });
  ORIEL_TRY(intensities_, shade_->shine(scene.images().source(), scene.pack().materials, scene.pack().sky));
  ORIEL_TRY_VOID(lists_.set_scene(*shade_));
  ORIEL_TRY_VOID(lists_.set_lights(*shade_, intensities_));
  ORIEL_TRY_VOID(boxes_.set_scene(*shade_));
  return maps_.begin(*shade_, scene.pack().movers, static_cast<int>(options.shade.map_side));
}

Status ShadeSteps::make_pictures(const View& view) {
  if (light_ && light_.width() == view.width && light_.height() == view.height) return {};
  depth_ = gpu::Texture2d(gpu::kDepth32f, view.width, view.height, nullptr);
  surfaces_ = gpu::Texture2d(gpu::kRgba32ui, view.width, view.height, nullptr);
  light_ = gpu::Texture2d(gpu::kRgba32f, view.width, view.height, nullptr);
  ORIEL_TRY(surfaces_target_, gpu::Framebuffer::create("surfaces", &surfaces_, &depth_));
  ORIEL_TRY(light_target_, gpu::Framebuffer::create("light that movers take", &light_, nullptr));
  ++pictures_;
  return gpu::check_gl("making the pictures of light that movers take");
}

// The scene as if there were no movers.
void ShadeSteps::draw_surfaces(const FrameContext& context) const {
  const auto& [scene, view, options, stats] = context;
  surfaces_target_.bind();
  glViewport(0, 0, view.width, view.height);
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  gpu::apply(state);
  glClearBufferuiv(GL_COLOR, 0, kNoSurface);
  glClear(GL_DEPTH_BUFFER_BIT);
  const std::vector<DrawBatch> shown = scene.show(make_frustum(view.clip_from_pack), {});
  scene.bind_shown();
  surface_.use();
  surface_.set("u_clip_from_pack", view.clip_from_pack);
  surface_.set("u_pack_from_object", Mat4(1));
  for (const DrawBatch& batch : shown) {
    const Material& m = scene.pack().materials[batch.material];
    state.cull = cull_of(m);
    gpu::apply(state);
    surface_.set("u_id", m.unlit ? kNothingId : kSceneId);
    set_cutout(surface_, scene, m);
    draw_batch(batch, stats);
  }
}

Result<StepCost> ShadeSteps::draw(const View& view, const FrameOptions& options, ShadeStep step,
                                  std::size_t lights_a_pass) {
  FrameStats stats;
  const FrameContext context{*scene_, view, options, stats};
  StepCost cost;
  ORIEL_TRY_VOID(make_pictures(view));
  ORIEL_TRY_VOID(scene_->load_images(view));
  const std::vector<PlacedMover> placed = place_movers(*scene_, options);
  const auto movers = std::span(placed).first(std::min<std::size_t>(placed.size(), BlockedLights::kMostMovers));
  draw_surfaces(context);
  auto start = std::chrono::steady_clock::now();
  milliseconds_since(start);
  spheres_.clear();
  for (std::uint32_t m = 0; m < movers.size(); ++m) {
    blocked_->move(m, movers[m].sphere);
    spheres_.push_back(movers[m].sphere);
  }
  lists_.set_movers(spheres_);
  std::vector<CellLights> lists = lights_in_view(*shade_, *blocked_, make_frustum(view.clip_from_pack));
  std::vector<LightPass> passes = passes_of(step, *shade_, lists);
  stats.shade.cells_ms = milliseconds_since(start);
  if (step == ShadeStep::kMerged) passes = merge_passes(std::move(passes), lights_a_pass);
  cost.merge_ms = milliseconds_since(start);
  if (step == ShadeStep::kEachLight) lists.assign(1, {0, passes.front().lights});
  stats.shade.late = static_cast<std::uint32_t>(maps_.refresh(context, lists, intensities_, movers));
  stats.shade.maps_ms = milliseconds_since(start);
  for (const LightPass& pass : passes) stats.shade.pairs += pass.cells.size() * pass.lights.size();
  cost.passes = step == ShadeStep::kLists ? 1 : count_passes(passes, lights_a_pass);
  light_target_.bind();
  glViewport(0, 0, view.width, view.height);
  constexpr GLfloat kNothing[] = {0, 0, 0, 0};
  gpu::apply({});  // maps are drawn without colour
  glClearBufferfv(GL_COLOR, 0, kNothing);
  const bool by_list = step == ShadeStep::kLists;
  ORIEL_TRY_VOID(by_list ? lists_.set_lists(lists) : boxes_.set_passes(std::move(passes), lights_a_pass));
  const auto draw_light = [&](const LitPixels& pixels) {
    by_list ? lists_.draw(maps_, pixels, stats) : boxes_.draw(view, lists_, maps_, pixels, stats);
  };
  if (step >= ShadeStep::kFewPixels)
    ORIEL_TRY_VOID(few_.draw({surfaces_, light_, light_target_, pictures_}, draw_light));
  else
    draw_light({surfaces_});
  stats.shade.light_ms = milliseconds_since(start);
  stats.shade.lights = static_cast<std::uint32_t>(shade_->lights.size());
  cost.shade = stats.shade;
  ORIEL_TRY_VOID(gpu::check_gl("drawing light that movers take"));
  return cost;
}

FloatImage ShadeSteps::read() const {
  FloatImage out{static_cast<std::uint32_t>(light_.width()), static_cast<std::uint32_t>(light_.height()), 4, {}};
  const std::size_t row = 4 * std::size_t{out.width};
  out.pixels.resize(row * out.height);
  light_target_.bind();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, light_.width(), light_.height(), GL_RGBA, GL_FLOAT, out.pixels.data());
  for (std::size_t low = 0, high = out.height; low + 1 < high--; ++low)
    std::swap_ranges(&out.pixels[low * row], &out.pixels[low * row] + row, &out.pixels[high * row]);
  return out;
}

}  // namespace oriel::study
