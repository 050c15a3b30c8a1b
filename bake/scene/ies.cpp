#include "bake/scene/ies.h"

#include <charconv>

namespace oriel {
namespace {

constexpr double kMostAngles = 4096;
constexpr double kMostCandela = 1e12;

// Lines for the header, then numbers between blanks, commas and line ends.
class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  template <class... Args>
  tl::unexpected<Error> error(fmt::format_string<Args...> format, Args&&... args) const {
    return invalid(fmt::format("{}: line {}", name_, line_), format, std::forward<Args>(args)...);
  }

  // The next line without blanks around it; false at the end of the file.
  bool line(std::string_view& out) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    out = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    const std::size_t first = out.find_first_not_of(kBlank), last = out.find_last_not_of(kBlank);
    out = first == std::string_view::npos ? std::string_view() : out.substr(first, last - first + 1);
    return true;
  }

  // `what` completes "expected".
  Result<double> number(const std::string& what, double lowest, double highest) {
    std::string_view token = next_token();
    if (token.empty()) return error("found the end of the file, expected {}", what);
    double value = 0;
    const std::string_view digits = token.front() == '+' ? token.substr(1) : token;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code != std::errc() || end != digits.data() + digits.size() || !(value >= lowest && value <= highest))
      return error("found '{}', expected {} from {} to {}", token.substr(0, 40), what, lowest, highest);
    return value;
  }
  Result<std::size_t> count(const std::string& what, double lowest) {
    ORIEL_TRY(const double value, number(what, lowest, kMostAngles));
    if (value != std::floor(value)) return error("found {}, expected {} as a whole number", value, what);
    return static_cast<std::size_t>(value);
  }

  bool at_end() { return next_token().empty(); }
  // Numbers start on the line after the one that line() gave last.
  void start_numbers() { ++line_; }

 private:
  static constexpr std::string_view kBlank = " \t\r\f\v\x1a";

  std::string_view next_token() {
    constexpr std::string_view kSeparators = " \t\r\n\f\v\x1a,";
    for (; at_ < text_.size() && kSeparators.find(text_[at_]) != std::string_view::npos; ++at_)
      line_ += text_[at_] == '\n';
    const std::size_t start = std::min(at_, text_.size());
    at_ = std::min(text_.find_first_of(kSeparators, start), text_.size());
    return text_.substr(start, at_ - start);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 0;
};

// Header and keywords, up to what TILT says.
Result<std::string_view> read_header(Reader& in) {
  std::string_view line;
  if (!in.line(line) || (line != "IESNA:LM-63-2002" && line != "IESNA:LM-63-1995" && line != "IESNA91"))
    return in.error("found '{}', expected IESNA:LM-63-2002, IESNA:LM-63-1995 or IESNA91", line.substr(0, 40));
  constexpr std::string_view kTilt = "TILT=";
  while (in.line(line))
    if (line.starts_with(kTilt)) return line.substr(kTilt.size());
  return in.error("found the end of the file, expected a line TILT=NONE or TILT=INCLUDE");
}

Result<std::vector<float>> read_angles(Reader& in, std::size_t count, const char* what) {
  std::vector<float> angles;
  for (std::size_t i = 0; i < count; ++i) {
    ORIEL_TRY(const double angle, in.number(fmt::format("{} angle {} of {}, degrees", what, i + 1, count), 0, 360));
    if (i > 0 && !(static_cast<float>(angle) > angles.back()))
      return in.error("found {} angle {} after {}, expected them to ascend", what, angle, angles.back());
    angles.push_back(static_cast<float>(angle));
  }
  return angles;
}

Status skip_tilt(Reader& in) {
  ORIEL_TRY_VOID(in.number("the lamp-to-luminaire geometry", 1, 3));
  ORIEL_TRY(const std::size_t pairs, in.count("the number of tilt angles", 0));
  ORIEL_TRY_VOID(read_angles(in, pairs, "tilt"));
  for (std::size_t i = 0; i < pairs; ++i) ORIEL_TRY_VOID(in.number("a tilt multiplier", 0, kMostCandela));
  return {};
}

