// XXH3: checksums of pack sections and names of inputs. Not for security.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace oriel {

std::uint64_t hash64(std::span<const std::byte> bytes);
// 32 lower-case hexadecimal digits of XXH3-128.
std::string hash128_hex(std::span<const std::byte> bytes);

// XXH3-128 as a value.
struct Hash128 {
  std::uint64_t high = 0, low = 0;
  auto operator<=>(const Hash128&) const = default;
};
// 32 lower-case hexadecimal digits.
std::string to_hex(const Hash128& hash);

// hash64 of bytes that come piece by piece.
class Hasher64 {
 public:
  Hasher64();
  ~Hasher64();
  Hasher64(const Hasher64&) = delete;
  Hasher64& operator=(const Hasher64&) = delete;

  void reset();
  void add(std::span<const std::byte> bytes);
  std::uint64_t result() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// XXH3-128 of bytes that come piece by piece.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  void add(std::span<const std::byte> bytes);
  Hash128 result() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel
