// Options as data: one entry each, from which come the command line, its help, --print-options, shell completion, the
// table of the docs, and the record of what was asked.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "formats/core/json.h"
#include "formats/core/result.h"

namespace oriel {

// How an option's text becomes a value and a value becomes text. It refers to the variable that it was made for.
struct OptionValue {
  std::string type;  // as the help has it, "auto|LENGTH": words without capitals are taken as they stand. Empty: a
                     // flag. "[PORT]": may be missing
  std::function<Status(const std::string&)> set;  // error kUsage: what was found and expected. A flag gets ""
  std::function<std::string()> get;               // as set() takes it; empty: nothing is set
  std::function<Json()> json;
  bool repeats = false;  // set() is called for each

  // None of these is inline: tables of options are long, and compilers slow where each row is unrolled.
  OptionValue(std::string type, std::function<Status(const std::string&)> set, std::function<std::string()> get,
              std::function<Json()> json = {});
  OptionValue(const OptionValue&);
  OptionValue(OptionValue&&) noexcept;
  OptionValue& operator=(const OptionValue&);
  OptionValue& operator=(OptionValue&&) noexcept;
  ~OptionValue();
};

enum class Use { kRare, kEveryday, kRequired };  // the first is in --help-all only

// Its texts are literals, which outlive it.
struct Option {
  const char* name;   // "--texel", "-o,--output"; "SCENE" is told by its place
  const char* group;  // heading of the help
  const char* help;
  OptionValue value;
  Use use = Use::kRare;
  // Name in the record of what was asked. Empty: members of value.json, where that is an object; else not recorded.
  const char* record = "";
  const char* see = "";       // page of the docs that tells more
  const char* excludes = "";  // names of other options, "--size --error"
  const char* needs = "";     // of another
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
OptionValue text(std::string& target, const char* type);
// For std::filesystem::path, whose header is dear.
template <class Path>
OptionValue path(Path& target, const char* type);
OptionValue texts(std::vector<std::string>& target, const char* type);
// Numbers with commas, low to high.
OptionValue numbers(std::vector<double>& target, double low, double high);
// One of some words.
OptionValue one_of(std::string& target, std::initializer_list<const char*> words);

// What a value is called.
template <class T>
struct Named {
  const char* name;
  T value;
};

// A variable of any type whose values a double holds.
struct NumberAccess {
  void* variable;
  void (*set)(void* variable, double value);
  double (*get)(const void* variable);
};
OptionValue choice_of(std::vector<Named<double>> names, NumberAccess access);

// One of some names, of enumerators for instance.
template <class T, std::size_t N>
OptionValue choice(T& target, const Named<std::type_identity_t<T>> (&names)[N]) {
  std::vector<Named<double>> all(N);
  for (std::size_t i = 0; i < N; ++i) all[i] = {names[i].name, static_cast<double>(names[i].value)};
  return choice_of(std::move(all),
                   {&target, [](void* at, double value) { *static_cast<T*>(at) = static_cast<T>(value); },
                    [](const void* at) { return static_cast<double>(*static_cast<const T*>(at)); }});
}

// What json() of a number is; for the types of number().
template <class T>
std::function<Json()> json_of(const T& value);

// A value with a unit: parse(text) gives it, print(value) its text. For the types of number() that bakes have.
template <class T, class Parsed>
OptionValue quantity(T& target, const char* type, Result<Parsed> (*parse)(const std::string&),
                     std::string (*print)(std::type_identity_t<T>));

// One that may be repeated.
template <class T, class Parse>
OptionValue each(std::vector<T>& target, const char* type, Parse parse,
                 std::string (*print)(const std::type_identity_t<T>&)) {
  OptionValue value(
      type,
      [&target, parse](const std::string& typed) -> Status {
        ORIEL_TRY(T more, parse(typed));
        target.push_back(std::move(more));
        return {};
      },
      [&target, print] {
        std::string all;
        for (const T& one : target) add_word(all, print(one));
        return all;
      });
  value.repeats = true;
  return value;
}

}  // namespace oriel
