#include "preview/frame/paths.h"

#include <algorithm>
#include <chrono>

#include "bake/jobs/parallel.h"
#include "formats/core/color.h"
#include "formats/metrics/relative_error.h"

namespace oriel {
namespace {

constexpr std::uint32_t kTile = 16;  // pixels a side
constexpr float kTrusted = 64;       // samples that are believed half without any reason

// Sums over the samples of each pixel.
struct PathSums {
  std::vector<DVec3> sum, squares;
  std::uint32_t samples = 0;

  PathMean mean(const ReferenceOptions& frame) const {
    const auto width = static_cast<std::uint32_t>(frame.width), height = static_cast<std::uint32_t>(frame.height);
    PathMean out{samples, {width, height, 3, {}}, {width, height, 3, {}}, 1};
    const double n = samples;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const DVec3 mean = sum[i] / n;
      const DVec3 error = glm::sqrt(glm::max(DVec3(0), squares[i] / n - mean * mean) / std::max(1.0, n - 1));
      for (int c = 0; c < 3; ++c) {
        out.mean.pixels.push_back(static_cast<float>(mean[c]));
        out.noise.pixels.push_back(static_cast<float>(error[c]));
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
  while (sums.samples < view.frame.samples) {
    const std::uint32_t from = sums.samples;
    const std::uint32_t to = std::min(view.frame.samples, from + std::clamp(from, 1u, 16u));
    const auto pixel = [&](std::uint32_t x, std::uint32_t y) {
      for (std::uint32_t i = from; i < to; ++i) {
        const DVec3 light(trace_sample(transport, view.camera, view.frame, {view.seed, x, y, i}));
        sums.sum[y * width + x] += light;
        sums.squares[y * width + x] += light * light;
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

FloatImage blend_paths(const PathMean& paths, const FloatImage& passes, bool whole) {
  const std::uint32_t width = paths.mean.width, height = paths.mean.height;
  FloatImage out{width, height, 4, std::vector<float>(std::size_t{4} * width * height)};
  const float least = static_cast<float>(paths.samples) / (static_cast<float>(paths.samples) + kTrusted);
  const auto at = [width](const FloatImage& image, std::uint32_t x, std::uint32_t y) {
    const float* p = image.pixels.data() + std::size_t{3} * (std::size_t{y} * width + x);
    return DVec3(p[0], p[1], p[2]);
  };
  for (std::uint32_t top = 0; top < height; top += kTile)
    for (std::uint32_t left = 0; left < width; left += kTile) {
      const std::uint32_t bottom = std::min(top + kTile, height), right = std::min(left + kTile, width);
      double noise = 0, distance = 0;
      for (std::uint32_t y = top; y < bottom; ++y)
        for (std::uint32_t x = left; x < right; ++x) {
          const DVec3 error = at(paths.noise, x, y), apart = at(paths.mean, x, y) - at(passes, x, y);
          noise += glm::dot(error, error);
          distance += glm::dot(apart, apart);
        }
      const double bias = std::max(0.0, distance - noise);
      const auto best = static_cast<float>(bias + noise > 0 ? bias / (bias + noise) : 1);
      const float weight = whole ? 1 : paths.samples < 2 ? 0 : std::max(least, best);
      for (std::uint32_t y = top; y < bottom; ++y)
        for (std::uint32_t x = left; x < right; ++x) {
          const DVec3 mean = at(paths.mean, x, y);
          float* p = out.pixels.data() + std::size_t{4} * (std::size_t{y} * width + x);
          for (int c = 0; c < 3; ++c) p[c] = static_cast<float>(mean[c]);
          p[3] = weight;
        }
    }
  return out;
}

}  // namespace oriel
