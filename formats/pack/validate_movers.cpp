// Movers and the light field.
#include <algorithm>

#include "formats/pack/issues.h"

namespace oriel {

static std::string text_of(const LightProbe& p) {
  return fmt::format("place {}, {} coefficients, {} depths, lights {:#x} and {:#x}", text_of(p.position), p.sh.size(),
                     p.depth.size(), p.bright, p.kept);
}

namespace {

bool all_finite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

bool is_rigid(const MoverPose& pose) {
  return bounded(pose.position) && std::abs(glm::length(DVec4(pose.rotation)) - 1) <= 1e-3;
}

void validate_transfer(std::size_t i, const Mover& mover, IssueList& list) {
  const CompressedTransfer& t = mover.transfer;
  const bool shape = t.bands >= 2 && t.bands <= 6 && (t.channels == 1 || t.channels == 3) && t.clusters >= 1 &&
                     t.clusters <= 256 && t.components >= 1 && t.components <= 64;
  const auto clusters = static_cast<std::size_t>(t.clusters), components = static_cast<std::size_t>(t.components);
  if (!shape || t.basis.size() != clusters * (components + 1) * t.stride() ||
      t.weight_scale.size() != clusters * components || t.cluster.size() != mover.mesh.positions.size() ||
      t.weight.size() != t.cluster.size() * components)
    return list.error(733,
                      "mover {} ('{}'): found a transfer of {} bands, {} clusters, {} components for {} of {} "
                      "vertices, expected sizes that fit",
                      i, mover.name, t.bands, t.clusters, t.components, t.cluster.size(), mover.mesh.positions.size());
  const bool in_range = std::all_of(t.cluster.begin(), t.cluster.end(), [&](std::uint8_t c) { return c < t.clusters; });
  if (!in_range || !all_finite(t.basis) || !all_finite(t.weight_scale) || !not_negative(t.error))
    list.error(734, "mover {} ('{}'): found transfer that is not finite or clusters out of range", i, mover.name);
}

void validate_tree(const LightField& field, IssueList& list) {
  const std::uint64_t grid = std::uint64_t{field.size[0]} * field.size[1] * field.size[2];
  for (std::size_t i = 0; i < field.cells.size(); ++i) {
    const FieldCell& cell = field.cells[i];
    const bool probes =
        std::all_of(cell.probes.begin(), cell.probes.end(), [&](std::uint32_t p) { return p < field.probes.size(); });
    // Parts follow their cell, so that no cell is a part of itself.
    const bool parts = cell.children == 0 || (cell.children >= grid && cell.children > i &&
                                              std::uint64_t{cell.children} + 8 <= field.cells.size());
    if (!probes || !parts)
      return list.error(742,
                        "cell {}: found parts from {} and probes up to {}, expected later cells of {} and {} probes", i,
                        cell.children, *std::max_element(cell.probes.begin(), cell.probes.end()), field.cells.size(),
                        field.probes.size());
  }
}

void validate_probes(const LightField& field, IssueList& list) {
  const auto coefficients = static_cast<std::size_t>(3 * field.bands * field.bands);
  const std::size_t texels = std::size_t{field.depth_side} * field.depth_side;
  const std::uint64_t known =
      field.lights.size() >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << field.lights.size()) - 1;
  list.each(
      743, "probes", field.probes,
      [&](const LightProbe& p) {
        return bounded(p.position) && p.sh.size() == coefficients && all_finite(p.sh) && p.depth.size() == texels &&
               std::all_of(p.depth.begin(), p.depth.end(),
                           [](const Vec2& d) { return within(d.x, 0, 1) && within(d.y, 0, 1); }) &&
               ((p.bright | p.kept) & ~known) == 0 && (p.bright & p.kept) == 0;
      },
      "finite numbers, as many as the field says, and lights of its list in one set only");
}

void validate_light(std::size_t i, const BrightLight& light, IssueList& list) {
  const bool polygon = light.kind == BrightLightKind::kPolygon;
  const bool corners = polygon ? !light.corners.empty() && light.corners.size() % 3 == 0 : light.corners.empty();
  const bool angles = within(light.inner_cone_rad, 0, kPi) && within(light.outer_cone_rad, 0, kPi) &&
                      within(light.angular_radius_rad, 0, kPi / 2 + 1e-3f);
  if (!corners || !std::all_of(light.corners.begin(), light.corners.end(), bounded) || !angles ||
      !not_negative(light.intensity) || !bounded(light.position) ||
      !(std::abs(glm::length(DVec3(light.direction)) - 1) <= 1e-3))
    list.error(744,
               "bright light {} ('{}'): found intensity {}, {} corners, place {}, direction {}, expected finite "
               "numbers, triangles of a polygon, and a unit direction",
               i, light.name, text_of(light.intensity), light.corners.size(), text_of(light.position),
               text_of(light.direction));
}

}  // namespace

