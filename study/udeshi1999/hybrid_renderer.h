// A frame as Udeshi & Hansen 1999 draw it: direct light with shadow volumes, one bounce of elements without shadows,
// specular pixels by rays, all added up on the processors.
#pragma once

#include <optional>

#include "bake/trace/sampler.h"
#include "preview/frame/traced.h"
#include "study/udeshi1999/shadow_pass.h"

namespace oriel::study {

struct HybridOptions {
  std::uint32_t points = 18;    // on lamps
  std::uint32_t cap_rays = 0;   // what holds the eye, as so many rays tell (sampled_caps.h); 0: exactly
  std::uint32_t elements = 32;  // that reflect light, at most LampPass::kMostElements; 0: none
  float glossy = 0.35f;         // roughness below which surfaces are traced
};

// By pixel, row 0 at the bottom.
struct HybridFrame {
  std::vector<Vec4> direct, indirect;  // irradiance, lux
  std::vector<Vec4> traced, sum;       // cd/m²
  std::vector<LampPoint> lamps, elements;
  double surfaces_s = 0, silhouettes_s = 0, volumes_s = 0, direct_s = 0, indirect_s = 0, traced_s = 0, composite_s = 0;
  std::size_t quads = 0, traced_pixels = 0;
};

class HybridRenderer {
 public:
  static Result<HybridRenderer> create(const gpu::Device& device);
  // Error kUsage where it has a measured lamp.
  Status take(std::shared_ptr<const PreviewScene> scene);
  Status look(const Camera& camera, int width, int height);
  // Error kRuntime of the driver.
  Result<HybridFrame> draw(const HybridOptions& options, Context& context);

  // What the camera sees, and by pixel how many shadow volumes of a lamp's point hold it, modulo 256; seen() comes
  // first.
  SeenPoints seen(float glossy);
  std::vector<std::uint8_t> count_volumes(const LampPoint& point, std::uint32_t cap_rays = 0);
  std::uint32_t volumes_around_eye(const LampPoint& point) const;

 private:
  ShadowVolumes volumes_of(const LampPoint& point, std::uint32_t cap_rays) const;
  void draw_direct(const HybridOptions& options, HybridFrame& frame);

  gpu::Device device_;
  SurfacePass surface_pass_;
  VolumePass volume_pass_;
  LampPass lamp_pass_;
  std::shared_ptr<const PreviewScene> scene_;
  ShadowMesh shadows_;
  PreviewMesh mesh_;
  View view_;
  std::optional<SeenSurfaces> surfaces_;
  gpu::Texture2d light_;
  gpu::Framebuffer light_framebuffer_;
};

}  // namespace oriel::study
