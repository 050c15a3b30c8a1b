#include "bake/radiance/reflectors.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"
#include "formats/core/check.h"
#include "formats/core/rectangle.h"

namespace oriel {
namespace {

constexpr std::uint32_t kOpenRays = 128;  // per side of a patch
constexpr float kMetal = 0.5f;            // reflectance at 60°: less is plastic, in planes without highlights
constexpr double kMostAround = 4;         // m²: what a surround map is for is seen from one place

// Triangles that may reflect, by node name and material: parts of one node that were split by the exporter join again.
using Groups = std::map<std::pair<std::uint32_t, std::string>, std::vector<std::uint32_t>>;

// Why a material shows no image; empty where it may.
std::string excluded_because(const SceneMaterial& m, const ReflectorMaterial& r, const ReflectorOptions& options) {
  if (m.unlit) return "it is unlit";
  if (!m.reflections) return "it is asked to show none (reflections=false)";
  const float reflectance = reflectance_at_60_deg(r);
  if (!(reflectance >= options.min_reflectance))
    return fmt::format("it reflects {:.2g} % at 60°, less than {:.2g} %", 100 * reflectance,
                       100 * options.min_reflectance);
  if (r.roughness > options.max_roughness && !shows_highlights(reflectance, r.roughness * r.roughness))
    return fmt::format("with a roughness of {:.3g} they are a glow without an outline", r.roughness);
  if (max_component(m.emission) > 0) return "it emits light, which outshines them";
  return {};
}

Groups group_triangles(const Scene& scene, std::span<const ReflectorMaterial> materials,
                       const ReflectorOptions& options, std::vector<Warning>& omitted) {
  std::vector<std::string> reason(scene.materials.size());
  std::vector<char> used(scene.materials.size());
  for (std::size_t m = 0; m < reason.size(); ++m)
    reason[m] = excluded_because(scene.materials[m], materials[m], options);
  Groups groups;
  for (const Surface& surface : scene.surfaces) {
    if (surface.triangle_count == 0) continue;
    used[surface.material] = 1;
    if (!reason[surface.material].empty()) continue;
    auto& list = groups[{surface.material, surface.name}];
    for (std::uint32_t i = 0; i < surface.triangle_count; ++i) list.push_back(surface.first_triangle + i);
  }
  for (std::size_t m = 0; m < reason.size(); ++m)
    // A material without any specular lobe leaves nothing out.
    if (used[m] && !reason[m].empty() && (materials[m].f90 > 0 || max_component(materials[m].f0) > 0))
      omitted.push_back({fmt::format("material '{}': baked and shown, but its reflections without an image: {}",
                                     scene.materials[m].name, reason[m]),
                         "no-image"});
  return groups;
}

// Share of cosine-distributed directions on one side of the patch that see something at a distance worth an image: not
// the sky where it is black, not the inside of a solid, not a thing closer than a tenth of the patch's size.
float open_share(const Accel& accel, const PlanarPatch& patch, const DVec3& normal) {
  const Scene& scene = accel.scene();
  std::vector<double> area_until;
  double total = 0;
  for (const std::uint32_t t : patch.triangles) area_until.push_back(total += triangle_area(scene, t));
  const float near = 0.1f * static_cast<float>(std::sqrt(patch.area_m2));
  const auto lift = static_cast<float>(patch.flatness_m) + 1e-6f * scene.radius();
  const Vec3 n(normal);
  const Mat3 frame = frame_from_normal(n);
  std::uint32_t open = 0;
  for (std::uint32_t i = 0; i < kOpenRays; ++i) {
    Sampler sampler(0, 0, i);
    const double area = sampler.next1() * total;
    const auto at = std::lower_bound(area_until.begin(), area_until.end(), area) - area_until.begin();
    const std::uint32_t t = patch.triangles[std::min<std::size_t>(at, patch.triangles.size() - 1)];
    const Vec3 p = point_on(scene, t, square_to_triangle(sampler.next2()));
    const Vec3 direction = frame * square_to_cosine_hemisphere(sampler.next2());
    const Hit hit = accel.intersect({p + lift * n, glm::normalize(direction)});
    if (!hit) {
      open += max_component(scene.sky) > 0;
    } else {
      const SceneMaterial& m = scene.material_of(hit.triangle);
      open += hit.distance > near && (hit.front || m.double_sided);
    }
  }
  return static_cast<float>(open) / kOpenRays;
}

// The sides of a patch from which it reflects; false where neither sees anything.
bool add_sides(const Accel& accel, const PlanarPatch& patch, const ReflectorMaterial& material,
               const ReflectorOptions& options, std::vector<FoundReflector>& out) {
  const Scene& scene = accel.scene();
  const Surface& surface = scene.surfaces[scene.triangle_surface[patch.triangles.front()]];
  const bool both = scene.materials[surface.material].double_sided;
  bool any = false;
  for (const bool front : {true, false}) {
    if (!front && !both) continue;
    if (open_share(accel, patch, front ? patch.normal : -patch.normal) < options.min_open_share) continue;
    FoundReflector found = make_reflector(scene, patch, front);
    found.reflectance = reflectance_at_60_deg(material);
    found.roughness = material.roughness;
    out.push_back(std::move(found));
    any = true;
  }
  return any;
}

double importance(const FoundReflector& f) {
  return double{f.reflectance} * f.reflector.area_m2 * (1 - f.roughness);
}

}  // namespace

FoundReflector make_reflector(const Scene& scene, const PlanarPatch& patch, bool front) {
  FoundReflector found;
  found.triangles = patch.triangles;
  const DVec3 z = front ? patch.normal : -patch.normal;
  // x as level as it can be, so that "aligned with the world" has a meaning in any plane.
  const DVec3 up = std::abs(z.y) < 0.99 ? DVec3(0, 1, 0) : DVec3(0, 0, -1);
  const DVec3 level = glm::normalize(glm::cross(up, z)), ascent = glm::cross(z, level);
  std::vector<DVec2> points;
  points.reserve(3 * patch.triangles.size());
  for (const std::uint32_t t : patch.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const DVec3 p(scene.positions[scene.triangles[t][corner]]);
      points.emplace_back(glm::dot(p, level), glm::dot(p, ascent));
    }
  const Rectangle r = tight_rectangle(points, DVec2(1, 0));
  const DVec3 x = r.axis.x * level + r.axis.y * ascent, y = glm::cross(z, x);
  const DVec2 middle = 0.5 * (r.lower + r.upper), half = 0.5 * (r.upper - r.lower);
  const DVec3 origin = middle.x * x + middle.y * y + (front ? patch.offset : -patch.offset) * z;

  Reflector& out = found.reflector;
  const Surface& surface = scene.surfaces[scene.triangle_surface[patch.triangles.front()]];
  out.name = surface.name;
  out.material = surface.material;
  out.pack_from_reflector = Mat4(Vec4(Vec3(x), 0), Vec4(Vec3(y), 0), Vec4(Vec3(z), 0), Vec4(Vec3(origin), 1));
  out.lower = Vec2(-half);
  out.upper = Vec2(half);
  out.area_m2 = static_cast<float>(patch.area_m2);
  out.flatness_m = static_cast<float>(patch.flatness_m);
  return found;
}

float reflectance_at_60_deg(const ReflectorMaterial& m) {
  return reflectance_at_60_deg(m.f0, m.f90, m.curve);
}

FoundReflectors find_reflectors(const Accel& accel, std::span<const ReflectorMaterial> materials,
                                const ReflectorOptions& options) {
  const Scene& scene = accel.scene();
  ORIEL_CHECK_EQ(materials.size(), scene.materials.size());
  FoundReflectors out;
  const Groups groups = group_triangles(scene, materials, options, out.omitted);
  const double radius = scene.radius(), small = small_scene(scene.radius());
  const PatchOptions patch_options{.max_angle_rad = options.max_angle_deg * kPiD / 180,
                                   .max_distance_m = options.flatness * radius,
                                   .relative_distance = 1e-3,  // of a reflector's own size
                                   .min_distance_m = 1e-6 * radius,
                                   .min_area_m2 = small * small * options.min_area_m2};
  for (const auto& [key, triangles] : groups) {
    const auto& [material, name] = key;
    const ReflectorMaterial& lobe = materials[material];
    const bool wide = lobe.roughness > options.max_roughness, metal = reflectance_at_60_deg(lobe) >= kMetal;
    double left_out_m2 = 0;
    std::size_t left_out = 0;
    std::vector<std::uint32_t> planar;
    for (const PlanarPatch& patch : find_planar_patches(scene, triangles, patch_options)) {
      if (wide && metal && patch.area_m2 < kMostAround) continue;  // a surround map shows it
      planar.insert(planar.end(), patch.triangles.begin(), patch.triangles.end());
      if (!wide && add_sides(accel, patch, lobe, options, out.reflectors)) continue;
      left_out_m2 += patch.area_m2;
      ++left_out;
    }
    if (left_out > 0)
      out.omitted.push_back(fmt::format("'{}' ({} planar pieces, {:.3g} m²): {}", name, left_out, left_out_m2,
                                        wide ? "roughness above 0.5 shows no image in a plane"
                                             : "sees nothing further away than a tenth of its size"));
    if (wide && !metal && left_out > 0) continue;  // round edges would show highlights, and flats none
    std::sort(planar.begin(), planar.end());
    std::set_difference(triangles.begin(), triangles.end(), planar.begin(), planar.end(),
                        std::back_inserter(out.unplanar));
  }
  std::sort(out.unplanar.begin(), out.unplanar.end());
  std::stable_sort(out.reflectors.begin(), out.reflectors.end(), [](const FoundReflector& a, const FoundReflector& b) {
    return importance(a) != importance(b) ? importance(a) > importance(b) : a.triangles.front() < b.triangles.front();
  });
  keep_first(options.max_reflectors, "reflectors", out.reflectors, out.omitted);
  return out;
}

}  // namespace oriel
