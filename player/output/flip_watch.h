// FLIP between two frames, found in the background once they are at rest. No OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <optional>

#include "formats/assets/camera.h"
#include "formats/image/image.h"
#include "player/passes/display_pass.h"
#include "player/scene/frame_options.h"

namespace oriel {

struct FlipFrame {
  FloatImage colors;  // heat() of FLIP by pixel, to be shown as it is: FrameTarget::light
  float mean = 0, largest = 0;
};

// Of pictures as shown, RGB, one size.
FlipFrame flip_frame(const ByteImage& first, const ByteImage& second);

class FlipWatch {
 public:
  // What the frames depend on.
  struct Key {
    Camera camera;
    IVec2 size{0};
    FrameOptions options;
    float ev100 = 0;
    ToneCurve curve = ToneCurve::kAces;
    std::array<std::uint64_t, 2> image_bytes{};  // of both packs, on the device: images may still come
  };
  static constexpr double kRest_s = 0.3;

  // To be called once a frame. True: the frames have been the same for kRest_s, and FLIP between them is not known: it
  // is time for start().
  bool look(const Key& key, double now_s);
  void start(ByteImage first, ByteImage second);
  // Of the frames that look() saw last, once it is known.
  const FlipFrame* found();
  bool busy() const { return work_.valid(); }

 private:
  Key key_;
  double since_s_ = 0;
  bool asked_ = false;  // for these frames
  bool stale_ = false;  // the work is on others
  std::future<FlipFrame> work_;
  std::optional<FlipFrame> found_;
};

}  // namespace oriel
