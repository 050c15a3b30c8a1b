#include "player/app/panorama_shot.h"

#include <algorithm>
#include <array>

#include "formats/core/color.h"
#include "player/app/stop.h"
#include "player/navigation/lamps.h"
#include "player/navigation/poses.h"
#include "player/output/panorama.h"
#include "player/output/picture.h"

namespace oriel {
namespace {

FloatImage as_light(const std::vector<std::uint8_t>& shown, std::uint32_t size) {
  FloatImage out{size, size, 3, {}};
  out.pixels.reserve(shown.size());
  for (const std::uint8_t v : shown) out.pixels.push_back(linear_from_srgb8(v));
  return out;
}

ByteImage as_shown(const FloatImage& light) {
  ByteImage out{light.width, light.height, 3, {}};
  out.pixels.reserve(light.pixels.size());
  for (const float v : light.pixels)
    out.pixels.push_back(static_cast<std::uint8_t>(255 * std::clamp(srgb_from_linear(v), 0.0f, 1.0f) + 0.5f));
  return out;
}

class PanoramaStudio {
 public:
  PanoramaStudio(const PlayArguments& arguments, GpuScene& scene, Renderer& renderer)
      : arguments_(arguments), scene_(scene), renderer_(renderer), options_(arguments.frame) {}

  Status draw(const Shot& shot) {
    ORIEL_TRY(options_.poses, poses_at(scene_.pack(), arguments_.moves, arguments_.time_s));
    ORIEL_TRY(options_.lamps, lamps_at(scene_.pack(), arguments_.moves, arguments_.time_s));
    const PanoramaViews views = panorama_views(shot.camera, arguments_.width);
    PictureNotes notes{views.cameras[0], scene_.pack().mesh.origin, shot.name, 0, arguments_.curve};
    notes.camera.vertical_fov_rad = kPi;
    ORIEL_TRY(notes.ev100, expose(views));
    const bool linear = is_linear_file(shot.file);
    const auto size = static_cast<std::uint32_t>(views.size);
    std::array<FloatImage, 6> faces;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      ORIEL_TRY_VOID(render(views.cameras[i], views.size));
      if (linear) {
        faces[i] = {size, size, 3, renderer_.read_light()};
      } else {
        ORIEL_TRY(const auto shown, renderer_.read_display(notes.ev100, arguments_.curve));
        faces[i] = as_light(shown, size);
      }
    }
    const FloatImage light = panorama(views, faces, static_cast<std::uint32_t>(arguments_.width));
    ORIEL_TRY_VOID(linear ? write_light(shot.file, light, notes) : write_shown(shot.file, as_shown(light), notes));
    fmt::print(stderr, "{}: {}x{}, EV {:.2f} ({})\n", shot.file, light.width, light.height, notes.ev100, shot.name);
    return {};
  }

 private:
  Status render(const Camera& camera, int size) {
    if (stop_requested()) return fail(ErrorCode::kStopped, "", "stopped by the user");
    const View view = make_view(camera, size, size, bounds_with_movers(scene_, options_.poses));
    ORIEL_TRY_VOID(renderer_.render(scene_, view, options_));
    return {};
  }

  // The mean over the directions that have light.
  Result<float> expose(const PanoramaViews& views) {
    if (arguments_.ev100) return *arguments_.ev100;
    float sum = 0;
    int count = 0;
    for (const Camera& camera : views.cameras) {
      ORIEL_TRY_VOID(render(camera, views.size));
      ORIEL_TRY(const std::optional<float> metered, renderer_.meter());
      if (!metered) continue;
      sum += *metered;
      ++count;
    }
    return count > 0 ? sum / static_cast<float>(count) : 0.0f;
  }

  const PlayArguments& arguments_;
  GpuScene& scene_;
  Renderer& renderer_;
  FrameOptions options_;
};

}  // namespace

Status draw_panoramas(const std::vector<Shot>& shots, const PlayArguments& arguments, GpuScene& scene,
                      Renderer& renderer) {
  PanoramaStudio studio(arguments, scene, renderer);
  for (const Shot& shot : shots) ORIEL_TRY_VOID(studio.draw(shot));
  return {};
}

}  // namespace oriel
