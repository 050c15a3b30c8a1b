#include "bake/run/forecast.h"

#include <algorithm>
#include <iterator>

namespace oriel {
namespace {

// Of the time of the first light: refinement, which may end soon, and detail, which looks for light on points as that
// does; and of the time of light and refinement. Measured 0.4 to 4.2, 0.5 to 2.2 and 0.07 to 0.16 on rooms, houses and
// halls.
// Rather long than short: what is told can hurry, but not rise.
constexpr double kRefinement = 1.8, kDetail = 1.1, kVerification = 0.12;
constexpr double kOverdue = 0.1;  // of what was foretold, where a part takes longer than that
constexpr double kTrusted = 0.3;  // of a part, after which what it took tells the rest

std::size_t index_of(std::string_view part) {
  const auto* const found = std::find(std::begin(Forecast::kParts), std::end(Forecast::kParts), part);
  return static_cast<std::size_t>(found - std::begin(Forecast::kParts));
}

}  // namespace

void Forecast::expect(std::string_view part, double seconds) {
  if (const std::size_t i = index_of(part); i != kNone) expected_s_[i] = std::max(seconds, 0.0);
}

void Forecast::at(std::string_view part, double done, double now_s) {
  const std::size_t i = index_of(part);
  if (i == kNone || (current_ != kNone && i < current_)) return;  // what comes out of turn is nobody's
  if (i != current_) {
    if (current_ != kNone) took_s_[current_] = now_s - begun_s_;
    current_ = i;
    begun_s_ = now_s;
    done_ = 0;
  }
  done_ = std::max(done_, std::clamp(done, 0.0, 1.0));
  told_s_ = now_s;
}

double Forecast::expected(std::size_t part) const {
  const auto time_of = [&](std::string_view other) {
    const std::size_t i = index_of(other);
    return took_s_[i] > 0 ? took_s_[i] : expected(i);
  };
  if (kParts[part] == "refinement") return kRefinement * time_of("first light");
  if (kParts[part] == "detail") return kDetail * time_of("first light");
  if (kParts[part] == "verification") return kVerification * (time_of("first light") + time_of("refinement"));
  return expected_s_[part];
}

double Forecast::of_current(double now_s) const {
  const double foretold = expected(current_), spent = now_s - begun_s_;
  const double by_clock = std::max(foretold - spent, kOverdue * foretold);
  if (done_ <= 0) return by_clock;
  if (done_ >= 1) return 0;
  const double by_share = (told_s_ - begun_s_) * (1 - done_) / done_;
  const double trust = foretold > 0 ? std::min(done_ / kTrusted, 1.0) : 1.0;
  const double at_told = trust * by_share + (1 - trust) * std::max(foretold * (1 - done_), 0.0);
  return std::max(at_told - (now_s - told_s_), kOverdue * at_told);
}

std::optional<double> Forecast::left(double now_s) const {
  const std::size_t light = index_of("first light");
  if (current_ == kNone || (current_ < light && expected_s_[light] <= 0)) return std::nullopt;
  if (done_ <= 0 && expected(current_) <= 0 && current_ < light) return std::nullopt;
  double sum = of_current(now_s);
  for (std::size_t i = current_ + 1; i < kCount; ++i) sum += expected(i);
  return sum;
}

}  // namespace oriel
