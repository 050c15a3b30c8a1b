// What `oriel-bake render` does.
#include "bake/cli/render_arguments.h"
#include "bake/jobs/parallel.h"
#include "bake/run/pipeline.h"
#include "bake/scene/motion/movers.h"
#include "formats/camera/camera_notes.h"
#include "formats/camera/camera_spec.h"
#include "formats/image/exr.h"

namespace oriel {
namespace {

Result<Camera> choose_camera(const Scene& scene, const std::string& text) {
  const CameraChoices choices{scene.cameras, scene.paths, scene.origin};
  if (text.empty()) return initial_camera(choices, scene.lower, scene.upper);
  return parse_camera(text, choices);
}

Status move_movers(std::span<const MoverMove> moves, Scene& scene) {
  if (moves.empty()) return {};
  std::vector<std::string> names;
  std::vector<MoverPose> poses;
  for (const SceneMover& mover : scene.movers) {
    names.push_back(mover.name);
    poses.push_back(mover.rest);
  }
  ORIEL_TRY_VOID(apply_moves(moves, names, scene.origin, poses));
  for (std::size_t i = 0; i < poses.size(); ++i) move_mover(scene, i, poses[i]);
  return {};
}

}  // namespace

Status run_render(const RenderArguments& args, Context& context) {
  ORIEL_TRY(ImportedScene imported, import_gltf(args.scene, args.import, context));
  ORIEL_TRY_VOID(move_movers(args.moves, imported.scene));
  const Scene& scene = imported.scene;
  ORIEL_TRY(const Camera camera, choose_camera(scene, args.camera));
  ORIEL_TRY(const Accel accel, Accel::build(scene, {args.reproducible, thread_count(context)}));
  const LightSet lights(scene);
  warn_about_light(scene, lights, context);
  ORIEL_TRY(ReferenceFrame frame, render_reference({accel, lights, {}}, camera, args.frame, context));
  LayeredImage image;
  image.layers = {{"", std::move(frame.total)},
                  {"direct", std::move(frame.direct)},
                  {"indirect", std::move(frame.indirect)},
                  {"specular", std::move(frame.specular)},
                  {"emission", std::move(frame.emission)},
                  {"error", std::move(frame.noise)},
                  {"diffuse_error", std::move(frame.diffuse_noise)},
                  {"specular_error", std::move(frame.specular_noise)}};
  image.attributes = camera_notes(camera, scene.origin);
  image.attributes["oriel.camera"] = args.camera.empty() ? camera.name : args.camera;
  image.attributes["oriel.unit"] = "cd/m2";
  image.attributes["oriel.samples"] = std::to_string(frame.samples);
  image.attributes["oriel.noise"] = fmt::format("{:.4g}", frame.relative_noise);
  return write_exr(args.output, image);
}

}  // namespace oriel
