// One list of an asset's members serves to write it into a section and to read it back from hostile bytes.
#pragma once

#include "formats/core/bytes.h"
#include "formats/core/result.h"
#include "formats/core/vec.h"
#include "formats/pack/layout.h"
#include "formats/pack/planes.h"
#include "formats/pack/quantise.h"

namespace oriel {

static_assert(sizeof(Vec2) == 8 && sizeof(Vec3) == 12 && sizeof(Mat4) == 64, "vectors have no padding");

// Of reading: after the first code that means nothing, and after the end of the bytes, nothing more is read: members
// are left as they are, and status() or ByteReader::ok() tells. Allocations stay in proportion to the bytes left.
class Serial {
 public:
  explicit Serial(ByteWriter& out) : out_(&out) {}
  explicit Serial(ByteReader& in) : in_(&in) {}

  bool reading() const { return in_ != nullptr; }
  bool ok() const { return in_ == nullptr || (status_ && in_->ok()); }
  const Status& status() const { return status_; }  // without a place
  ByteReader& in() { return *in_; }
  ByteWriter& out() { return *out_; }

  // Numbers, vectors, matrices (column by column, as GL and glTF) and strings, one after the other.
  template <class... T>
  void operator()(T&... values) {
    (one(values), ...);
  }
  // A number that is of another type in the file.
  template <class Stored, class T>
  void as(T& value) {
    auto stored = static_cast<Stored>(value);
    one(stored);
    if (reading() && ok()) value = static_cast<T>(stored);
  }
  // A byte that chooses among 0 … last. T: an enum, or bool with last = 1.
  template <class T>
  void choice(const char* what, std::uint8_t last, T& value) {
    auto code = static_cast<std::uint8_t>(value);
    one(code);
    if (code > last) refuse("found {} {}, expected 0 to {}", what, code, last);
    if (reading() && ok()) value = static_cast<T>(code);
  }
  void reserved(int bytes) {
    for (std::uint8_t zero = 0; bytes > 0; --bytes, zero = 0) choice("reserved byte", 0, zero);
  }
  // Width and height of a map: two u32. The product fits in 32 bits.
  void size(std::uint32_t& width, std::uint32_t& height) {
    (*this)(width, height);
    if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide)
      refuse("found {} x {} texels, expected 1 to {} a side", width, height, kMaxSide);
  }
  // What values were divided by before they became halves: 2 to this.
  void scale_exponent(int& exponent) {
    as<std::int32_t>(exponent);
    if (exponent < kMinScaleExponent || exponent > kMaxScaleExponent)
      refuse("found scale exponent {}, expected {} to {}", exponent, kMinScaleExponent, kMaxScaleExponent);
  }
  // u32: how many of `things` follow.
  template <class T>
  std::uint32_t count(const std::vector<T>& things) {
    auto n = static_cast<std::uint32_t>(things.size());
    one(n);
    return ok() ? n : 0;
  }
  // n things, each described by `each`.
  template <class T, class Each>
  void list(std::vector<T>& things, std::uint32_t n, const Each& each) {
    for (std::uint32_t i = 0; i < n && ok(); ++i) {
      if (reading()) things.emplace_back();
      each(things[i]);
    }
    if (reading() && !ok() && !things.empty()) things.pop_back();
  }
  // n plain elements, as they lie in memory.
  template <class T>
  void array(std::vector<T>& values, std::uint64_t n) {
    if (!reading()) return out_->put_array(std::span<const T>(values));
    if (ok()) values = in_->get_array<T>(n);
  }
  // n plain elements as planes (planes.h).
  template <class T>
  void planes(std::vector<T>& values, std::uint64_t n) {
    if (!reading()) return put_planes(*out_, std::span<const T>(values));
    if (ok()) values = get_planes<T>(*in_, n);
  }
  // n elements as planes of codes. decode(code, i) may refuse.
  template <class Code, class T, class Encode, class Decode>
  void coded(std::vector<T>& values, std::uint64_t n, const Encode& encode, const Decode& decode) {
    std::vector<Code> codes;
    if (!reading()) {
      codes.reserve(values.size());
      for (const T& value : values) codes.push_back(encode(value));
    }
    planes(codes, n);
    if (!reading()) return;
    values.resize(codes.size());
    for (std::size_t i = 0; i < codes.size() && status_; ++i) values[i] = decode(codes[i], i);
  }

  // Of reading: what was read means nothing. The first refusal counts; of what lay behind the end none does.
  template <class... Args>
  void refuse(fmt::format_string<Args...> format, Args&&... args) {
    if (reading() && ok()) status_ = invalid("", format, std::forward<Args>(args)...);
  }
  void refuse(Status status) {
    if (reading() && ok() && !status) status_ = std::move(status);
  }

 private:
  template <class T>
  requires std::is_arithmetic_v<T>
  void one(T& value) {
    if (!reading()) return out_->put(value);
    if (ok()) value = in_->get<T>();
  }
  template <glm::length_t n, class T, glm::qualifier q>
  void one(glm::vec<n, T, q>& v) {
    for (int i = 0; i < n; ++i) one(v[i]);
  }
  void one(Mat4& m) {
    for (int column = 0; column < 4; ++column) one(m[column]);
  }
  void one(std::string& text) {
    if (!reading()) return out_->put_string(text);
    if (ok()) text = in_->get_string();
  }

  ByteWriter* out_ = nullptr;
  ByteReader* in_ = nullptr;
  Status status_;
};

}  // namespace oriel
