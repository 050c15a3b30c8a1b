#include "preview/frame/preview_scene.h"

#include <chrono>
#include <thread>

#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

void find_elements(PreviewScene& scene, std::uint64_t seed, std::uint32_t elements) {
  constexpr std::uint32_t kFiner = 16;  // times as many
  scene.elements = bounce_elements(scene.transport(), seed, elements);
  scene.finer = bounce_elements(scene.transport(), seed, kFiner * elements);
}

Result<std::shared_ptr<const PreviewScene>> prepare_preview_scene(ImportedScene imported, std::uint32_t elements,
                                                                  Context& context) {
  auto out = std::make_shared<PreviewScene>();
  out->imported = std::move(imported);
  const Scene& scene = out->scene();
  // What passes need is made beside what rays need.
  std::jthread passes([&] {
    const Clock::time_point begun = Clock::now();
    out->lamps = Lamps(scene);
    out->shadows = ShadowMesh(scene);
    out->passes_s = seconds_since(begun);
  });
  const Clock::time_point begun = Clock::now();
  auto accel = Accel::build(scene, {false, thread_count(context)});
  if (accel) {
    out->accel.emplace(std::move(*accel));
    out->lights.emplace(scene);
    find_elements(*out, context.seed, elements);
  }
  out->rays_s = seconds_since(begun);
  passes.join();
  if (!accel) return tl::unexpected<Error>(accel.error());
  if (context.stopped()) return fail(ErrorCode::kStopped, "", "stopped");
  return std::shared_ptr<const PreviewScene>(std::move(out));
}

Result<std::shared_ptr<const PreviewScene>> load_preview_scene(const PreviewSceneOptions& options, Context& context) {
  const Clock::time_point start = Clock::now();
  ORIEL_TRY(ImportedScene imported, import_gltf(options.file, options.import, context));
  const double import_s = seconds_since(start);
  ORIEL_TRY(const auto scene, prepare_preview_scene(std::move(imported), options.elements, context));
  auto out = std::const_pointer_cast<PreviewScene>(scene);  // nobody else has it yet
  out->import_s = import_s;
  return scene;
}

}  // namespace oriel
