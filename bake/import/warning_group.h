// Warnings of one kind: the first few in full, the rest as a number.
#pragma once

#include "bake/jobs/context.h"

namespace oriel {

class WarningGroup {
 public:
  static constexpr std::size_t kLimit = 8;

  // `what` completes "3 more …".
  WarningGroup(Context& context, std::string what, WarningKind kind = WarningKind::kOther)
      : context_(context), what_(std::move(what)), kind_(kind) {}

  void add(const std::string& message) { add(message, kind_); }
  void add(const std::string& message, WarningKind kind) {
    if (++count_ <= kLimit) context_.warning({message, kind});
  }
  // Call once, after the last add().
  void finish() {
    if (count_ > kLimit) context_.warning({fmt::format("{} more {}", count_ - kLimit, what_), kind_});
  }

 private:
  Context& context_;
  std::string what_;
  WarningKind kind_;
  std::size_t count_ = 0;
};

}  // namespace oriel
