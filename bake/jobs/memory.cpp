#include "bake/jobs/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace oriel {
namespace {

// The first number of a file; none where there is no such file or no number ("max").
bool read_number(const char* path, std::uint64_t& number) {
  std::ifstream file(path);
  return static_cast<bool>(file >> number);
}

}  // namespace

std::uint64_t free_memory() {
  std::uint64_t free = std::numeric_limits<std::uint64_t>::max();
  std::ifstream info("/proc/meminfo");
  for (std::string word; info >> word;)
    if (std::uint64_t kib = 0; word == "MemAvailable:" && info >> kib) free = kib * 1024;
  // Version 2 and version 1 of control groups.
  for (const auto& [limit_path, used_path] :
       {std::pair{"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"},
        std::pair{"/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"}})
    if (std::uint64_t limit = 0, used = 0; read_number(limit_path, limit) && read_number(used_path, used))
      free = std::min(free, limit - std::min(limit, used));
  return free == std::numeric_limits<std::uint64_t>::max() ? 0 : free;
}

}  // namespace oriel
