#include "bake/jobs/unit_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <tuple>

#include "formats/core/file.h"

namespace oriel {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kUnit = ".unit";

constexpr std::uint64_t kMagic = 0x32304e5545524fULL;  // "OREUN02"

constexpr int kLevel = 1;                                // of zstd: writing is to cost next to nothing
constexpr unsigned long long kMostResults = 1ull << 34;  // bytes

Bytes compressed(const Bytes& bytes) {
  Bytes out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  out.resize(ZSTD_isError(size) ? 0 : size);
  return out;
}

std::optional<Bytes> expanded(const Bytes& bytes) {
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size > kMostResults) return std::nullopt;  // errors are large numbers too
  Bytes out(size);
  if (ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size()) != size) return std::nullopt;
  return out;
}

// The whole file of a unit: magic, checksum of the rest, name, seconds, results (zstd).
Bytes file_of(const Hash128& name, const KeptUnit& unit) {
  Bytes rest, file;
  Archive body(rest), head(file);
  Bytes results = compressed(unit.results);
  body(name, unit.seconds, results);
  head(kMagic, hash64(rest));
  file.insert(file.end(), rest.begin(), rest.end());
  return file;
}

std::optional<KeptUnit> unit_in(std::span<const std::byte> file, const Hash128& name) {
  constexpr std::size_t kHead = 2 * sizeof(std::uint64_t);
  std::uint64_t magic = 0, checksum = 0;
  if (file.size() < kHead) return std::nullopt;
  Archive head(file.first(kHead));
  head(magic, checksum);
  const auto rest = file.subspan(kHead);
  if (magic != kMagic || checksum != hash64(rest)) return std::nullopt;
  KeptUnit unit;
  Hash128 found;
  Archive archive(rest);
  Bytes results;
  archive(found, unit.seconds, results);
  if (!archive.complete() || found != name) return std::nullopt;
  auto bytes = expanded(results);
  if (!bytes) return std::nullopt;
  unit.results = std::move(*bytes);
  return unit;
}

std::optional<Bytes> bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return std::nullopt;
  Bytes bytes(static_cast<std::size_t>(std::max<std::streamoff>(0, in.tellg())));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) return std::nullopt;
  return bytes;
}

// Without a flush to the disk: what a crash of the machine leaves half-written fails its checksum.
bool write_beside_and_rename(const fs::path& path, const fs::path& beside, const Bytes& bytes) {
  std::ofstream out(beside, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out && ::rename(beside.c_str(), path.c_str()) == 0) return true;
  const int reason = errno;
  ::unlink(beside.c_str());
  errno = reason;
  return false;
}

}  // namespace

UnitCache::UnitCache(fs::path folder, std::string program, std::function<void(const Warning&)> warn,
                     std::chrono::milliseconds lease_life)
    : folder_(std::move(folder)),
      program_(std::move(program)),
      warn_(std::move(warn)),
      leases_(folder_ / "leases", lease_life) {}

fs::path UnitCache::path_of(const Hash128& own_name) const {
  const std::string hex = to_hex(own_name);
  return folder_ / hex.substr(0, 2) / (hex.substr(2) + std::string(kUnit));
}

std::optional<KeptUnit> UnitCache::read(const Hash128& own_name) const {
  const fs::path path = path_of(own_name);
  const auto file = bytes_of(path);
  auto unit = file ? unit_in(*file, own_name) : std::nullopt;
  if (unit) ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);  // prune_cache() leaves what was used last
  return unit;
}

void UnitCache::write(const Hash128& own_name, const KeptUnit& unit) {
  if (!writes_) return;
  const fs::path path = path_of(own_name);
  std::error_code ec;
  fs::create_directories(path.parent_path(), ec);
  const fs::path beside = path.string() + ".tmp-" + to_hex(hash_of(Leases::own_name(), ++written_));
  if (!write_beside_and_rename(path, beside, file_of(own_name, unit)) && writes_.exchange(false) && warn_)
    warn_({fmt::format("the cache {} cannot be written: {}; what follows is computed and not kept", folder_.string(),
                       std::strerror(errno)),
           "cache-unwritable"});
}

std::optional<KeptUnit> UnitCache::find(const Hash128& name) {
  auto unit = read(own(name));
  if (!unit) return std::nullopt;
  const std::lock_guard lock(mutex_);
  ++share_.reused;
  share_.reused_s += unit->seconds;
  return unit;
}

