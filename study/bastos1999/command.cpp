// oriel-study bastos1999: bakes a scene as the paper does, and draws its cameras.
#include <memory>
#include <string_view>

#include "bake/run/option_table.h"
#include "formats/core/file.h"
#include "formats/query/camera_spec.h"
#include "player/navigation/view.h"
#include "player/output/played_frame.h"
#include "player/session/option_names.h"
#include "study/bastos1999/reflections.h"
#include "study/rooms.h"

namespace oriel::study {
namespace {

struct ImageMethodArguments {
  BakeOptions bake = command_line_defaults();
  MethodOptions method;
  FrameOptions frame;
  int cells = 16;
  std::vector<std::string> references;  // by camera
  std::string json;
};

// Of the baker's options those that a lightmap alone has.
std::vector<Option> lightmap_options(BakeOptions& bake) {
  std::vector<Option> out;
  for (Option& option : bake_options(bake))
    if (const std::string_view name = option.name; name == "--error" || name == "--samples" || name == "--texel")
      out.push_back(std::move(option));
  return out;
}

std::vector<Option> image_method_options(ImageMethodArguments& a) {
  constexpr const char *kBaked = "What is baked", *kFrame = "What is drawn";
  std::vector<Option> options = lightmap_options(a.bake);
  const std::vector<Option> own{
      {"--views", kBaked, "Viewpoints on the hemisphere behind each element of a reflector",
       number(a.method.views, 1, 4096), Use::kEveryday},
      {"--map-size", kBaked, "Longer side of a radiance map in pixels", number(a.method.map_side, 8, 4096),
       Use::kEveryday},
      {"--facets", kBaked, "Distribution of K's facets",
       choice(a.method.facets, {{"beckmann", Facets::kBeckmann}, {"gaussian", Facets::kGaussian}}), Use::kEveryday},
      {"--sphere", kBaked, "R of the sphere maps: equation (4), or the directional albedo of the product's tables",
       choice(a.method.sphere_of, {{"albedo", SphereOf::kAlbedo}, {"equation4", SphereOf::kEquation4}}),
       Use::kEveryday},
      {"--sphere-map", kBaked, "Side of a sphere map in texels", number(a.method.sphere_side, 1, 1024), Use::kEveryday},
      {"--sphere-cells", kFrame,
       "A reflector is divided into so many cells a side, at whose corners the sphere map is looked up",
       number(a.cells, 1, 256), Use::kEveryday},
      {"--maps", kFrame, "Radiance maps drawn for each element in view", number(a.frame.maps_per_element, 1, 64),
       Use::kEveryday},
      {"--show", kFrame, "A stage alone",
       choice(a.frame.show,
              {{"D", Show::kD}, {"M", Show::kM}, {"MK", Show::kMK}, {"MKR", Show::kMKR}, {"all", Show::kAll}}),
       Use::kEveryday},
      {"--reference", kFrame,
       "Compares a camera's frame with this file of oriel-bake render, as oriel-play does; one for each --camera",
       texts(a.references, "FILE"), Use::kEveryday},
      {"--json", kFrame, "A file for the comparison's numbers", text(a.json, "FILE"), Use::kEveryday, "", "", "",
       "--reference"},
  };
  options.insert(options.end(), own.begin(), own.end());
  return options;
}

Result<Comparison> compare_with(const std::string& file, const std::string& camera, ShownScene& shown,
                                const FrameOptions& options, ImageReflections& extension) {
  ORIEL_TRY(const LayeredImage reference, read_layered_exr(file));
  const Pack& pack = shown.scene->pack();
  ORIEL_TRY(const Camera eye, parse_camera(camera, {pack.cameras, pack.paths, pack.mesh.origin}));
  const FloatImage& picture = reference.layers.at("");
  const View view =
      make_view(eye, static_cast<int>(picture.width), static_cast<int>(picture.height), shown.scene->bounds());
  ORIEL_TRY(const PlayedFrame frame, draw_compared(*shown.renderer, {*shown.scene, view, options, 1, &extension}));
  return compare(frame, reference, 0);
}

// A list of what oriel-play --json has of one.
Status compare_all(ShownScene& shown, const ShownArguments& arguments, const ImageMethodArguments& a,
                   ImageReflections& extension) {
  if (a.references.size() != arguments.cameras.size())
    return fail(ErrorCode::kUsage, "--reference", "found {} for {} of --camera, expected as many", a.references.size(),
                arguments.cameras.size());
  std::string json;
  for (std::size_t i = 0; i < a.references.size(); ++i) {
    ORIEL_TRY(const Comparison found, compare_with(a.references[i], arguments.cameras[i], shown, a.frame, extension));
    fmt::print("{}\n{}", arguments.cameras[i], comparison_text(found));
    json += (json.empty() ? "[" : ",\n") + comparison_json(found);
  }
  return a.json.empty() ? Status() : write_text_atomically(a.json, json + "]\n");
}

Status run_image_method(const ShownArguments& arguments, const ImageMethodArguments& a) {
  ORIEL_TRY(BakedMethod baked, bake_method(a.bake, a.method));
  for (const std::string& line : baked.omitted) fmt::print("{}\n", line);
  std::size_t pixels = 0;
  for (const RadianceMap& map : baked.maps) pixels += map.valid.size();
  fmt::print("{} reflectors, {} maps of {} pixels\n", baked.reflectors.size(), baked.maps.size(), pixels);
  ORIEL_TRY(ShownScene shown, ShownScene::open(std::move(baked.pack)));
  ORIEL_TRY(const auto extension, ImageReflections::create(shown.device, baked, a.cells));
  if (!a.references.empty()) ORIEL_TRY_VOID(compare_all(shown, arguments, a, *extension));
  extension->take_times();
  ORIEL_TRY_VOID(draw_cameras(shown, arguments, a.frame, extension.get()));
  const auto ms = extension->take_times();
  fmt::print("of a frame: points {:.1f} ms, kernel {:.1f} ms, sphere map {:.1f} ms\n", ms.points, ms.kernel, ms.sphere);
  return {};
}

}  // namespace

ToolCommand bastos1999_command(ShownArguments& arguments) {
  const auto a = std::make_shared<ImageMethodArguments>();
  std::vector<Option> options = shown_options(arguments);
  for (Option& option : image_method_options(*a)) options.push_back(std::move(option));
  return {
      .name = "bastos1999",
      .help = "Reflections from radiance maps: points, a kernel and a sphere map (Bastos, Hoff, Wynn and Lastra 1999)",
      .footer = "",
      .options = std::move(options),
      .settle = [a, &arguments](const Given& given) -> Status {
        a->bake.scene = arguments.input;
        ORIEL_TRY_VOID(settle(a->bake, given));
        a->bake.given.clear();  // they are the method's
        return {};
      },
      .run = [a, &arguments] { return run_image_method(arguments, *a); }};
}

}  // namespace oriel::study
