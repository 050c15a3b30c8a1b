// The shade of movers in light that comes from everywhere: what the lightmap holds and no bright light brings. A few
// hundred lights stand for it (ShadeScene); what movers block of them is taken from what the bake found, so that a
// frame without movers is the baked one, and the lights' errors show in the shade alone. After Barczak 2006, chapter 4:
// cells of space know which lights may be blocked there, maps of the movers around each light are octahedral, and
// pictures of few pixels are filled up where surfaces are even.
#pragma once

#include <future>
#include <optional>

#include "player/movers/blocked_lights.h"
#include "player/movers/shade_draw.h"

namespace oriel {

class ShadePass {
 public:
  ShadePass();  // nothing but a place for what create() gives
  static Result<ShadePass> create(gpu::Dialect dialect);
  ~ShadePass();
  ShadePass(ShadePass&&) noexcept;
  ShadePass& operator=(ShadePass&&) noexcept;

  // Whether there is any, now or once the scene is known. The first time it takes a second or some; with images in the
  // background it begins there once all of them have come, and until it is done there is no shade. Errors of images.
  Result<bool> prepare(const FrameContext& context, std::span<const PlacedMover> movers);
  // After prepare(). Own framebuffers stay bound. Error kRuntime.
  Status draw(const FrameContext& context, std::span<const PlacedMover> movers, const LitTarget& target);
  // Whether a frame of the same view would show more: of a scene that is known by now, or with maps that were late.
  bool has_news() const;
  // Rises whenever draw() would give something else though neither eye nor movers have moved.
  std::uint64_t version() const { return version_; }

 private:
  struct Work;  // in the background
  bool is_done() const;
  Status make_programs();
  Status take(ShadeScene scene, const FrameContext& context);
  Status set_intensities(const FrameContext& context);
  void move(std::span<const PlacedMover> movers);

  ShadeDraw light_;
  FewPixels few_;
  ShadeMaps maps_;
  bool made_ = false;  // the three above
  std::shared_ptr<const ShadeScene> scene_;
  std::optional<BlockedLights> blocked_;
  std::vector<Vec4> spheres_;      // of movers, as blocked_ knows them
  std::vector<Vec3> intensities_;  // by light
  std::unique_ptr<Work> work_;
  std::uint64_t geometry_ = 0, serial_ = 0, version_ = 0;  // of the scene: whose shape, whose light
  std::uint32_t wanted_lights_ = 0;
  gpu::Dialect dialect_{};
  GLint layers_ = 0;  // of an array: as many lights
  std::size_t late_ = 0;
};

}  // namespace oriel
