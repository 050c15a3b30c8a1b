#include "player/window/pointed.h"

#include <utility>

namespace oriel {

void Pointed::look(GpuScene& scene, const View& view, const Vec2& place, const Vec3& eye) {
  const PageOf page_of = [&](std::uint32_t page) -> const LightmapPage* {
    const auto found = scene.page(page);
    return found ? *found : nullptr;
  };
  const auto before = std::exchange(surface_, pick_surface(scene.pack(), ray_through(view, place), page_of));
  const bool rests = before && surface_ && before->page == surface_->page && before->texel == surface_->texel &&
                     before->part == surface_->part;
  if (!rests || !surface_->known) return;
  surface_->why = before->why;
  if (surface_->why) return;
  if (!rays_) rays_.emplace(scene.pack().mesh);
  surface_->why = why_at(scene.pack(), *rays_, surface_->at, {.reach_m = 0.5f, .eye = eye}, page_of);
}

}  // namespace oriel
