// Prints what docs/notes/validation.md shows: every case of the suite with its exact and published value, ours and the
// stated error, as Markdown. Usage: ORIEL_VALIDATION=DIR validation_table [--quick] [--lux-only] [FAMILY…] [CASE…]
#include <chrono>
#include <cstdio>
#include <functional>
#include <set>

#include "tests/validation/measure.h"
#include "tests/validation/suite.h"

namespace oriel::validation {
namespace {

constexpr std::uint64_t kSeed = 1;

// A value, its distance from the exact one in percent of it, and its stated error.
std::string cell(const Measurements& m, std::size_t i, const Reading& r) {
  if (m.empty() || std::isnan(m[i].value)) return " | |";
  const double difference = m[i].value - r.expected;
  const bool inside = std::abs(difference) <= r.tolerance;
  const std::string relative =
      r.expected != 0 ? fmt::format("{:+.2f} %", 100 * difference / r.expected) : fmt::format("{:+.2g}", difference);
  return fmt::format(" {:.6g} ± {:.2g} | {}{} |", m[i].value, m[i].error, relative, inside ? "" : " **outside**");
}

struct Totals {
  int readings = 0, outside = 0, covered = 0;
  double worst = 0;  // share of the tolerance
};

void count(const Case& c, const Measurements& m, Totals& totals) {
  for (std::size_t i = 0; i < m.size(); ++i) {
    const Reading& r = c.readings[i];
    if (std::isnan(m[i].value)) continue;
    const double difference = std::abs(m[i].value - r.expected);
    ++totals.readings;
    totals.outside += difference > r.tolerance;
    // Closed forms have no noise: what they differ by is rounding, and quadrature over a face.
    totals.covered += difference <= 1.96 * std::hypot(m[i].error, r.reference_error) + 2e-4 * std::abs(r.expected);
    if (r.tolerance > 0) totals.worst = std::max(totals.worst, difference / r.tolerance);
  }
}

// A whole grid in one line.
void print_grid(const Case& c, const Measurements& m, const char* way) {
  if (m.empty()) return;
  double sum = 0, reference = 0, squares = 0, worst = 0;
  for (std::size_t i = 0; i < m.size(); ++i) {
    if (std::isnan(m[i].value)) continue;
    sum += m[i].value;
    reference += c.readings[i].expected;
    squares += std::pow(m[i].value - c.readings[i].expected, 2);
    worst = std::max(worst, std::abs(m[i].value / c.readings[i].expected - 1));
  }
  std::printf("| %s | %s | %zu | %+.2f %% | %.2f %% | %.1f %% |\n", c.id.c_str(), way, m.size(),
              100 * (sum / reference - 1), 100 * std::sqrt(squares * static_cast<double>(m.size())) / reference,
              100 * worst);
}

void print_case(const Case& c, const Measurements& lux, const Measurements& texture) {
  for (std::size_t i = 0; i < c.readings.size(); ++i) {
    const Reading& r = c.readings[i];
    const std::string published = std::isnan(r.published) ? "" : fmt::format("{:g}", r.published);
    std::printf("| %s%s%s | %s | %.6g | %s |%s%s %.2g |\n", c.id.c_str(), c.label.empty() ? "" : ", ", c.label.c_str(),
                r.name.c_str(), r.expected, published.c_str(), cell(lux, i, r).c_str(), cell(texture, i, r).c_str(),
                r.tolerance);
  }
}

int run(const std::set<std::string>& arguments) {
  const auto suite = Suite::open();
  if (!suite) {
    std::fprintf(stderr, "validation_table: ORIEL_VALIDATION names no folder with the suite\n");
    return 1;
  }
  const bool thorough = !arguments.contains("--quick"), textures = !arguments.contains("--lux-only");
  const std::pair<const char*, std::function<std::vector<Case>()>> families[] = {
      {"factors", [&] { return factor_cases(*suite); }},
      {"enclosures", [&] { return enclosure_cases(*suite, thorough); }},
      {"lamps", [&] { return lamp_cases(*suite); }},
      {"skies", [&] { return sky_cases(*suite, thorough); }},
      {"peers", [&] { return peer_cases(*suite, thorough); }}};
  const bool everything =
      std::none_of(arguments.begin(), arguments.end(), [](const std::string& a) { return a[0] != '-'; });
  for (const auto& [name, make] : families) {
    std::vector<Case> cases = make();
    if (!everything && !arguments.contains(name))
      std::erase_if(cases, [&](const Case& c) { return !arguments.contains(c.id); });
    if (cases.empty()) continue;
    const bool grids = std::string(name) == "peers";
    std::printf(grids ? "\n### %s\n\n| case | way | points | mean | nrmse | worst point |\n|---|---|---|---|---|---|\n"
                      : "\n### %s\n\n| case | reading | exact | published | lux | difference | texture | difference | "
                        "tolerance |\n|---|---|---|---|---|---|---|---|---|\n",
                name);
    Totals by_lux, by_texture;
    const auto start = std::chrono::steady_clock::now();
    for (const Case& c : cases) {
      const Measurements lux = measure_by_lux(c, kSeed);
      const Measurements texture =
          textures && c.texel_m > 0
              ? measure_by_texture(c, {.estimator = Estimator::kCached, .samples = 16384, .error = 0.002}, kSeed)
              : Measurements{};
      count(c, lux, by_lux);
      count(c, texture, by_texture);
      if (grids) {
        print_grid(c, lux, "lux");
        print_grid(c, texture, "texture");
      } else {
        print_case(c, lux, texture);
      }
      std::fflush(stdout);
    }
    for (const auto& [way, t] : {std::pair{"lux", by_lux}, {"texture", by_texture}})
      if (t.readings > 0)
        std::fprintf(stderr,
                     "%s by %s: %d readings, %d outside, worst at %.0f %% of its tolerance, %.1f %% within 1.96 "
                     "stated errors, %.0f s\n",
                     name, way, t.readings, t.outside, 100 * t.worst, 100.0 * t.covered / t.readings,
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 0;
}

}  // namespace
}  // namespace oriel::validation

int main(int argc, char** argv) {
  return oriel::validation::run({argv + 1, argv + argc});
}
