#include "tests/validation/material/brdf_cases.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/brdf/compensation.h"
#include "bake/brdf/fresnel.h"
#include "bake/brdf/quadrature.h"

namespace oriel::validation {
namespace {

constexpr int kOrder = 64;

double cosine_of(double degrees) {
  return degrees >= 90 ? 0 : std::cos(degrees * kPiD / 180);
}

// Relative or absolute, whichever is wider: the suite's rule.
double tolerance_of(const Json& tolerance, double expected) {
  return std::max(tolerance.value("abs", 0.0), tolerance.value("rel", 0.0) * std::abs(expected));
}

double number(const std::string& text) {
  return std::stod(text);
}

ComplexIndex index_of(const Json& nk) {
  return {nk[0].get<double>(), nk[1].get<double>()};
}

// Appends readings of one case.
class Readings {
 public:
  explicit Readings(const Json& from) : id_(from["id"].get<std::string>()), tolerance_(from["tolerance"]) {}
  void add(const std::string& what, double value, double expected) {
    add(what, value, expected, tolerance_of(tolerance_, expected));
  }
  void add(const std::string& what, double value, double expected, double tolerance) {
    list.push_back({id_ + " " + what, value, expected, tolerance});
  }
  std::vector<FunctionReading> list;

 private:
  std::string id_;
  const Json& tolerance_;
};

void append(std::vector<FunctionReading>& all, const Readings& more) {
  all.insert(all.end(), more.list.begin(), more.list.end());
}

// 2 ∫ F µ dµ.
template <class F>
double cosine_average(const F& f) {
  const GaussRule& rule = gauss_rule(256);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double root = rule.nodes[i], mu = root * root;  // F bends at grazing angles
    sum += rule.weights[i] * 2 * root * 2 * mu * f(mu);
  }
  return sum;
}

void metal_case(const Json& c, std::vector<FunctionReading>& all) {
  Readings r(c);
  for (const char* channel : {"R", "G", "B"}) {
    const ComplexIndex index = index_of(c["inputs"]["nk"][channel]);
    const Json& angles = c["inputs"]["angles_deg"];
    const Json& expected = c["expected"];
    for (std::size_t i = 0; i < angles.size(); ++i)
      r.add(fmt::format("{} {}°", channel, angles[i].dump()),
            fresnel_conductor(index, cosine_of(angles[i].get<double>())),
            expected["F_unpolarised"][channel][i].get<double>());
    if (expected.contains("F0"))
      r.add(std::string("F0 ") + channel, fresnel_conductor(index, 1), expected["F0"][channel].get<double>());
    if (expected.contains("F_s_60")) {
      const PolarisedReflectance at_60 = polarised_reflectance(index, cosine_of(60));
      r.add(std::string("s ") + channel, at_60.s, expected["F_s_60"][channel].get<double>());
      r.add(std::string("p ") + channel, at_60.p, expected["F_p_60"][channel].get<double>());
    }
    if (expected.contains("F_cosine_average"))
      r.add(std::string("average ") + channel, cosine_average([&](double mu) { return fresnel_conductor(index, mu); }),
            expected["F_cosine_average"][channel].get<double>());
  }
  append(all, r);
}

// The metals that materials name hold the suite's constants.
void named_metal(const Json& c, const char* symbol, std::vector<FunctionReading>& all) {
  Readings r(c);
  const auto metal = metal_by_name(symbol);
  if (!metal) return;
  const std::array<const char*, 3> channels{"R", "G", "B"};
  for (std::size_t i = 0; i < 3; ++i)
    r.add(fmt::format("table {} {}", symbol, channels[i]), fresnel_conductor(constants_of(*metal).rgb[i], 1),
          c["expected"]["F0"][channels[i]].get<double>());
  append(all, r);
}

void dielectric_cases(const Suite& suite, std::vector<FunctionReading>& all) {
  const Json& c = suite.find("FRE-diel-a");
  Readings r(c);
  const Json& angles = c["inputs"]["angles_deg"];
  for (const auto& [name, values] : c["expected"]["F_unpolarised"].items()) {
    const double n = number(name);
    for (std::size_t i = 0; i < angles.size(); ++i)
      r.add(fmt::format("n {} {}°", name, angles[i].dump()), fresnel_dielectric(n, cosine_of(angles[i].get<double>())),
            values[i].get<double>());
    r.add("F0 " + name, dielectric_f0(n), c["expected"]["F0"][name].get<double>());
    r.add("average " + name, cosine_average([&](double mu) { return fresnel_dielectric(n, mu); }),
          c["expected"]["F_cosine_average"][name].get<double>());
  }
  append(all, r);
  const Json& inside = suite.find("FRE-int");
  Readings ri(inside);
  for (std::size_t i = 0; i < inside["inputs"]["angles_deg"].size(); ++i)
    ri.add(inside["inputs"]["angles_deg"][i].dump(),
           fresnel_dielectric(inside["inputs"]["n_rel"].get<double>(),
                              cosine_of(inside["inputs"]["angles_deg"][i].get<double>())),
           inside["expected"]["F_unpolarised"][i].get<double>());
  append(all, ri);
}

void schlick_case(const Suite& suite, std::vector<FunctionReading>& all) {
  const Json& c = suite.find("FRE-schlick");
  const std::array<std::pair<const char*, ComplexIndex>, 4> materials{{
      {"n=1.5", {1.5, 0}},
      {"Au R", index_of(suite.find("NK-Au")["inputs"]["nk"]["R"])},
      {"Al G", index_of(suite.find("NK-Al")["inputs"]["nk"]["G"])},
      {"Cr G", index_of(suite.find("NK-Cr")["inputs"]["nk"]["G"])},
  }};
  Readings r(c);
  for (const auto& [name, index] : materials)
    for (std::size_t i = 0; i < c["inputs"]["angles_deg"].size(); ++i) {
      const double mu = cosine_of(c["inputs"]["angles_deg"][i].get<double>());
      r.add(fmt::format("{} {}", name, c["inputs"]["angles_deg"][i].dump()),
            glm::mix(fresnel_conductor(index, 1), 1.0, schlick_weight(mu)) - fresnel_conductor(index, mu),
            c["expected"]["schlick_minus_exact"][name][i].get<double>());
    }
  append(all, r);
}

void extreme_case(const Suite& suite, std::vector<FunctionReading>& all) {
  const Json& c = suite.find("FRE-ext-a");
  Readings r(c);
  for (std::size_t m = 0; m < c["inputs"]["nk"].size(); ++m) {
    const ComplexIndex index = index_of(c["inputs"]["nk"][m]);
    for (std::size_t i = 0; i < c["inputs"]["angles_deg"].size(); ++i) {
      const double angle = c["inputs"]["angles_deg"][i].get<double>();
      const double expected = c["expected"]["F_unpolarised"][m][i].get<double>(),
                   value = fresnel_conductor(index, cosine_of(angle));
      r.add(fmt::format("{} {}°", c["inputs"]["nk"][m].dump(), angle), value, expected);
      if (angle == 90) r.add(fmt::format("{} exactly", c["inputs"]["nk"][m].dump()), value, expected, 0);
    }
  }
  append(all, r);
}

double albedo(const LobeFunction& f_cos, double width, double mu) {
  double sum = 0;
  for_each_reflection(mu, width, kOrder, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
    sum += f_cos(direction_at(mu), wi, h) * solid_angle;
  });
  return sum;
}

