// Always-on checks of our own invariants. A failed one is a bug in Oriel: it prints both values and aborts.
// Never use them on input: bad input gets a Result (result.h).
#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace oriel::detail {

template <class A, class B>
[[noreturn]] void check_failed(const char* file, int line, const char* text, const A& a, const B& b) {
  std::ostringstream out;
  out << file << ":" << line << ": broken invariant: " << text << " (found " << a << " and " << b << ")\n";
  std::fputs(out.str().c_str(), stderr);
  std::abort();
}

}  // namespace oriel::detail

#define ORIEL_CHECK_OP_(op, a, b)                                                                                      \
  do {                                                                                                                 \
    const auto& oriel_a = (a);                                                                                         \
    const auto& oriel_b = (b);                                                                                         \
    if (!(oriel_a op oriel_b)) ::oriel::detail::check_failed(__FILE__, __LINE__, #a " " #op " " #b, oriel_a, oriel_b); \
  } while (false)
#define ORIEL_CHECK_EQ(a, b) ORIEL_CHECK_OP_(==, a, b)
#define ORIEL_CHECK_LT(a, b) ORIEL_CHECK_OP_(<, a, b)
#define ORIEL_CHECK_LE(a, b) ORIEL_CHECK_OP_(<=, a, b)
#define ORIEL_CHECK(condition) ORIEL_CHECK_OP_(==, static_cast<bool>(condition), true)
