// JSON, read with suspicion: every value knows the path that leads to it, the first thing that is wrong is kept, and
// reading goes on with defaults until someone asks.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bake/jobs/context.h"
#include "formats/core/bytes.h"
#include "formats/core/json.h"
#include "formats/core/result.h"

namespace oriel::gltf {

// Deeper documents are refused before a recursive parser sees them. glTF itself needs about ten levels.
inline constexpr int kMaxJsonDepth = 64;

class JsonAt;

// A parsed document. The JsonAt values it hands out point into it.
class JsonDocument {
 public:
  // A byte order mark, and zero bytes at the end, are skipped. Error kInvalid: wrong syntax, not UTF-8, a number out of
  // range, or nested deeper than kMaxJsonDepth. `file` names the document in errors.
  static Result<JsonDocument> parse(std::span<const std::byte> text, const std::string& file);

  JsonAt root();
  const std::string& file() const { return file_; }
  // What was wrong first, if anything was.
  Status status() const;
  void add_error(const std::string& path, std::string message);
  // What was wrong and is mended: `what` says the fault and the cure. Faults of one kind make one warning.
  void add_repair(const std::string& path, const std::string& what, WarningCode code = "file-damaged");
  std::vector<Warning> repairs() const;

 private:
  struct Repair {
    std::string what, first_path;
    WarningCode code;
    std::size_t count = 0;
  };
  std::vector<Repair> repairs_;
  oriel::Json value_;
  std::string file_;
  std::optional<Error> first_error_;
};

// A value at a path, or the absence of one. Readers return `fallback` where the value is absent, and also where it has
// the wrong type or range, which is recorded in the document.
class JsonAt {
 public:
  JsonAt(JsonDocument* document, const oriel::Json* value, std::string path)
      : document_(document), value_(value), path_(std::move(path)) {}

  bool present() const { return value_ != nullptr; }
  const std::string& path() const { return path_; }

  // A member of an object; it is an error if this is something else than an object.
  JsonAt operator[](std::string_view key) const;
  // The same, and it is an error if it is absent.
  JsonAt need(const char* key) const;
  // extensions[name], absent where either is.
  JsonAt extension(const char* name) const;
  // A member that is an object, absent where it is something else: extras are anybody's.
  JsonAt object(std::string_view key) const;
  std::vector<std::string> keys() const;

  // Elements of an array; 0 where absent.
  std::size_t size() const;
  JsonAt at(std::size_t i) const;

  double number(double fallback, double lowest = -1e300, double highest = 1e300) const;
  // Whole numbers from 0 to 2^53, however they are written (3 or 3.0).
  std::uint64_t integer(std::uint64_t fallback, std::uint64_t highest = std::uint64_t{1} << 53) const;
  // An index into an array of `count`; -1 where absent or wrong.
  int index(std::size_t count) const;
  bool boolean(bool fallback) const;
  std::string text(std::string fallback = {}) const;
  // A boolean, number or string as text, in one line.
  std::optional<std::string> scalar_text() const;
  // A text fit to be printed in one line: control characters become question marks.
  std::string name() const;
  // Exactly values.size() numbers; untouched where absent.
  void numbers(std::span<double> values) const;

  // Records "found <this value>, expected <expected>".
  void expected(std::string_view what) const;
  void error(std::string message) const { document_->add_error(path_, std::move(message)); }
  void repaired(const std::string& what, WarningCode code = "file-damaged") const {
    document_->add_repair(path_, what, code);
  }
  JsonDocument& document() const { return *document_; }

 private:
  JsonDocument* document_;
  const oriel::Json* value_;
  std::string path_;
};

}  // namespace oriel::gltf
