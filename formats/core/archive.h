// One list of a thing's members serves to write it, to read it back to the last bit, and to hash it.
#pragma once

#include <array>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "formats/core/bytes.h"
#include "formats/core/check.h"
#include "formats/core/hash.h"
#include "formats/core/vec.h"

namespace oriel {

// Values whose bytes are all their own, so that equal values have equal bytes: numbers, enumerations, GLM's types of
// those, arrays of any of them. Structs may hold padding; they have a function of their own instead:
//   void fields(Archive& archive, Thing& thing) { archive(thing.first, thing.second); }
template <class T>
struct IsPlain : std::bool_constant<std::is_arithmetic_v<T> || std::is_enum_v<T>> {};
template <glm::length_t n, class T, glm::qualifier q>
struct IsPlain<glm::vec<n, T, q>> : std::bool_constant<sizeof(glm::vec<n, T, q>) == n * sizeof(T)> {};
template <glm::length_t n, glm::length_t m, class T, glm::qualifier q>
struct IsPlain<glm::mat<n, m, T, q>> : std::bool_constant<sizeof(glm::mat<n, m, T, q>) == n * m * sizeof(T)> {};
template <class T, std::size_t n>
struct IsPlain<std::array<T, n>> : IsPlain<T> {};

// Little-endian, without names, versions or padding: for bytes that the same program reads, or for a hash.
class Archive {
 public:
  explicit Archive(Bytes& to) : to_(&to) {}
  explicit Archive(Hasher& to) : hasher_(&to) {}
  explicit Archive(std::span<const std::byte> from) : from_(from), reading_(true) {}

  // Numbers, vectors, strings, arrays, pairs, spans, std::vectors, and what has a function fields(). Constants can be
  // written and hashed only.
  template <class... T>
  void operator()(T&&... things) {
    (constant(things), ...);
  }

  // Of reading: what was asked for was there. After a failure all else is left as it is.
  bool ok() const { return ok_; }
  // And nothing else is.
  bool complete() const { return ok_ && from_.empty(); }
  // Of reading: bytes that break this are those of another thing.
  void require(bool fits) { ok_ = ok_ && fits; }

 private:
  template <class T>
  void constant(const T& thing) {
    ORIEL_CHECK_LT(reading_, true);
    one(const_cast<T&>(thing));  // it is only looked at
  }
  template <class T>
  void constant(T& thing) {
    one(thing);
  }

  template <class T>
  void one(T& thing) {
    if constexpr (IsPlain<T>::value)
      raw(&thing, sizeof(T));
    else
      fields(*this, thing);
  }
  template <class T, std::size_t n>
  requires(!IsPlain<T>::value) void one(std::array<T, n>& things) {
    for (T& thing : things) one(thing);
  }
  template <class A, class B>
  void one(std::pair<A, B>& pair) {
    one(pair.first), one(pair.second);
  }
  // Of a length that both sides know.
  template <class T>
  void one(std::span<T>& things) {
    const auto wanted = static_cast<std::uint64_t>(things.size());
    ok_ = length(wanted) == wanted && ok_;
    for (T& thing : things) constant(thing);
  }
  void one(std::string& text) { sequence(text); }
  template <class T>
  void one(std::vector<T>& things) {
    sequence(things);
  }
  void one(std::vector<bool>& flags) {
    std::vector<std::uint8_t> bytes(flags.begin(), flags.end());
    sequence(bytes);
    flags.assign(bytes.begin(), bytes.end());
  }

  template <class Sequence>
  void sequence(Sequence& things) {
    using T = typename Sequence::value_type;
    const std::uint64_t count = length(things.size());
    if (reading_) {
      // Nothing is allocated for a count that cannot be true: an element has a byte at least.
      ok_ = ok_ && count <= from_.size() / (IsPlain<T>::value ? sizeof(T) : 1);
      if (!ok_) return;
      things.resize(count);
    }
    if constexpr (IsPlain<T>::value)
      raw(things.data(), things.size() * sizeof(T));
    else
      for (T& thing : things) one(thing);
  }

  void raw(void* data, std::size_t size);
  // As it is written, or read.
  std::uint64_t length(std::uint64_t count);

  Bytes* to_ = nullptr;
  Hasher* hasher_ = nullptr;
  std::span<const std::byte> from_;
  bool reading_ = false;
  bool ok_ = true;
};

// The hash of things one after the other.
template <class... T>
Hash128 hash_of(const T&... things) {
  Hasher hasher;
  Archive archive(hasher);
  archive(things...);
  return hasher.result();
}

inline void fields(Archive& archive, Hash128& hash) {
  archive(hash.high, hash.low);
}

}  // namespace oriel
