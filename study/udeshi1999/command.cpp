// oriel-study udeshi1999: draws a scene as the paper does, with the times of its stages.
#include <algorithm>
#include <filesystem>

#include "bake/run/view_options.h"
#include "formats/core/color.h"
#include "formats/image/exr.h"
#include "formats/image/png.h"
#include "player/gpu/headless.h"
#include "study/rooms.h"
#include "study/udeshi1999/ray_check.h"

namespace oriel::study {
namespace {
namespace fs = std::filesystem;

struct HybridArguments {
  fs::path scene, output;
  std::string camera;
  int width = 640, height = 480, frames = 1;
  HybridOptions options;
};

FloatImage upright(const std::vector<Vec4>& texels, const HybridArguments& a, const Vec3& scale = Vec3(1)) {
  FloatImage out{static_cast<std::uint32_t>(a.width), static_cast<std::uint32_t>(a.height), 3, {}};
  for (std::size_t y = out.height; y-- > 0;)
    for (std::size_t x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) out.pixels.push_back(scale[c] * texels[y * out.width + x][c]);
  return out;
}

// The brightest tenth of the pixels may be white.
Status write_exposed(const fs::path& file, const FloatImage& image) {
  std::vector<float> sorted = image.pixels;
  const auto white = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 9 / 10);
  std::nth_element(sorted.begin(), white, sorted.end());
  ByteImage out{image.width, image.height, 3, {}};
  for (const float v : image.pixels)
    out.pixels.push_back(static_cast<std::uint8_t>(
        std::lround(255 * srgb_from_linear(std::clamp(0.8f * v / std::max(*white, 1e-30f), 0.0f, 1.0f)))));
  return write_png(file, out);
}

Status write_pictures(const HybridFrame& frame, const RayCheck& check, const HybridArguments& a) {
  if (a.output.extension() == ".exr") return write_exr(a.output, upright(frame.sum, a), {{"oriel.unit", "cd/m2"}});
  if (a.output.extension() == ".png") return write_exposed(a.output, upright(frame.sum, a));
  std::error_code failed;
  fs::create_directories(a.output, failed);
  if (failed) return fail(ErrorCode::kIo, a.output.string(), "cannot be made: {}", failed.message());
  std::vector<Vec4> shadow;
  for (const float share : check.reached) shadow.emplace_back(share);
  const std::pair<const char*, const std::vector<Vec4>*> pictures[] = {{"direct.png", &frame.direct},
                                                                       {"shadow.png", &shadow},
                                                                       {"indirect.png", &frame.indirect},
                                                                       {"traced.png", &frame.traced},
                                                                       {"frame.png", &frame.sum}};
  for (const auto& [name, texels] : pictures) ORIEL_TRY_VOID(write_exposed(a.output / name, upright(*texels, a)));
  return {};
}

void print_stages(const HybridFrame& frame, const HybridArguments& a) {
  const std::pair<const char*, double> stages[] = {
      {"surfaces", frame.surfaces_s},       {"silhouettes and caps", frame.silhouettes_s},
      {"shadow volumes", frame.volumes_s},  {"direct light", frame.direct_s},
      {"indirect light", frame.indirect_s}, {"specular pixels", frame.traced_s},
      {"composite", frame.composite_s}};
  double all = 0;
  for (const auto& [name, seconds] : stages) all += seconds;
  fmt::print("{}x{}, {} points on lamps, {} shadow quads, {} elements, {} traced pixels\n", a.width, a.height,
             frame.lamps.size(), frame.quads, frame.elements.size(), frame.traced_pixels);
  for (const auto& [name, seconds] : stages)
    fmt::print("{:>21} {:8.1f} ms {:5.1f} %\n", name, 1000 * seconds, 100 * seconds / all);
  fmt::print("{:>21} {:8.1f} ms\n", "all", 1000 * all);
}

void print_check(const RayCheck& check) {
  fmt::print("direct light by rays: {:.1f} ms; of {} pixels {} differ, of {} on silhouettes {}\n", 1000 * check.rays_s,
             check.lit + check.dark - check.silhouettes, check.wrong, check.silhouettes, check.wrong_on_silhouettes);
  const auto blocks =
      static_cast<double>(std::max<std::size_t>(check.blocks[0] + check.blocks[1] + check.blocks[2], 1));
  fmt::print("blocks of 8x8 pixels, by lamp: {:.1f} % lit, {:.1f} % umbra, {:.1f} % penumbra\n",
             100 * static_cast<double>(check.blocks[0]) / blocks, 100 * static_cast<double>(check.blocks[1]) / blocks,
             100 * static_cast<double>(check.blocks[2]) / blocks);
}

Status draw_hybrid(const HybridArguments& a) {
  ORIEL_TRY(const auto gl, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  ORIEL_TRY(HybridRenderer renderer, HybridRenderer::create(device));
  Context context;
  context.warn = [](const Warning& warning) { fmt::print(stderr, "oriel-study: {}\n", warning.text); };
  ORIEL_TRY(const auto scene, load_preview_scene({a.scene, {}}, context));
  ORIEL_TRY(const Camera camera, choose_camera(scene->scene(), a.camera));
  ORIEL_TRY_VOID(renderer.take(scene));
  ORIEL_TRY_VOID(renderer.look(camera, a.width, a.height));
  HybridFrame frame;
  for (int i = 0; i <= a.frames; ++i) {  // in the first one the driver compiles
    ORIEL_TRY(frame, renderer.draw(a.options, context));
    if (i > 0) print_stages(frame, a);
  }
  ORIEL_TRY(const RayCheck check, check_by_rays(renderer, *scene, frame.lamps, a.options.cap_rays, context));
  print_check(check);
  return a.output.empty() ? Status{} : write_pictures(frame, check, a);
}

}  // namespace

ToolCommand udeshi1999_command() {
  const auto a = std::make_shared<HybridArguments>();
  constexpr const char* kPicture = "Picture";
  constexpr const char* kHybrid = "Method";
  return {
      .name = "udeshi1999",
      .help = "A frame by shadow volumes, one bounce of elements and traced specular pixels (Udeshi & Hansen 1999)",
      .footer = "",
      .options = {{"SCENE", kPicture, "The scene: .glb, or .gltf", path(a->scene, "FILE"), Use::kRequired},
                  camera_option(a->camera),
                  size_option(a->width, a->height),
                  {"-o,--output", kPicture, "The frame, .png or .exr; a folder for the picture of each stage too",
                   path(a->output, "FILE|DIR"), Use::kEveryday},
                  {"--frames", kPicture, "How often it is drawn", number(a->frames, 1, 1000), Use::kEveryday},
                  {"--points", kHybrid, "On lamps, by their power", number(a->options.points, 1, 4096), Use::kEveryday},
                  {"--cap-rays", kHybrid,
                   "Which triangles hold the eye in their shadow, as so many rays from the view plane tell, which "
                   "miss some; 0: exactly",
                   number(a->options.cap_rays, 0, 65536), Use::kEveryday},
                  {"--elements", kHybrid, "Of surfaces that shine back what lamps throw on them; 0: none",
                   number(a->options.elements, 0, std::uint32_t{LampPass::kMostElements}), Use::kEveryday}},
      .settle = {},
      .run = [a] { return draw_hybrid(*a); }};
}

}  // namespace oriel::study
