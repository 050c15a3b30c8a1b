// A JSON value: what our files, records and reports are made of, and read into. The library that reads and writes the
// text takes seconds to compile: json_text.cpp alone sees it, and what is here is defined in json.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/core/result.h"

namespace oriel {

// A value that was asked to be what it is not: at() of what is not there, get() of another type.
class JsonError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct JsonMember;

// Null, a boolean, a number, a string, an array, or an object, whose members keep the order in which they came.
// Whole numbers are kept exactly, from -2^63 to 2^64 - 1.
class Json {
 public:
  // As deep as arrays and objects of a text may be: what walks a value recurses.
  static constexpr int kMaxDepth = 512;

  Json() noexcept = default;
  Json(std::nullptr_t) noexcept {}
  Json(bool value) noexcept;
  Json(int value) noexcept;
  Json(long value) noexcept;
  Json(long long value) noexcept;
  Json(unsigned value) noexcept;
  Json(unsigned long value) noexcept;
  Json(unsigned long long value) noexcept;
  Json(float value) noexcept;
  Json(double value) noexcept;
  Json(const char* value);
  Json(std::string_view value);
  Json(std::string value);
  Json(const void*) = delete;  // or a pointer would be a boolean
  // An object, if all are pairs that begin with a string: {{"name", "lamp"}, {"at", {0, 1, 2}}}; else an array.
  Json(std::initializer_list<Json> values);
  template <class T>
  Json(const std::vector<T>& values) : Json(list(values.begin(), values.end())) {}
  template <class T, std::size_t N>
  Json(const std::array<T, N>& values) : Json(list(values.begin(), values.end())) {}
  template <class Iterator>
  static Json list(Iterator begin, Iterator end) {
    Json out = array();
    for (; begin != end; ++begin) out.push_back(Json(*begin));
    return out;
  }
  static Json array(std::initializer_list<Json> values = {});
  static Json object(std::initializer_list<Json> members = {});

  Json(const Json& other);
  Json(Json&& other) noexcept : kind_(other.kind_), data_(other.data_) { other.kind_ = Kind::kNull; }
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json() {
    if (kind_ >= Kind::kString) drop();
  }

  // Error kInvalid at `where`: what is wrong at which byte, or that it is nested deeper than kMaxDepth. Of members of
  // one name the last counts.
  static Result<Json> parse(std::string_view text, const std::string& where = "");
  static Result<Json> parse(std::span<const std::byte> text, const std::string& where = "");
  // One line, or lines indented by `indent` a level. What is not UTF-8 becomes U+FFFD; what is no finite number, null.
  std::string dump(int indent = -1) const;
  // The same as ASCII, in one line.
  std::string dump_ascii() const;

  bool is_null() const { return kind_ == Kind::kNull; }
  bool is_boolean() const { return kind_ == Kind::kBoolean; }
  bool is_number() const { return kind_ >= Kind::kInteger && kind_ <= Kind::kReal; }
  bool is_number_integer() const { return kind_ == Kind::kInteger || kind_ == Kind::kUnsigned; }
  bool is_number_unsigned() const { return kind_ == Kind::kUnsigned; }
  bool is_number_float() const { return kind_ == Kind::kReal; }
  bool is_string() const { return kind_ == Kind::kString; }
  bool is_array() const { return kind_ == Kind::kArray; }
  bool is_object() const { return kind_ == Kind::kObject; }

  // Elements or members; 0 of null and 1 of other values.
  std::size_t size() const;
  bool empty() const { return size() == 0; }

  // A member; nullptr where there is none, or this is no object.
  const Json* find(std::string_view name) const;
  Json* find(std::string_view name);
  bool contains(std::string_view name) const { return find(name) != nullptr; }
  // A member or an element; null where there is none. Of a value that may change they are made: null becomes an object
  // or an array, and an array grows. JsonError where this is something else.
  const Json& operator[](std::string_view name) const;
  const Json& operator[](std::size_t index) const;
  Json& operator[](std::string_view name);
  Json& operator[](std::size_t index);
  // JsonError where there is none.
  const Json& at(std::string_view name) const;
  const Json& at(std::size_t index) const;
  Json& at(std::size_t index);
  const Json& front() const { return at(std::size_t{0}); }
  const Json& back() const { return at(size() - 1); }
  Json& back() { return at(size() - 1); }

  // The elements of an array; none of anything else.
  const Json* begin() const;
  const Json* end() const;
  Json* begin();
  Json* end();
  // The members of an object; none of anything else.
  const std::vector<JsonMember>& items() const;

  // Appends to an array, which null becomes.
  Json& push_back(Json value);
  // Sets the members of another object.
  void update(const Json& other);
  void erase(std::string_view name);
  // With the members of all objects by name.
  Json sorted() const;

  // T: bool, int, unsigned, long, unsigned long, float, double, std::string, and vectors of some of them. JsonError
  // where this is another type; numbers convert to each other.
  template <class T>
  T get() const;
  // get() of a member, or what stands in for it.
  template <class T>
  T value(std::string_view name, T otherwise) const {
    const Json* member = find(name);
    return member ? member->get<T>() : std::move(otherwise);
  }
  std::string value(std::string_view name, const char* otherwise) const;

  // Numbers by value, objects whatever the order of their members.
  friend bool operator==(const Json& a, const Json& b) { return a.equals(b); }
  friend std::ostream& operator<<(std::ostream& out, const Json& json);

 private:
  friend class JsonReader;
  using Array = std::vector<Json>;
  using Object = std::vector<JsonMember>;
  enum class Kind : std::uint8_t { kNull, kBoolean, kInteger, kUnsigned, kReal, kString, kArray, kObject };
  union Data {
    bool boolean;
    std::int64_t integer;
    std::uint64_t natural;
    double real;
    std::string* string;
    Array* array;
    Object* object;
  };

  void drop() noexcept;
  bool equals(const Json& other) const;
  const char* name_of_kind() const;
  template <class T>
  T number(const char* type) const;
  template <class T>
  std::vector<T> numbers() const;

  Kind kind_ = Kind::kNull;
  Data data_ = {};
};

struct JsonMember {
  std::string name;
  Json value;
};

template <>
bool Json::get<bool>() const;
template <>
int Json::get<int>() const;
template <>
unsigned Json::get<unsigned>() const;
template <>
long Json::get<long>() const;
template <>
unsigned long Json::get<unsigned long>() const;
template <>
float Json::get<float>() const;
template <>
double Json::get<double>() const;
template <>
std::string Json::get<std::string>() const;
template <>
Json Json::get<Json>() const;
template <>
std::vector<int> Json::get<std::vector<int>>() const;
template <>
std::vector<double> Json::get<std::vector<double>>() const;
template <>
std::vector<std::string> Json::get<std::vector<std::string>>() const;

}  // namespace oriel
