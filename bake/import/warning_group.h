// Warnings of one kind: the first few in full, the rest as a number.
#pragma once

#include "bake/jobs/context.h"

namespace oriel {

class WarningGroup {
 public:
  static constexpr std::size_t kLimit = 8;

  // `kind` completes "3 more …".
  WarningGroup(Context& context, std::string kind) : context_(context), kind_(std::move(kind)) {}

  void add(const std::string& message) {
    if (++count_ <= kLimit) context_.warning(message);
  }
  // Call once, after the last add().
  void finish() {
    if (count_ > kLimit) context_.warning(fmt::format("{} more {}", count_ - kLimit, kind_));
  }

 private:
  Context& context_;
  std::string kind_;
  std::size_t count_ = 0;
};

}  // namespace oriel
