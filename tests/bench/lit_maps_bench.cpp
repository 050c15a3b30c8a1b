// How long maps of reflectors take to follow lamps that are switched:
//   lit_maps_bench PACK.oriel GROUP [CAMERA …]
// For each camera (all, where none is named): milliseconds of the switch itself on the thread that draws; until maps in
// view have followed, the first time and again; the longest of the steps in between on the thread that draws.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "formats/pack/deferred.h"
#include "player/gpu/headless.h"
#include "player/passes/frame.h"

namespace {
using namespace oriel;
using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Followed {
  double switch_ms = 0, all_ms = 0, longest_ms = 0;
};

class Bench {
 public:
  Bench(GpuScene& scene, Renderer& renderer, const Camera& camera)
      : scene_(scene), renderer_(renderer), view_(make_view(camera, 320, 240, scene.bounds())) {
    options_.live.in_background = true;
  }

  // Frames until nothing is on its way.
  Status settle() {
    do {
      ORIEL_TRY_VOID(scene_.load_images(view_));
      if (const auto errors = scene_.advance(std::chrono::milliseconds(20)); !errors.empty())
        return tl::unexpected<Error>(errors.front());
      ORIEL_TRY_VOID(renderer_.render(scene_, view_, options_));
    } while (on_its_way());
    return {};
  }

  Result<Followed> follow(const std::vector<Vec3>& lights) {
    options_.lights = lights;
    Followed out;
    const auto start = Clock::now();
    ORIEL_TRY_VOID(scene_.set_lamps(options_.lights, {}, options_.live));
    out.switch_ms = ms_since(start);
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const auto step = Clock::now();
      if (const auto errors = scene_.advance(std::chrono::milliseconds(2)); !errors.empty())
        return tl::unexpected<Error>(errors.front());
      out.longest_ms = std::max(out.longest_ms, ms_since(step));
    } while (on_its_way());
    out.all_ms = ms_since(start);
    return out;
  }

 private:
  bool on_its_way() const {
    const LoadingState state = scene_.images().state();
    return state.busy || state.following;
  }

  GpuScene& scene_;
  Renderer& renderer_;
  View view_;
  FrameOptions options_;
};

Status measure(const char* file, const std::string& group, const std::vector<std::string>& cameras) {
  ORIEL_TRY(const auto context, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  ORIEL_TRY(auto renderer, Renderer::create(device));
  ORIEL_TRY(const DeferredPack first, open_pack(file));
  const auto& groups = first.pack.light_groups;
  const auto at = std::ranges::find(groups, group, &LightGroup::name);
  if (at == groups.end()) return fail(ErrorCode::kUsage, file, "found no light group \"{}\"", group);
  std::vector<Vec3> off(groups.size(), Vec3(1));
  off[static_cast<std::size_t>(at - groups.begin())] = Vec3(0);
  fmt::print("| camera | maps, MB | switch | maps, first time | again | longest step |\n|---|---|---|---|---|---|\n");
  for (const Camera& camera : first.pack.cameras) {
    if (!cameras.empty() && std::ranges::find(cameras, camera.name) == cameras.end()) continue;
    ORIEL_TRY(DeferredPack pack, open_pack(file));
    ORIEL_TRY(const auto scene, GpuScene::create(std::move(pack), device, {true, kNoLimit}));
    Bench bench(*scene, *renderer, camera);
    ORIEL_TRY_VOID(bench.settle());
    ORIEL_TRY(const Followed once, bench.follow(off));
    ORIEL_TRY_VOID(bench.follow({}));
    ORIEL_TRY(const Followed again, bench.follow(off));
    fmt::print("| {} | {:.1f} | {:.1f} ms | {:.0f} ms | {:.0f} ms | {:.1f} ms |\n", camera.name,
               static_cast<double>(scene->map_bytes()) * 1e-6, again.switch_ms, once.all_ms, again.all_ms,
               std::max(once.longest_ms, again.longest_ms));
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "lit_maps_bench PACK.oriel GROUP [CAMERA ...]\n");
    return 1;
  }
  const Status status = measure(argv[1], argv[2], {argv + 3, argv + argc});
  if (status) return 0;
  fmt::print(stderr, "{}\n", status.error().text());
  return static_cast<int>(status.error().code);
}
