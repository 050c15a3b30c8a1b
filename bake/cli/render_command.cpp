// What `oriel-bake render` does.
#include "bake/cli/render_arguments.h"
#include "bake/jobs/parallel.h"
#include "bake/run/pipeline.h"
#include "formats/camera/camera_spec.h"
#include "formats/image/exr.h"

namespace oriel {
namespace {

FloatImage layer(const ReferenceFrame& frame, const std::vector<Vec3>& values) {
  FloatImage image{static_cast<std::uint32_t>(frame.width), static_cast<std::uint32_t>(frame.height), 3, {}};
  image.pixels.reserve(values.size() * 3);
  for (const Vec3& v : values) image.pixels.insert(image.pixels.end(), {v.r, v.g, v.b});
  return image;
}

Result<Camera> choose_camera(const Scene& scene, const std::string& text) {
  const CameraChoices choices{scene.cameras, scene.paths, scene.origin};
  if (text.empty()) return initial_camera(choices, scene.lower, scene.upper);
  return parse_camera(text, choices);
}

}  // namespace

Status run_render(const RenderArguments& args, Context& context) {
  ORIEL_TRY(const ImportedScene imported, import_gltf(args.scene, args.import, context));
  const Scene& scene = imported.scene;
  ORIEL_TRY(const Camera camera, choose_camera(scene, args.camera));
  ORIEL_TRY(const Accel accel, Accel::build(scene, {args.reproducible, thread_count(context)}));
  const LightSet lights(scene);
  warn_about_light(scene, lights, context);
  ORIEL_TRY(const ReferenceFrame frame, render_reference({accel, lights, {}}, camera, args.frame, context));
  LayeredImage image;
  image.layers = {{"", layer(frame, frame.total)},
                  {"direct", layer(frame, frame.direct)},
                  {"indirect", layer(frame, frame.indirect)},
                  {"specular", layer(frame, frame.specular)},
                  {"emission", layer(frame, frame.emission)},
                  {"error", layer(frame, frame.noise)},
                  {"diffuse_error", layer(frame, frame.diffuse_noise)},
                  {"specular_error", layer(frame, frame.specular_noise)}};
  image.attributes = {{"oriel.camera", args.camera.empty() ? camera.name : args.camera},
                      {"oriel.unit", "cd/m2"},
                      {"oriel.samples", std::to_string(frame.samples)},
                      {"oriel.noise", fmt::format("{:.4g}", frame.relative_noise())}};
  return write_exr(args.output, image);
}

}  // namespace oriel
