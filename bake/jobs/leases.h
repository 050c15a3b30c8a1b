// Who computes which unit, where many processes on many machines share a folder.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "formats/core/hash.h"

namespace oriel {

// A lease is a hard link to a file of its owner's, which the owner rewrites every few seconds: link() is atomic, on
// network file systems too, and one write renews all leases of a process. Clocks are never compared: an observer takes
// a lease over once it has seen no change in it for `life` by its own clock, or at once where the owner was a process
// of this machine that is gone. Two may then compute the same unit; that costs time and does no harm, since units are
// pure. Where the folder takes no links, every claim is granted.
class Leases {
 public:
  static constexpr std::chrono::milliseconds kLife{30'000};

  // The folder is made at the first claim.
  explicit Leases(std::filesystem::path folder, std::chrono::milliseconds life = kLife);
  ~Leases();
  Leases(const Leases&) = delete;
  Leases& operator=(const Leases&) = delete;

  // Any thread.
  bool claim(const Hash128& unit);
  void release(const Hash128& unit);

  // Boot, process namespace, process and when it started: no two processes that ever share a folder have the same.
  static std::string own_name();

 private:
  struct Seen {
    std::string content;
    std::chrono::steady_clock::time_point since;
  };

  bool begin();
  void beat();
  void renew();
  bool is_over(const Hash128& unit, const std::string& content);
  std::filesystem::path path_of(const Hash128& unit) const;

  std::filesystem::path folder_, own_;
  std::chrono::milliseconds life_;
  std::string name_;
  std::mutex mutex_;
  bool begun_ = false, works_ = false;
  int file_ = -1;
  std::uint64_t beats_ = 0, takeovers_ = 0;
  std::map<Hash128, Seen> seen_;  // leases of others
  std::jthread heart_;
};

}  // namespace oriel
