#include "bake/cli/requirements.h"

#include <algorithm>

#include "formats/core/text.h"

namespace oriel {
namespace {

Status require(const std::string& word, Requirements& out, BakeSession& session) {
  constexpr std::string_view kError = "error<=";
  if (word.starts_with(kError)) {
    ORIEL_TRY(out.error, parse_share(word.substr(kError.size())));
  } else if (word == "nothing") {
    out.whole = false;
  } else if (word == "light") {
    session.errors.emplace_back("no-light");
  } else if (word == "textures") {
    session.errors.emplace_back("missing-texture");
  } else if (word == "reflections") {
    out.reflections = true;
  } else if (word == "sound") {
    out.sound = true;
  } else {
    return fail(ErrorCode::kUsage, "",
                "found '{}', expected error<=SHARE, light, textures, reflections, sound or nothing", word);
  }
  out.given.push_back(word);
  return {};
}

// What the lightmap's error is: the larger one of what it states and what paths measured, where that is not noise.
Status judge_error(double most, const RadiosityReport& report, BakeSession& session) {
  const HeldOutError& measured = report.held_out_error;
  const bool told = measured.pixels > 0 && measured.error_low > 0;
  const double error = std::max(report.stated(), told ? measured.relative_error : 0);
  const std::string text = fmt::format("{:.3g} % (stated {:.3g} %{})", 100 * error, 100 * report.stated(),
                                       measured.pixels > 0 ? ", measured " + measured_text(measured) : std::string());
  if (error > most)
    return fail(kUnmet, "", "misses --require: found an error of {}, expected at most {:.3g} %", text, 100 * most);
  session.note(
      fmt::format("required: the error is {}, {:.3g} % below {:.3g} %", text, 100 * (most - error), 100 * most));
  return {};
}

}  // namespace

OptionValue requirements(Requirements& out, BakeSession& session) {
  return {"LIST",
          [&](const std::string& typed) -> Status {
            for (std::size_t at = 0; at <= typed.size();) {
              const std::size_t comma = std::min(typed.find(',', at), typed.size());
              ORIEL_TRY_VOID(require(typed.substr(at, comma - at), out, session));
              at = comma + 1;
            }
            return {};
          },
          [&out] {
            std::string all;
            for (const std::string& word : out.given) add_word(all, word, ",");
            return all;
          }};
}

std::string measured_text(const HeldOutError& c) {
  if (c.error_low <= 0)
    return fmt::format("at most {:.2g} % (less is hidden by the noise of its paths)", 100 * c.error_high);
  return fmt::format("{:.2g} % ({:.2g} to {:.2g} %)", 100 * c.relative_error, 100 * c.error_low, 100 * c.error_high);
}

Status judge(const Requirements& required, const BakeResult& result, BakeSession& session) {
  if (!result.left_out.empty()) return fail(kIncomplete, "", "is without {}", result.left_out[0]);
  if (required.whole && !result.shortfalls.empty())
    return fail(kIncomplete, "", "is less than what was asked for: {} (--require nothing takes it)",
                result.shortfalls[0].text);
  if (required.error > 0) ORIEL_TRY_VOID(judge_error(required.error, result.radiosity, session));
  for (const Warning& omission : result.omissions)
    if (required.reflections && omission.code == "no-reflections")
      return fail(kUnmet, "", "misses --require reflections: {}", omission.text);
  if (required.sound && !result.findings.empty())
    return fail(kUnmet, "", "misses --require sound: {}", result.findings[0].text);
  return {};
}

}  // namespace oriel