LobeFunction smith(FacetModel model, double alpha) {
  return [facets = Microfacet(model, alpha)](const DVec3& wo, const DVec3& wi, const DVec3& h) {
    return facets.f_cos(wo, wi, h);
  };
}

void albedo_case(const Suite& suite, std::vector<FunctionReading>& all) {
  const Json& c = suite.find("MIC-E-a");
  Readings r(c);
  const std::array<std::pair<const char*, std::function<LobeFunction(double)>>, 3> models{{
      {"ggx_smith_height_correlated", [](double a) { return smith(FacetModel::kGgx, a); }},
      {"beckmann_smith_height_correlated", [](double a) { return smith(FacetModel::kBeckmann, a); }},
      {"ggx_smith_separable",
       [](double a) -> LobeFunction {
         return [facets = Microfacet(FacetModel::kGgx, a)](const DVec3& wo, const DVec3& wi, const DVec3& h) {
           return facets.d(h) * facets.g1(wo) * facets.g1(wi) / (4 * wo.z);
         };
       }},
  }};
  for (const auto& [name, model] : models)
    for (const auto& [alpha, values] : c["expected"][name].items())
      for (std::size_t i = 0; i < values.size(); ++i) {
        const double mu = c["inputs"]["mu"][i].get<double>();
        r.add(fmt::format("{} alpha {} mu {}", name, alpha, mu), albedo(model(number(alpha)), number(alpha), mu),
              values[i].get<double>());
      }
  append(all, r);
  const Json& mean = suite.find("MIC-Eavg-a");
  Readings rm(mean);
  for (const auto& [name, model] :
       {std::pair{"E_avg_ggx_corr", FacetModel::kGgx}, {"E_avg_beck_corr", FacetModel::kBeckmann}})
    for (const auto& [alpha, value] : mean["expected"][name].items()) {
      const LobeFunction f = smith(model, number(alpha));
      const GaussRule& rule = gauss_rule(48);
      double sum = 0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double mu = rule.nodes[i] * rule.nodes[i];
        sum += rule.weights[i] * 2 * rule.nodes[i] * 2 * mu * albedo(f, number(alpha), mu);
      }
      rm.add(std::string(name) + " alpha " + alpha, sum, value.get<double>());
    }
  append(all, rm);
}

