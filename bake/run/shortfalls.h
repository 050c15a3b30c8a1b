// Whether a bake is all that was asked for.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bake/run/pipeline.h"
#include "bake/run/time_budget.h"

namespace oriel {

// Keeps what the context is warned of, while it lives, and tells it on.
class WarningLog {
 public:
  WarningLog(Context& context, std::vector<std::string>& warnings) : context_(context), listener_(context.warn) {
    context_.warn = [this, &warnings](const std::string& text) {
      warnings.push_back(text);
      if (listener_) listener_(text);
    };
  }
  ~WarningLog() { context_.warn = std::move(listener_); }
  WarningLog(const WarningLog&) = delete;
  WarningLog& operator=(const WarningLog&) = delete;

 private:
  Context& context_;
  std::function<void(const std::string&)> listener_;
};

// Each warns, and adds why to the shortfalls.

// An error that was named, alone or with a time, is missed; the default one is a wish, and a warning only.
void judge_error(const BakeOptions& options, const RadiosityReport& report, const TimeBudget& budget, Context& context,
                 std::vector<std::string>& shortfalls);
void judge_time(const BakeOptions& options, const TimeBudget& budget, const std::vector<StageTime>& times,
                Context& context, std::vector<std::string>& shortfalls);
// Stages that are not there for want of time, or since the user had enough: omissions and warnings name --time then.
void judge_stages(const BakeResult& result, Context& context, std::vector<std::string>& shortfalls);

}  // namespace oriel
