// GGX's lobe as printed numbers have it: energy, mean direction, encircled energy.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "bake/material/slices.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

Json cases_named(const std::string& prefix) {
  Json found = Json::array();
  const char* folder = std::getenv("ORIEL_VALIDATION");
  if (folder == nullptr) return found;
  std::ifstream file(std::string(folder) + "/brdf_fresnel.json");
  const Json suite = Json::parse(std::string(std::istreambuf_iterator<char>(file), {})).value();
  for (const Json& c : suite["cases"])
    if (c["id"].get<std::string>().rfind(prefix, 0) == 0) found.push_back(c);
  return found;
}

// Linear in the table of shares.
double encircled(const KernelSlice& s, double gamma_deg) {
  const double u = 2 * std::tan(gamma_deg * kPiD / 360);
  const double last = static_cast<double>(s.radial.size() - 1),
               at = std::min(std::sqrt(u / s.radial_extent) * last, last);
  const auto i = std::min(static_cast<std::size_t>(at), s.radial.size() - 2);
  return s.radial[i] + (at - static_cast<double>(i)) * (s.radial[i + 1] - s.radial[i]);
}

void expect_lobe(const Json& expected, const Json& tolerance) {
  const double m = expected["m"].get<double>(), mu = expected["mu"].get<double>();
  const KernelSlice s = make_slice(microfacet_lobe(FacetModel::kGgx, m), m, mu);
  const double fraction = tolerance["abs_fraction"].get<double>();
  EXPECT_NEAR(s.albedo, expected["E"].get<double>(), fraction) << m << " at " << mu;
  EXPECT_NEAR((std::asin(mu) + s.tilt_rad) * 180 / kPiD, expected["mean_elev_deg"].get<double>(),
              tolerance["abs_deg"].get<double>())
      << m << " at " << mu;
  for (const auto& [degrees, share] : expected["encircled_energy_fraction"].items()) {
    if (share.get<double>() >= s.radial.back()) continue;  // beyond what the table holds
    EXPECT_NEAR(encircled(s, std::stod(degrees)), share.get<double>(), fraction)
        << m << " at " << mu << ": " << degrees;
  }
}

TEST(KernelCases, LobesHaveTheirCentreAndWidth) {
  const Json cases = cases_named("CTK-lobe");
  if (cases.empty()) GTEST_SKIP() << "ORIEL_VALIDATION is not set";
  for (const Json& c : cases)
    for (const Json& lobe : c["expected"]["ggx_smith_corr"]) expect_lobe(lobe, c["tolerance"]);
}

}  // namespace
}  // namespace oriel
