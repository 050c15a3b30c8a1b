// Whole rooms with a Monte Carlo reference per point.
#include "tests/validation/suite.h"

namespace oriel::validation {
namespace {

const Json& quad_named(const Json& quads, const std::string& name) {
  for (const Json& q : quads)
    if (q["name"] == name) return q;
  return quads[0];
}

// Texel k of a grid of nu × nv on the quad o, u, v.
Probe texel_of(const Json& quad, std::size_t k, double nu, double nv) {
  const double i = std::fmod(static_cast<double>(k), nu), j = std::floor(static_cast<double>(k) / nu);
  const DVec3 u = vec(quad["u"]), v = vec(quad["v"]);
  return {from_case(vec(quad["o"]) + u * ((i + 0.5) / nu) + v * ((j + 0.5) / nv)),
          from_case(glm::normalize(glm::cross(u, v))), 1};
}

Reading against_noise(Reading r, double error, const Json& tolerance) {
  r.reference_error = error;
  r.tolerance = r.expected * tolerance["per_texel_rel"].get<double>() + 2 * error;
  return r;
}

Case peer(const Suite& suite, const std::string& id, std::size_t step) {
  const Json& j = suite.find(id);
  Case c;
  c.id = id;
  c.scene = suite.scene(id).value();
  c.texel_m = id == "PEER-troom" ? 0.125 : id == "PEER-cornell" ? 1.0 / 32 : 0.125;
  c.lux_error = 0.01;
  c.grid = {j["tolerance"]["mean_rel"].get<double>(), j["tolerance"]["nrmse"].get<double>()};
  if (j["expected"].contains("irradiance_points"))
    for (const Json& p : j["expected"]["irradiance_points"])
      c.readings.push_back(against_noise(at("point " + p["p"].dump(), probe(p["p"], p["n"]), p["E"].get<double>(), 0),
                                         p["stderr"].get<double>(), j["tolerance"]));
  if (!j["expected"].contains("irradiance_grids")) return c;
  for (const auto& [face, grid] : j["expected"]["irradiance_grids"].items()) {
    const Json& quad = quad_named(j["inputs"]["quads"], face);
    for (std::size_t i = 0; i < grid["k"].size(); i += step) {
      const Probe where =
          texel_of(quad, grid["k"][i].get<std::size_t>(), grid["nu"].get<double>(), grid["nv"].get<double>());
      c.readings.push_back(against_noise(
          at(fmt::format("{} texel {}", face, grid["k"][i].dump()), where, grid["E_rgb"][i][1].get<double>(), 0),
          grid["stderr_g"][i].get<double>(), j["tolerance"]));
    }
  }
  return c;
}

}  // namespace

// PEER-glossyA asks for a lobe after Ward, which glTF's materials do not have.
std::vector<Case> peer_cases(const Suite& suite, bool thorough) {
  const std::size_t step = thorough ? 1 : 9;
  return {peer(suite, "PEER-cornell", step), peer(suite, "PEER-troom", 1), peer(suite, "PEER-glossyC", step)};
}

}  // namespace oriel::validation