std::optional<Bytes> UnitCache::peek(const Hash128& name) {
  auto kept = read(own(name));
  return kept ? std::optional(std::move(kept->results)) : std::nullopt;
}

// Where nothing can be written, nobody waits for it.
bool UnitCache::claim(const Hash128& name) {
  return !writes_ || leases_.claim(own(name));
}

void UnitCache::leave(const Hash128& name) {
  leases_.release(own(name));
}

void UnitCache::keep(const Hash128& name, const KeptUnit& unit) {
  const Hash128 own_name = own(name);
  write(own_name, unit);
  leases_.release(own_name);
  const std::lock_guard lock(mutex_);
  ++share_.computed;
  share_.computed_s += unit.seconds;
}

UnitShare UnitCache::share() const {
  const std::lock_guard lock(mutex_);
  return share_;
}

std::string program_identity() {
  auto program = bytes_of("/proc/self/exe");
  if (!program) return "";
  const auto mark = std::as_bytes(std::span(kCommitMark));
  for (auto at = program->begin();;) {
    at = std::search(at, program->end(), mark.begin(), mark.end());
    if (program->end() - at < std::ssize(mark) + 12) return hash128_hex(*program);
    at = std::fill_n(at + std::ssize(mark), 12, std::byte{});
  }
}

std::string build_id() {
  static const std::string id = program_identity().substr(0, 12);
  return id;
}

std::string instruction_sets(bool embree_fixed) {
  std::string names;
  const auto add = [&](const char* name, bool has) { names += has ? std::string(name) + " " : ""; };
  add("fma", __builtin_cpu_supports("fma"));
  if (embree_fixed) return names;
  add("sse4.2", __builtin_cpu_supports("sse4.2"));
  add("avx", __builtin_cpu_supports("avx"));
  add("avx2", __builtin_cpu_supports("avx2"));
  add("avx512", __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"));
  return names;
}

namespace {

struct CacheFile {
  fs::file_time_type used;
  fs::path path;
  std::uint64_t bytes = 0;
};

// As path_of() names files, or what is written beside them: nobody else's.
bool is_kept(const fs::path& path) {
  const auto is_hex = [](std::string_view text, std::size_t digits) {
    return text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
  };
  const std::string name = path.filename().string(), folder = path.parent_path().filename().string();
  const std::size_t dot = name.find('.');
  if (!is_hex(folder, 2) || dot == std::string::npos || !is_hex(std::string_view(name).substr(0, dot), 30))
    return false;
  std::string_view rest = std::string_view(name).substr(dot);
  if (!rest.starts_with(kUnit)) return false;
  rest.remove_prefix(kUnit.size());
  return rest.empty() || rest.starts_with(".tmp-");
}

// Units of all programs, and what was being written when a process died.
Result<std::vector<CacheFile>> files_of(const fs::path& folder) {
  std::vector<CacheFile> files;
  std::error_code ec;
  for (fs::recursive_directory_iterator entry(folder, ec), end; !ec && entry != end; entry.increment(ec)) {
    if (!is_kept(entry->path()) || !entry->is_regular_file(ec)) continue;
    files.push_back({entry->last_write_time(ec), entry->path(), entry->file_size(ec)});
  }
  if (ec) return fail(ErrorCode::kIo, folder.string(), "cannot be listed: {}", ec.message());
  return files;
}

}  // namespace

Result<CacheContent> cache_content(const fs::path& folder) {
  ORIEL_TRY(const auto files, files_of(folder));
  CacheContent content;
  for (const CacheFile& file : files) ++content.units, content.bytes += file.bytes;
  return content;
}

Result<CacheContent> prune_cache(const fs::path& folder, std::uint64_t bytes) {
  ORIEL_TRY(auto files, files_of(folder));
  std::sort(files.begin(), files.end(),
            [](const CacheFile& a, const CacheFile& b) { return std::tie(a.used, a.path) > std::tie(b.used, b.path); });
  const auto day_ago = fs::file_time_type::clock::now() - std::chrono::hours(24);
  CacheContent removed;
  std::uint64_t kept = 0;
  for (const CacheFile& file : files) {
    const bool unfinished = file.path.extension() != kUnit;  // of a process that may still be at it
    if (unfinished ? file.used > day_ago : kept + file.bytes <= bytes) {
      kept += file.bytes;
      continue;
    }
    std::error_code ec;
    if (!fs::remove(file.path, ec)) continue;
    ++removed.units;
    removed.bytes += file.bytes;
  }
  return removed;
}

}  // namespace oriel
