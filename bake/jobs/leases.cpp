#include "bake/jobs/leases.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <fstream>
#include <iterator>
#include <sstream>

namespace oriel {
namespace fs = std::filesystem;
namespace {

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Field 22 of /proc/PID/stat: clock ticks from boot to its start. Empty where there is no such process.
std::string start_of(const std::string& process) {
  const std::string stat = text_of("/proc/" + process + "/stat");
  const std::size_t name_end = stat.rfind(')');  // the name may hold anything
  if (name_end == std::string::npos) return "";
  std::istringstream fields(stat.substr(name_end + 1));
  std::string field;
  for (int i = 3; i <= 22; ++i) fields >> field;
  return field;
}

// What processes that can see each other have in common.
const std::string& own_machine() {
  static const std::string machine = [] {
    std::string boot = text_of("/proc/sys/kernel/random/boot_id");
    std::erase(boot, '\n');
    std::error_code ec;
    return boot + "/" + fs::read_symlink("/proc/self/ns/pid", ec).string();
  }();
  return machine;
}

bool is_gone(const std::string& owner) {
  const std::string machine = own_machine() + "/";
  if (owner.rfind(machine, 0) != 0) return false;
  const std::string rest = owner.substr(machine.size());
  const std::size_t slash = rest.find('/');
  return slash != std::string::npos && start_of(rest.substr(0, slash)) != rest.substr(slash + 1);
}

std::string owner_in(const std::string& content) {
  return content.substr(0, content.find(' '));
}

}  // namespace

std::string Leases::own_name() {
  const std::string process = std::to_string(::getpid());
  return own_machine() + "/" + process + "/" + start_of(process);
}

Leases::Leases(fs::path folder, std::chrono::milliseconds life)
    : folder_(std::move(folder)), life_(life), name_(own_name()) {}

Leases::~Leases() {
  heart_ = {};  // asks it to stop, and waits
  if (file_ < 0) return;
  ::close(file_);
  ::unlink(own_.c_str());
}

fs::path Leases::path_of(const Hash128& unit) const {
  return folder_ / (to_hex(unit) + ".lease");
}

// Makes the owner's file, clears away what dead processes of this machine left, and starts the heart. mutex_ is held.
bool Leases::begin() {
  if (begun_) return works_;
  begun_ = true;
  std::error_code ec;
  fs::create_directories(folder_, ec);
  for (fs::directory_iterator entry(folder_, ec), end; !ec && entry != end; entry.increment(ec))
    if (is_gone(owner_in(text_of(entry->path())))) ::unlink(entry->path().c_str());
  // Several of one process may share a folder.
  const std::string about = fmt::format("{} {}", name_, fmt::ptr(this));
  own_ = folder_ / ("owner-" + hash128_hex(std::as_bytes(std::span(about))));
  file_ = ::open(own_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file_ < 0) return false;
  renew();
  heart_ = std::jthread([this](const std::stop_token& stop) {
    std::mutex sleep;
    std::condition_variable_any wake;
    std::unique_lock lock(sleep);
    while (!wake.wait_for(lock, stop, life_ / 10, [&] { return stop.stop_requested(); })) beat();
  });
  return works_ = true;
}

void Leases::beat() {
  const std::lock_guard lock(mutex_);
  renew();
}

void Leases::renew() {
  const std::string content =
      fmt::format("{} {:016x} {:016x}\n", name_, reinterpret_cast<std::uintptr_t>(this), ++beats_);
  [[maybe_unused]] const ssize_t written = ::pwrite(file_, content.data(), content.size(), 0);
}

// Whether the lease has ended. mutex_ is held.
bool Leases::is_over(const Hash128& unit, const std::string& content) {
  if (is_gone(owner_in(content))) return true;
  const auto now = std::chrono::steady_clock::now();
  const auto [seen, is_new] = seen_.try_emplace(unit, Seen{content, now});
  if (!is_new && seen->second.content != content) seen->second = {content, now};
  return now - seen->second.since >= life_;
}

bool Leases::claim(const Hash128& unit) {
  const std::lock_guard lock(mutex_);
  if (!begin()) return true;
  const fs::path path = path_of(unit);
  if (::link(own_.c_str(), path.c_str()) == 0) return true;
  if (errno != EEXIST) return true;  // no links here, or no room: better twice than never
  if (!is_over(unit, text_of(path))) return false;
  seen_.erase(unit);
  const fs::path mine = folder_ / fmt::format("{}-{}", own_.filename().string(), ++takeovers_);
  if (::link(own_.c_str(), mine.c_str()) == 0) ::rename(mine.c_str(), path.c_str());
  return true;
}

void Leases::release(const Hash128& unit) {
  const std::lock_guard lock(mutex_);
  if (works_) ::unlink(path_of(unit).c_str());
}

}  // namespace oriel
