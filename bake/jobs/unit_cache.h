// Finished units of work in a folder that bakes, machines and times share.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>

#include "bake/jobs/context.h"
#include "bake/jobs/leases.h"
#include "bake/jobs/units.h"

namespace oriel {

// Files FOLDER/xx/yyy….unit, named by the hash of the unit's inputs and of this program. They appear whole (written
// beside and renamed) and are checked when read: length, name and checksum inside. What is cut off, damaged or foreign
// is computed again. Where the folder cannot be written, one warning says so, and the bake goes on.
class UnitCache : public UnitStore {
 public:
  // `program`: who computes; units of others are not found (program_identity()).
  UnitCache(std::filesystem::path folder, std::string program, std::function<void(const Warning&)> warn,
            std::chrono::milliseconds lease_life = Leases::kLife);

  std::optional<KeptUnit> find(const Hash128& name) override;
  bool claim(const Hash128& name) override;
  void keep(const Hash128& name, const KeptUnit& unit) override;
  void leave(const Hash128& name) override;

  UnitShare share() const override;
  std::optional<Bytes> peek(const Hash128& name) override;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  Hash128 own(const Hash128& name) const { return hash_of(program_, name); }
  std::filesystem::path path_of(const Hash128& own_name) const;
  std::optional<KeptUnit> read(const Hash128& own_name) const;
  void write(const Hash128& own_name, const KeptUnit& unit);

  std::filesystem::path folder_;
  std::string program_;
  std::function<void(const Warning&)> warn_;
  Leases leases_;
  std::atomic<bool> writes_{true};
  std::atomic<std::uint64_t> written_{0};
  mutable std::mutex mutex_;
  UnitShare share_;
};

// The bytes of this program but the commit that it is of (kCommitMark), as a hash: another build may compute other
// bits.
std::string program_identity();
std::string build_id();                                           // its first 12 digits
inline constexpr std::string_view kCommitMark = "oriel-commit:";  // 12 bytes follow

// The instruction sets of this machine that results may depend on: Embree and the C library choose among them. With
// Embree's fixed (BakeOptions::reproducible) only FMA, which the C library's functions use where the CPU has it.
std::string instruction_sets(bool embree_fixed);

// A cache's files.
struct CacheContent {
  std::uint64_t units = 0, bytes = 0;
};
Result<CacheContent> cache_content(const std::filesystem::path& folder);

// Removes the units that were used longest ago until no more than `bytes` are left, and what killed bakes left behind.
// Returns what was removed. Errors kIo.
Result<CacheContent> prune_cache(const std::filesystem::path& folder, std::uint64_t bytes);

}  // namespace oriel
