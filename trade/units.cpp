#include "trade/units.h"

#include <cmath>

namespace oriel::trade {

Result<Measures> Units::once(const std::string& kind, const std::string& label, const std::string& key,
                             const std::function<Result<Measures>()>& work) {
  if (const auto known = done_.find(key); known != done_.end()) return known->second;
  all_.insert(key);
  if (auto found = store_.find(key)) {
    if (counting_) return *found;
    ++reused_;
    ++finished_;
    return done_[key] = std::move(*found);
  }
  if (counting_) {
    kinds_[kind].missing.insert(key);
    return Measures{};
  }
  if (over()) return done_[key] = Measures{};
  ++started_;
  note_(fmt::format("{} of {}: {}{}", started_ + reused_, all_.size(), label, time_left()));
  const auto start = Clock::now();
  Result<Measures> measured = work();
  Kind& own = kinds_[kind];
  own.missing.erase(key);
  if (!measured && measured.error().code == ErrorCode::kStopped) return done_[key] = Measures{};
  if (!measured) return measured;
  own.seconds += seconds_since(start);
  ++own.count;
  ORIEL_TRY_VOID(store_.keep(key, *measured));
  ++finished_;
  return done_[key] = std::move(*measured);
}

// By the mean of each kind; of kinds of which none has run yet by that of all.
std::string Units::time_left() const {
  double seconds = 0, count = 0, left = 0;
  for (const auto& [name, kind] : kinds_) seconds += kind.seconds, count += kind.count;
  if (count == 0) return "";
  for (const auto& [name, kind] : kinds_)
    left += static_cast<double>(kind.missing.size()) * (kind.count > 0 ? kind.seconds / kind.count : seconds / count);
  if (left < 100) return fmt::format(" (about {:.0f} s left)", left);
  return fmt::format(" (about {:.0f} min left)", std::ceil(left / 60));
}

}  // namespace oriel::trade
