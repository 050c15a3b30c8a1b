#include "bake/jobs/context.h"

namespace oriel {

std::vector<std::string> texts_of(const std::vector<Warning>& warnings) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

Result<bool> done_in_time(Context& context, const std::function<bool()>& enough, const std::function<Status()>& work) {
  if (!enough) return work().map([] { return true; });
  const Interruptible until(context, enough);
  const Status ended = work();
  if (ended) return true;
  if (ended.error().code != ErrorCode::kStopped || context.stop) return tl::unexpected(ended.error());
  return false;
}

void Context::warning(const Warning& warning) {
  const std::lock_guard lock(mutex_);
  if (warn) warn(warning);
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
