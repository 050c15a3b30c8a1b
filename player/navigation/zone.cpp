#include "player/navigation/zone.h"

#include <algorithm>

#include "formats/core/json.h"

namespace oriel {
namespace {

bool is_near(const WalkGrid& grid, const Vec3& eye) {
  if (!(grid.cell_m > 0) || !is_finite(eye)) return false;
  const Vec2 cell = (Vec2(eye.x, eye.z) - grid.lower) / grid.cell_m;
  const auto width = static_cast<float>(grid.width), height = static_cast<float>(grid.height);
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const Vec2 near = glm::floor(cell) + Vec2(static_cast<float>(dx), static_cast<float>(dy));
      if (!(near.x >= 0 && near.y >= 0 && near.x < width && near.y < height)) continue;
      const std::size_t at = static_cast<std::size_t>(near.y) * grid.width + static_cast<std::size_t>(near.x);
      if (grid.walkable(at) && std::fabs(grid.eye(at).y - eye.y) <= kZoneHeight_m) return true;
    }
  return false;
}

// A member of an object, null where there is none: a pack's text may be anything.
Json member(const Json& object, const char* name) {
  return object.is_object() && object.contains(name) ? object[name] : Json();
}

std::vector<Vec3> eyes_of_file(const Json& points, const DVec3& origin) {
  std::vector<Vec3> eyes;
  for (const Json& p : points) {
    if (!p.is_array() || p.size() != 3 || !std::all_of(p.begin(), p.end(), [](const Json& v) { return v.is_number(); }))
      continue;
    eyes.emplace_back(DVec3(p[0].get<double>(), p[1].get<double>(), p[2].get<double>()) - origin);
  }
  return eyes;
}

std::vector<Vec3> eyes_of_cameras(const Pack& pack) {
  std::vector<Vec3> eyes;
  for (const Camera& camera : pack.cameras)
    if (camera.vertical_fov_rad > 0) eyes.push_back(camera.eye);
  for (const CameraPath& path : pack.paths)
    for (const CameraKey& key : path.keys) eyes.push_back(key.eye);
  return eyes;
}

Zone::Box box_of(const Mesh& mesh) {
  Zone::Box box{mesh.positions.front(), mesh.positions.front()};
  for (const Vec3& p : mesh.positions) {
    box.lower = glm::min(box.lower, p);
    box.upper = glm::max(box.upper, p);
  }
  return box;
}

}  // namespace

bool Zone::holds(const Vec3& eye) const {
  if (grids.empty() && eyes.empty() && !box) return true;
  if (box && glm::all(glm::greaterThanEqual(eye, box->lower)) && glm::all(glm::lessThanEqual(eye, box->upper)))
    return true;
  return std::any_of(eyes.begin(), eyes.end(), [&](const Vec3& e) { return glm::distance(e, eye) <= kZoneRadius_m; }) ||
         std::any_of(grids.begin(), grids.end(), [&](const WalkGrid& grid) { return is_near(grid, eye); });
}

Zone planned_zone(const Pack& pack) {
  Zone zone;
  const Json options = member(Json::parse(pack.provenance).value_or(Json()), "options");
  const Json source = member(options, "eyes");
  if (source == "file") {
    zone.eyes = eyes_of_file(member(options, "eye_points"), pack.mesh.origin);
    return zone;
  }
  zone.grids = pack.walk_grids;
  if (source == "walk") zone.eyes = eyes_of_cameras(pack);
  // Of a scene without a floor and without a camera any place counts.
  const bool anywhere = source == "box" || (source == "walk" && zone.grids.empty() && zone.eyes.empty());
  if (anywhere && !pack.mesh.positions.empty()) zone.box = box_of(pack.mesh);
  return zone;
}

}  // namespace oriel
