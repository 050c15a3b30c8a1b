// The error that people see in a pack's light, whoever baked it: held-out pixels against unbiased paths.
#include <cstdio>

#include "bake/radiosity/held_out_error.h"
#include "bake/run/pipeline.h"
#include "bake/run/prepare.h"
#include "formats/cli/command.h"
#include "formats/core/text.h"
#include "formats/pack/reader.h"

namespace oriel {
namespace {

constexpr std::uint32_t kEyes = 1024, kPixels = 64;
constexpr std::uint64_t kSeed = 0xbe9c;  // of no bake

Result<HeldOutError> measure(const BakeOptions& options, double known_to, std::uint64_t rays_at_most) {
  Context context;
  std::vector<StageTime> times;
  Stopwatch timed(times);
  ORIEL_TRY(PreparedScene prepared, prepare_scene(options, timed, context));
  ORIEL_TRY_VOID(lay_out_lightmap(options, timed, context, prepared));
  ORIEL_TRY(const Pack pack, read_pack(options.output));
  const Atlas& atlas = prepared.atlas;
  bool same = pack.lightmaps.size() == atlas.pages.size();
  for (std::size_t p = 0; same && p < atlas.pages.size(); ++p)
    same = pack.lightmaps[p].width == atlas.pages[p].width && pack.lightmaps[p].height == atlas.pages[p].height;
  if (!same)
    return invalid(options.output.string(), "found pages of another layout than the scene's with this --texel");
  const LightSet lights(prepared.scene());
  const Transport transport{*prepared.accel, lights, path_options(options)};
  context.seed = kSeed;
  ORIEL_TRY(
      const std::vector<FramePixel> pixels,
      find_frame_pixels(transport, atlas, {held_out_eyes(prepared.region, kEyes, kSeed), kPixels}, kSeed, context));
  return measure_held_out_error({transport, atlas, prepared.texel_map}, pack.lightmaps, pixels,
                                {known_to, rays_at_most}, context);
}

int bench(int argc, char** argv) {
  BakeOptions options;
  std::string texel = "auto";
  double known_to = 0.02, rays = 2e8;
  if (const auto code = parse_options(
          argc, argv,
          "Prints the frame error of a pack's lightmap (docs/notes/error-estimate.md) with its 95 % interval.",
          {{"SCENE", "Arguments", "That was baked", path(options.scene, "SCENE"), Use::kRequired},
           {"PACK", "Arguments", "Baked of that scene", path(options.output, "PACK"), Use::kRequired},
           {"--texel", "Options", "That it was baked with", text(texel, "auto|LENGTH")},
           {"--known-to", "Options", "Error whose square is to be known to a fifth", number(known_to, 1e-9, 1e9)},
           {"--rays", "Options", "At most", number(rays, 1, 1e18)}}))
    return *code;
  const auto texel_m = texel == "auto" ? Result<float>(0.0f) : parse_length(texel);
  if (!texel_m) return std::fprintf(stderr, "%s\n", texel_m.error().text().c_str()), 1;
  options.choose_texel = *texel_m == 0;
  if (!options.choose_texel) options.atlas.texel_m = *texel_m;
  const auto c = measure(options, known_to, static_cast<std::uint64_t>(rays));
  if (!c) return std::fprintf(stderr, "%s\n", c.error().text().c_str()), static_cast<int>(c.error().code);
  std::printf("frame error %.2f %% (%.2f to %.2f %%), %+.2f %% ± %.2f %% brighter, %zu pixels, %.1f Mrays\n",
              100 * c->relative_error, 100 * c->error_low, 100 * c->error_high, 100 * c->bias, 100 * c->bias_interval,
              c->pixels, static_cast<double>(c->rays) * 1e-6);
  for (const WorstPixel& w : c->worst)
    std::printf("  %4.1f %% of its square: %.3g for %.3g cd/m2 (%+.0f %%) at %.3f %.3f %.3f\n", 100 * w.share, w.baked,
                w.paths, 100 * (w.baked / w.paths - 1), static_cast<double>(w.position.x),
                static_cast<double>(w.position.y), static_cast<double>(w.position.z));
  return 0;
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  return oriel::bench(argc, argv);
}
