#include "bake/run/replay.h"

#include <algorithm>

#include "bake/radiosity/texels/texel_paths.h"
#include "bake/run/prepare.h"

namespace oriel {
namespace {

std::string text_of(const Vec3& v) {
  return fmt::format("{:.6g} {:.6g} {:.6g}", v.r, v.g, v.b);
}

// Writes a line for each vertex and for each light that a path finds.
class PathText : public PathListener {
 public:
  explicit PathText(const Scene& scene) : scene_(scene) {}

  void begin(const char* what) override {
    text += fmt::format("  {}\n", what);
    weight_ = 1;
  }
  void weigh(float weight) override { weight_ = weight; }
  void meet(const SurfacePoint& surface, const Vec3& throughput) override {
    const Surface& of = scene_.surfaces[scene_.triangle_surface[surface.triangle]];
    const DVec3 at = DVec3(surface.position) + scene_.origin;
    text += fmt::format("    at {:.6g} {:.6g} {:.6g} on {} of '{}', triangle {}, '{}': throughput {}\n", at.x, at.y,
                        at.z, surface.front ? "the front" : "the back", of.name, surface.triangle - of.first_triangle,
                        scene_.materials[of.material].name, text_of(weight_ * throughput));
  }
  void add(const char* from, const Vec3& light) override {
    if (max_component(light) > 0) text += fmt::format("      + {} from {}\n", text_of(weight_ * light), from);
  }

  std::string text;

 private:
  const Scene& scene_;
  float weight_ = 1;
};

Result<std::size_t> find_texel(const std::vector<TexelMapPage>& map, const TexelAddress& at) {
  const std::string where = fmt::format("texel:{},{},{}", at.page, at.x, at.y);
  if (at.page >= map.size())
    return fail(ErrorCode::kUsage, where, "found page {}, expected less than {}", at.page, map.size());
  const TexelMapPage& page = map[at.page];
  if (at.x >= page.width || at.y >= page.height)
    return fail(ErrorCode::kUsage, where, "lies outside its page of {} x {} texels", page.width, page.height);
  const auto found = std::lower_bound(page.texel.begin(), page.texel.end(), at.y * page.width + at.x);
  if (found == page.texel.end() || *found != at.y * page.width + at.x)
    return fail(ErrorCode::kUsage, where, "shows no surface");
  return static_cast<std::size_t>(found - page.texel.begin());
}

}  // namespace

Result<std::string> replay_texel(const BakeOptions& options, const TexelAddress& texel, const PathRange& paths,
                                 Context& context) {
  std::vector<StageTime> times;
  Stopwatch timed(times);
  ORIEL_TRY(PreparedScene prepared, prepare_scene(options, timed, context));
  ORIEL_TRY_VOID(lay_out_lightmap(options, timed, context, prepared));
  ORIEL_TRY(const std::size_t index, find_texel(prepared.texel_map, texel));
  const LightSet lights(prepared.scene());
  PathText listener(prepared.scene());
  const Transport transport{*prepared.accel, lights, path_options(options), &listener};
  const std::vector<Vec3> eyes = sample_eyes(prepared.region, kLightmapEyes, context.seed);
  const bool directional = choose_directional(prepared.scene(), options.directional, prepared.omissions);
  const TexelPaths of_texel({transport, prepared.atlas, prepared.texel_map}, eyes, directional, context.seed, context);
  TexelSums sums;
  std::uint64_t rays = 0;
  for (std::uint32_t k = paths.first; k < paths.first + paths.count; ++k) {
    TexelSums one;
    listener.text += fmt::format("path {}\n", k);
    of_texel.add({texel.page, index}, {k, k + 1}, one, rays);
    sums.sum += one.sum, sums.squares += one.squares, sums.count += one.count;
    listener.text += one.count > 0 ? fmt::format("  = {} lux\n", text_of(Vec3(one.irradiance())))
                                   : std::string("  left out: inside a body, or cut off by a wall\n");
  }
  return listener.text + fmt::format("{} paths: {} lux, standard error {}\n", sums.count,
                                     text_of(Vec3(sums.irradiance())), text_of(Vec3(glm::sqrt(sums.variance()))));
}

Result<std::string> replay_pixel(const Transport& transport, const Camera& camera, const ReferenceOptions& options,
                                 const PixelSample& first, std::uint32_t count) {
  if (static_cast<int>(first.x) >= options.width || static_cast<int>(first.y) >= options.height)
    return fail(ErrorCode::kUsage, fmt::format("pixel:{},{}", first.x, first.y),
                "lies outside the frame of {} x {} pixels", options.width, options.height);
  PathText listener(transport.accel.scene());
  Transport told = for_eyes(transport, camera, options, first.seed);
  told.listener = &listener;
  DVec3 sum(0);
  PixelSample sample = first;
  for (std::uint32_t k = 0; k < count; ++k, ++sample.number) {
    listener.text += fmt::format("path {}\n", sample.number);
    const Vec3 light = trace_sample(told, camera, options, sample);
    listener.text += fmt::format("  = {} cd/m2\n", text_of(light));
    sum += DVec3(light);
  }
  return listener.text + fmt::format("{} paths: {} cd/m2\n", count, text_of(Vec3(sum / double(std::max(count, 1u)))));
}

}  // namespace oriel
