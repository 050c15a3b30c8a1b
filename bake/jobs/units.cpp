#include "bake/jobs/units.h"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <numeric>
#include <thread>

#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr double kRaysAUnit = 1 << 17;  // a tenth of a second of one CPU: a thousand times what storing them takes
constexpr auto kPatience = std::chrono::milliseconds(20);  // between looks at what others are computing

// What no inputs of a stage name is computed, not kept: units of other scenes would have the same names.
bool keeps(const Context& context) {
  return context.units && context.inputs != Hash128();
}

// The i-th of `count` items in an order that spreads over all of them, so that what is done of a loop that ends early
// is everywhere: multiples of the golden section (Weyl).
class Scattered {
 public:
  explicit Scattered(std::size_t count)
      : count_(count), step_(static_cast<std::size_t>((std::numbers::phi - 1) * static_cast<double>(count)) | 1) {
    while (std::gcd(step_, count_) > 1) ++step_;
  }
  std::size_t operator[](std::size_t i) const { return i * step_ % count_; }

 private:
  std::size_t count_, step_;
};

// Fills what `write` writes from bytes that it wrote once. Where they are not those, all stays as it was.
bool restore(const Bytes& from, const std::function<void(Archive&)>& write) {
  Bytes before;
  Archive saved(before);
  write(saved);
  Archive archive{std::span<const std::byte>(from)};
  write(archive);
  if (archive.complete()) return true;
  Archive undo{std::span<const std::byte>(before)};
  write(undo);
  return false;
}

Bytes written(const std::function<void(Archive&)>& write) {
  Bytes bytes;
  Archive archive(bytes);
  write(archive);
  return bytes;
}

// The units of a loop: runs of its items.
class Units {
 public:
  Units(const Stage& stage, const UnitLoop& loop) : stage_(stage), context_(stage.context), loop_(loop) {
    side_ = static_cast<std::size_t>(std::clamp(kRaysAUnit / std::max(loop.rays, 1.0), 1.0, 1e9));
  }

  std::size_t count() const { return (loop_.count + side_ - 1) / side_; }

  bool recall(std::size_t unit, const Hash128& inputs) {
    const std::optional<Bytes> kept = context_.units->peek(name_of(unit, inputs));
    std::uint64_t traced = 0;
    return kept && restore(*kept, [&](Archive& a) { results(unit, traced, a); });
  }

  // False: someone else is computing it.
  bool finish(std::size_t unit) {
    const Hash128 name = name_of(unit, context_.inputs);
    if (take(unit, name)) return true;
    if (!context_.units->claim(name)) return false;
    if (take(unit, name)) {  // it was finished in between
      context_.units->leave(name);
      return true;
    }
    const ElapsedTime clock;
    std::uint64_t traced = 0;
    for (std::size_t i = first(unit); i < last(unit) && !context_.stopped(); ++i) traced += loop_.compute(i);
    stage_.count(traced);
    if (context_.stopped())
      context_.units->leave(name);  // it may be a part only
    else
      context_.units->keep(name, {written([&](Archive& a) { results(unit, traced, a); }), clock.spent()});
    return true;
  }

 private:
  std::size_t first(std::size_t unit) const { return unit * side_; }
  std::size_t last(std::size_t unit) const { return std::min(loop_.count, (unit + 1) * side_); }

  Hash128 name_of(std::size_t unit, const Hash128& inputs) const {
    Hasher hasher;
    Archive archive(hasher);
    archive(inputs, std::string(loop_.stage), last(unit) - first(unit));
    for (std::size_t i = first(unit); i < last(unit); ++i) loop_.inputs(i, archive);
    return hasher.result();
  }

  void results(std::size_t unit, std::uint64_t& traced, Archive& archive) const {
    archive(traced);
    for (std::size_t i = first(unit); i < last(unit); ++i) loop_.results(i, archive);
  }

  bool take(std::size_t unit, const Hash128& name) {
    const std::optional<KeptUnit> kept = context_.units->find(name);
    std::uint64_t traced = 0;
    if (!kept || !restore(kept->results, [&](Archive& a) { results(unit, traced, a); })) return false;
    stage_.count(traced);
    return true;
  }

  Stage stage_;
  Context& context_;
  const UnitLoop& loop_;
  std::size_t side_;  // items of a unit
};

}  // namespace

Status parallel_units(const Stage& stage, const UnitLoop& loop) {
  Context& context = stage.context;
  if (!keeps(context)) {
    const Scattered item(loop.count);
    ORIEL_TRY_VOID(
        parallel_for(stage, loop.stage, loop.count, [&](std::size_t i) { stage.count(loop.compute(item[i])); }));
    // An item may have ended meanwhile with half of its work.
    return context.stopped() ? fail(ErrorCode::kStopped, std::string(loop.stage), "stopped") : Status();
  }
  Units units(stage, loop);
  std::vector<std::uint8_t> finished(units.count());
  const Scattered unit(units.count());
  ORIEL_TRY_VOID(parallel_for(stage, loop.stage, units.count(),
                              [&](std::size_t i) { finished[unit[i]] = units.finish(unit[i]); }));
  for (;;) {
    if (context.stopped()) return fail(ErrorCode::kStopped, std::string(loop.stage), "stopped");
    std::vector<std::size_t> left;
    for (std::size_t u = 0; u < finished.size(); ++u)
      if (!finished[u]) left.push_back(u);
    if (left.empty()) return {};
    std::this_thread::sleep_for(kPatience);
    ORIEL_TRY_VOID(
        parallel_for(context, "", left.size(), [&](std::size_t i) { finished[left[i]] = units.finish(left[i]); }));
  }
}

bool recall_item(Context& context, const Hash128& inputs, const UnitLoop& loop, std::size_t item) {
  return context.units && Units(context, loop).recall(item, inputs);
}

Status one_unit(Context& context, std::string_view stage, const std::function<void(Archive&)>& inputs,
                const std::function<Status()>& compute, const std::function<void(Archive&)>& results) {
  if (!keeps(context)) return compute();
  Hasher hasher;
  Archive archive(hasher);
  archive(context.inputs, std::string(stage));
  inputs(archive);
  const Hash128 name = hasher.result();
  const auto take = [&] {
    const auto kept = context.units->find(name);
    return kept && restore(kept->results, results);
  };
  for (;; std::this_thread::sleep_for(kPatience)) {
    if (take()) return {};
    if (context.stopped()) return fail(ErrorCode::kStopped, std::string(stage), "stopped");
    if (context.units->claim(name)) break;
  }
  if (take()) {  // it was finished in between
    context.units->leave(name);
    return {};
  }
  const ElapsedTime clock;
  const Status status = compute();
  if (status && !context.stopped())
    context.units->keep(name, {written(results), clock.spent()});
  else
    context.units->leave(name);
  return status;
}

}  // namespace oriel
