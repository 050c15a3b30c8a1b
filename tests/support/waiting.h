// What tests wait for: conditions, never a time. A busy machine may take any.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

namespace oriel::testing {

// Asks again and again. False: not within minutes, which is an error however busy the machine is.
inline bool wait_until(const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(4);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

// Files below a folder whose name ends so: of a cache that others write to meanwhile.
inline std::size_t count_files(const std::filesystem::path& folder, const std::string& extension) {
  std::size_t count = 0;
  std::error_code gone;
  for (std::filesystem::recursive_directory_iterator it(folder, gone), end; !gone && it != end; it.increment(gone))
    if (it->path().extension() == extension) ++count;
  return count;
}

// Time that a child, which has not been waited for, has had of processors, in seconds.
inline double cpu_seconds(pid_t child) {
  std::ifstream in("/proc/" + std::to_string(child) + "/stat");
  std::string text;
  std::getline(in, text);
  double user = 0, system = 0;
  const std::size_t name = text.rfind(')');
  if (name == text.npos) return 0;
  std::sscanf(text.c_str() + name, ") %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lf %lf", &user, &system);
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

struct Ended {
  int status = 0;          // as waitpid has it
  double cpu_seconds = 0;  // in all
};
inline Ended wait_for_end(pid_t child) {
  Ended out;
  rusage usage{};
  ::wait4(child, &out.status, 0, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  out.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return out;
}

// So many seconds of all processors: what a program can do in that time on a machine of its own.
inline double on_all_processors(double seconds) {
  return seconds * std::max(std::thread::hardware_concurrency(), 1u);
}

}  // namespace oriel::testing
