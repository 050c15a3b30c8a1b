// Whole paths while nothing moves: the frame of oriel-bake render, sample by sample, on threads of its own.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "bake/reference/reference.h"
#include "preview/frame/preview_scene.h"

namespace oriel {

// The mean of so many paths a pixel, and its noise; row 0 at the top, RGB, cd/m².
struct PathMean {
  std::uint32_t samples = 0;
  FloatImage mean, noise;     // noise: standard errors; none of one sample
  FloatImage halves;          // half the difference of the means of even and of odd samples: noise as large as mean's
  double relative_noise = 1;  // as ReferenceFrame's
};

// What is being traced, and from where.
struct PathView {
  std::shared_ptr<const PreviewScene> scene;
  Camera camera;
  ReferenceOptions frame;  // samples: at most
  std::uint64_t seed = 1;
};

class PathFrame {
 public:
  explicit PathFrame(int threads);  // 0: all CPUs
  ~PathFrame();
  PathFrame(const PathFrame&) = delete;
  PathFrame& operator=(const PathFrame&) = delete;

  // From the first path on; what was under way is dropped.
  void start(PathView view);
  void stop();
  // Lets the processors to others until it is called with false; nothing is lost.
  void hold(bool held);
  // The mean of more samples than that, once it is there.
  std::optional<PathMean> newer(std::uint32_t than) const;
  // Waits until all samples are taken, or for so long.
  bool wait(double seconds) const;

 private:
  void work();
  void trace(const PathView& view);
  bool trace_pixels(const ReferenceOptions& frame, const std::function<void(std::uint32_t x, std::uint32_t y)>& pixel);

  Context context_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::optional<PathView> wanted_;
  PathMean mean_;  // given to the frame
  bool busy_ = false, ends_ = false;
  std::atomic<bool> held_{false};
  std::thread thread_;
};

}  // namespace oriel
