#include "bake/scene/ldt.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace oriel {
namespace {

class LdtReader {
 public:
  LdtReader(std::string_view text, const std::string& name) : name_(name) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty()) {
      const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
      lines_.emplace_back(text.substr(0, end));
      text.remove_prefix(std::min(text.size(), end + (text.substr(end).starts_with("\r\n") ? 2 : 1)));
    }
  }

  template <class... Args>
  tl::unexpected<Error> error(fmt::format_string<Args...> format, Args&&... args) const {
    return invalid(fmt::format("{}: line {}", name_, at_), format, std::forward<Args>(args)...);
  }
  void skip(std::size_t lines) { at_ += lines; }
  // `what` completes "expected".
  Result<double> number(const std::string& what, double lowest, double highest) {
    const std::size_t at = at_++;
    if (at >= lines_.size()) return error("found the end of the file, expected {}", what);
    std::string text = lines_[at];
    std::erase_if(text, [](char c) { return c == ' ' || c == '\t' || c == '+'; });
    std::ranges::replace(text, ',', '.');
    double value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || !(value >= lowest && value <= highest))
      return error("found '{}', expected {} from {} to {}", text.substr(0, 40), what, lowest, highest);
    return value;
  }
  Result<std::size_t> count(const std::string& what, double lowest, double highest) {
    ORIEL_TRY(const double value, number(what, lowest, highest));
    if (value != std::floor(value)) return error("found {}, expected {} as a whole number", value, what);
    return static_cast<std::size_t>(value);
  }
  Result<std::vector<float>> angles(const char* what, std::size_t number_of, double highest) {
    std::vector<float> all;
    for (std::size_t i = 0; i < number_of; ++i) {
      ORIEL_TRY(const double angle, number(fmt::format("{} {} of {}, degrees", what, i + 1, number_of), 0, highest));
      if (i > 0 && !(static_cast<float>(angle) > all.back()))
        return error("found {} {} after {}, expected them to ascend", what, angle, all.back());
      all.push_back(static_cast<float>(angle));
    }
    return all;
  }

 private:
  const std::string& name_;
  std::vector<std::string> lines_;
  std::size_t at_ = 0;  // lines read
};

struct LdtHeading {
  std::size_t symmetry = 0, planes = 0, angles = 0;
  double factor = 0;  // of the intensities: cd
};

Result<LdtHeading> read_ldt_heading(LdtReader& in) {
  LdtHeading heading;
  in.skip(2);  // company, kind
  ORIEL_TRY(heading.symmetry, in.count("the symmetry", 0, 4));
  ORIEL_TRY(heading.planes, in.count("the number of C planes", 1, 721));
  in.skip(1);  // their distance
  ORIEL_TRY(heading.angles, in.count("the number of intensities in a plane", 2, 721));
  in.skip(17);  // distance, names, date, sizes, flux fractions
  ORIEL_TRY(const double conversion, in.number("the conversion factor for intensities", 0, kMostCandela));
  in.skip(1);  // tilt while it was measured
  ORIEL_TRY(const std::size_t sets, in.count("the number of sets of lamps", 1, 20));
  in.skip(2);  // number and type of the first set
  ORIEL_TRY(const double lumens, in.number("the flux of the first set of lamps, lm", 0, kMostCandela));
  in.skip(3 + 6 * (sets - 1) + 10);  // colour, watts; other sets; direct ratios
  heading.factor = conversion * lumens / 1000;
  return heading;
}

// The planes that a file of a symmetry holds, of those that it names: the first, and how many.
struct StoredPlanes {
  std::size_t first, count;
};
StoredPlanes stored_planes(const LdtHeading& h) {
  switch (h.symmetry) {
    case 1:
      return {0, 1};
    case 2:
      return {0, h.planes / 2 + 1};
    case 3:
      return {3 * h.planes / 4, h.planes / 2 + 1};
    case 4:
      return {0, h.planes / 4 + 1};
    default:
      return {0, h.planes};
  }
}

}  // namespace

Result<IesFile> parse_ldt(std::string_view text, const std::string& name) {
  LdtReader in(text, name);
  IesFile file;
  LightProfile& profile = file.profile;
  profile.name = name;
  ORIEL_TRY(const LdtHeading heading, read_ldt_heading(in));
  ORIEL_TRY(const std::vector<float> planes, in.angles("C plane", heading.planes, 360));
  ORIEL_TRY(profile.vertical_deg, in.angles("gamma angle", heading.angles, 180));
  const StoredPlanes stored = stored_planes(heading);
  std::vector<std::vector<float>> rows(stored.count);
  for (std::vector<float>& row : rows)
    for (std::size_t i = 0; i < heading.angles; ++i) {
      ORIEL_TRY(const double value, in.number("a luminous intensity, cd per 1000 lm", -kMostCandela, kMostCandela));
      row.push_back(static_cast<float>(std::clamp(value * heading.factor, 0.0, kMostCandela)));
    }
  for (std::size_t i = 0; i < stored.count; ++i)
    profile.horizontal_deg.push_back(planes[(stored.first + i) % planes.size()]);
  std::vector<float>& h = profile.horizontal_deg;
  if (heading.symmetry == 3) {  // 270 by way of 0 to 90: the mirror image of 90 to 270
    for (float& angle : h) angle = angle >= 270 ? 540 - angle : 180 - angle;
    std::ranges::reverse(h), std::ranges::reverse(rows);
  }
  if (heading.symmetry == 0 && h.size() > 1 && h.back() < 360) h.push_back(360), rows.push_back(rows.front());
  const std::array<float, 2> wanted = heading.symmetry == 3   ? std::array{90.0f, 270.0f}
                                      : heading.symmetry == 4 ? std::array{0.0f, 90.0f}
                                      : heading.symmetry == 2 ? std::array{0.0f, 180.0f}
                                      : h.size() == 1         ? std::array{h[0], h[0]}
                                                              : std::array{0.0f, 360.0f};
  if (h.front() != wanted[0] || h.back() != wanted[1])
    return in.error("found C planes from {} to {}, expected {} to {} for symmetry {}", h.front(), h.back(), wanted[0],
                    wanted[1], heading.symmetry);
  for (const std::vector<float>& row : rows) profile.candela.insert(profile.candela.end(), row.begin(), row.end());
  return file;
}

}  // namespace oriel
