#include "player/output/played_frame.h"

namespace oriel {
namespace {

// Draws the stages that are compared, as large pictures, and averages them.
class Stages {
 public:
  Stages(Renderer& renderer, const ComparedView& of)
      : scene_(of.scene),
        renderer_(renderer),
        view_(of.view),
        options_(of.options),
        n_(of.parts),
        extension_(of.extension) {}

  Result<PlayedFrame> draw() {
    PlayedFrame frame;
    ORIEL_TRY(frame.diffuse, draw_stage(Show::kD));
    options_.count_holes = true;
    ORIEL_TRY(frame.specular, draw_stage(Show::kMKR));
    frame.holes = stats_.reflected_pixels > 0
                      ? static_cast<double>(stats_.holes) / static_cast<double>(stats_.reflected_pixels)
                      : 0;
    options_.count_holes = false;
    ORIEL_TRY(frame.total, draw_stage(Show::kAll));
    const std::vector<std::int32_t> materials = renderer_.read_reflective();
    const auto blurs = [&](std::int32_t material) {
      const Pack& pack = scene_.pack();
      const std::int32_t kernel = pack.materials[static_cast<std::size_t>(material)].kernel;
      return kernel >= 0 && pack.kernels[static_cast<std::size_t>(kernel)].size > 1;
    };
    frame.mirrors = region(materials, [&](std::int32_t m) { return m >= 0 && !blurs(m); });
    frame.glossy = region(materials, [&](std::int32_t m) { return m >= 0 && blurs(m); });
    frame.movers = region(materials, [](std::int32_t m) { return m == Renderer::kMoverPixel; });
    return frame;
  }

 private:
  Result<FloatImage> draw_stage(Show show) {
    options_.show = show;
    ORIEL_TRY(stats_, renderer_.render(scene_, view_, options_, extension_));
    const auto width = static_cast<std::uint32_t>(view_.width), height = static_cast<std::uint32_t>(view_.height);
    return shrink(FloatImage{width, height, 3, renderer_.read_light()}, n_);
  }

  // Pixels of the small picture all of whose parts count.
  template <class Counts>
  std::vector<std::uint8_t> region(const std::vector<std::int32_t>& materials, Counts counts) const {
    const std::size_t large = static_cast<std::size_t>(view_.width), width = large / n_,
                      height = static_cast<std::size_t>(view_.height) / n_;
    std::vector<std::uint8_t> out(width * height, 1);
    for (std::size_t i = 0; i < materials.size(); ++i)
      if (!counts(materials[i])) out[i / large / n_ * width + i % large / n_] = 0;
    return out;
  }

  GpuScene& scene_;
  Renderer& renderer_;
  const View& view_;
  FrameOptions options_;
  FrameStats stats_;  // of the last stage
  std::uint32_t n_;
  FrameExtension* extension_;
};

}  // namespace

Result<PlayedFrame> draw_compared(Renderer& renderer, const ComparedView& of) {
  return Stages(renderer, of).draw();
}

}  // namespace oriel
