// Options as data: one entry each, from which come the command line, its help, --print-options, shell completion, the
// table of the docs, and the record of what was asked.
#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/core/json.h"
#include "formats/core/result.h"

namespace oriel {

// How an option's text becomes a value and a value becomes text. It refers to the variable that it was made for.
struct OptionValue {
  std::string type;  // as the help has it, "auto|LENGTH": words without capitals are taken as they stand. Empty: a flag
  std::function<Status(const std::string&)> set;  // error kUsage: what was found and expected. A flag gets ""
  std::function<std::string()> get;               // as set() takes it; empty: nothing is set
  std::function<Json()> json = {};
  bool repeats = false;  // set() is called for each
};

enum class Use { kRare, kEveryday, kRequired };  // the first is in --help-all only

struct Option {
  std::string name;   // "--texel", "-o,--output"; "SCENE" is told by its place
  std::string group;  // heading of the help
  std::string help;
  OptionValue value;
  Use use = Use::kRare;
  // Name in the record of what was asked. Empty: members of value.json, where that is an object; else not recorded.
  std::string record = {};
  std::string see = {};                    // page of the docs that tells more
  std::vector<std::string> excludes = {};  // names of other options
  std::string needs = {};                  // of another
};

// "--output" of "-o,--output".
std::string long_name(const Option& option);
// Appends to the record.
void record(const Option& option, Json& record);
void append(std::vector<Option>& options, std::vector<Option> more);

// "a b": appends a word to a list.
void add_word(std::string& list, std::string_view word, std::string_view between = " ");

// Values of the common kinds. The variable must outlive the option.

OptionValue flag(bool& target, bool when_given = true);
// From low to high, both included; for int, std::uint32_t, std::uint64_t, float and double.
template <class T>
OptionValue number(T& target, double low, double high);
template <class T>
OptionValue number(std::optional<T>& target, double low, double high);
OptionValue text(std::string& target, std::string type);
OptionValue path(std::filesystem::path& target, std::string type);
OptionValue texts(std::vector<std::string>& target, std::string type);
// Numbers with commas, low to high.
OptionValue numbers(std::vector<double>& target, double low, double high);
// One of some names: choose() gets its index, chosen() tells it.
OptionValue choice_of(std::vector<std::string> names, std::function<void(std::size_t)> choose,
                      std::function<std::size_t()> chosen);

template <class T>
using Names = std::vector<std::pair<std::string, T>>;

// pairs: a list or a map of names and values.
template <class T, class Pairs = Names<T>>
OptionValue choice(T& target, const Pairs& pairs) {
  const Names<T> names(pairs.begin(), pairs.end());
  std::vector<std::string> only;
  for (const auto& [name, value] : names) only.push_back(name);
  return choice_of(
      std::move(only), [&target, names](std::size_t i) { target = names[i].second; },
      [&target, names] {
        const auto is_it = [&](const auto& entry) { return entry.second == target; };
        return static_cast<std::size_t>(std::find_if(names.begin(), names.end(), is_it) - names.begin());
      });
}

// What json() of a number is; for the types of number().
template <class T>
std::function<Json()> json_of(const T& value);

// A value with a unit: parse(text) gives it as a Result, print(value) its text.
template <class T, class Parse, class Print>
OptionValue quantity(T& target, std::string type, Parse parse, Print print) {
  return {std::move(type),
          [&target, parse](const std::string& typed) -> Status {
            ORIEL_TRY(target, parse(typed));
            return {};
          },
          [&target, print] { return print(target); }, json_of(target)};
}

// One that may be repeated.
template <class T, class Parse, class Print>
OptionValue each(std::vector<T>& target, std::string type, Parse parse, Print print) {
  return {std::move(type),
          [&target, parse](const std::string& typed) -> Status {
            ORIEL_TRY(T value, parse(typed));
            target.push_back(std::move(value));
            return {};
          },
          [&target, print] {
            std::string all;
            for (const T& value : target) add_word(all, print(value));
            return all;
          },
          {},
          true};
}

}  // namespace oriel
