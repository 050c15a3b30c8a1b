// Interaction of oriel-preview in three scenes, with many points on lamps, on one core and on two: frames a second at
// 640x480 while the eye moves, and the share of each stage. preview_bench [FRAMES [SCENE]]
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "formats/core/file.h"
#include "player/gpu/headless.h"
#include "player/passes/display_pass.h"
#include "preview/frame/preview_renderer.h"
#include "scenes/generators.h"
#include "scenes/kit/glb_writer.h"

namespace oriel {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kWidth = 640, kHeight = 480;

struct Class {
  const char* name;
  sample::SampleScene (*make)();
  std::uint32_t samples;
};
constexpr Class kClasses[] = {{"office", sample::make_office, 18},
                              {"classroom", sample::make_classroom, 36},
                              {"glass-sphere", sample::make_glass_sphere, 25}};

struct Way {
  const char* name;
  bool shared;
};
constexpr Way kWays[] = {{"shared rays", true}, {"rays", false}};

template <typename T>
T must(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "preview_bench: %s\n", result.error().text().c_str());
  std::exit(4);
}

void add(PreviewStats& sum, const PreviewStats& s) {
  sum.surfaces_s += s.surfaces_s, sum.direct_s += s.direct_s;
  sum.bounce_s += s.bounce_s, sum.traced_s += s.traced_s, sum.total_s += s.total_s;
  sum.traced_pixels += s.traced_pixels;
}

// The eye turns by half a degree a frame, as a walker's does.
void walk(PreviewRenderer& renderer, DisplayPass& display, const Camera& camera, const Class& c, const Way& way,
          int frames) {
  Context context;
  const PreviewOptions options{.samples = c.samples, .shared = way.shared};
  const gpu::Texture2d shown(gpu::kRgba8, kWidth, kHeight, nullptr);
  const gpu::Framebuffer target = must(gpu::Framebuffer::create("shown", &shown, nullptr));
  PreviewStats sum;
  double seconds = 0, cpu_s = 0;
  for (int i = -1; i < frames; ++i) {
    const Clock::time_point start = Clock::now();
    const std::clock_t cpu = std::clock();
    Camera turned = camera;
    const float yaw = 0.009f * static_cast<float>(i);
    const Vec3 f = camera.forward;
    turned.forward = Vec3(std::cos(yaw) * f.x + std::sin(yaw) * f.z, f.y, std::cos(yaw) * f.z - std::sin(yaw) * f.x);
    if (const Status status = renderer.look(turned, kWidth, kHeight); !status) std::exit(4);
    const PreviewStats stats = must(renderer.pass(options, context));
    const FrameTarget* frame = must(renderer.frame(nullptr));
    const float ev = must(display.meter(*frame)).value_or(0);
    target.bind();
    display.draw(*frame, ev, ToneCurve::kAces);
    glFinish();
    if (i < 0) continue;  // the driver compiles
    seconds += std::chrono::duration<double>(Clock::now() - start).count();
    cpu_s += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    add(sum, stats);
  }
  const auto share = [&](double s) { return 100 * s / seconds; };
  std::printf(
      "  %-12s %5.2f frames/s, %4.0f ms of CPU each  direct %2.0f %%  bounce %2.0f  traced %2.0f  surfaces "
      "%2.0f  rest %2.0f  "
      "(%zu traced pixels a frame)\n",
      way.name, frames / seconds, 1000 * cpu_s / frames, share(sum.direct_s), share(sum.bounce_s), share(sum.traced_s),
      share(sum.surfaces_s), share(seconds - sum.direct_s - sum.bounce_s - sum.traced_s - sum.surfaces_s),
      sum.traced_pixels / static_cast<std::size_t>(frames));
  std::fflush(stdout);
}

void measure(const Class& c, int frames) {
  const auto file = std::filesystem::temp_directory_path() / (std::string("preview-bench-") + c.name + ".glb");
  if (!write_file_atomically(file, must(sample::write_glb(c.make())))) std::exit(2);
  const auto gl = must(gpu::HeadlessContext::create());
  const gpu::Device device = must(gpu::open_device());
  PreviewRenderer renderer = must(PreviewRenderer::create(device));
  DisplayPass display = must(DisplayPass::create(device.dialect));
  Context context;
  const auto scene = must(load_preview_scene({.file = file, .import = {}}, context));
  std::filesystem::remove(file);
  if (const Status taken = renderer.take(scene); !taken) std::exit(4);
  for (const Way& way : kWays)
    walk(renderer, display, scene->scene().cameras.front(), c, way, way.shared ? frames : (frames + 2) / 3);
}

// In a process of its own: how many cores the driver takes is settled once.
void measure_on(int cores, const Class& c, int frames) {
  std::printf("%s, %u points on lamps, %d core%s\n", c.name, c.samples, cores, cores == 1 ? "" : "s");
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child == 0) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (int i = 0; i < cores; ++i) CPU_SET(i, &set);
    ::sched_setaffinity(0, sizeof set, &set);
    ::setenv("LP_NUM_THREADS", std::to_string(cores).c_str(), 1);
    measure(c, frames);
    std::fflush(stdout);
    ::_exit(0);  // the driver's threads are not waited for
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (status != 0) std::exit(4);
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  const int frames = std::max(1, argc > 1 ? std::atoi(argv[1]) : 12);
  for (const oriel::Class& c : oriel::kClasses) {
    if (argc > 2 && std::string(argv[2]) != c.name) continue;
    for (const int cores : {1, 2}) oriel::measure_on(cores, c, frames);
  }
}
