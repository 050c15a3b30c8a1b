// Soft-shadow textures a second on one core, beside shadow rays through Embree at the same texels and samples, in one
// run. Scenes are small triangles that float over a receiver, as many as asked.
#include <chrono>
#include <cstdio>
#include <random>

#include "bake/trace/accel.h"
#include "formats/shadow/silhouettes.h"
#include "formats/shadow/soft_shadow.h"
#include "tests/bake/support/scene_parts.h"
#include "tests/formats/shadow/test_lights.h"

namespace oriel {
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
    light = sample_parallelogram({corner, x, y}, Vec3(1), s.samples);
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
  SoftShadow out;
  Times t;
  t.all = best_ms([&] { shadows.run(occluders, f.receiver, f.light, out); });
  t.view = best_ms([&] { (void)shadows.view(occluders, f.receiver, f.light); }, 0.2);
  const OccluderView view = shadows.view(occluders, f.receiver, f.light);
  t.block = best_ms([&] { (void)shadows.block(view, f.receiver); }, 0.5);
  return t;
}

// As many shadow rays in packets of 16 neighbours, and no weights. differ: texels and samples that rays see otherwise.
double rays_ms(const Floating& f, std::size_t& differ) {
  test::SceneParts parts;
  std::vector<Vec3> positions;
  std::vector<UVec3> triangles;
  for (const DVec3& p : f.points) positions.emplace_back(p);
  for (const auto& t : f.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  parts.mesh("floating", parts.diffuse(Vec3(0.5f)), positions, std::vector<Vec3>(positions.size(), Vec3(0, 0, 1)),
             triangles);
  const Scene scene = parts.finish();
  const Accel accel = Accel::build(scene).value();
  const auto texels = static_cast<std::size_t>(f.receiver.width * f.receiver.height);
  std::vector<Ray> rays(texels);
  std::vector<Vec3> passed(texels);
  SoftShadows shadows;
  const BlockedRows& rows = shadows.block(shadows.view(f.occluders(), f.receiver, f.light), f.receiver);
  double ms = 0;
  differ = 0;
  for (std::size_t s = 0; s < f.light.samples.size(); ++s) {
    for (std::size_t i = 0; i < texels; ++i) {
      const auto x = static_cast<int>(i) % f.receiver.width, y = static_cast<int>(i) / f.receiver.width;
      const DVec3 from = f.receiver.center_of(x, y), to = f.light.samples[s].position - from;
      rays[i] = {Vec3(from), Vec3(glm::normalize(to)), static_cast<float>(glm::length(to))};
    }
    const auto start = std::chrono::steady_clock::now();
    accel.transmittance(rays, passed);
    ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    for (std::size_t i = 0; i < texels; ++i)
      differ += rows.blocked(static_cast<int>(s), static_cast<int>(i) % f.receiver.width,
                             static_cast<int>(i) / f.receiver.width) != (passed[i].x == 0);
  }
  return ms;
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

void print_scaling() {
  std::printf("\nBit rows beside shadow rays (Embree, packets of 16, no weights)\n");
  std::printf("%9s %8s %7s %9s %9s %9s %7s %13s\n", "triangles", "samples", "texels", "ms", "rays ms", "textures/s",
              "times", "rays differ");
  for (const auto& s : {Setting{}, Setting{.occluders = 30}, Setting{.occluders = 3000}, Setting{.samples = 16},
                        Setting{.samples = 256}, Setting{.texels = 128}, Setting{.texels = 512}}) {
    const Floating f(s);
    std::size_t differ = 0;
    const double ms = times_of(f, CountMethod::kBitRows).all, rays = rays_ms(f, differ);
    std::printf("%9d %8d %7d %9.3f %9.1f %9.0f %7.0f %13zu\n", s.occluders, s.samples, s.texels, ms, rays, 1e3 / ms,
                rays / ms, differ);
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
    SoftShadow exact;
    shadows.run(f.occluders(), f.receiver, f.light, exact);
    const std::vector<std::uint16_t> blocked =
        count_blocked(shadows.block(shadows.view(f.occluders(), f.receiver, f.light), f.receiver));
    const std::vector<float> open = form_factor_light(f.receiver, f.corners, 8);
    double square = 0, most = 0, light = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const double difference = open[i] * (1 - blocked[i] / static_cast<double>(s.samples)) - exact.light[0][i];
      square += difference * difference, light += open[i];
      most = std::max(most, std::abs(difference) / open[i]);
    }
    std::printf("lamp %.1f m wide, %.1f m high   %9.2f%% %9.1f%%\n", s.light, s.height,
                100 * std::sqrt(square / static_cast<double>(open.size())) / (light / static_cast<double>(open.size())),
                100 * most);
  }
}

// A closed body with dents, 0.4 m in radius, 1 m over the receiver.
Floating body_over(const Setting& s, int around) {
  Floating f(s);
  f.points.clear(), f.triangles.clear();
  const int down = around / 2;
  const auto at = [&](int i, int j) {
    const double theta = 2 * kPiD * (i % around) / around, phi = kPiD * j / down;
    const double r = 0.4 * (1 + 0.25 * std::sin(5 * theta) * std::sin(phi) * std::sin(phi));
    return DVec3(2, 2, 1) + r * DVec3(std::cos(theta) * std::sin(phi), std::sin(theta) * std::sin(phi), std::cos(phi));
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < down; ++j) {
      const auto n = static_cast<std::uint32_t>(f.points.size());
      f.points.insert(f.points.end(), {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
      if (j + 1 < down) f.triangles.push_back({n, n + 1, n + 2});
      if (j > 0) f.triangles.push_back({n, n + 2, n + 3});
    }
  return f;
}

// What blocks, by faces and by silhouettes.
void print_silhouettes() {
  std::printf("\nOne body, 256 x 256 texels, 64 samples: bits alone, one core\n%9s %14s %14s %16s\n", "triangles",
              "bit rows, ms", "silhouettes, ms", "samples differ");
  for (const int around : {18, 55, 174}) {
    const Floating f = body_over({}, around);
    const Occluders occluders = f.occluders();
    const ShadowBody body(occluders);
    SoftShadows shadows;
    const double ms = best_ms([&] { (void)shadows.block(shadows.view(occluders, f.receiver, f.light), f.receiver); });
    const OccluderView lamp = shadows.view({}, f.receiver, f.light);
    std::vector<DVec3> samples;
    for (const ShadowLightSample& sample : f.light.samples) samples.push_back(sample.position);
    const BodyPlace place{ReceiverSpace(f.receiver), samples, lamp.apexes, 0};
    SilhouetteShadows silhouettes;
    BlockedRows rows;
    const double quick = best_ms([&] {
      rows.reset(f.receiver.width, f.receiver.height, 64);
      silhouettes.add(body, place, {0, 0, f.receiver.width / 32, f.receiver.height}, best_simd(), rows);
    });
    const std::vector<std::uint16_t> by_edge = count_blocked(rows);
    const std::vector<std::uint16_t> by_face =
        count_blocked(shadows.block(shadows.view(occluders, f.receiver, f.light), f.receiver));
    int differ = 0;
    for (std::size_t i = 0; i < by_edge.size(); ++i) differ += std::abs(by_edge[i] - by_face[i]);
    std::printf("%9zu %14.3f %14.3f %16d\n", f.triangles.size(), ms, quick, differ);
  }
}

}  // namespace
}  // namespace oriel

int main() {
  oriel::print_methods();
  oriel::print_silhouettes();
  oriel::print_scaling();
  oriel::print_culling();
  oriel::print_weights();
}
