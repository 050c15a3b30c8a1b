// What a stage may know of its surroundings: threads, progress, stop, seed, warnings. No file, clock or terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/core/hash.h"
#include "formats/core/result.h"

namespace oriel {

struct Progress {
  std::string_view stage;  // "radiosity", …
  double fraction = 0;     // [0,1] of this stage, monotonic
  std::uint64_t rays = 0;  // traced by this stage so far
  double left_s = -1;      // of the whole work, as it is foretold now; negative: nobody knows
};

// What warnings are about, for who sorts them: stable. The manual lists them (docs/pipelines.md#warnings).
inline constexpr std::string_view kWarningCodes =
    "animation-left-out animation-simplified backs-seen bad-number bad-profile bad-sky bad-viewpoint buried-point "
    "cache-unwritable coarser-detail coarser-probes coarser-texels converted coplanar-surfaces degenerate-triangles "
    "dropped-samples duplicate-triangles ended-early energy-ledger error-missed eyes-guessed facing-apart "
    "failed-checks file-damaged idle-option left-out light-groups light-lingers light-units material-value "
    "missing-texcoords missing-texture mover-light mover-still night no-image no-light no-reflections normals-behind "
    "not-oriented object-key plain-charts scene-chosen shared-edges sky-added sun-replaced thin-glass "
    "time-missed time-over too-small trade-incomplete unit-guessed unsupported uv1-faulty uv1-moved";
constexpr bool is_warning_code(std::string_view name) {
  for (std::size_t at = 0; (at = kWarningCodes.find(name, at)) != kWarningCodes.npos; at += name.size())
    if ((at == 0 || kWarningCodes[at - 1] == ' ') &&
        (kWarningCodes.size() == at + name.size() || kWarningCodes[at + name.size()] == ' '))
      return !name.empty();
  return false;
}

class WarningCode {
 public:
  consteval WarningCode(const char* name) : name_(name) {
    if (!is_warning_code(name_)) throw "expected one of kWarningCodes";  // which no compiler takes
  }
  std::string_view name() const { return name_; }
  friend bool operator==(const WarningCode&, const WarningCode&) = default;

 private:
  std::string_view name_;
};

struct Warning {
  std::string text;
  WarningCode code;
  Warning(std::string said, WarningCode of = "left-out") : text(std::move(said)), code(of) {}
  Warning(const char* said, WarningCode of = "left-out") : text(said), code(of) {}
};
std::vector<std::string> texts_of(const std::vector<Warning>& warnings);

class UnitStore;  // units.h

// The wall clock since it was made.
class ElapsedTime {
 public:
  double spent() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }  // seconds

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

// Shared by all stages of one bake. Every member function may be called from any thread.
class Context {
 public:
  int threads = 0;                                // 0: all that the machine has
  std::uint64_t seed = 1;                         // of every random number
  std::function<void(const Progress&)> progress;  // called from one thread at a time; may be empty
  std::function<void(const Warning&)> warn;       // what the user should read; may be empty
  UnitStore* units = nullptr;                     // where finished units of work are kept; null: nowhere
  Hash128 inputs;                   // of all that the stage under way is a function of: what names its units (units.h)
  std::atomic<bool> stop{false};    // set from outside (a signal handler may): stages return kStopped soon
  std::atomic<bool> finish{false};  // set likewise: what can be left out is, and what is there is the result
  std::atomic<bool> finishable{false};  // set by the bake: what is there would make a result

  // Work under way shall end: it is thrown away, or within an Interruptible may stay as it is.
  bool stopped() const { return stop.load(std::memory_order_relaxed) || (enough_ && enough_()); }
  void warning(WarningCode code, std::string text) { warning(Warning(std::move(text), code)); }
  void warning(const Warning& warning);
  void warning(const char* text) = delete;  // it has no code
  void warning(std::string text) = delete;
  void report(std::string_view stage, double fraction, std::uint64_t rays = 0);
  // A part of a stage is under way: how much of its time is over, [0,1], as far as that can be told.
  void foretell(std::string_view part, double fraction);
  std::function<void(std::string_view part, double fraction)> foretold;  // may be empty

 private:
  friend class Interruptible;
  std::mutex mutex_;
  std::function<bool()> enough_;
};

// What a stage runs with, and who counts the rays that it traces. A context alone is one whose rays nobody counts.
struct Stage {
  Stage(Context& of, std::atomic<std::uint64_t>* counter = nullptr) : context(of), rays(counter) {}
  void count(std::uint64_t traced) const {
    if (rays) *rays += traced;
  }
  std::uint64_t traced() const { return rays ? rays->load() : 0; }

  Context& context;
  std::atomic<std::uint64_t>* rays;  // what is traced is added; may be null
};

// While it lives, stopped() is also true once enough() is: for work that may end anywhere. It is made and ends while no
// other thread uses the context; enough() is called from any thread.
class Interruptible {
 public:
  Interruptible(Context& context, std::function<bool()> enough) : context_(context) {
    context_.enough_ = std::move(enough);
  }
  ~Interruptible() { context_.enough_ = nullptr; }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  Context& context_;
};

// Does work that may end anywhere: whether it ended by itself, before enough() was true. Without enough() it does.
Result<bool> done_in_time(Context& context, const std::function<bool()>& enough, const std::function<Status()>& work);

// While it lives, keeps what the context is warned of; and tells it on, or not.
class WarningLog {
 public:
  WarningLog(Context& context, std::vector<Warning>& warnings, bool tell_on = true)
      : context_(context), listener_(std::move(context.warn)) {
    context_.warn = [this, &warnings, tell_on](const Warning& warning) {
      warnings.push_back(warning);
      if (tell_on && listener_) listener_(warning);
    };
  }
  ~WarningLog() { context_.warn = std::move(listener_); }
  WarningLog(const WarningLog&) = delete;
  WarningLog& operator=(const WarningLog&) = delete;

 private:
  Context& context_;
  std::function<void(const Warning&)> listener_;
};

// While it lives, work is a trial: nothing of it is found or kept, so that it takes the time it takes, and none is
// reported.
class Trial {
 public:
  explicit Trial(Context& context)
      : context_(context),
        units_(std::exchange(context.units, nullptr)),
        progress_(std::exchange(context.progress, nullptr)) {}
  ~Trial() { context_.units = units_, context_.progress = std::move(progress_); }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

 private:
  Context& context_;
  UnitStore* units_;
  std::function<void(const Progress&)> progress_;
};

}  // namespace oriel
