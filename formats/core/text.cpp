#include "formats/core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace oriel {
namespace {

// Levenshtein's distance.
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t changed = diagonal + (a[i - 1] != b[k - 1]);
      diagonal = row[k];
      row[k] = std::min({changed, row[k] + 1, row[k - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

Result<double> parse_quantity(const std::string& text, std::span<const Unit> units, const char* what,
                              const char* example) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  if (error == std::errc() && std::isfinite(value) && value > 0)
    for (const Unit& u : units)
      if (unit == u.name) return value * u.factor;
  return fail(ErrorCode::kUsage, "", "found '{}', expected a {} such as {}", text, what, example);
}

Result<double> parse_share(const std::string& text) {
  static constexpr Unit kUnits[] = {{"%", 0.01}, {"", 1}};
  ORIEL_TRY(const double share, parse_quantity(text, kUnits, "share", "2% or 0.02"));
  if (text.back() == '%' || share <= 0.5) return share;
  return fail(ErrorCode::kUsage, "", "found {0:g}, expected a share: write {0:g}% or {1}", share,
              share > 1 ? fmt::format("{:g}", share / 100) : share_text(share));
}

std::string share_text(double share) {
  return share > 0 ? fmt::format("{:.6g}%", 100 * share) : "";
}

Result<float> parse_length(const std::string& text) {
  static constexpr Unit kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"km", 1000}};
  ORIEL_TRY(const double metres, parse_quantity(text, kUnits, "length", "10cm, 0.1m or 100mm"));
  return static_cast<float>(metres);
}

Result<std::uint64_t> parse_bytes(const std::string& text) {
  static constexpr Unit kUnits[] = {{"B", 1},      {"kB", 1e3},      {"MB", 1e6},        {"GB", 1e9},
                                    {"KiB", 1024}, {"MiB", 1048576}, {"GiB", 1073741824}};
  ORIEL_TRY(const double bytes, parse_quantity(text, kUnits, "size", "64MiB or 2GB"));
  if (bytes > 0x1p60) return fail(ErrorCode::kUsage, "", "found '{}', expected at most 1 EiB", text);
  return static_cast<std::uint64_t>(bytes);
}

bool fits_pattern(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, taken = 0;  // by the last *: text up to `taken`
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*')
      star = p++, taken = t;
    else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t]))
      ++p, ++t;
    else if (star != std::string_view::npos)
      p = star + 1, t = ++taken;
    else
      return false;
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::string names_like(const std::string& wanted, const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 5;
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const std::string& name : names)
    if (!name.empty()) sorted.emplace_back(edits_between(wanted, name), name);
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, sorted.size()); ++i)
    text += fmt::format("{}\"{}\"", i > 0 ? ", " : "", sorted[i].second);
  return text.empty() ? "none has a name" : "the nearest are " + text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace oriel
