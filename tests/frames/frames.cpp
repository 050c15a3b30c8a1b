#include "tests/frames/frames.h"

#include <sys/wait.h>

#include <cstdlib>

#include "formats/core/color.h"

namespace oriel::test {

int run(const std::filesystem::path& folder, const std::string& command) {
  const std::string line = "cd '" + folder.string() + "' && '" + ORIEL_BIN_DIR + "'/" + command + " >>log 2>&1";
  const int status = std::system(line.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

FloatImage shrink(const FloatImage& image, std::uint32_t n) {
  FloatImage out{image.width / n, image.height / n, 3, {}};
  out.pixels.resize(std::size_t{out.width} * out.height * 3);
  for (std::uint32_t y = 0; y < out.height * n; ++y)
    for (std::uint32_t x = 0; x < out.width * n; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        out.pixels[(std::size_t{y / n} * out.width + x / n) * 3 + c] +=
            image.pixels[(std::size_t{y} * image.width + x) * image.channels + c] / static_cast<float>(n * n);
  return out;
}

double FrameError::net() const {
  return std::sqrt(std::max(0.0, rel_rmse * rel_rmse - noise * noise));
}

FrameError compare(const FloatImage& frame, const std::vector<Vec3>& reference, const std::vector<Vec3>& noise) {
  DVec3 mean(0), mean_frame(0);
  const double n = static_cast<double>(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    mean += DVec3(reference[i]) / n;
    for (std::size_t c = 0; c < 3; ++c) mean_frame[static_cast<int>(c)] += frame.pixels[i * 3 + c] / n;
  }
  FrameError e;
  for (std::size_t i = 0; i < reference.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double r = reference[i][c], x = frame.pixels[i * 3 + static_cast<std::size_t>(c)];
      e.n_rmse += (x - r) * (x - r) / (3 * n);
      const double denominator = r * r + 1e-4 * mean[c] * mean[c];
      if (denominator <= 0) continue;
      e.rel_rmse += (x - r) * (x - r) / denominator / (3 * n);
      e.noise += std::pow(noise[i][c], 2) / denominator / (3 * n);
    }
  e.rel_rmse = std::sqrt(e.rel_rmse);
  e.noise = std::sqrt(e.noise);
  e.n_rmse = std::sqrt(e.n_rmse) * 3 / (mean.x + mean.y + mean.z);
  e.bias = (mean_frame.x + mean_frame.y + mean_frame.z) / (mean.x + mean.y + mean.z) - 1;
  return e;
}

double psnr_srgb(const FloatImage& frame, const std::vector<Vec3>& reference, float exposure,
                 const std::vector<char>& mask) {
  double squares = 0, count = 0;
  const auto shown = [&](float radiance) {
    return srgb_from_linear(std::min(1.0f, std::max(0.0f, exposure * radiance)));
  };
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (!mask[i]) continue;
    for (int c = 0; c < 3; ++c) {
      const double d = shown(frame.pixels[i * 3 + static_cast<std::size_t>(c)]) - shown(reference[i][c]);
      squares += d * d;
      count += 1;
    }
  }
  return squares > 0 ? -10 * std::log10(squares / count) : 99;
}

}  // namespace oriel::test
