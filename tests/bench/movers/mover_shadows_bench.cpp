// Shadows of moving movers by shadow maps and by soft-shadow textures: what they cost a frame, and how far they are
// from rays (docs/notes/movers.md).
#include <sys/resource.h>

#include <chrono>
#include <cstdio>

#include "formats/cli/command.h"
#include "formats/core/parallel.h"
#include "formats/pack/reader.h"
#include "formats/query/camera.h"
#include "formats/query/mesh_rays.h"
#include "formats/query/mover_pose.h"
#include "player/gpu/headless.h"
#include "player/passes/frame.h"

namespace oriel {
namespace {

constexpr float kCircle = 0.1f;  // metres, that each mover goes about where it rests
constexpr int kRays = 24;        // to a lamp's triangle, along a side
constexpr int kEvery = 5;        // pixels, along each side, between those that rays are sent from

struct Way {
  const char* name;
  MoverLights lights;
  MoverShadows shadows = MoverShadows::kMaps;
};
constexpr Way kWays[] = {{"none", MoverLights::kUnshadowed},
                         {"shadow maps", MoverLights::kShadowed},
                         {"textures", MoverLights::kShadowed, MoverShadows::kTextures}};

struct Shown {
  std::unique_ptr<GpuScene> scene;
  std::unique_ptr<Renderer> renderer;
  Camera camera;
  IVec2 size{0};
};

std::vector<MoverPose> poses_at_frame(const Pack& pack, int frame) {
  std::vector<MoverPose> poses;
  for (std::size_t i = 0; i < pack.movers.size(); ++i) {
    const float angle = 0.3f * static_cast<float>(frame) + static_cast<float>(i);
    const float half = 0.1f * static_cast<float>(frame);
    MoverPose pose = pack.movers[i].rest;
    pose.position += kCircle * Vec3(std::cos(angle), 0, std::sin(angle));
    pose.rotation = {0, std::sin(half), 0, std::cos(half)};
    poses.push_back(pose);
  }
  return poses;
}

Result<FrameStats> draw(const Shown& shown, const Way& way, int frame) {
  FrameOptions options;
  options.show = Show::kD;
  options.timed = true;
  options.mover_lights = way.lights;
  options.mover_shadows = way.shadows;
  options.poses = poses_at_frame(shown.scene->pack(), frame);
  const View view =
      make_view(shown.camera, shown.size.x, shown.size.y, bounds_with_movers(*shown.scene, options.poses));
  return shown.renderer->render(*shown.scene, view, options);
}

// Of all threads: what else runs on the machine is not in it.
double processor_ms() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

Status print_times(const Shown& shown, int frames) {
  std::printf("| shadows | movers' pass, ms | textures of it, ms | processor, ms a frame |\n|---|---|---|---|\n");
  for (const Way& way : kWays) {
    std::vector<double> pass, textures, used;
    for (int frame = 0; frame < frames; ++frame) {
      const double before = processor_ms();
      ORIEL_TRY(const FrameStats stats, draw(shown, way, frame));
      glFinish();
      used.push_back(processor_ms() - before);
      pass.push_back(stats.ms[static_cast<std::size_t>(Pass::kMovers)]);
      textures.push_back(stats.shadow_texture_ms);
    }
    std::printf("| %s | %.1f | %.1f | %.1f |\n", way.name, median(pass), median(textures), median(used));
  }
  return {};
}

// By rays, lux: what polygon lamps give a point of the scene without movers, and what these take of it.
struct Lit {
  double open = 0, taken = 0;
};

class Rays {
 public:
  explicit Rays(const GpuScene& scene, int frame)
      : scene_(scene), still_(scene.pack().mesh), poses_(poses_at_frame(scene.pack(), frame)) {
    for (const Mover& mover : scene.pack().movers) movers_.emplace_back(mover.mesh);
    for (const MoverPose& pose : poses_) object_from_pack_.push_back(glm::inverse(Mat4(pack_from_object(pose))));
  }

  Lit at(const Vec3& p, const Vec3& normal) const {
    Lit lit;
    for (const BrightLight& light : scene_.bright_lights()) {
      if (light.kind != BrightLightKind::kPolygon) continue;
      for (std::size_t t = 0; t + 2 < light.corners.size(); t += 3)
        add_triangle(light, &light.corners[t], p, normal, lit);
    }
    return lit;
  }

 private:
  void add_triangle(const BrightLight& light, const Vec3* c, const Vec3& p, const Vec3& normal, Lit& lit) const {
    const float area = 0.5f * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
    for (int i = 0; i < kRays * kRays; ++i) {
      const float u = std::sqrt((static_cast<float>(i % kRays) + 0.5f) / kRays);
      const float v = (static_cast<float>(i / kRays) + 0.5f) / kRays;
      const Vec3 q = (1 - u) * c[0] + u * (1 - v) * c[1] + u * v * c[2], to = q - p;
      const float r2 = glm::dot(to, to);
      const float cosines = glm::dot(to, normal) * -glm::dot(to, light.direction);
      if (!(glm::dot(to, normal) > 0 && cosines > 0)) continue;
      const double lux = double{light.intensity.g} * cosines / (r2 * r2) * area / (kRays * kRays);
      const Vec3 from = p + 1e-3f * to, end = p + 0.999f * to;
      std::uint32_t last = 0;
      if (still_.blocks(from, end, last)) continue;
      lit.open += lux;
      if (blocked_by_movers(p + 1e-5f * to, end)) lit.taken += lux;
    }
  }

