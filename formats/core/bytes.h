// Little-endian bytes, read with bounds checks and written without depending on how structs lie in memory.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

static_assert(std::endian::native == std::endian::little, "packs are little-endian and copied as they are");

namespace oriel {

using Bytes = std::vector<std::byte>;

inline Bytes bytes_of_text(std::string_view text) {
  const auto* p = reinterpret_cast<const std::byte*>(text.data());
  return Bytes(p, p + text.size());
}

class ByteWriter {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T value) {
    const auto* p = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), p, p + sizeof(T));
  }
  // All elements of a span of trivially copyable scalars or of padding-free float vectors.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put_array(std::span<const T> values) {
    const auto* p = reinterpret_cast<const std::byte*>(values.data());
    bytes_.insert(bytes_.end(), p, p + values.size_bytes());
  }
  // u32 length, then the bytes.
  void put_string(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    const auto* p = reinterpret_cast<const std::byte*>(text.data());
    bytes_.insert(bytes_.end(), p, p + text.size());
  }
  const Bytes& bytes() const { return bytes_; }
  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

// After the first read past the end every read fails and yields zeros; ask ok() once at the end of a record.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T> T get() {
    T value{};
    if (take(sizeof(T))) std::memcpy(&value, bytes_.data() + at_ - sizeof(T), sizeof(T));
    return value;
  }
  // count elements, or an empty vector where fewer are left: nothing is allocated for a count that cannot be true.
  template <class T>
  requires std::is_trivially_copyable_v<T> std::vector<T> get_array(std::uint64_t count) {
    std::vector<T> values;
    if (count > remaining() / sizeof(T)) {
      ok_ = false;
      return values;
    }
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
    return values;
  }
  // The next bytes as they lie; empty, with ok() false, where fewer are left.
  std::span<const std::byte> get_span(std::uint64_t bytes) {
    if (bytes > remaining()) ok_ = false;
    if (!ok_) return {};
    at_ += bytes;
    return bytes_.subspan(at_ - bytes, bytes);
  }
  std::string get_string() {
    const auto length = get<std::uint32_t>();
    const auto chars = get_array<char>(length);
    return {chars.begin(), chars.end()};
  }
  bool ok() const { return ok_; }
  std::size_t remaining() const { return ok_ ? bytes_.size() - at_ : 0; }
  std::size_t position() const { return at_; }

 private:
  bool take(std::size_t n) {
    if (!ok_ || n > bytes_.size() - at_) {
      ok_ = false;
      return false;
    }
    at_ += n;
    return true;
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace oriel
