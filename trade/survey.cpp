#include "trade/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "formats/query/camera_spec.h"

namespace oriel::trade {
namespace {

struct Bounds {
  Vec3 lower{std::numeric_limits<float>::max()}, upper{std::numeric_limits<float>::lowest()};
};

Bounds bounds_of(const Mesh& mesh) {
  Bounds b;
  for (const Vec3& p : mesh.positions) b.lower = glm::min(b.lower, p), b.upper = glm::max(b.upper, p);
  return mesh.positions.empty() ? Bounds{Vec3(0), Vec3(0)} : b;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const DVec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]];
    area += 0.5 * glm::length(glm::cross(b - a, DVec3(mesh.positions[mesh.indices[i + 2]]) - a));
  }
  return area;
}

Vec3 centre_of(const Reflector& r) {
  return Vec3(r.pack_from_reflector * Vec4(0.5f * (r.lower + r.upper), 0, 1));
}

// Whether the eye is before the reflector's front; its normal is z.
bool before(const Vec3& eye, const Reflector& r) {
  return glm::dot(eye - centre_of(r), Vec3(r.pack_from_reflector[2])) > 0;
}

constexpr double kWellSeen = 0.1;  // steradians: some tenth of a frame

// How large a reflector looks from a camera, as the solid angle of a small patch, up to where it is well seen; 0 where
// its centre is out of view.
double seen(const Camera& camera, const Reflector& r) {
  const Vec3 to = centre_of(r) - camera.eye;
  const float distance = glm::length(to);
  if (distance == 0 || !before(camera.eye, r)) return 0;
  const float ahead = glm::dot(to / distance, glm::normalize(camera.forward));
  if (ahead < std::cos(std::max(camera.vertical_fov_rad, 0.5f) / 2)) return 0;
  const double facing = -glm::dot(to / distance, Vec3(r.pack_from_reflector[2]));
  return std::min(kWellSeen, r.area_m2 * facing / (distance * distance));
}

// The first, then one after the other that which adds most to what is seen of each reflector, or where none adds
// anything the next in the file.
std::vector<std::size_t> chosen_cameras(const Pack& pack, std::size_t count) {
  std::vector<std::size_t> chosen;
  std::vector<double> covered(pack.reflectors.size(), 0);
  const auto gain = [&](std::size_t c) {
    double sum = 0;
    for (std::size_t r = 0; r < covered.size(); ++r)
      sum += std::max(0.0, seen(pack.cameras[c], pack.reflectors[r]) - covered[r]);
    return sum;
  };
  while (chosen.size() < std::min(count, pack.cameras.size())) {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t c = 0; c < pack.cameras.size(); ++c) {
      if (std::find(chosen.begin(), chosen.end(), c) != chosen.end()) continue;
      const double here = chosen.empty() ? (c == 0 ? 1 : 0) : gain(c);
      if (here > most) most = here, best = c;
    }
    chosen.push_back(best);
    for (std::size_t r = 0; r < covered.size(); ++r)
      covered[r] = std::max(covered[r], seen(pack.cameras[best], pack.reflectors[r]));
  }
  return chosen;
}

// Its name where that means it, else its number.
std::string spec_of(const Pack& pack, std::size_t camera) {
  const std::string& name = pack.cameras[camera].name;
  for (std::size_t c = 0; c < camera; ++c)
    if (pack.cameras[c].name == name) return std::to_string(camera);
  return name.empty() ? std::to_string(camera) : name;
}

std::string spec_of(const Vec3& eye, const Vec3& target, const DVec3& origin) {
  const DVec3 e = DVec3(eye) + origin, t = DVec3(target) + origin;
  return fmt::format("{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}", e.x, e.y, e.z, t.x, t.y, t.z);
}

}  // namespace

SceneFacts survey(const Pack& pack, std::size_t cameras) {
  SceneFacts facts;
  const Bounds bounds = bounds_of(pack.mesh);
  facts.diagonal_m = glm::distance(bounds.lower, bounds.upper);
  facts.area_m2 = area_of(pack.mesh);
  facts.planar = !pack.reflectors.empty();
  facts.curved = !pack.curved_reflectors.empty();
  facts.movers = !pack.movers.empty();
  const auto blurs = [&](const auto& reflector) {
    const std::int32_t kernel = pack.materials[reflector.material].kernel;
    return kernel >= 0 && pack.kernels[static_cast<std::size_t>(kernel)].size > 1;
  };
  facts.glossy = std::any_of(pack.reflectors.begin(), pack.reflectors.end(), blurs) ||
                 std::any_of(pack.curved_reflectors.begin(), pack.curved_reflectors.end(), blurs);
  for (const std::size_t camera : chosen_cameras(pack, cameras)) facts.cameras.push_back(spec_of(pack, camera));
  if (!facts.cameras.empty()) return facts;
  const Camera view = initial_camera({pack.cameras, pack.paths, pack.mesh.origin}, bounds.lower, bounds.upper);
  facts.cameras.push_back(spec_of(view.eye, view.eye + view.forward, pack.mesh.origin));
  return facts;
}

double fitting_texel_m(double diagonal_m) {
  constexpr double kDefault = 0.1;
  const double wanted = diagonal_m / 100;
  if (!(wanted > 0) || wanted >= kDefault) return kDefault;
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  const std::array<double, 4> steps = {1, 2, 5, 10};
  const auto off = [&](double step) { return std::fabs(std::log(wanted / (step * decade))); };
  const double best =
      *std::min_element(steps.begin(), steps.end(), [&](double a, double b) { return off(a) < off(b); });
  return std::min(kDefault, best * decade);
}

}  // namespace oriel::trade
