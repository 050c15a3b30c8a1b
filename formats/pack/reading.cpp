#include "formats/pack/reading.h"

#include <mutex>

#include "formats/core/parallel.h"

namespace oriel {

Status first_failure(std::size_t count, std::uint64_t bytes, const std::function<Status(std::size_t)>& work) {
  constexpr std::uint64_t kSmall = 1 << 20;  // bytes that take less time than starting a thread
  std::mutex of_first;
  std::size_t first = count;
  Status error;
  for_each_parallel(count, bytes < kSmall ? 1 : core_count(), [&](std::size_t i) {
    if (const std::lock_guard lock(of_first); i > first) return;
    Status status = work(i);
    if (status) return;
    const std::lock_guard lock(of_first);
    if (i < first) first = i, error = std::move(status);
  });
  return error;
}

Status refuse_errors(const std::vector<Issue>& issues) {
  for (const auto& issue : issues)
    if (issue.severity == Severity::kError) return invalid(issue.section, "issue {}: {}", issue.number, issue.message);
  return {};
}

tl::unexpected<Error> in_file(const std::string& path, Error error) {
  error.where = error.where.empty() ? path : path + ": " + error.where;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace oriel
