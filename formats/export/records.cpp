#include <optional>

#include "formats/analysis/leaves.h"
#include "formats/core/color.h"
#include "formats/core/json.h"
#include "formats/export/html.h"
#include "formats/export/sections.h"

namespace oriel::report {
namespace {

std::string dump(const Json& json) {
  return json.sorted().dump();
}

Json parsed(const std::string& text) {
  Json json = Json::parse(text).value_or(Json());
  return json.is_object() ? json : Json::object();
}

// A member of a member …; null where there is none.
Json at(const Json& json, std::initializer_list<const char*> path) {
  const Json* here = &json;
  for (const char* name : path) {
    if (!here->is_object() || !here->contains(name)) return {};
    here = &(*here)[name];
  }
  return *here;
}

std::string percent(const Json& value) {
  return value.is_number() ? fmt::format("{:.3g} %", 100 * value.get<double>()) : "";
}

std::string interval(const Json& value) {
  if (!value.is_array() || value.size() != 2) return {};
  return percent(value[0]) + " to " + percent(value[1]);
}

// Of a triple of lumens, red, green and blue.
std::optional<double> lumens(const Json& value) {
  if (!value.is_array() || value.size() != 3) return {};
  DVec3 rgb(0);
  for (std::size_t c = 0; c < 3; ++c) {
    if (!value[c].is_number()) return {};
    rgb[static_cast<int>(c)] = value[c].get<double>();
  }
  return luminance(rgb);
}

std::string components_html(const Json& plan) {
  Table table({"component", "asked", "stated", "measured", "95 % interval", "of what is seen", "holes"});
  const Json errors = at(plan, {"errors"});
  for (const Json& e : errors.is_array() ? errors : Json::array()) {
    const Json component = at(e, {"component"});
    table.row({component.is_string() ? component.get<std::string>() : dump(component), percent(at(e, {"asked"})),
               percent(at(e, {"stated"})), percent(at(e, {"measured"})), interval(at(e, {"measured_95_interval"})),
               percent(at(e, {"of_seen"})), percent(at(e, {"holes"}))});
  }
  const Json stated = at(plan, {"radiosity", "relative_standard_error"});
  if (table.empty() && stated.is_number()) table.row({"D", "", percent(stated), "", "", "", ""});
  if (table.empty()) return {};
  return "<h2>Errors</h2>\n<p class=\"quiet\">Relative, by component: D what diffuse surfaces show, S what reflectors "
         "do, and how much of it no map saw. Stated: what the bake expects of its own estimate; measured: against "
         "unbiased paths at pixels that it did not know, with the interval that holds the truth 19 times of 20; the "
         "standard error below is one texel's own noise.</p>\n" +
         table.html();
}

std::string with_error(const Json& value, const Json& error) {
  if (!value.is_number()) return {};
  const std::string text = number_text(value.get<double>());
  return error.is_number() && error.get<double>() > 0 ? text + " ± " + number_text(error.get<double>()) : text;
}

// Emitted and what became of it, by particles from the lights, beside the lightmap.
void add_balance(const Json& ledger, Table& table) {
  const auto row = [&](const char* what, const Json& of) {
    table.row({what, with_error(at(of, {"lm"}), at(of, {"standard_error"}))});
  };
  table.row({"emitted", with_error(at(ledger, {"emitted_lm"}), {})});
  row("absorbed", at(ledger, {"absorbed"}));
  row("escaped", at(ledger, {"escaped"}));
  row("lost behind one-sided surfaces", at(ledger, {"lost_behind_surfaces"}));
  row("lost on long paths", at(ledger, {"lost_on_long_paths"}));
  row("kept by surfaces with texels, by particles", at(ledger, {"kept_by_texels", "by_particles"}));
  table.row({"the same, by the lightmap", with_error(at(ledger, {"kept_by_texels", "by_lightmap_lm"}), {})});
}

std::string ledger_html(const Json& plan) {
  const auto emitted = lumens(at(plan, {"scene", "emitted_lm"})),
             incident = lumens(at(plan, {"radiosity", "incident_lm"}));
  const Json ledger = at(plan, {"ledger"});
  if (!emitted && !incident && !ledger.is_object()) return {};
  Table table({"light", "lm"});
  if (emitted) table.row({"emitted by surfaces and lamps", number_text(*emitted)});
  if (incident) table.row({"received by surfaces, over all bounces", number_text(*incident)});
  if (ledger.is_object()) add_balance(ledger, table);
  const std::string off = percent(at(ledger, {"closure"}));
  const std::string closure = off.empty() ? "" : "<p class=\"quiet\">The ledger closes within " + off + ".</p>\n";
  return "<h2>Light</h2>\n" + table.html() + closure;
}

std::string omissions_html(const Json& plan, const Limits& limits) {
  const Json omitted = at(plan, {"omitted"});
  if (!omitted.is_array() || omitted.empty()) return {};
  std::string html = "<h2>Left out by the bake</h2>\n<ul>\n";
  const std::size_t shown = std::min(limits.lines, omitted.size());
  for (std::size_t i = 0; i < shown; ++i)
    html += "<li>" + shown_line(omitted[i].is_string() ? omitted[i].get<std::string>() : dump(omitted[i])) + "</li>\n";
  return html + "</ul>\n" + left_out(omitted.size(), shown, "omissions");
}

std::string leaves_html(const char* title, const std::string& text, const Limits& limits) {
  const auto leaves = leaves_of(text);
  if (leaves.empty()) return {};
  Table table({"name", "value"});
  std::size_t shown = 0;
  for (const auto& [name, value] : leaves) {
    if (shown == limits.lines) break;
    table.row({name, value});
    ++shown;
  }
  return fmt::format("<details><summary>{}</summary>\n", title) + table.html() +
         left_out(leaves.size(), shown, "lines") + "</details>\n";
}

}  // namespace

std::string errors_html(const Pack& pack, const Limits& limits) {
  const Json plan = parsed(pack.plan);
  return components_html(plan) + ledger_html(plan) + omissions_html(plan, limits);
}

std::string records_html(const Pack& pack, const Limits& limits) {
  const std::string html = leaves_html("Provenance: options, inputs, versions", pack.provenance, limits) +
                           leaves_html("Plan: all that the bake says of itself", pack.plan, limits);
  return html.empty() ? "" : "<h2>Records</h2>\n" + html;
}

}  // namespace oriel::report
