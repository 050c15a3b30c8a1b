// What a pack is shown beside: another pack, or a picture of a file.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "formats/image/image.h"
#include "formats/query/mover_pose.h"
#include "player/output/picture.h"
#include "player/passes/frame.h"

namespace oriel {

class Other {
 public:
  // A pack, .exr (linear light, cd/m²) or .png (as shown). loading: of a pack. Errors: those of reading them and of
  // GpuScene::create; kUsage for another kind of file.
  static Result<std::unique_ptr<Other>> open(const std::string& path, const gpu::Device& device,
                                             const LoadingOptions& loading = {});

  const std::string& path() const { return path_; }
  // Where a picture that tells it was taken from, in the space of that origin. Nothing of a pack.
  std::optional<Camera> camera(const DVec3& origin) const;

  // The frame as the first pack's is seen.
  struct Seen {
    const Camera& camera;  // in the space of `origin`
    DVec3 origin{0};
    int width = 1, height = 1;
    const FrameOptions& options;       // but for poses
    std::span<const MoverMove> moves;  // those of movers that it has count
    double time_s = 0;
  };
  // Draws it, or lays the picture over the frame, whatever the camera. Errors of Renderer::render.
  Status draw(const Seen& seen);
  // What draw() has made, as Renderer's.
  void display(float ev100, ToneCurve curve) const { renderer_->display(ev100, curve); }
  Result<std::vector<std::uint8_t>> read_display(float ev100, ToneCurve curve) {
    return renderer_->read_display(ev100, curve);
  }
  std::vector<float> read_light() const { return renderer_->read_light(); }
  Renderer& renderer() { return *renderer_; }
  // shown_picture() and write_picture() of what both have drawn last: the first's up to the divider [0, 1], from there
  // on this one's.
  Result<ByteImage> shown_beside(Renderer& first, float divider, const PictureNotes& notes, std::uint32_t n = 1);
  Status write_beside(Renderer& first, float divider, const std::string& path, const PictureNotes& notes,
                      std::uint32_t n = 1);

 private:
  Other() = default;
  Status read_picture();

  std::string path_;
  std::unique_ptr<Renderer> renderer_;  // of its own: it keeps what it draws, and what it made of the scene
  std::unique_ptr<GpuScene> scene_;     // null: a picture
  FloatImage picture_;                  // linear
  bool as_shown_ = false;               // the picture: without exposure and tone curve
  bool laid_ = false;                   // in the renderer's frame
  std::map<std::string, std::string> notes_;
};

}  // namespace oriel