void split_case(const Suite& suite, std::vector<FunctionReading>& all) {
  const Json& c = suite.find("MIC-DFG");
  Readings r(c);
  for (const auto& [alpha, values] : c["expected"]["A_B"].items())
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double mu = c["inputs"]["mu"][i].get<double>();
      const LobeFunction f = smith(FacetModel::kGgx, number(alpha));
      const double bias = albedo([&](const DVec3& wo, const DVec3& wi,
                                     const DVec3& h) { return f(wo, wi, h) * schlick_weight(glm::dot(wo, h)); },
                                 number(alpha), mu);
      r.add(fmt::format("A alpha {} mu {}", alpha, mu), albedo(f, number(alpha), mu) - bias,
            values[i][0].get<double>());
      r.add(fmt::format("B alpha {} mu {}", alpha, mu), bias, values[i][1].get<double>());
    }
  append(all, r);
}

}  // namespace

std::vector<FunctionReading> fresnel_readings(const Suite& suite) {
  std::vector<FunctionReading> all;
  for (const char* symbol : {"Au", "Cu", "Al", "Cr", "Ni"}) {
    const Json& c = suite.find(std::string("NK-") + symbol);
    metal_case(c, all);
    named_metal(c, symbol, all);
  }
  metal_case(suite.find("NK-Au-fig6"), all);
  dielectric_cases(suite, all);
  schlick_case(suite, all);
  extreme_case(suite, all);
  return all;
}

std::vector<FunctionReading> microfacet_readings(const Suite& suite) {
  std::vector<FunctionReading> all;
  const Json& d = suite.find("MIC-D-a");
  Readings rd(d);
  const Json& g = suite.find("MIC-G-a");
  Readings rg(g);
  for (const auto& [model, d_name, g_name] : {std::tuple{FacetModel::kGgx, "D_ggx", "G1_ggx"},
                                              {FacetModel::kBeckmann, "D_beckmann", "G1_beckmann_exact_erf"}}) {
    for (const auto& [alpha, values] : d["expected"][d_name].items())
      for (std::size_t i = 0; i < values.size(); ++i)
        rd.add(fmt::format("{} alpha {} {}°", d_name, alpha, d["inputs"]["theta_h_deg"][i].dump()),
               Microfacet(model, number(alpha)).d(direction_at(cosine_of(d["inputs"]["theta_h_deg"][i].get<double>()))),
               values[i].get<double>());
    for (const auto& [alpha, values] : g["expected"][g_name].items())
      for (std::size_t i = 0; i < values.size(); ++i)
        rg.add(fmt::format("{} alpha {} mu {}", g_name, alpha, g["inputs"]["mu"][i].dump()),
               Microfacet(model, number(alpha)).g1(direction_at(g["inputs"]["mu"][i].get<double>())),
               values[i].get<double>());
  }
  append(all, rd);
  append(all, rg);
  albedo_case(suite, all);
  split_case(suite, all);
  return all;
}

}  // namespace oriel::validation
