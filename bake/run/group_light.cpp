#include "bake/run/group_light.h"

#include <algorithm>
#include <map>

#include "bake/jobs/parallel.h"
#include "bake/radiance/punctual_emitter.h"
#include "bake/radiance/sun_emitter.h"
#include "bake/scene/shade.h"
#include "bake/scene/sky.h"
#include "bake/trace/punctual.h"
#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"
#include "formats/query/group_light.h"

namespace oriel {
namespace {

constexpr std::uint32_t kNobody = ~0u;
constexpr std::uint32_t kShareRays = 4096, kProbeRays = 256;  // of a map, of a probe
constexpr std::uint32_t kHastyRays = 16;                      // of either, once --time is over

bool shines(const Material& material) {
  return !material.unlit && max_component(material.emission) > 0;
}

// Parts and surfaces are in one order; a surface is one part for each page.
std::vector<std::uint32_t> group_of_parts(const Scene& scene, const Mesh& mesh) {
  std::vector<std::uint32_t> groups;
  std::size_t surface = 0, left = 3 * std::size_t{scene.surfaces[0].triangle_count};
  for (const MeshPart& part : mesh.parts) {
    while (left == 0) left = 3 * std::size_t{scene.surfaces[++surface].triangle_count};
    groups.push_back(scene.surfaces[surface].light_group);
    left -= part.index_count;
  }
  return groups;
}

// Each shining material of one group: parts of others get copies.
void divide_materials(const Scene& scene, Pack& pack) {
  std::vector<std::uint32_t> owner(pack.materials.size(), kNobody);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;
  const std::vector<std::uint32_t> groups = group_of_parts(scene, pack.mesh);
  for (std::size_t p = 0; p < groups.size(); ++p) {
    std::uint32_t& material = pack.mesh.parts[p].material;
    if (!shines(pack.materials[material])) continue;
    if (owner[material] == kNobody) owner[material] = groups[p];
    if (owner[material] == groups[p]) continue;
    const auto [at, added] = copies.try_emplace({material, groups[p]}, pack.materials.size());
    if (added) {
      Material copy = pack.materials[material];
      copy.name += " (" + pack.light_groups[groups[p]].name + ")";
      pack.materials.push_back(std::move(copy));
      owner.push_back(groups[p]);
    }
    material = at->second;
  }
  for (std::uint32_t m = 0; m < owner.size(); ++m)
    if (owner[m] != kNobody) pack.light_groups[owner[m]].materials.push_back(m);
}

// Of the shining triangle that has most of these corners; kNobody: none has two.
std::uint32_t group_of_corners(const Scene& scene, std::span<const Vec3> corners) {
  std::uint32_t group = kNobody;
  int most = 1;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const Surface& surface = scene.surfaces[scene.triangle_surface[t]];
    if (!(max_component(scene.materials[surface.material].emission) > 0)) continue;
    int same = 0;
    for (int k = 0; k < 3; ++k)
      same += std::ranges::find(corners, scene.positions[scene.triangles[t][k]]) != corners.end() ? 1 : 0;
    if (same > most) most = same, group = surface.light_group;
  }
  if (group != kNobody) return group;
  std::uint32_t light = sun_of_corners(scene, {corners.begin(), corners.end()});
  if (light == ~0u) light = punctual_of_corners(scene, corners);
  return light == ~0u ? kNobody : scene.lights[light].light_group;
}

std::uint32_t group_of(const Scene& scene, const BrightLight& light) {
  if (light.kind == BrightLightKind::kPolygon) return group_of_corners(scene, std::span(light.corners).first(3));
  for (const Light& other : scene.lights)
    if (other.name == light.name && other.intensity == light.intensity && other.direction == light.direction &&
        (light.kind == BrightLightKind::kDirectional || other.position == light.position))
      return other.light_group;
  return kNobody;
}

// What one place sees of each group's light: its share of the radiance that comes from all directions above a normal,
// or all around. Lamps themselves do not count: they are seen in few directions, and would drown all else.
class Shares {
 public:
  Shares(const BakedScene& baked, const std::vector<std::vector<LightmapPage>>& light)
      : baked_(baked), light_(light), scene_(baked.accel.scene()) {}

  void add(const Ray& ray, std::vector<DVec3>& sum) const {
    const Hit hit = baked_.accel.intersect(ray);
    if (!hit) {
      each_owner(scene_, sky_owner(scene_), ray.direction, sky_radiance(scene_, ray.direction),
                 [&](std::uint32_t group, const Vec3& light) { sum[group] += DVec3(light); });
      return;
    }
    if (!hit.front) return;
    const SurfacePoint point = surface_at(scene_, hit, ray.direction);
    const TexelPoint at{hit.triangle, hit.barycentric};
    for (std::size_t g = 0; g < light_.size(); ++g) {
      std::vector<Vec3> of_group(light_.size(), Vec3(0));
      of_group[g] = Vec3(1);
      const Vec3 e = baked_irradiance(baked_.atlas, light_[g], at, point.normal, point.normal) +
                     baked_.sharp_irradiance_at(at, point.normal, of_group);
      sum[g] += DVec3(point.shade.diffuse / kPi * e);
    }
  }

  std::vector<Vec3> of(std::uint32_t count, const std::function<Ray(std::uint32_t)>& ray) const {
    std::vector<DVec3> sum(scene_.light_groups.size(), DVec3(0));
    for (std::uint32_t k = 0; k < count; ++k) add(ray(k), sum);
    DVec3 total(0);
    for (const DVec3& part : sum) total += part;
    std::vector<Vec3> shares;
    for (const DVec3& part : sum) shares.emplace_back(glm::min(part / glm::max(total, DVec3(1e-30)), DVec3(1)));
    return shares;
  }

