#include "bake/plan/plan.h"
#include "bake/run/version.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

constexpr int kSchema = 1;  // grows when a field changes its meaning or goes; new fields leave it as it is

const char* text_of(LightCensus::Sky sky) {
  return sky == LightCensus::Sky::kNone ? "none" : sky == LightCensus::Sky::kConstant ? "constant" : "image";
}

Json lights_json(const LightCensus& c) {
  return {{"point", c.points},
          {"spot", c.spots},
          {"directional", c.directionals},
          {"profiles", c.profiles},
          {"emitting_surfaces", c.emitting_surfaces},
          {"emitting_triangles", c.emitting_triangles},
          {"sky", text_of(c.sky)},
          {"power_lm", c.power_lm},
          {"dark", c.dark}};
}

Json materials_json(const std::vector<MaterialCensus>& materials) {
  Json out = Json::array();
  for (const MaterialCensus& m : materials)
    out.push_back({{"name", m.name},
                   {"lobe", name_of(m.lobe)},
                   {"alpha", m.alpha},
                   {"reflectance_60", m.reflectance},
                   {"transmission", m.transmission},
                   {"textured", m.textured},
                   {"normal_map", m.normal_map},
                   {"emits", m.emits},
                   {"area_m2", m.area_m2},
                   {"seen_share", m.seen},
                   {"left_out_share", m.left_out},
                   {"kernel", m.kernel}});
  return out;
}

Json reflectors_json(const std::vector<ReflectorCensus>& reflectors) {
  Json out = Json::array();
  for (const ReflectorCensus& r : reflectors)
    out.push_back({{"name", r.name},
                   {"kind", r.planar ? "planar" : "curved"},
                   {"area_m2", r.area_m2},
                   {"reflectance_60", r.reflectance},
                   {"alpha", r.alpha}});
  return out;
}

Json stages_json(const std::vector<StageCensus>& stages) {
  Json out = Json::array();
  for (const StageCensus& s : stages) {
    Json amounts = Json::object();
    for (const auto& [unit, number] : s.amounts) amounts[unit] = number;
    out.push_back({{"name", s.name}, {"runs", s.runs}, {"why", s.why}, {"amounts", amounts}});
  }
  return out;
}

Json findings_json(const std::vector<Finding>& findings, std::span<const AllowedFinding> allowed) {
  Json out = Json::array();
  for (const Finding& f : findings)
    out.push_back({{"kind", static_cast<int>(f.kind)},
                   {"name", name_of(f.kind)},
                   {"severity", name_of(severity_of(f.kind))},
                   {"allowed", is_allowed(f, allowed)},
                   {"object", f.object},
                   {"found", f.found},
                   {"expected", f.expected},
                   {"fix", f.fix}});
  return out;
}

Json prediction_json(const Prediction& p) {
  Json components = Json::array(), limits = Json::array();
  for (const Component& c : p.components)
    components.push_back({{"name", c.name},
                          {"seconds", c.seconds},
                          {"rays", c.rays > 0 ? Json(c.rays) : Json()},
                          {"bytes", c.bytes},
                          {"error", c.error < 0 ? Json() : Json(c.error)}});
  for (const Limit& l : p.limits)
    limits.push_back(
        {{"option", l.option}, {"asked", l.asked}, {"predicted", l.predicted}, {"holds", l.holds}, {"text", l.text}});
  return {{"pilot_seconds", p.pilot_seconds},
          {"seconds", p.seconds},
          {"bytes", p.bytes},
          {"components", components},
          {"limits", limits}};
}

}  // namespace

std::string plan_as_json(const ScenePlan& plan) {
  const Census& c = plan.census;
  const Json json = {{"schema", kSchema},
                     {"tool", std::string("oriel-bake ") + kVersion},
                     {"scene",
                      {{"file", plan.scene},
                       {"triangles", c.triangles},
                       {"surfaces", c.surfaces},
                       {"size_m", {c.size_m.x, c.size_m.y, c.size_m.z}},
                       {"area_m2", c.area_m2},
                       {"walkable_m2", c.walkable_m2}}},
                     {"lights", lights_json(c.lights)},
                     {"materials", materials_json(c.materials)},
                     {"reflectors", reflectors_json(c.reflectors)},
                     {"stages", stages_json(c.stages)},
                     {"omitted", texts_of(c.omissions)},
                     {"findings", findings_json(plan.findings, plan.allowed)},
                     {"prediction", plan.prediction ? prediction_json(*plan.prediction) : Json()}};
  return json.dump(2) + "\n";
}

}  // namespace oriel
