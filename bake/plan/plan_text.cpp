#include <fmt/format.h>

#include <algorithm>

#include "bake/plan/plan.h"

namespace oriel {
namespace {

constexpr std::size_t kShownMaterials = 24;  // by area; JSON has them all

std::string lights_line(const LightCensus& c) {
  if (c.dark) return "none";
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, const char* kind) {
    if (count > 0) parts.push_back(fmt::format("{} {}{}", count, kind, count == 1 ? "" : "s"));
  };
  add(c.points, "point light");
  add(c.spots, "spot light");
  add(c.directionals, "directional light");
  add(c.profiles, "measured profile");
  add(c.emitting_surfaces, "emitting surface");
  if (c.sky != LightCensus::Sky::kNone)
    parts.push_back(c.sky == LightCensus::Sky::kConstant ? "a constant sky" : "a sky image");
  return fmt::format("{}; {:.4g} lm", fmt::join(parts, ", "), c.power_lm);
}

std::string material_line(const MaterialCensus& m) {
  const bool reflects = m.reflectance > 0;
  const std::string alpha = reflects ? fmt::format("alpha {:.3g}", m.alpha) : "",
                    share = reflects ? fmt::format("R(60°) {:.1f} %", 100.0f * m.reflectance) : "";
  std::string line = fmt::format("  {:<24.24} {:<7} {:<13} {:<13} {:>8.1f} m²  seen {:>5.1f} %", m.name,
                                 name_of(m.lobe), alpha, share, m.area_m2, 100 * m.seen);
  if (m.kernel >= 0) line += fmt::format("  kernel {}", m.kernel);
  if (m.normal_map) line += "  normal map";
  if (m.transmission > 0) line += "  transmits";
  if (m.left_out > 0) line += fmt::format("  left out <= {:.2g} %", 100 * m.left_out);
  return line + "\n";
}

std::string materials_text(std::vector<MaterialCensus> materials) {
  std::stable_sort(materials.begin(), materials.end(),
                   [](const MaterialCensus& a, const MaterialCensus& b) { return a.area_m2 > b.area_m2; });
  std::string text = "materials\n";
  for (std::size_t i = 0; i < std::min(kShownMaterials, materials.size()); ++i) text += material_line(materials[i]);
  if (materials.size() > kShownMaterials)
    text += fmt::format("  {} more, see --json\n", materials.size() - kShownMaterials);
  double left_out = 0;
  for (const MaterialCensus& m : materials) left_out += m.left_out;
  return text + fmt::format("  reflections shown without an image: at most {:.2g} % of the light that people see\n",
                            100 * left_out);
}

std::string reflectors_text(const std::vector<ReflectorCensus>& reflectors) {
  if (reflectors.empty()) return {};
  std::string text = "reflectors\n";
  for (const ReflectorCensus& r : reflectors)
    text += fmt::format("  {:<24.24} {:<7} alpha {:<7.3g} R(60°) {:.1f} %  {:.2f} m²\n", r.name,
                        r.planar ? "planar" : "curved", r.alpha, 100.0f * r.reflectance, r.area_m2);
  return text;
}

std::string findings_text(const std::vector<Finding>& findings, std::span<const AllowedFinding> allowed) {
  std::string text = fmt::format("findings   {}\n", findings.empty() ? "none" : std::to_string(findings.size()));
  for (const Finding& f : findings)
    text += fmt::format("  D{} {}, {}{}: {}\n      found     {}\n      expected  {}\n      fix       {}\n",
                        static_cast<int>(f.kind), name_of(f.kind), name_of(severity_of(f.kind)),
                        is_allowed(f, allowed) ? ", allowed" : "", f.object, f.found, f.expected, f.fix);
  return text;
}

std::string prediction_text(const Prediction& p) {
  std::string text = fmt::format("predicted  from a pilot of {:.1f} s on this machine\n", p.pilot_seconds);
  for (const Component& c : p.components)
    text +=
        fmt::format("  {:<12} {:>9.1f} s {:>10.2f} MB   {}\n", c.name, c.seconds, static_cast<double>(c.bytes) * 1e-6,
                    c.error < 0 ? "" : fmt::format("error {:.2g} %", 100 * c.error));
  text += fmt::format("  {:<12} {:>9.1f} s {:>10.2f} MB\n", "all", p.seconds, static_cast<double>(p.bytes) * 1e-6);
  for (const Limit& l : p.limits) text += fmt::format("  {} {}\n", l.holds ? "holds:" : "INFEASIBLE:", l.text);
  return text;
}

}  // namespace

std::string plan_text(const ScenePlan& plan) {
  const Census& c = plan.census;
  std::string text = fmt::format(
      "scene      {}: {} triangles, {} surfaces, {:.3g} x {:.3g} x {:.3g} m, {:.4g} m², people walk on {:.4g} m²\n",
      plan.scene, c.triangles, c.surfaces, c.size_m.x, c.size_m.y, c.size_m.z, c.area_m2, c.walkable_m2);
  text += fmt::format("lights     {}\n", lights_line(c.lights));
  text += materials_text(c.materials) + reflectors_text(c.reflectors);
  for (const bool runs : {true, false}) {
    text += runs ? "modelled\n" : "left out\n";
    for (const StageCensus& s : c.stages) {
      if (s.runs != runs) continue;
      std::string amounts;
      for (const auto& [unit, number] : s.amounts)
        if (runs) amounts += fmt::format("{}{} {}", amounts.empty() ? "" : ", ", unit, number);
      text += fmt::format("  {:<12} {}{}\n", s.name, s.why, amounts.empty() ? "" : " (" + amounts + ")");
    }
  }
  for (const Warning& omission : c.omissions) text += "  - " + omission.text + "\n";
  text += findings_text(plan.findings, plan.allowed);
  if (plan.prediction) text += prediction_text(*plan.prediction);
  return text;
}

}  // namespace oriel
