// Units of work: parts of a stage that are pure functions of their inputs, so that who knows the inputs knows the
// result. Finished ones are kept by a store and need never be computed again, by whomever.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string_view>

#include "bake/jobs/context.h"
#include "formats/core/archive.h"

namespace oriel {

struct KeptUnit {
  Bytes results;
  double seconds = 0;  // that computing it took
};

// What of a bake's units was found and what was computed.
struct UnitShare {
  std::uint64_t reused = 0, computed = 0;
  double reused_s = 0, computed_s = 0;  // wall clock of each unit, added up over threads: what they take or once took

  std::uint64_t units() const { return reused + computed; }
  double work() const { return reused_s + computed_s > 0 ? reused_s / (reused_s + computed_s) : 0; }
};

// Finished units by the hash of their inputs. Every function may be called from any thread. None fails: what cannot be
// kept or found is computed.
class UnitStore {
 public:
  virtual ~UnitStore() = default;
  virtual std::optional<KeptUnit> find(const Hash128& name) = 0;
  // Whether the caller is to compute it, and to end that by keep() or leave(). False: someone else is at it.
  virtual bool claim(const Hash128& name) = 0;
  virtual void keep(const Hash128& name, const KeptUnit& unit) = 0;
  virtual void leave(const Hash128& name) = 0;
  // As find(), but not counted in share(): who looks may compute it all the same.
  virtual std::optional<Bytes> peek(const Hash128&) { return std::nullopt; }
  virtual UnitShare share() const = 0;
};

// While it lives, the units of loops are named by these inputs of their stage too.
class StageInputs {
 public:
  template <class... T>
  explicit StageInputs(Context& context, const T&... inputs) : context_(context), before_(context.inputs) {
    if (context.units) context.inputs = hash_of(inputs..., context.seed);
  }
  ~StageInputs() { context_.inputs = before_; }
  StageInputs(const StageInputs&) = delete;
  StageInputs& operator=(const StageInputs&) = delete;

 private:
  Context& context_;
  Hash128 before_;
};

// A loop whose items are computed or found.
struct UnitLoop {
  std::string_view stage = {};  // for progress, and to name the units apart from other loops'
  std::size_t count = 0;        // of items
  double rays = 0;              // that an item takes, about: says how many of them make a unit
  // What an item is a function of, beside its stage's inputs: its number, its part of the data, the results before
  // where compute() adds to them.
  std::function<void(std::size_t, Archive&)> inputs = {};
  // Fills the results of an item and returns the rays traced; called from any thread, in no particular order.
  std::function<std::uint64_t(std::size_t)> compute = {};
  // All that compute() fills, to be written or read back.
  std::function<void(std::size_t, Archive&)> results = {};
};

// parallel_for over the items that no store holds. The results are the same with any store and any number of threads.
// Units that others have claimed are waited for, last. The rays counted are those that computing all items takes or
// took. Error kStopped.
Status parallel_units(const Stage& stage, const UnitLoop& loop);

// Fills an item's results with those that this loop had under other stage inputs, where the store has them: of loops
// whose items are units of their own (`rays` at least those of a unit). Whether they were there.
bool recall_item(Context& context, const Hash128& inputs, const UnitLoop& loop, std::size_t item);

// One unit that is computed by work in parallel of its own: compute() fills what results() writes or reads, and
// inputs() names. An error of compute() is returned, and nothing kept.
Status one_unit(Context& context, std::string_view stage, const std::function<void(Archive&)>& inputs,
                const std::function<Status()>& compute, const std::function<void(Archive&)>& results);

}  // namespace oriel
