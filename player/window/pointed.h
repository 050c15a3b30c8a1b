// The surface under the pointer, and why its light is as it is once the pointer rests there.
#pragma once

#include <optional>

#include "formats/query/mesh_rays.h"
#include "player/navigation/view.h"
#include "player/scene/gpu_scene.h"
#include "player/session/pick.h"

namespace oriel {

class Pointed {
 public:
  // place: of the pointer in the window, [0,1]² from the top left corner.
  void look(GpuScene& scene, const View& view, const Vec2& place, const Vec3& eye);
  // Another scene.
  void forget() {
    surface_.reset();
    rays_.reset();
  }
  const std::optional<PickedSurface>& surface() const { return surface_; }

 private:
  std::optional<PickedSurface> surface_;
  std::optional<MeshRays> rays_;  // of the scene, once somebody asks why
};

}  // namespace oriel
