#include "formats/cli/option.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <utility>

namespace oriel {
namespace {

// Not a number is neither more nor less than any bound, and refused.
template <class T>
Result<T> parse_number(const std::string& typed, double low, double high) {
  T value{};
  const auto [end, error] = std::from_chars(typed.data(), typed.data() + typed.size(), value);
  const bool whole = error == std::errc() && end == typed.data() + typed.size();
  if (whole && static_cast<double>(value) >= low && static_cast<double>(value) <= high) return value;
  const char* kind = std::is_integral_v<T> ? "whole " : "";
  if (std::is_integral_v<T> &&
      high >= static_cast<double>(std::numeric_limits<T>::max()))  // what memory holds: no limit
    return fail(ErrorCode::kUsage, "", "found '{}', expected a {}number of at least {:g} that has at most {} digits",
                typed, kind, low, std::numeric_limits<T>::digits10);
  return fail(ErrorCode::kUsage, "", "found '{}', expected a {}number from {:g} to {:g}", typed, kind, low, high);
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string out;
  for (const std::string& word : words) add_word(out, word, between);
  return out;
}

// One of some names: choose() gets its index, chosen() tells it.
OptionValue named(std::vector<std::string> names, std::function<void(std::size_t)> choose,
                  std::function<std::size_t()> chosen) {
  const std::string type = joined(names, "|");
  const auto get = [names, chosen = std::move(chosen)] {
    const std::size_t i = chosen();
    return i < names.size() ? names[i] : std::string();
  };
  return {type,
          [names, choose = std::move(choose)](const std::string& typed) -> Status {
            const auto found = std::find(names.begin(), names.end(), typed);
            if (found == names.end())
              return fail(ErrorCode::kUsage, "", "found '{}', expected {}{}", typed, names.size() > 1 ? "one of " : "",
                          joined(names, ", "));
            choose(static_cast<std::size_t>(found - names.begin()));
            return {};
          },
          get, [get] { return Json(get()); }};
}

}  // namespace

OptionValue::OptionValue(std::string type_, std::function<Status(const std::string&)> set_,
                         std::function<std::string()> get_, std::function<Json()> json_)
    : type(std::move(type_)), set(std::move(set_)), get(std::move(get_)), json(std::move(json_)) {}
OptionValue::OptionValue(const OptionValue&) = default;
OptionValue::OptionValue(OptionValue&&) noexcept = default;
OptionValue& OptionValue::operator=(const OptionValue&) = default;
OptionValue& OptionValue::operator=(OptionValue&&) noexcept = default;
OptionValue::~OptionValue() = default;

std::string long_name(const Option& option) {
  const std::string name = option.name;
  return name.substr(name.rfind(',') + 1);
}

void record(const Option& option, Json& record) {
  if (!option.value.json) return;
  Json value = option.value.json();
  if (*option.record != '\0')
    record[option.record] = std::move(value);
  else if (value.is_object())
    record.update(value);
}

void add_word(std::string& list, std::string_view word, std::string_view between) {
  if (!list.empty()) list += between;
  list += word;
}

void append(std::vector<Option>& options, std::vector<Option> more) {
  options.insert(options.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

OptionValue flag(bool& target, bool when_given) {
  return {"",
          [&target, when_given](const std::string&) -> Status {
            target = when_given;
            return {};
          },
          [&target, when_given] { return std::string(target == when_given ? "on" : "off"); },
          [&target] { return Json(target); }};
}

template <class T>
std::function<Json()> json_of(const T& value) {
  return [&value] { return Json(value); };
}

template <class T>
OptionValue number(T& target, double low, double high) {
  return {std::is_integral_v<T> ? "N" : "X",
          [&target, low, high](const std::string& typed) -> Status {
            ORIEL_TRY(target, parse_number<T>(typed, low, high));
            return {};
          },
          [&target] { return fmt::format("{}", target); }, json_of(target)};
}

template <class T>
OptionValue number(std::optional<T>& target, double low, double high) {
  return {std::is_integral_v<T> ? "N" : "X",
          [&target, low, high](const std::string& typed) -> Status {
            ORIEL_TRY(target, parse_number<T>(typed, low, high));
            return {};
          },
          [&target] { return target ? fmt::format("{}", *target) : std::string(); },
          [&target] { return target ? Json(*target) : Json(); }};
}

template OptionValue number(int&, double, double);
template OptionValue number(std::uint32_t&, double, double);
template OptionValue number(std::uint64_t&, double, double);
template OptionValue number(float&, double, double);
template OptionValue number(double&, double, double);
template OptionValue number(std::optional<int>&, double, double);
template OptionValue number(std::optional<std::uint32_t>&, double, double);
template OptionValue number(std::optional<float>&, double, double);
template OptionValue number(std::optional<double>&, double, double);
template std::function<Json()> json_of(const int&);
template std::function<Json()> json_of(const std::uint32_t&);
template std::function<Json()> json_of(const std::uint64_t&);
template std::function<Json()> json_of(const float&);
template std::function<Json()> json_of(const double&);

OptionValue text(std::string& target, const char* type) {
  return {type,
          [&target](const std::string& typed) -> Status {
            target = typed;
            return {};
          },
          [&target] { return target; }, [&target] { return Json(target); }};
}

template <class Path>
OptionValue path(Path& target, const char* type) {
  return {type,
          [&target](const std::string& typed) -> Status {
            target = typed;
            return {};
          },
          [&target] { return target.string(); }};
}

template OptionValue path(std::filesystem::path&, const char*);

OptionValue texts(std::vector<std::string>& target, const char* type) {
  OptionValue value(
      type,
      [&target](const std::string& typed) -> Status {
        target.push_back(typed);
        return {};
      },
      [&target] { return joined(target, " "); }, [&target] { return Json(target); });
  value.repeats = true;
  return value;
}

OptionValue numbers(std::vector<double>& target, double low, double high) {
  return {"X,…",
          [&target, low, high](const std::string& typed) -> Status {
            target.clear();
            for (std::size_t at = 0; at <= typed.size();) {
              const std::size_t comma = std::min(typed.find(',', at), typed.size());
              ORIEL_TRY(const double value, parse_number<double>(typed.substr(at, comma - at), low, high));
              target.push_back(value);
              at = comma + 1;
            }
            return {};
          },
          [&target] {
            std::vector<std::string> words;
            for (const double value : target) words.push_back(fmt::format("{}", value));
            return joined(words, ",");
          }};
}

OptionValue one_of(std::string& target, std::initializer_list<const char*> words) {
  const std::vector<std::string> names(words.begin(), words.end());
  return named(
      names, [&target, names](std::size_t i) { target = names[i]; },
      [&target, names] { return static_cast<std::size_t>(std::ranges::find(names, target) - names.begin()); });
}

OptionValue choice_of(std::vector<Named<double>> names, NumberAccess access) {
  std::vector<std::string> only;
  for (const auto& [name, value] : names) only.emplace_back(name);
  return named(
      std::move(only), [access, names](std::size_t i) { access.set(access.variable, names[i].value); },
      [access, names] {
        const auto found = std::ranges::find(names, access.get(access.variable), &Named<double>::value);
        return static_cast<std::size_t>(found - names.begin());
      });
}

template <class T, class Parsed>
OptionValue quantity(T& target, const char* type, Result<Parsed> (*parse)(const std::string&),
                     std::string (*print)(std::type_identity_t<T>)) {
  return {type,
          [&target, parse](const std::string& typed) -> Status {
            ORIEL_TRY(target, parse(typed));
            return {};
          },
          [&target, print] { return print(target); }, json_of(target)};
}

template OptionValue quantity(float&, const char*, Result<float> (*)(const std::string&), std::string (*)(float));
template OptionValue quantity(double&, const char*, Result<float> (*)(const std::string&), std::string (*)(double));
template OptionValue quantity(double&, const char*, Result<double> (*)(const std::string&), std::string (*)(double));
template OptionValue quantity(std::uint64_t&, const char*, Result<std::uint64_t> (*)(const std::string&),
                              std::string (*)(std::uint64_t));

}  // namespace oriel
