#include "preview/frame/preview_scene.h"

#include <chrono>

#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// same: a scene of the same shape, or null.
Status make_rays(PreviewScene& scene, const PreviewScene* same, Context& context) {
  if (same != nullptr) {
    scene.accel = same->accel->of(scene.scene());
  } else {
    ORIEL_TRY(scene.accel, Accel::build(scene.scene(), {false, thread_count(context)}));
  }
  scene.lights.emplace(scene.scene());
  scene.sources.emplace(scene.scene(), *scene.lights);
  return {};
}

}  // namespace

void find_lamps(PreviewScene& scene) {
  scene.lamps = Lamps(scene.scene());
  scene.lights.emplace(scene.scene());
  scene.sources.emplace(scene.scene(), *scene.lights);
}

Result<std::shared_ptr<const PreviewScene>> prepare_preview_scene(ImportedScene imported, Context& context,
                                                                  const PreviewScene* last) {
  auto out = std::make_shared<PreviewScene>();
  out->imported = std::move(imported);
  const Scene& scene = out->scene();
  out->parts = parts_of(scene);
  const PreviewScene* same = last != nullptr && last->parts.shape == out->parts.shape ? last : nullptr;
  const Clock::time_point begun = Clock::now();
  ORIEL_TRY_VOID(make_rays(*out, same, context));
  out->lamps = Lamps(scene);
  out->rays_s = seconds_since(begun);
  if (context.stopped()) return fail(ErrorCode::kStopped, "", "stopped");
  return std::shared_ptr<const PreviewScene>(std::move(out));
}

Result<std::shared_ptr<const PreviewScene>> load_preview_scene(const PreviewSceneOptions& options, Context& context,
                                                               const PreviewScene* last) {
  const Clock::time_point start = Clock::now();
  ORIEL_TRY(ImportedScene imported,
            import_gltf(options.file, options.import, context, last != nullptr ? &last->imported : nullptr));
  const double import_s = seconds_since(start);
  ORIEL_TRY(const auto scene, prepare_preview_scene(std::move(imported), context, last));
  auto out = std::const_pointer_cast<PreviewScene>(scene);  // nobody else has it yet
  out->import_s = import_s;
  return scene;
}

}  // namespace oriel
