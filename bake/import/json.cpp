#include "bake/import/json.h"

#include <algorithm>
#include <cmath>

namespace oriel::gltf {
namespace {

// Brackets outside of strings: what walks the values recurses.
bool nested_deeper_than(std::string_view text, int limit) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > limit) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

std::string shown(const oriel::Json& value) {
  if (value.is_object()) return value.empty() ? "{}" : "an object";
  if (value.is_array()) return fmt::format("an array of {}", value.size());
  std::string text = value.dump_ascii();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

}  // namespace

Result<JsonDocument> JsonDocument::parse(std::span<const std::byte> bytes, const std::string& file) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const bool marked = text.starts_with("\xEF\xBB\xBF"), padded = text.ends_with('\0');
  if (marked) text.remove_prefix(3);
  while (text.ends_with('\0')) text.remove_suffix(1);
  if (nested_deeper_than(text, kMaxJsonDepth))
    return invalid(file, "found JSON nested deeper than {} levels, expected less", kMaxJsonDepth);
  JsonDocument document;
  document.file_ = file;
  if (marked) document.add_repair("", "a byte order mark before the JSON is skipped");
  if (padded) document.add_repair("", "zero bytes after the JSON are skipped");
  ORIEL_TRY(document.value_, oriel::Json::parse(text, file));
  if (!document.value_.is_object()) return invalid(file, "found {}, expected a JSON object", shown(document.value_));
  return document;
}

JsonAt JsonDocument::root() {
  return JsonAt(this, &value_, "");
}

Status JsonDocument::status() const {
  if (first_error_) return tl::unexpected<Error>(*first_error_);
  return {};
}

void JsonDocument::add_error(const std::string& path, std::string message) {
  if (!first_error_)
    first_error_ = Error{ErrorCode::kInvalid, std::move(message), path.empty() ? file_ : file_ + ": " + path};
}

void JsonDocument::add_repair(const std::string& path, const std::string& what, WarningCode code) {
  auto repair = std::ranges::find(repairs_, what, &Repair::what);
  if (repair == repairs_.end()) repair = repairs_.insert(repair, {what, path, code});
  ++repair->count;
}

std::vector<Warning> JsonDocument::repairs() const {
  std::vector<Warning> lines;
  for (const Repair& repair : repairs_)
    lines.emplace_back(fmt::format("{}{}{}{}: {}", file_, repair.first_path.empty() ? "" : ": ", repair.first_path,
                                   repair.count > 1 ? fmt::format(" and {} more", repair.count - 1) : "", repair.what),
                       repair.code);
  return lines;
}

JsonAt JsonAt::operator[](std::string_view key) const {
  std::string path = path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
  if (!value_) return JsonAt(document_, nullptr, std::move(path));
  if (!value_->is_object()) {
    expected("an object");
    return JsonAt(document_, nullptr, std::move(path));
  }
  return JsonAt(document_, value_->find(key), std::move(path));
}

JsonAt JsonAt::need(const char* key) const {
  JsonAt member = (*this)[key];
  if (value_ && value_->is_object() && !member.present()) error(fmt::format("found no \"{}\", expected one", key));
  return member;
}

JsonAt JsonAt::extension(const char* name) const {
  return (*this)["extensions"][name];
}

JsonAt JsonAt::object(std::string_view key) const {
  const JsonAt member = (*this)[key];
  return member.present() && !member.value_->is_object() ? JsonAt(document_, nullptr, member.path_) : member;
}

std::vector<std::string> JsonAt::keys() const {
  std::vector<std::string> names;
  if (!value_) return names;
  if (!value_->is_object()) {
    expected("an object");
    return names;
  }
  for (const auto& item : value_->items()) names.push_back(item.name);
  std::ranges::sort(names);
  return names;
}

std::size_t JsonAt::size() const {
  if (!value_) return 0;
  if (value_->is_array()) return value_->size();
  expected("an array");
  return 0;
}

JsonAt JsonAt::at(std::size_t i) const {
  const bool inside = value_ && value_->is_array() && i < value_->size();
  return JsonAt(document_, inside ? &(*value_)[i] : nullptr, fmt::format("{}[{}]", path_, i));
}

double JsonAt::number(double fallback, double lowest, double highest) const {
  if (!value_) return fallback;
  const double value = value_->is_number() ? value_->get<double>() : std::nan("");
  if (value >= lowest && value <= highest) return value;
  expected(lowest <= -1e300 && highest >= 1e300 ? "a number"
           : highest >= 1e300                   ? fmt::format("a number of at least {}", lowest)
                                                : fmt::format("a number from {} to {}", lowest, highest));
  return fallback;
}

std::uint64_t JsonAt::integer(std::uint64_t fallback, std::uint64_t highest) const {
  if (!value_) return fallback;
  if (value_->is_number_unsigned()) {
    const auto value = value_->get<std::uint64_t>();
    if (value <= highest) return value;
  } else if (value_->is_number_float()) {
    const double value = value_->get<double>();
    if (value >= 0 && value <= static_cast<double>(highest) && std::floor(value) == value)
      return static_cast<std::uint64_t>(value);
  }
  expected(fmt::format("a whole number from 0 to {}", highest));
  return fallback;
}

int JsonAt::index(std::size_t count) const {
  if (!value_) return -1;
  if (value_->is_number_unsigned()) {
    const auto value = value_->get<std::uint64_t>();
    if (value < count && value < std::uint64_t{1} << 31) return static_cast<int>(value);
  }
  expected(count == 0 ? "no index: there are none" : fmt::format("an index below {}", count));
  return -1;
}

bool JsonAt::boolean(bool fallback) const {
  if (!value_) return fallback;
  if (value_->is_boolean()) return value_->get<bool>();
  expected("true or false");
  return fallback;
}

std::string JsonAt::text(std::string fallback) const {
  if (!value_) return fallback;
  if (value_->is_string()) return value_->get<std::string>();
  expected("a string");
  return fallback;
}

std::optional<std::string> JsonAt::scalar_text() const {
  if (value_ && value_->is_string()) return name();
  if (value_ && (value_->is_boolean() || value_->is_number())) return value_->dump_ascii();
  return std::nullopt;
}

std::string JsonAt::name() const {
  std::string printable = text();
  for (char& c : printable)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return printable;
}

void JsonAt::numbers(std::span<double> values) const {
  if (!value_) return;
  if (!value_->is_array() || value_->size() != values.size())
    return expected(fmt::format("an array of {} numbers", values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = at(i).number(values[i]);
}

void JsonAt::expected(std::string_view what) const {
  error(fmt::format("found {}, expected {}", value_ ? shown(*value_) : "nothing", what));
}

}  // namespace oriel::gltf
