#include "study/bastos1999/baked_method.h"

#include <algorithm>

#include "bake/radiance/capture.h"
#include "bake/radiance/reproject.h"
#include "bake/radiance/views.h"
#include "bake/run/pipeline.h"
#include "bake/run/reflections.h"
#include "bake/scene/texture.h"

namespace oriel::study {
namespace {

constexpr float kElement_m = 3;  // largest side of an element
constexpr std::uint32_t kMostElements = 16;

// Rings at even arcs, the last band of which ends at the rim, where a frustum would be flat.
constexpr RingArc kToRim{0.5 * kPiD, 0.5};

struct Windows {
  std::vector<std::vector<Element>> elements;  // by reflector
  std::uint64_t pixels = 0;                    // of a map of each
};

Windows find_windows(const Scene& scene, std::vector<FoundReflector>& reflectors, std::uint32_t map_side) {
  Windows out;
  for (FoundReflector& found : reflectors) {
    Reflector& r = found.reflector;
    const ElementGrid grid = element_grid(r.upper - r.lower, kElement_m, kMostElements);
    r.elements_x = grid.x, r.elements_y = grid.y;
    out.elements.push_back(covered_elements(scene, found, grid));
    for (const Element& element : out.elements.back()) out.pixels += map_bytes(element, map_side) / kMapBytesPerPixel;
  }
  return out;
}

float mean_distance(std::span<const RadianceMap> maps) {
  double sum = 0, count = 0;
  for (const RadianceMap& map : maps)
    for (std::size_t i = 0; i < map.valid.size(); ++i) {
      if (map.valid[i] != 1 || !(map.disparity[i] > 0)) continue;
      const Vec2 pixel(i % map.width, i / map.width);
      sum += double{glm::length(Vec3(map_point(map, pixel + 0.5f), 0) - map.eye)} * (1 / double{map.disparity[i]} - 1);
      ++count;
    }
  return count > 0 ? static_cast<float>(sum / count) : 0.0f;
}

// The scene as it was baked, laid out again: the same file and options give the same charts.
struct LaidOut {
  PreparedScene prepared;
  FoundReflections found;
  std::vector<MaterialSummary> materials;
};
Result<LaidOut> lay_out(const BakeOptions& bake, Context& context) {
  LaidOut out;
  std::vector<StageTime> times;
  Stopwatch timed(times);
  ORIEL_TRY(out.prepared, prepare_scene(bake, timed, context));
  ORIEL_TRY_VOID(lay_out_lightmap(bake, timed, context, out.prepared));
  ORIEL_TRY_VOID(make_mips(out.prepared.imported->scene, context));
  out.materials = summarize_materials(out.prepared.scene());
  ORIEL_TRY(out.found, find_reflections(bake, out.prepared, out.materials, HUGE_VAL, context));
  return out;
}

Status capture(const LaidOut& laid, const std::vector<FoundReflector>& reflectors, Context& context, BakedMethod& out) {
  const LightSet lights(laid.prepared.scene());
  BakedScene baked{*laid.prepared.accel, lights, laid.prepared.atlas, out.pack.lightmaps};
  for (const Material& material : out.pack.materials)
    if (material.unlit) baked.unlit_white = material.emission.g;
  SightOptions sight;
  sight.orders = 1;
  const ReflectedSurroundings around(*laid.prepared.accel, reflectors, sight);
  const OutgoingRadiance outgoing = [&](const SeenSurface& seen) { return baked_radiance(baked, seen); };
  return capture_maps({around, outgoing}, Stage(context), out.maps);
}

BakedReflector material_of(const Material& material, const Pack& pack, const SpecularLayers& layers,
                           const MethodOptions& options) {
  BakedReflector out;
  out.kernel.weights = {1.0f};
  if (material.kernel >= 0) {
    const auto lobe = [&](double alpha) { return cook_torrance_lobe(options.facets, alpha); };
    out.kernel = make_kernel(pack.kernels[static_cast<std::size_t>(material.kernel)].alpha, lobe);
  }
  const FresnelMap none;
  const FresnelMap& albedo =
      material.fresnel_map < 0 ? none : pack.fresnel_maps[static_cast<std::size_t>(material.fresnel_map)];
  out.sphere = make_sphere_map(options.sphere_side, [&](double cos_theta) {
    return options.sphere_of == SphereOf::kEquation4 ? equation_4(layers, cos_theta)
                                                     : fresnel_lookup(albedo, static_cast<float>(cos_theta));
  });
  return out;
}

}  // namespace

std::vector<RadianceMap> plan_hemispheres(const Scene& scene, std::vector<FoundReflector>& reflectors,
                                          const MethodOptions& options, std::vector<std::string>& omitted) {
  const Windows windows = find_windows(scene, reflectors, options.map_side);
  const std::uint64_t most = options.memory_bytes / std::max(kMapBytesPerPixel * windows.pixels, std::uint64_t{1});
  const auto views = static_cast<std::uint32_t>(std::min(std::uint64_t{options.views}, most));
  if (views < options.views) omitted.push_back(fmt::format("{} of {} views per element", views, options.views));
  std::vector<RadianceMap> maps;
  for (std::uint32_t r = 0; r < reflectors.size(); ++r) {
    Reflector& out = reflectors[r].reflector;
    std::uint64_t outside = 0;
    out.first_map = static_cast<std::uint32_t>(maps.size());
    for (const Element& element : windows.elements[r]) {
      const Vec3 centre(0.5f * (element.lower + element.upper), 0);
      const float radius = 0.5f * glm::length(element.upper - element.lower);
      for (const Vec3& direction : views > 0 ? hemisphere_directions(views, kToRim) : std::vector<Vec3>()) {
        const Vec3 eye = centre + radius * direction;
        if (is_inside(scene, pack_from_reflector(out, mirrored(eye)), radius)) {
          maps.push_back(blank_map(r, eye, element, options.map_side));
        } else {
          ++outside;
        }
      }
    }
    out.map_count = static_cast<std::uint32_t>(maps.size()) - out.first_map;
    if (outside > 0)
      omitted.push_back(fmt::format("'{}': {} viewpoints see it from outside the scene", out.name, outside));
  }
  return maps;
}

Result<BakedMethod> bake_method(BakeOptions bake, const MethodOptions& options) {
  bake.ways = WaysWanted::kGeometry;
  Context context;
  context.warn = [](const Warning& warning) { fmt::print(stderr, "oriel-study: {}\n", warning.text); };
  BakedMethod out;
  ORIEL_TRY(BakeResult baked, oriel::bake(bake, context));
  out.pack = std::move(baked.pack);
  out.pack.curved_reflectors.clear();
  out.pack.surround_maps.clear();
  ORIEL_TRY(LaidOut laid, lay_out(bake, context));
  std::vector<FoundReflector>& found = laid.found.found.reflectors;
  if (found.size() != out.pack.reflectors.size())
    return fail(ErrorCode::kInvalid, bake.scene.string(), "found {} reflectors, expected the {} that were baked",
                found.size(), out.pack.reflectors.size());
  out.maps = plan_hemispheres(laid.prepared.scene(), found, options, out.omitted);
  ORIEL_TRY_VOID(capture(laid, found, context, out));
  for (std::size_t r = 0; r < found.size(); ++r) {
    const Reflector& reflector = found[r].reflector;
    BakedReflector one = material_of(out.pack.materials[reflector.material], out.pack,
                                     layers_of(laid.materials[reflector.material]), options);
    one.elements = group_by_element(reflector, out.maps);
    one.mean_distance = mean_distance(std::span(out.maps).subspan(reflector.first_map, reflector.map_count));
    out.reflectors.push_back(std::move(one));
  }
  return out;
}

}  // namespace oriel::study
