// D·G, its kernels and equation (4): against closed forms and printed numbers.
#include "study/bastos1999/lobes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "bake/material/slices.h"
#include "formats/core/json.h"

namespace oriel::study {
namespace {

BrdfKernel kernel_of(Facets facets, float alpha) {
  return make_kernel(alpha, [=](double a) { return cook_torrance_lobe(facets, a); });
}

// Narrow, a Gaussian of angles is Beckmann's of slopes; wide, its tail is longer. Seen straight their G is 1 but far
// from the normal.
TEST(CookTorrance, KernelsAreGaussianAndBeckmannWithG) {
  for (const float alpha : {0.01f, 0.1f, 0.3f})
    for (const Facets facets : {Facets::kBeckmann, Facets::kGaussian}) {
      const BrdfKernel kernel = kernel_of(facets, alpha);
      double sum = 0;
      for (const float w : kernel.weights) {
        EXPECT_GE(w, 0);
        sum += double{w};
      }
      EXPECT_NEAR(sum, 1, 1e-5);
      EXPECT_EQ(kernel.weights.size(), std::size_t{kernel.size} * kernel.size);
      EXPECT_TRUE(kernel.slices.empty());
    }
  const BrdfKernel narrow = kernel_of(Facets::kGaussian, 0.01f), slopes = kernel_of(Facets::kBeckmann, 0.01f);
  ASSERT_EQ(narrow.size, slopes.size);
  EXPECT_NEAR(narrow.half_extent, slopes.half_extent, 0.01f * slopes.half_extent);
  for (std::size_t i = 0; i < narrow.weights.size(); ++i) EXPECT_NEAR(narrow.weights[i], slopes.weights[i], 1e-3);
  const BrdfKernel smith =
      make_kernel(0.3f, [](double alpha) { return microfacet_lobe(FacetModel::kBeckmann, alpha); });
  EXPECT_GT(kernel_of(Facets::kGaussian, 0.3f).half_extent, kernel_of(Facets::kBeckmann, 0.3f).half_extent);
  EXPECT_NE(kernel_of(Facets::kBeckmann, 0.3f).weights, smith.weights) << "Smith's G2 is another";
}

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
  const KernelSlice s = make_slice(cook_torrance_lobe(Facets::kBeckmann, m), m, mu);
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

TEST(CookTorrance, LobesHaveTheirCentreAndWidth) {
  const Json cases = cases_named("CTK-lobe");
  if (cases.empty()) GTEST_SKIP() << "ORIEL_VALIDATION is not set";
  for (const Json& c : cases)
    for (const Json& lobe : c["expected"]["cook_torrance_beckmann_vcavity"]) expect_lobe(lobe, c["tolerance"]);
}

TEST(CookTorrance, LobesHaveTheirEnergy) {
  const Json cases = cases_named("CTK-E");
  if (cases.empty()) GTEST_SKIP() << "ORIEL_VALIDATION is not set";
  for (const Json& c : cases)
    for (const auto& [m_text, energies] : c["expected"]["E"].items()) {
      const double m = std::stod(m_text);
      for (std::size_t i = 0; i < energies.size(); ++i) {
        const double mu = c["inputs"]["mu_view"][i].get<double>();
        const KernelSlice s = make_slice(cook_torrance_lobe(Facets::kBeckmann, m), m, mu);
        EXPECT_NEAR(s.albedo, energies[i].get<double>(), c["tolerance"]["abs"].get<double>()) << m << " at " << mu;
      }
    }
}

// Centre = normal, rim = grazing, and equal area: cosθ = 1 - r².
TEST(SphereMaps, HoldWhatTheyAreMadeOf) {
  const auto r_of = [](double c) { return Vec3(static_cast<float>(1 - 0.5 * c)); };
  const SphereMap map = make_sphere_map(64, r_of);
  ASSERT_EQ(map.texels.size(), 64u * 64u);
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      const double px = (x + 0.5) / 32 - 1, py = (y + 0.5) / 32 - 1, r = std::min(1.0, std::hypot(px, py));
      EXPECT_NEAR(map.texels[y * 64 + x].r, r_of(std::cos(2 * std::asin(r / std::sqrt(2.0)))).r, 1e-3);
    }
  EXPECT_EQ(map.texels[0], map.texels[64 * 64 - 1]);  // corners: the rim's value
  EXPECT_EQ(sphere_map_cos_theta(0), 1);
  EXPECT_EQ(sphere_map_cos_theta(1.3f), 0);
  EXPECT_EQ(sphere_lookup(SphereMap{}, 0.5f), Vec3(0));
}

// π F / (π N·L N·V): F seen straight, four times that at 60°, and 1 where it would be more.
TEST(SphereMaps, HoldEquationFour) {
  const SpecularLayers layers{.base = {Vec3(0.04f), 1, 0.09f, {}}};
  const SphereMap map = make_sphere_map(256, [&](double c) { return equation_4(layers, c); });
  const auto at = [&](double cos_theta) { return double{sphere_lookup(map, static_cast<float>(cos_theta)).g}; };
  EXPECT_NEAR(at(1), 0.04, 1e-3);
  for (const double c : {0.9, 0.7, 0.5, 0.4})
    EXPECT_NEAR(at(c), (0.04 + 0.96 * std::pow(1 - c, 5)) / (c * c), 5e-3) << c;
  EXPECT_EQ(at(0.1), 1);
  EXPECT_GT(at(0.5), 3 * specular_reflectance(layers.base, 0.5f).g) << "three times the directional albedo";
}

// Figure 6: a sphere map of gold is red-yellow in the middle and white at the rim; of 64² texels it has few there.
TEST(SphereMaps, GoldTurnsWhiteAtGrazing) {
  const SpecularLayers gold{.base = {Vec3(metal_f0(Metal::kGold)), 1, 0.01f, {.metal = Metal::kGold}}};
  const ExactLayers exact(gold);
  const SphereMap map = make_sphere_map(64, exact);
  const Vec3 centre = map.texels[32 * 64 + 32], rim = exact(0);
  EXPECT_NEAR(centre.r, 0.94f, 0.01);
  EXPECT_NEAR(centre.g, 0.70f, 0.01);
  EXPECT_NEAR(centre.b, 0.40f, 0.01);
  EXPECT_GT(rim.b, 0.9f);
  EXPECT_LT(rim.r - rim.b, 0.1f);
  EXPECT_GT(max_component(glm::abs(sphere_lookup(map, 0.01f) - exact(0.01f))), 1e-3f);
}

}  // namespace
}  // namespace oriel::study
