// What `oriel-bake material` prints.
#include <nlohmann/json.hpp>

#include "bake/cli/material/material_arguments.h"
#include "bake/trace/brdf/ward.h"
#include "formats/core/file.h"

namespace oriel {
namespace {

using Json = nlohmann::ordered_json;

Json rgb(const DVec3& v) {
  return Json::array({v.r, v.g, v.b});
}

std::string evaluation_json(const std::vector<Evaluation>& rows) {
  Json out = Json::array();
  for (const Evaluation& r : rows) {
    Json& entry = out.emplace_back(Json{{"angle_deg", r.angle_deg},
                                        {"F", rgb(r.f)},
                                        {"F_schlick_error", rgb(r.f_error)},
                                        {"D", r.d},
                                        {"G1", r.g1},
                                        {"G", r.g2},
                                        {"albedo", rgb(r.albedo)}});
    if (r.compensated) entry["albedo_compensated"] = rgb(*r.compensated);
  }
  return out.dump(2) + "\n";
}

std::string evaluation_table(const std::vector<Evaluation>& rows) {
  std::string text = fmt::format("{:>8} {:>35} {:>13} {:>9} {:>9} {:>35} {:>35} {:>13}\n", "angle", "F (R G B)", "D",
                                 "G1", "G", "albedo (R G B)", "compensated (R G B)", "Schlick - F");
  const auto three = [](const DVec3& v) { return fmt::format("{:11.6g} {:11.6g} {:11.6g}", v.r, v.g, v.b); };
  for (const Evaluation& r : rows) {
    const DVec3 size = glm::abs(r.f_error);
    text += fmt::format("{:8.3f} {} {:13.6g} {:9.6f} {:9.6f} {} {:>35} {:13.2e}\n", r.angle_deg, three(r.f), r.d, r.g1,
                        r.g2, three(r.albedo), r.compensated ? three(*r.compensated) : "-",
                        std::max({size.r, size.g, size.b}));
  }
  return text;
}

std::string fit_table(const std::vector<double>& alphas) {
  std::string text = fmt::format("{:>8} {:>18} {:>14} {:>12} {:>16}\n", "alpha", "exponent*alpha^2", "gain/exponent",
                                 "chi2", "chi2 published");
  for (const double alpha : alphas) {
    const PhongFit fit = fit_phong(alpha);
    text += fmt::format("{:8g} {:18.5f} {:14.6f} {:12.3g} {:16.3g}\n", alpha, fit.phong.exponent * alpha * alpha,
                        fit.phong.gain / fit.phong.exponent, fit.chi2, fit.published_chi2);
  }
  return text;
}

}  // namespace

Status run_material(const MaterialArguments& args) {
  if (args.plot.wanted()) return run_material_plot(args.plot);
  if (!args.evaluate) return print(fit_table(args.fit_alphas));
  const std::vector<Evaluation> rows = evaluate(args.evaluation);
  return print(args.json ? evaluation_json(rows) : evaluation_table(rows));
}

}  // namespace oriel