 private:
  const BakedScene& baked_;
  const std::vector<std::vector<LightmapPage>>& light_;
  const Scene& scene_;
};

// Of each group's lamps together, by their lumens; a sky's counts where there is nothing else.
void find_colors(const Scene& scene, Pack& pack) {
  std::vector<DVec3> sum(pack.light_groups.size(), DVec3(0));
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (const Surface& surface = scene.surfaces[scene.triangle_surface[t]];
        max_component(scene.materials[surface.material].emission) > 0 && !scene.materials[surface.material].unlit)
      sum[surface.light_group] += triangle_area(scene, t) * DVec3(mean_emission(scene, t));
  for (const Light& light : scene.lights)
    sum[light.light_group] +=
        light.type == LightType::kDirectional ? DVec3(light.intensity) : punctual_power(scene, light);
  for (std::size_t g = 0; g < sum.size(); ++g) {
    if (pack.light_groups[g].sky && sum[g] == DVec3(0)) sum[g] = DVec3(scene.sky);
    if (luminance(sum[g]) > 0) pack.light_groups[g].own_color = Vec3(sum[g] / luminance(sum[g]));
  }
}

// Once it is `late`, few rays are traced of each place.
Status find_shares(const BakedScene& baked, const std::vector<std::vector<LightmapPage>>& light,
                   const std::function<bool()>& late, const Stage& stage, Pack& pack) {
  const Shares shares(baked, light);
  const auto find = [&](std::vector<Vec3> LightGroup::*list, std::size_t count, std::uint32_t rays,
                        const auto& ray) -> Status {
    std::vector<std::vector<Vec3>> found(count);
    ORIEL_TRY_VOID(parallel_for(stage, "", count, [&](std::size_t i) {
      const std::uint32_t traced = late() ? kHastyRays : rays;
      found[i] = shares.of(traced, [&](std::uint32_t k) { return ray(i, k); });
      stage.count(traced);
    }));
    for (const std::vector<Vec3>& of_place : found)
      for (std::size_t g = 0; g < of_place.size(); ++g) (pack.light_groups[g].*list).push_back(of_place[g]);
    return {};
  };
  ORIEL_TRY_VOID(find(&LightGroup::reflectors, pack.reflectors.size(), kShareRays, [&](std::size_t r, std::uint32_t k) {
    const Reflector& reflector = pack.reflectors[r];
    const Mat3 rotation(reflector.pack_from_reflector);
    Sampler sampler(r, 0, k);
    const Vec2 at = glm::mix(reflector.lower, reflector.upper, sampler.next2());
    const Vec3 direction = rotation * square_to_cosine_hemisphere(sampler.next2());
    return Ray{Vec3(reflector.pack_from_reflector * Vec4(at, 0, 1)) + 1e-3f * rotation[2], direction};
  }));
  const auto around = [](const Vec3& place, std::uint64_t seed, std::uint64_t stream, std::uint32_t k) {
    return Ray{place, square_to_sphere(Sampler(seed, stream, k).next2())};
  };
  ORIEL_TRY_VOID(find(&LightGroup::surrounds, pack.surround_maps.size(), kShareRays,
                      [&](std::size_t m, std::uint32_t k) { return around(pack.surround_maps[m].centre, m, 1, k); }));
  return find(&LightGroup::probes, pack.light_field.probes.size(), kProbeRays,
              [&](std::size_t p, std::uint32_t k) { return around(pack.light_field.probes[p].position, p, 2, k); });
}

// The pack opens at one hour. Who knows nothing of days shows that too: its group many times, the others not at all.
void show_day(const Scene& scene, Pack& pack) {
  if (scene.day.empty()) return;
  pack.day = scene.day;
  for (const DayHour& hour : pack.day.hours) {
    if (hour.group == kNight) continue;
    LightGroup& group = pack.light_groups[hour.group];
    group.sky = hour.hour == pack.day.shown_hour;
    group.value = group.sky ? static_cast<float>(pack.day.lit()) : 0.0f;
  }
}

}  // namespace

Status assemble_light_groups(const BakedScene& baked, const std::vector<std::vector<LightmapPage>>& light,
                             const std::function<bool()>& late, const Stage& stage, Pack& pack) {
  const Scene& scene = baked.accel.scene();
  if (light.empty()) return {};
  for (const SceneLightGroup& group : scene.light_groups) {
    LightGroup& added = pack.light_groups.emplace_back();
    added.name = group.name, added.lamps = group.lamps;
    if (group.motion < 0) continue;
    const SceneMover& motion = scene.lamp_motions[static_cast<std::size_t>(group.motion)];
    added.rest = motion.rest, added.keys = motion.keys;
  }
  const auto own = [&](std::uint32_t group, std::vector<std::uint32_t> LightGroup::*list, std::size_t index) {
    if (group != kNobody) (pack.light_groups[group].*list).push_back(static_cast<std::uint32_t>(index));
  };
  divide_materials(scene, pack);
  for (std::size_t e = 0; e < pack.emitters.size(); ++e)
    own(group_of_corners(scene, pack.emitters[e].corners), &LightGroup::emitters, e);
  for (std::size_t b = 0; b < pack.light_field.lights.size(); ++b)
    own(group_of(scene, pack.light_field.lights[b]), &LightGroup::bright_lights, b);
  if (max_component(scene.sky) > 0 && scene.day.empty()) pack.light_groups[scene.sky_group].sky = true;
  show_day(scene, pack);
  find_colors(scene, pack);
  ORIEL_TRY_VOID(find_shares(baked, light, late, stage, pack));
  for (std::uint32_t p = 0; p < pack.lightmaps.size(); ++p)
    pack.page_groups.push_back(groups_of_page(pack.lightmaps[p], p, light));
  return {};
}

}  // namespace oriel
