#include "tests/validation/suite.h"

#include <cstdlib>
#include <fstream>

#include "bake/import/import.h"
#include "formats/core/check.h"

namespace oriel::validation {

std::optional<Suite> Suite::open() {
  const char* folder = std::getenv("ORIEL_VALIDATION");
  if (!folder) return std::nullopt;
  Suite suite;
  suite.folder_ = folder;
  for (const char* name : {"radiosity.json", "cie171.json", "peer_scenes.json", "brdf_fresnel.json"}) {
    std::ifstream in(suite.folder_ / name);
    auto read = Json::parse(std::string(std::istreambuf_iterator<char>(in), {}));
    if (!read) return std::nullopt;
    suite.files_.push_back(std::move(*read));
  }
  return suite;
}

const Json& Suite::find(const std::string& id) const {
  for (const Json& file : files_)
    for (const Json& c : file["cases"])
      if (c["id"] == id) return c;
  static const Json kNone;
  ORIEL_CHECK(false && "a case that the suite has");
  return kNone;
}

std::optional<Scene> Suite::scene(const std::string& name) const {
  const auto path = folder_ / "scenes" / (name + ".gltf");
  if (!std::filesystem::exists(path)) return std::nullopt;
  Context context;
  auto imported = import_gltf(path, {}, context);
  if (!imported) return std::nullopt;
  return std::move(imported->scene);
}

std::uint32_t QuadScene::material(const DVec3& rho, const DVec3& exitance) {
  return parts_.diffuse(Vec3(rho), Vec3(exitance / kPiD));
}

void QuadScene::quad(const std::string& name, std::uint32_t material, const DVec3& o, const DVec3& u, const DVec3& v) {
  parts_.quad(name, material, Vec3(from_case(o)), Vec3(from_case(u)), Vec3(from_case(v)));
}

void QuadScene::room(const DVec3& s, const std::vector<std::uint32_t>& materials, const std::string& without) {
  const DVec3 x(s.x, 0, 0), y(0, s.y, 0), z(0, 0, s.z);
  const struct {
    const char* name;
    DVec3 o, u, v;
  } faces[] = {{"x0", DVec3(0), y, z}, {"x1", x, z, y},        {"y0", DVec3(0), z, x},
               {"y1", y, x, z},        {"z0", DVec3(0), x, y}, {"z1", z, y, x}};
  for (std::size_t i = 0; i < 6; ++i)
    if (without != faces[i].name) quad(faces[i].name, materials[i], faces[i].o, faces[i].u, faces[i].v);
}

void QuadScene::quad_with_hole(const std::string& name, std::uint32_t material, const DVec3& o, const DVec3& u,
                               const DVec3& v, const DVec2& low, const DVec2& high) {
  if (low.x > 0) quad(name, material, o, low.x * u, v);
  if (high.x < 1) quad(name, material, o + high.x * u, (1 - high.x) * u, v);
  const DVec3 between = o + low.x * u, width = (high.x - low.x) * u;
  if (low.y > 0) quad(name, material, between, width, low.y * v);
  if (high.y < 1) quad(name, material, between + high.y * v, width, (1 - high.y) * v);
}

void QuadScene::point_light(const DVec3& position, double flux_lm) {
  Light light;
  light.position = Vec3(from_case(position));
  light.intensity = Vec3(static_cast<float>(flux_lm / (4 * kPiD)));
  parts_.scene().lights.push_back(light);
}

Reading at(const std::string& name, const Probe& probe, double expected, double tolerance) {
  Reading r;
  r.name = name;
  r.expected = expected;
  r.tolerance = tolerance;
  r.probes = {probe};
  return r;
}

Reading mean_over(const std::string& name, std::vector<std::string> nodes, double expected, double tolerance) {
  Reading r;
  r.name = name;
  r.expected = expected;
  r.tolerance = tolerance;
  r.over = Over::kMean;
  r.nodes = std::move(nodes);
  return r;
}

}  // namespace oriel::validation
