// Lobes' shapes: Cook and Torrance's grooves, GGX.
#include <algorithm>
#include <cmath>

#include "bake/brdf/compensation.h"
#include "bake/brdf/quadrature.h"
#include "tests/validation/material/brdf_cases.h"

namespace oriel::validation {
namespace {

constexpr int kLobeOrder = 200;  // the grooves' G has kinks

// D G / (4 cosθo) of Cook and Torrance 1981, whose D/π has the 1/4 that the 1982 paper lost: there it is 4 times this.
LobeFunction grooves(double m) {
  return [facets = Microfacet(FacetModel::kBeckmann, m)](const DVec3& wo, const DVec3& wi, const DVec3& h) {
    const double both = 2 * h.z / glm::dot(wo, h);
    return facets.d(h) * std::clamp(std::min(both * wo.z, both * wi.z), 0.0, 1.0) / (4 * wo.z);
  };
}

struct Shape {
  double energy = 0;
  DVec3 sum{0};                                   // of directions, weighted
  std::vector<std::pair<double, double>> radius;  // angle from the mirror direction, radians; weight
};

Shape shape_of(const LobeFunction& f_cos, double width, double mu) {
  const DVec3 wo = direction_at(mu), mirror(-wo.x, 0, wo.z);
  Shape shape;
  for_each_reflection(mu, width, kLobeOrder, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
    const double weight = f_cos(wo, wi, h) * solid_angle;
    shape.energy += weight;
    shape.sum += weight * DVec3(wi.x, 0, wi.z);  // its mirror image is counted in
    shape.radius.emplace_back(std::atan2(glm::length(glm::cross(wi, mirror)), glm::dot(wi, mirror)), weight);
  });
  std::sort(shape.radius.begin(), shape.radius.end());
  return shape;
}

double energy_within(const Shape& shape, double degrees) {
  double sum = 0;
  for (const auto& [angle, weight] : shape.radius)
    if (angle <= degrees * kPiD / 180) sum += weight;
  return sum / shape.energy;
}

double radius_of(const Shape& shape, double share) {
  double sum = 0;
  for (const auto& [angle, weight] : shape.radius)
    if ((sum += weight) >= share * shape.energy) return angle * 180 / kPiD;
  return 180;
}

void shape_case(const Json& in, const Json& expected, const LobeFunction& f, const std::string& name,
                const Json& tolerance, std::vector<FunctionReading>& all) {
  const Shape shape = shape_of(f, in["m"].get<double>(), in["mu"].get<double>());
  const std::string what = fmt::format("CTK-lobe {} mu {} m {} ", name, in["mu"].dump(), in["m"].dump());
  const double fraction = tolerance["abs_fraction"].get<double>(), degrees = tolerance["abs_deg"].get<double>();
  all.push_back({what + "E", shape.energy, expected["E"].get<double>(), fraction});
  all.push_back({what + "mean elevation", std::atan2(shape.sum.z, -shape.sum.x) * 180 / kPiD,
                 expected["mean_elev_deg"].get<double>(), degrees});
  for (int axis : {0, 2})
    all.push_back(
        {what + "mean direction", shape.sum[axis] / shape.energy, expected["mean_dir"][axis].get<double>(), fraction});
  for (const auto& [cone, share] : expected["encircled_energy_fraction"].items())
    all.push_back(
        {what + "within " + cone + "°", energy_within(shape, std::stod(cone)), share.get<double>(), fraction});
  all.push_back({what + "r50", radius_of(shape, 0.5), expected["r50_deg"].get<double>(), degrees});
  all.push_back({what + "r90", radius_of(shape, 0.9), expected["r90_deg"].get<double>(), degrees});
}

}  // namespace

std::vector<FunctionReading> groove_readings(const Suite& suite) {
  std::vector<FunctionReading> all;
  const Json& c = suite.find("CTK-E-a");
  const double tolerance = c["tolerance"]["abs"].get<double>();
  for (const auto& [m, values] : c["expected"]["E"].items())
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double mu = c["inputs"]["mu_view"][i].get<double>(), width = std::stod(m);
      const double e = shape_of(grooves(width), width, mu).energy;
      all.push_back({fmt::format("CTK-E m {} mu {}", m, mu), e, values[i].get<double>(), tolerance});
      all.push_back({fmt::format("CTK-E 1982 m {} mu {}", m, mu), 4 * e,
                     c["expected"]["E_with_1982_constants"][m][i].get<double>(), 4 * tolerance});
    }
  const Json& lobes = suite.find("CTK-lobe-a");
  for (std::size_t i = 0; i < lobes["inputs"]["cases"].size(); ++i) {
    const Json& in = lobes["inputs"]["cases"][i];
    const Microfacet ggx(FacetModel::kGgx, in["m"].get<double>());
    shape_case(in, lobes["expected"]["cook_torrance_beckmann_vcavity"][i], grooves(in["m"].get<double>()), "grooves",
               lobes["tolerance"], all);
    shape_case(
        in, lobes["expected"]["ggx_smith_corr"][i],
        [&](const DVec3& wo, const DVec3& wi, const DVec3& h) { return ggx.f_cos(wo, wi, h); }, "ggx",
        lobes["tolerance"], all);
  }
  return all;
}

}  // namespace oriel::validation
