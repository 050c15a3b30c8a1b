#include "preview/frame/paths.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bake/jobs/parallel.h"
#include "formats/image/relative_error.h"

namespace oriel {
namespace {

// Sums over the samples of each pixel.
struct PathSums {
  std::vector<DVec3> sum, squares, even;  // even: of every other sample
  std::uint32_t samples = 0;

  PathMean mean(const ReferenceOptions& frame) const {
    const auto width = static_cast<std::uint32_t>(frame.width), height = static_cast<std::uint32_t>(frame.height);
    PathMean out{samples, {width, height, 3, {}}, {width, height, 3, {}}, {width, height, 3, {}}, 1};
    const double n = samples, evens = std::ceil(n / 2), odds = std::max(1.0, n - evens);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const DVec3 mean = sum[i] / n;
      const DVec3 error = glm::sqrt(glm::max(DVec3(0), squares[i] / n - mean * mean) / std::max(1.0, n - 1));
      for (int c = 0; c < 3; ++c) {
        out.mean.pixels.push_back(static_cast<float>(mean[c]));
        out.noise.pixels.push_back(static_cast<float>(error[c]));
        out.halves.pixels.push_back(static_cast<float>(0.5 * (even[i][c] / evens - (sum[i][c] - even[i][c]) / odds)));
      }
    }
    if (samples > 1) out.relative_noise = relative_error(out.mean, out.mean, out.noise)->noise;
    return out;
  }
};

}  // namespace

PathFrame::PathFrame(int threads) : thread_([this] { work(); }) {
  context_.threads = threads;
}

PathFrame::~PathFrame() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
    context_.stop = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PathFrame::start(PathView view) {
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = std::move(view);
    mean_ = {};
    context_.stop = true;
  }
  changed_.notify_all();
}

void PathFrame::stop() {
  std::unique_lock lock(mutex_);
  wanted_.reset();
  mean_ = {};
  context_.stop = true;
  changed_.notify_all();
  changed_.wait(lock, [&] { return !busy_; });
}

void PathFrame::hold(bool held) {
  if (held_.exchange(held) == held) return;
  { const std::scoped_lock lock(mutex_); }  // whoever looked before it changed waits by now
  changed_.notify_all();
}

std::optional<PathMean> PathFrame::newer(std::uint32_t than) const {
  const std::scoped_lock lock(mutex_);
  return mean_.samples > than ? std::optional(mean_) : std::nullopt;
}

bool PathFrame::wait(double seconds) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return !busy_ && !wanted_; });
}

void PathFrame::work() {
  while (true) {
    PathView view;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ends_ || wanted_; });
      if (ends_) return;
      view = std::move(*wanted_);
      wanted_.reset();
      busy_ = true;
      context_.stop = false;
    }
    trace(view);
    {
      const std::scoped_lock lock(mutex_);
      busy_ = false;
    }
    changed_.notify_all();
  }
}

// Each pixel once, with rests while it is held. False: it was ended before.
bool PathFrame::trace_pixels(const ReferenceOptions& frame,
                             const std::function<void(std::uint32_t x, std::uint32_t y)>& pixel) {
  const auto width = static_cast<std::uint32_t>(frame.width);
  std::vector<std::uint32_t> done(static_cast<std::size_t>(frame.height));  // of each row
  const auto row = [&](std::size_t y) {
    for (std::uint32_t& x = done[y]; x < width && !held_ && !context_.stopped(); ++x)
      pixel(x, static_cast<std::uint32_t>(y));
  };
  while (std::any_of(done.begin(), done.end(), [&](std::uint32_t x) { return x < width; })) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return !held_ || context_.stopped(); });
    }
    if (!parallel_for(context_, "", done.size(), row)) return false;
  }
  return true;
}

// Rounds of 1, 1, 2, 4, … samples of all pixels, at most 16, so that news comes soon and costs little later.
void PathFrame::trace(const PathView& view) {
  const auto width = static_cast<std::size_t>(view.frame.width), height = static_cast<std::size_t>(view.frame.height);
  const Transport transport = view.scene->transport();
  PathSums sums;
  sums.sum.resize(width * height);
  sums.squares.resize(width * height);
  sums.even.resize(width * height);
  while (sums.samples < view.frame.samples) {
    const std::uint32_t from = sums.samples;
    const std::uint32_t to = std::min(view.frame.samples, from + std::clamp(from, 1u, 16u));
    const auto pixel = [&](std::uint32_t x, std::uint32_t y) {
      for (std::uint32_t i = from; i < to; ++i) {
        const DVec3 light(trace_sample(transport, view.camera, view.frame, {view.seed, x, y, i}));
        sums.sum[y * width + x] += light;
        sums.squares[y * width + x] += light * light;
        if (i % 2 == 0) sums.even[y * width + x] += light;
      }
    };
    if (!trace_pixels(view.frame, pixel)) return;
    sums.samples = to;
    PathMean mean = sums.mean(view.frame);
    const std::scoped_lock lock(mutex_);
    if (wanted_ || context_.stopped()) return;
    mean_ = std::move(mean);
    changed_.notify_all();
  }
}

}  // namespace oriel