  bool blocked_by_movers(const Vec3& from, const Vec3& to) const {
    for (std::size_t m = 0; m < movers_.size(); ++m) {
      std::uint32_t last = 0;
      const auto in_object = [&](const Vec3& p) { return Vec3(object_from_pack_[m] * Vec4(p, 1)); };
      if (movers_[m].blocks(in_object(from), in_object(to), last)) return true;
    }
    return false;
  }

  const GpuScene& scene_;
  MeshRays still_;
  std::vector<MeshRays> movers_;
  std::vector<MoverPose> poses_;
  std::vector<Mat4> object_from_pack_;
};

struct Place {
  std::size_t pixel = 0;
  Vec3 at{0};
  Lit lit{};
};

// Pixels that show the floor.
std::vector<Place> floor_places(const Shown& shown, float floor_y) {
  const std::vector<std::int32_t> what = shown.renderer->read_reflective();
  const MeshRays rays(shown.scene->pack().mesh);
  std::vector<Place> places;
  for (int y = kEvery / 2; y < shown.size.y; y += kEvery)
    for (int x = kEvery / 2; x < shown.size.x; x += kEvery) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(shown.size.x) + static_cast<std::size_t>(x);
      const PixelRay ray = pixel_ray(shown.camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                                     static_cast<float>(shown.size.x), static_cast<float>(shown.size.y));
      if (what[pixel] == Renderer::kMoverPixel || !(ray.direction.y < 0)) continue;
      const Vec3 at = ray.origin + ray.direction * ((floor_y - ray.origin.y) / ray.direction.y);
      std::uint32_t last = 0;
      if (!rays.blocks(ray.origin, glm::mix(at, ray.origin, 1e-3f), last)) places.push_back({pixel, at});
    }
  return places;
}

Status print_errors(const Shown& shown, float floor_y) {
  std::array<std::vector<float>, 3> light;
  for (std::size_t w = 0; w < 3; ++w) {
    ORIEL_TRY_VOID(draw(shown, kWays[w], 1));
    light[w] = shown.renderer->read_light();
  }
  std::vector<Place> places = floor_places(shown, floor_y);
  const Rays rays(*shown.scene, 1);
  for_each_parallel(places.size(), core_count(),
                    [&](std::size_t i) { places[i].lit = rays.at(places[i].at, Vec3(0, 1, 0)); });
  std::printf(
      "\n| shadows | places in shadow | RMS error, of the light without movers | 95 %% within |\n|---|---|---|---|\n");
  for (std::size_t w = 1; w < 3; ++w) {
    std::vector<double> errors;
    double squares = 0;
    for (const Place& place : places) {
      const double found = double{light[0][3 * place.pixel + 1] - light[w][3 * place.pixel + 1]} * kPiD;
      if (!(place.lit.open > 0) || std::max(place.lit.taken, found) < 1e-3 * place.lit.open) continue;
      errors.push_back(std::abs(found - place.lit.taken) / place.lit.open);
      squares += errors.back() * errors.back();
    }
    std::ranges::sort(errors);
    const double n = static_cast<double>(std::max<std::size_t>(errors.size(), 1));
    std::printf("| %s | %zu | %.2f %% | %.2f %% |\n", kWays[w].name, errors.size(), 100 * std::sqrt(squares / n),
                errors.empty() ? 0 : 100 * errors[errors.size() * 95 / 100]);
  }
  return {};
}

Status run(const std::string& file, const std::string& camera, const IVec2& size, int frames) {
  ORIEL_TRY(Pack pack, read_pack(file));
  if (pack.movers.empty()) return fail(ErrorCode::kUsage, file, "found no movers, expected some");
  // All white and dull: what is shown is the light.
  pack.reflectors.clear(), pack.curved_reflectors.clear();
  for (Material& m : pack.materials) {
    m.base_color = Vec3(1);
    m.base_color_texture = m.kernel = m.fresnel_map = m.normal_texture = -1;
    m.metallic = m.transmission = 0;
  }
  const auto found = std::ranges::find(pack.cameras, camera, &Camera::name);
  if (found == pack.cameras.end()) return fail(ErrorCode::kUsage, file, "found no camera '{}'", camera);
  ORIEL_TRY(const auto context, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  Shown shown;
  shown.camera = *found, shown.size = size;
  ORIEL_TRY(shown.scene, GpuScene::create(std::move(pack), device));
  ORIEL_TRY(shown.renderer, Renderer::create(device));
  ORIEL_TRY_VOID(print_times(shown, frames));
  float floor_y = 1e30f;
  for (const FlatPlane& plane : find_flat_surfaces(shown.scene->pack()).planes)
    if (plane.normal.y > 0.999) floor_y = std::min(floor_y, static_cast<float>(plane.origin.y));
  return print_errors(shown, floor_y);
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  using namespace oriel;
  std::string pack, camera = "entrance";
  int width = 720, height = 486, frames = 20;
  if (const auto code = parse_options(
          argc, argv,
          "Prints what movers' shadows cost a frame in which all movers of a pack move, and their error on the floor.",
          {{"PACK", "Arguments", "With movers", text(pack, "PACK"), Use::kRequired},
           {"--camera", "Options", "By name", text(camera, "NAME")},
           {"--width", "Options", "Pixels", number(width, 1, 16384)},
           {"--height", "Options", "Pixels", number(height, 1, 16384)},
           {"--frames", "Options", "Of each measurement", number(frames, 1, 1e6)}}))
    return *code;
  const Status done = run(pack, camera, {width, height}, frames);
  if (!done) return std::fprintf(stderr, "%s\n", done.error().text().c_str()), static_cast<int>(done.error().code);
  return 0;
}
