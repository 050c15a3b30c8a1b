// The suite's files, and the cases made of them. ORIEL_VALIDATION names the folder; docs/notes/validation.md tells of
// it.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "formats/core/json.h"
#include "tests/bake/support/scene_parts.h"
#include "tests/validation/case.h"

namespace oriel::validation {

class Suite {
 public:
  // Nothing where ORIEL_VALIDATION is unset or names no folder with the suite.
  static std::optional<Suite> open();

  // A case of radiosity.json, cie171.json, peer_scenes.json or brdf_fresnel.json; it must be there.
  const Json& find(const std::string& id) const;
  // scenes/NAME.gltf, imported; nothing where there is no such file.
  std::optional<Scene> scene(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  std::vector<Json> files_;
};

// `thorough`: all points and settings that resolve every tolerance; otherwise what a minute on two cores can do.
std::vector<Case> factor_cases(const Suite& suite);                    // VF
std::vector<Case> enclosure_cases(const Suite& suite, bool thorough);  // ENC, FUR, PLT
std::vector<Case> lamp_cases(const Suite& suite);                      // CIE 171: 5.2 to 5.8
std::vector<Case> sky_cases(const Suite& suite, bool thorough);        // CIE 171: 5.9 to 5.13
std::vector<Case> peer_cases(const Suite& suite, bool thorough);       // PEER

// Cases have z up, scenes y up.
inline DVec3 from_case(const DVec3& v) {
  return {v.x, v.z, -v.y};
}
inline DVec3 vec(const Json& j) {
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}
inline Probe probe(const Json& position, const Json& normal) {
  return {from_case(vec(position)), from_case(vec(normal)), 1};
}

// A scene out of quads in case coordinates: corners o, o+u, o+u+v, o+v, front u × v.
class QuadScene {
 public:
  // rho: reflectance; exitance M, so that the radiance is M/π.
  std::uint32_t material(const DVec3& rho, const DVec3& exitance = DVec3(0));
  void quad(const std::string& name, std::uint32_t material, const DVec3& o, const DVec3& u, const DVec3& v);
  // The inside of [0,x] × [0,y] × [0,z]; faces x0 (plane x = 0) to z1, in this order, each with its material; faces in
  // `without` are left out.
  void room(const DVec3& size, const std::vector<std::uint32_t>& materials, const std::string& without = "");
  // The quad with a rectangular hole: from (a0, b0) to (a1, b1) along u and v as shares of them.
  void quad_with_hole(const std::string& name, std::uint32_t material, const DVec3& o, const DVec3& u, const DVec3& v,
                      const DVec2& low, const DVec2& high);
  void point_light(const DVec3& position, double flux_lm);
  test::SceneParts& parts() { return parts_; }
  Scene finish() { return parts_.finish(); }

 private:
  test::SceneParts parts_;
};

// A reading at one point.
Reading at(const std::string& name, const Probe& probe, double expected, double tolerance);
// The mean over surfaces.
Reading mean_over(const std::string& name, std::vector<std::string> nodes, double expected, double tolerance);

}  // namespace oriel::validation
