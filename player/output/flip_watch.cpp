#include "player/output/flip_watch.h"

#include <chrono>
#include <cmath>

#include "formats/core/color.h"
#include "formats/image/flip.h"
#include "formats/image/heat.h"

namespace oriel {
namespace {

constexpr float kSameEv = 0.01f;  // automatic exposure comes to rest by and by

FloatImage encoded(const ByteImage& shown) {
  FloatImage out{shown.width, shown.height, 3, {}};
  out.pixels.reserve(shown.pixels.size());
  for (const std::uint8_t v : shown.pixels) out.pixels.push_back(static_cast<float>(v) / 255);
  return out;
}

bool same(const FlipWatch::Key& a, const FlipWatch::Key& b) {
  FrameOptions of_a = a.options, of_b = b.options;
  of_a.timed = of_b.timed = false;
  return a.size == b.size && a.image_bytes == b.image_bytes && a.curve == b.curve &&
         std::fabs(a.ev100 - b.ev100) < kSameEv && of_a == of_b && a.camera.eye == b.camera.eye &&
         a.camera.forward == b.camera.forward && a.camera.up == b.camera.up &&
         a.camera.vertical_fov_rad == b.camera.vertical_fov_rad && a.camera.half_height == b.camera.half_height;
}

}  // namespace

FlipFrame flip_frame(const ByteImage& first, const ByteImage& second) {
  const FloatImage flip = flip_map(encoded(first), encoded(second));
  FlipFrame out{{flip.width, flip.height, 4, {}}, 0, 0};
  out.colors.pixels.reserve(4 * flip.pixels.size());
  double sum = 0;
  for (const float v : flip.pixels) {
    const Vec3 color = linear_from_srgb(heat(v));
    out.colors.pixels.insert(out.colors.pixels.end(), {color.r, color.g, color.b, 2});
    sum += double{v};
    out.largest = std::max(out.largest, v);
  }
  out.mean = static_cast<float>(sum / static_cast<double>(flip.pixels.size()));
  return out;
}

bool FlipWatch::look(const Key& key, double now_s) {
  if (!same(key, key_)) {
    key_ = key;
    since_s_ = now_s;
    asked_ = false;
    stale_ = busy();
    found_.reset();
  }
  return !asked_ && !busy() && now_s - since_s_ >= kRest_s;
}

void FlipWatch::start(ByteImage first, ByteImage second) {
  asked_ = true;
  stale_ = false;
  work_ = std::async(std::launch::async, flip_frame, std::move(first), std::move(second));
}

const FlipFrame* FlipWatch::found() {
  if (busy() && work_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    FlipFrame frame = work_.get();
    if (!std::exchange(stale_, false)) found_ = std::move(frame);
  }
  return found_ ? &*found_ : nullptr;
}

}  // namespace oriel
