// Warnings of one kind: the first few in full, the rest as a number.
#pragma once

#include "bake/jobs/context.h"

namespace oriel {

class WarningGroup {
 public:
  static constexpr std::size_t kLimit = 8;

  // `what` completes "3 more …".
  WarningGroup(Context& context, std::string what, WarningCode code)
      : context_(context), what_(std::move(what)), code_(code) {}

  void add(const std::string& message) { add(message, code_); }
  void add(const std::string& message, WarningCode code) {
    if (++count_ <= kLimit) context_.warning(code, message);
  }
  // Call once, after the last add().
  void finish() {
    if (count_ > kLimit) context_.warning(code_, fmt::format("{} more {}", count_ - kLimit, what_));
  }

 private:
  Context& context_;
  std::string what_;
  WarningCode code_;
  std::size_t count_ = 0;
};

}  // namespace oriel