void validate_motion(const std::string& whose, const MoverPose& rest, const std::vector<MoverKey>& keys,
                     IssueList& list) {
  const auto bad = std::count_if(keys.begin(), keys.end(),
                                 [](const MoverKey& key) { return !std::isfinite(key.time_s) || !is_rigid(key.pose); });
  if (!is_rigid(rest) || bad > 0)
    list.error(731, "{}: found {} keys, or its rest, without a finite place and a unit quaternion", whose, bad);
  for (std::size_t k = 1; k < keys.size(); ++k)
    if (!(keys[k].time_s >= keys[k - 1].time_s)) {
      list.error(732, "{}: found time {} s of key {} after {} s, expected rising times", whose, keys[k].time_s, k,
                 keys[k - 1].time_s);
      break;
    }
}

void validate_movers(const Pack& pack, IssueList& list) {
  for (std::size_t i = 0; i < pack.movers.size(); ++i) {
    const Mover& mover = pack.movers[i];
    list.in_section(kMoverSection, i);
    validate_motion(fmt::format("mover {} ('{}')", i, mover.name), mover.rest, mover.keys, list);
    validate_mesh(pack, mover.mesh, list);
    validate_transfer(i, mover, list);
    for (const MeshPart& part : mover.mesh.parts)
      if (part.material < pack.materials.size() && pack.materials[part.material].normal_texture >= 0 &&
          mover.mesh.normal_uvs.empty())
        list.error(736, "mover {} ('{}'): part '{}' shows a normal texture, but the mesh has no coordinates for it", i,
                   mover.name, part.name);
    if (mover.transfer.bands > pack.light_field.bands)
      list.error(735, "mover {} ('{}'): found a transfer of {} bands, expected at most the light field's {}", i,
                 mover.name, mover.transfer.bands, pack.light_field.bands);
  }
}

void validate_light_field(const Pack& pack, IssueList& list) {
  const LightField& field = pack.light_field;
  if (field.bands == 0) return;
  list.in_section(kLightFieldSection);
  bool shape = field.bands >= 2 && field.bands <= 6 && field.depth_side >= 2 && field.depth_side <= kMaxDepthSide;
  std::uint64_t grid = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    shape &= field.size[a] >= 1 && field.size[a] <= kMaxSide;
    shape &= within(field.cell_m[static_cast<int>(a)], 1e-9f, kLengthLimit);
    grid *= std::min(field.size[a], kMaxSide);
  }
  if (!shape || grid > field.cells.size() || !bounded(field.lower) || !within(field.depth_cap_m, 1e-9f, kLengthLimit) ||
      !not_negative(field.error) || field.lights.size() > kMaxBrightLights)
    return list.error(741,
                      "found {} bands, {} depth texels a side up to {} m, {} x {} x {} cells of {} from {}, {} in "
                      "all, {} lights",
                      field.bands, field.depth_side, field.depth_cap_m, field.size[0], field.size[1], field.size[2],
                      text_of(field.cell_m), text_of(field.lower), field.cells.size(), field.lights.size());
  validate_tree(field, list);
  validate_probes(field, list);
  for (std::size_t i = 0; i < field.lights.size(); ++i) validate_light(i, field.lights[i], list);
}

}  // namespace oriel
