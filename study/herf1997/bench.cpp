// Soft-shadow textures a second on one core, and what light samples are worth. Scenes are small triangles that float
// over a receiver, as many as asked.
#include <chrono>
#include <cstdio>
#include <random>

#include "study/herf1997/equal_weights.h"
#include "study/herf1997/herf1997.h"
#include "study/herf1997/soft_shadow.h"

namespace oriel::study {
namespace {

struct Setting {
  int occluders = 300, samples = 64, texels = 256;
  double light = 0.5, height = 3;  // side and place of the lamp, metres
};

// 4 x 4 m under a lamp 3 m above. Triangles keep their size: some 20 texels of 256 high as they are seen.
struct Floating {
  std::vector<DVec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  ShadowReceiver receiver;
  ShadowLight light;
  std::array<DVec3, 4> corners;  // of the light, counter-clockwise from below

  // hall: metres along its side over which they float.
  explicit Floating(const Setting& s, double hall = 4)
      : receiver(make_shadow_receiver(DVec3(0), DVec3(4, 0, 0), DVec3(0, 4, 0), IVec2(s.texels), DVec3(0, 0, 1))) {
    const DVec3 corner(2 - s.light / 2, 2 - s.light / 2, s.height), x(0, s.light, 0), y(s.light, 0, 0);
    light = sample_parallelogram({corner, x, y}, 1, s.samples);
    corners = {corner, corner + x, corner + x + y, corner + y};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(0, 1);
    for (int k = 0; k < s.occluders; ++k) {
      const double px = hall * u(random), py = hall * u(random);
      const DVec3 middle(px, py, (0.05 + 0.6 * u(random)) * s.height);
      for (int c = 0; c < 3; ++c) {
        const double a = u(random), b = u(random);
        points.push_back(middle + 0.4 * (DVec3(a, b, u(random)) - DVec3(0.5)));
      }
      const auto n = static_cast<std::uint32_t>(points.size());
      triangles.push_back({n - 3, n - 2, n - 1});
    }
  }
  Occluders occluders() const { return {points, triangles}; }
};

template <class Work>
double best_ms(const Work& work, double budget_s = 1) {
  double best = 1e300, spent = 0;
  while (spent < budget_s) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const double now = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::min(best, now), spent += now;
  }
  return best * 1e3;
}

struct Times {
  double all = 0, view = 0, block = 0;  // ms
};

Times times_of(const Floating& f, CountMethod method, Simd simd = best_simd()) {
  const Occluders occluders = f.occluders();
  SoftShadows shadows({.method = method, .touching = 0, .simd = simd});
  std::vector<float> out;
  Times t;
  t.all = best_ms([&] { shadows.run(occluders, f.receiver, f.light, out); });
  t.view = best_ms([&] { (void)shadows.view(occluders, f.receiver, f.light); }, 0.2);
  const OccluderView view = shadows.view(occluders, f.receiver, f.light);
  t.block = best_ms([&] { (void)shadows.block(view, f.receiver); }, 0.5);
  return t;
}

void print_methods() {
  std::printf("\n256 x 256 texels, 64 samples, 300 triangles, one core, exact weights\n");
  std::printf("%-28s %10s %12s %10s %10s\n", "", "ms", "textures/s", "cull ms", "count ms");
  const Floating f({});
  const auto line = [&](const char* name, CountMethod method, Simd simd) {
    const Times t = times_of(f, method, simd);
    std::printf("%-28s %10.3f %12.0f %10.3f %10.3f\n", name, t.all, 1e3 / t.all, t.view, t.block);
  };
  line("images", CountMethod::kImages, best_simd());
  line("span buffers", CountMethod::kSpanBuffers, best_simd());
  line("edge flags", CountMethod::kEdgeFlags, best_simd());
  line("bit rows", CountMethod::kBitRows, best_simd());
  if (best_simd() == Simd::kAvx512) line("bit rows, AVX2", CountMethod::kBitRows, Simd::kAvx2);
  line("bit rows, SSE2", CountMethod::kBitRows, Simd::kBaseline);
}

// Of exact weights, beside the most samples that there are.
void print_samples() {
  std::printf("\nError by light samples, of the light without shadows, beside %d\n", kMaxLightSamples);
  std::printf("%9s %10s %12s %10s %10s\n", "samples", "ms", "textures/s", "RMS", "most");
  const auto light_of = [](int samples, bool blocked) {
    const Floating f({.samples = samples});
    std::vector<float> out;
    SoftShadows().run(blocked ? f.occluders() : Occluders(), f.receiver, f.light, out);
    return out;
  };
  const std::vector<float> exact = light_of(kMaxLightSamples, true), open = light_of(kMaxLightSamples, false);
  for (const int samples : {1, 4, 16, 64, 256}) {
    const std::vector<float> found = light_of(samples, true);
    double square = 0, most = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double error = std::abs(found[i] - exact[i]) / open[i];
      square += error * error, most = std::max(most, error);
    }
    const double ms = times_of(Floating({.samples = samples}), CountMethod::kBitRows).all;
    std::printf("%9d %10.3f %12.0f %9.2f%% %9.1f%%\n", samples, ms, 1e3 / ms,
                100 * std::sqrt(square / static_cast<double>(found.size())), 100 * most);
  }
}

// Herf 1997, section 5.2: a receiver among n polygons that fill a hall of their own density.
void print_culling() {
  std::printf("\nCulling: a hall with one triangle a square metre\n%9s %12s %12s %10s\n", "triangles", "looked at",
              "left", "ms");
  for (const int n : {100, 1000, 10000, 100000}) {
    const Floating f({.occluders = n}, std::sqrt(n));
    const Occluders occluders = f.occluders();
    const SoftShadows shadows;
    const OccluderView view = shadows.view(occluders, f.receiver, f.light);
    const double ms = best_ms([&] { (void)shadows.view(occluders, f.receiver, f.light); }, 0.2);
    std::printf("%9d %12zu %12zu %10.4f\n", n, view.tested, view.faces.size(), ms);
  }
}

// The paper's equal weights beside exact ones, 300 triangles, 64 samples.
void print_weights() {
  std::printf("\nThe paper's equal weights, of the light without shadows\n%-28s %10s %10s\n", "", "RMS", "most");
  for (const auto& s :
       {Setting{.light = 0.2, .height = 1}, Setting{}, Setting{.light = 2}, Setting{.light = 1, .height = 0.6}}) {
    const Floating f(s);
    SoftShadows shadows;
    std::vector<float> exact;
    shadows.run(f.occluders(), f.receiver, f.light, exact);
    const std::vector<std::uint16_t> blocked =
        count_blocked(shadows.block(shadows.view(f.occluders(), f.receiver, f.light), f.receiver));
    const std::vector<float> open = form_factor_light(f.receiver, f.corners, 8);
    double square = 0, most = 0, light = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const double difference = open[i] * (1 - blocked[i] / static_cast<double>(s.samples)) - exact[i];
      square += difference * difference, light += open[i];
      most = std::max(most, std::abs(difference) / open[i]);
    }
    std::printf("lamp %.1f m wide, %.1f m high   %9.2f%% %9.1f%%\n", s.light, s.height,
                100 * std::sqrt(square / static_cast<double>(open.size())) / (light / static_cast<double>(open.size())),
                100 * most);
  }
}

}  // namespace

void print_herf1997_bench() {
  print_methods();
  print_samples();
  print_culling();
  print_weights();
}

}  // namespace oriel::study
