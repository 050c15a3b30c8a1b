#include "bake/run/shortfalls.h"

#include <algorithm>

namespace oriel {
namespace {

constexpr double kWorse = 1.3;  // times the error that was stated, which is worth a warning

void fall_short(const Warning& why, Context& context, std::vector<Warning>& shortfalls) {
  shortfalls.push_back(why);
  context.warning(why);
}

}  // namespace

void judge_error(const BakeOptions& options, const RadiosityReport& report, const TimeBudget& budget, Context& context,
                 std::vector<Warning>& shortfalls) {
  const double asked = options.radiosity.error, stated = report.relative_error;
  const HeldOutError& c = report.held_out_error;
  if (asked <= 0 || context.finish) return;
  const bool named = options.error_named;
  const auto tell = [&](const std::string& text) {
    if (named) {
      fall_short({text, "error-missed"}, context, shortfalls);
    } else {
      context.warning("error-missed", text);
    }
  };
  if (c.error_low > kWorse * std::max(asked, report.stated()))
    tell(
        fmt::format("the lightmap's measured error is {:.3g} % ({:.3g} to {:.3g} %), {}stated is {:.3g} %: light "
                    "varies more within "
                    "texels than they tell; --texel makes those finer",
                    100 * c.relative_error, 100 * c.error_low, 100 * c.error_high,
                    named ? fmt::format("asked for was {:.3g} % and ", 100 * asked) : "", 100 * stated));
  if (stated <= 1.25 * asked) return;
  if (report.ended_early) {
    if (budget.limited() && (named || asked > kBestError))
      tell(
          fmt::format("--error {:.3g} % was not reached within --time {:.4g} s: the lightmap's stated error is {:.3g} "
                      "%, {:.2g} times too much; give it more time, or a larger --texel",
                      100 * asked, options.time_s, 100 * stated, stated / asked));
    return;
  }
  if (report.out_of_rays)
    return tell(
        fmt::format("the lightmap's stated error is {:.3g} %: the default of {:.3g} % takes more than a bake's first "
                    "minutes; --error {:.3g}% goes on until it is there",
                    100 * stated, 100 * asked, 100 * asked));
  tell(
      fmt::format("the lightmap's stated error is {:.3g} %, asked for was {:.3g} %: some texels stay noisy at {} rays "
                  "each, or lie where light changes within a texel; --texel makes those finer",
                  100 * stated, 100 * asked, options.radiosity.samples));
}

void judge_time(const BakeOptions& options, const TimeBudget& budget, const std::vector<StageTime>& times,
                Context& context, std::vector<Warning>& shortfalls) {
  if (!budget.missed()) return;
  const auto longest = std::max_element(times.begin(), times.end(),
                                        [](const StageTime& a, const StageTime& b) { return a.seconds < b.seconds; });
  fall_short({fmt::format("--time {:.4g} s was missed by {:.3g} s: '{}' alone took {:.3g} s, its first estimate cannot "
                          "end earlier; a larger --texel takes less",
                          options.time_s, budget.spent() - options.time_s, longest->stage, longest->seconds),
              "time-missed"},
             context, shortfalls);
}

void judge_stages(const BakeResult& result, Context& context, std::vector<Warning>& shortfalls) {
  if (context.finish)
    fall_short(
        {fmt::format("the bake ended early, as asked: the pack holds what was there, with the error that is stated{}",
                     context.units ? "; the same command again goes on from the cache" : ""),
         "ended-early"},
        context, shortfalls);
  for (const auto* all : {&result.omissions, &result.warnings})
    for (const Warning& one : *all)
      if (one.code == "time-over") shortfalls.push_back(one);
}

std::function<bool()> refined_enough(const BakeOptions& options, const TimeBudget& budget, double later,
                                     const Context& context) {
  const double verifying = kSlowPaths * options.radiosity.verify;
  return [=, &budget, &finish = context.finish, begun = budget.spent()] {
    return finish || budget.left() <= later + verifying * (budget.spent() - begun);
  };
}

}  // namespace oriel