Status check_range(const Reader& in, const LightProfile& p) {
  const float v0 = p.vertical_deg.front(), v1 = p.vertical_deg.back();
  if ((v0 != 0 && v0 != 90) || (v1 != 90 && v1 != 180))
    return in.error("found vertical angles from {} to {}, expected 0 to 90, 90 to 180 or 0 to 180", v0, v1);
  const float h0 = p.horizontal_deg.front(), h1 = p.horizontal_deg.back();
  const bool from_zero = h0 == 0 && (h1 == 0 || h1 == 90 || h1 == 180 || h1 == 360);
  if (!from_zero && !(h0 == 90 && h1 == 270))
    return in.error("found horizontal angles from {} to {}, expected 0 alone, 0 to 90, 180 or 360, or 90 to 270", h0,
                    h1);
  return {};
}

// The factor for the candela values, and how many angles follow.
struct Heading {
  double factor;
  std::size_t verticals, horizontals;
};

Result<Heading> read_heading(Reader& in) {
  ORIEL_TRY_VOID(in.number("the number of lamps", 0, kMostCandela));
  ORIEL_TRY_VOID(in.number("the lumens of a lamp (-1: absolute photometry)", -1, kMostCandela));
  ORIEL_TRY(const double multiplier, in.number("the candela multiplier", 0, kMostCandela));
  ORIEL_TRY(const std::size_t verticals, in.count("the number of vertical angles", 2));
  ORIEL_TRY(const std::size_t horizontals, in.count("the number of horizontal angles", 1));
  ORIEL_TRY(const std::size_t type, in.count("the photometric type", 1));
  if (type != 1)
    return in.error("found photometric type {}{}, expected 1: type C, with the nadir as axis", type,
                    type == 2   ? " (B)"
                    : type == 3 ? " (A)"
                                : "");
  ORIEL_TRY_VOID(in.number("the unit of the dimensions (1: feet, 2: metres)", 1, 2));
  for (const char* dimension : {"width", "length", "height"})  // negative where round
    ORIEL_TRY_VOID(in.number(fmt::format("the luminaire's {}", dimension), -kMostCandela, kMostCandela));
  ORIEL_TRY(const double ballast, in.number("the ballast factor", 0, kMostCandela));
  ORIEL_TRY(const double ballast_lamp, in.number("the ballast-lamp factor", 0, kMostCandela));
  ORIEL_TRY_VOID(in.number("the input power, watts", 0, kMostCandela));
  return Heading{multiplier * ballast * ballast_lamp, verticals, horizontals};
}

}  // namespace

Result<IesFile> parse_ies(std::string_view text, const std::string& name) {
  Reader in(text, name);
  IesFile file;
  LightProfile& profile = file.profile;
  profile.name = name;
  ORIEL_TRY(const std::string_view tilt, read_header(in));
  if (tilt != "NONE" && tilt != "INCLUDE")
    return in.error("found TILT={}, expected TILT=NONE or TILT=INCLUDE", tilt.substr(0, 40));
  in.start_numbers();
  if (tilt == "INCLUDE") {
    ORIEL_TRY_VOID(skip_tilt(in));
    file.warnings.push_back(fmt::format("{}: TILT=INCLUDE is left out: the luminaire shines as if not tilted", name));
  }
  ORIEL_TRY(const Heading heading, read_heading(in));
  ORIEL_TRY(profile.vertical_deg, read_angles(in, heading.verticals, "vertical"));
  ORIEL_TRY(profile.horizontal_deg, read_angles(in, heading.horizontals, "horizontal"));
  ORIEL_TRY_VOID(check_range(in, profile));
  const std::size_t count = heading.verticals * heading.horizontals;
  for (std::size_t i = 0; i < count; ++i) {
    ORIEL_TRY(const double candela, in.number(fmt::format("candela value {} of {}", i + 1, count), 0, kMostCandela));
    if (!(candela * heading.factor <= kMostCandela))
      return in.error("found {} cd times {}, expected at most {} cd", candela, heading.factor, kMostCandela);
    profile.candela.push_back(static_cast<float>(candela * heading.factor));
  }
  if (!in.at_end()) file.warnings.push_back(fmt::format("{}: what follows the last candela value is left out", name));
  return file;
}

}  // namespace oriel
