#include "bake/jobs/context.h"

namespace oriel {

void Context::warning(const std::string& message) {
  const std::lock_guard lock(mutex_);
  if (warn) warn(message);
}

void Context::foretell(std::string_view part, double fraction) {
  const std::lock_guard lock(mutex_);
  if (foretold) foretold(part, fraction);
}

void Context::report(std::string_view stage, double fraction, std::uint64_t rays) {
  const std::lock_guard lock(mutex_);
  if (progress) progress({stage, fraction, rays});
}

}  // namespace oriel
