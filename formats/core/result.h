// Result and Error: how bad input and failed work are reported. Nothing here throws or exits.
#pragma once

#include <fmt/core.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace oriel {

// What went wrong, as the exit code that a tool ends with (docs/notes/conventions.md).
enum class ErrorCode {
  kUsage = 1,      // wrong arguments
  kIo = 2,         // a file could not be read or written
  kInvalid = 3,    // the input breaks its specification
  kRuntime = 4,    // the work failed: no memory, no GL context, …
  kDifferent = 5,  // a comparison found differences
  kStopped = 130,  // the user stopped it
};

struct Error {
  ErrorCode code = ErrorCode::kRuntime;
  std::string message;  // one line: what was found and what was expected
  std::string where;    // file, node, mesh, accessor, section …; may be empty

  // In result.cpp: each ORIEL_TRY moves one and destroys two, which is long where it is inline.
  Error();
  Error(ErrorCode code, std::string message, std::string where = {});
  Error(const Error&);
  Error(Error&&) noexcept;
  Error& operator=(const Error&);
  Error& operator=(Error&&) noexcept;
  ~Error();

  // "where: message", or the message alone.
  std::string text() const;
};

// A value, or the Error that says why there is none.
template <class T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

tl::unexpected<Error> failed(ErrorCode code, std::string where, fmt::string_view format, fmt::format_args args);
template <class... Args>
tl::unexpected<Error> fail(ErrorCode code, std::string where, fmt::format_string<Args...> format, Args&&... args) {
  return failed(code, std::move(where), format, fmt::make_format_args(args...));
}
template <class... Args>
tl::unexpected<Error> invalid(std::string where, fmt::format_string<Args...> format, Args&&... args) {
  return failed(ErrorCode::kInvalid, std::move(where), format, fmt::make_format_args(args...));
}

#define ORIEL_CONCAT_(a, b) a##b
#define ORIEL_CONCAT(a, b) ORIEL_CONCAT_(a, b)
// ORIEL_TRY(x, expression): declares x as the value of a Result, or returns its Error from the enclosing function.
#define ORIEL_TRY(declaration, expression)                                                     \
  auto ORIEL_CONCAT(result_, __LINE__) = (expression);                                         \
  if (!ORIEL_CONCAT(result_, __LINE__))                                                        \
    return tl::unexpected<::oriel::Error>(std::move(ORIEL_CONCAT(result_, __LINE__)).error()); \
  declaration = std::move(*ORIEL_CONCAT(result_, __LINE__))
// ORIEL_TRY_VOID(expression): the same for a Status, or for a Result whose value is not wanted.
#define ORIEL_TRY_VOID(expression)                                                             \
  do {                                                                                         \
    auto oriel_status = (expression);                                                          \
    if (!oriel_status) return tl::unexpected<::oriel::Error>(std::move(oriel_status).error()); \
  } while (false)

}  // namespace oriel
