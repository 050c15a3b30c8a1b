#include "bake/run/view_options.h"

#include <algorithm>

#include "formats/query/camera_spec.h"

namespace oriel {
namespace {

constexpr int kLargestSide = 16384;

}  // namespace

Option size_option(int& width, int& height) {
  const OptionValue size{"WxH",
                         [&width, &height](const std::string& typed) -> Status {
                           char rest = 0;
                           const bool read = std::sscanf(typed.c_str(), "%dx%d%c", &width, &height, &rest) == 2;
                           if (read && std::min(width, height) >= 1 && std::max(width, height) <= kLargestSide)
                             return {};
                           return fail(ErrorCode::kUsage, "",
                                       "found '{}', expected WIDTHxHEIGHT, as 1280x720, at most {} a side", typed,
                                       kLargestSide);
                         },
                         [&width, &height] { return fmt::format("{}x{}", width, height); }};
  return {"--size", kFrameGroup, "Pixels of the frame", size, Use::kEveryday};
}

Option camera_option(std::string& camera) {
  return {
      "--camera", kFrameGroup,
      "A camera by name or by number from 0, PATH@SECONDS for a point of a path, or eye and target in world metres; "
      "as oriel-play takes it. Default: the first",
      text(camera, "NAME|N|PATH@S|ex,ey,ez,tx,ty,tz"), Use::kEveryday};
}

Result<Camera> choose_camera(const Scene& scene, const std::string& text) {
  const CameraChoices choices{scene.cameras, scene.paths, scene.origin};
  if (text.empty()) return initial_camera(choices, scene.lower, scene.upper);
  return parse_camera(text, choices);
}

}  // namespace oriel
