#include "trade/table.h"

#include <cmath>
#include <thread>

#include "formats/core/json.h"
#include "trade/front.h"

namespace oriel::trade {
namespace {

// Of all cameras together.
Json summary_json(const Measures& m) {
  Json json = Json::object();
  const auto put = [&](const char* name, const std::optional<double>& value) {
    if (value) json[name] = *value;
  };
  put("sum", frame_error(m, &CameraError::sum));
  put("D", frame_error(m, &CameraError::diffuse));
  put("S", specular_error(m));
  put("noise", frame_error(m, &CameraError::noise));
  put("flip", mean_flip(m));
  put("psnr_db", psnr(m));
  return json;
}

Json row_json(const Row& row) {
  const Configuration& c = row.configuration;
  Json json = {{"knob", c.knob},
               {"setting", c.setting},
               {"bake_options", options_text(c.bake)},
               {"play_options", options_text(c.play)},
               {"preview_options", options_text(c.preview)},
               {"paths", c.paths}};
  json.update(as_json(row.measures));
  json["all_frames"] = summary_json(row.measures);
  json["fronts"] = row.fronts;
  if (!row.failure.empty()) json["failure"] = row.failure;
  return json;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out(1, '"');
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
  return out;
}

std::string csv_row(const Row& row) {
  const Configuration& c = row.configuration;
  const Measures& m = row.measures;
  std::string line = fmt::format("{},{},{},{},{}", quoted(c.knob), quoted(c.setting), quoted(options_text(c.bake)),
                                 quoted(options_text(c.play)), c.paths);
  for (const Quantity& quantity : quantities()) {
    line += ',';
    const auto value = quantity.value(m);
    if (value && *value == std::floor(*value))
      line += fmt::format("{:.0f}", *value);
    else if (value)
      line += fmt::format("{:.6g}", *value);
  }
  std::string fronts;
  for (const std::string& front : row.fronts) fronts += fmt::format("{}{}", fronts.empty() ? "" : " ", front);
  return fmt::format("{},{},{}\r\n", line, fronts, quoted(row.failure));
}

}  // namespace

std::string options_text(const Settings& settings) {
  std::string text;
  for (const auto& [option, value] : settings) text += fmt::format("{}{} {}", text.empty() ? "" : " ", option, value);
  return text;
}

std::string trade_json(const Trade& trade) {
  Json rows = Json::array(), fronts = Json::object();
  for (const Row& row : trade.rows) rows.push_back(row_json(row));
  for (const FrontKind& kind : front_kinds()) {
    fronts[kind.id] = {{"cost", kind.cost_label}, {"error", kind.error_label}, {"configurations", Json::array()}};
    for (std::size_t i = 0; i < trade.rows.size(); ++i)
      for (const std::string& front : trade.rows[i].fronts)
        if (front == kind.id) fronts[kind.id]["configurations"].push_back(i);
  }
  const Json json = {{"scene", trade.scene},
                     {"threads", std::thread::hardware_concurrency()},
                     {"cameras", trade.facts.cameras},
                     {"reference",
                      {{"bake_options", options_text(trade.plan.reference)},
                       {"paths", trade.plan.reference_paths},
                       {"width", trade.plan.width},
                       {"height", trade.plan.height}}},
                     {"timed_frames", {{"width", trade.width}, {"height", trade.height}, {"drawn", trade.frames}}},
                     {"skipped", trade.plan.skipped},
                     {"unfinished", trade.left},
                     {"configurations", rows},
                     {"fronts", fronts}};
  return json.dump(1) + "\n";
}

std::string trade_csv(const Trade& trade) {
  std::string text = "knob,setting,bake_options,play_options,paths";
  for (const Quantity& quantity : quantities()) text += fmt::format(",{}", quantity.name);
  text += ",fronts,failure\r\n";
  for (const Row& row : trade.rows) text += csv_row(row);
  return text;
}

}  // namespace oriel::trade
