#include "bake/scene/ies.h"

#include <algorithm>
#include <charconv>

namespace oriel {
namespace {

constexpr double kMostAngles = 4096;

// Without a byte order mark, and with line ends of one kind.
std::string plain_text(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\r')
      plain += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      plain += '\n';
  return plain;
}

// Without blanks, in capitals.
std::string keyword(std::string_view line) {
  std::string word;
  for (const char c : line)
    if (c != ' ' && c != '\t') word += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return word;
}

// Lines for the header, then numbers between blanks, commas and line ends.
class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : text_(plain_text(text)), name_(name) {}

  template <class... Args>
  tl::unexpected<Error> error(fmt::format_string<Args...> format, Args&&... args) const {
    return invalid(fmt::format("{}: line {}", name_, line_), format, std::forward<Args>(args)...);
  }

  // The next line without blanks around it; false at the end of the file.
  bool line(std::string_view& out) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    out = std::string_view(text_).substr(at_, end - at_);
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
    std::string digits(token.front() == '+' ? token.substr(1) : token);
    for (char& c : digits) c = c == 'D' || c == 'd' ? 'e' : c == ',' ? '.' : c;  // Fortran's exponent; decimal comma
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
  static constexpr std::string_view kBlank = " \t\f\v\x1a";

  std::string_view next_token() {
    constexpr std::string_view kSeparators = " \t\n\f\v\x1a,;";
    for (; at_ < text_.size() && kSeparators.find(text_[at_]) != std::string_view::npos; ++at_)
      line_ += text_[at_] == '\n';
    const std::size_t start = std::min(at_, text_.size());
    at_ = std::min(text_.find_first_of(kSeparators, start), text_.size());
    return std::string_view(text_).substr(start, at_ - start);
  }

  const std::string text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 0;
};

// Header and keywords, up to what TILT says. Files of 1986 have no line of their version.
struct Header {
  std::string tilt;
  bool generation_type = false;  // LM-63-2019: a number says how the file came to be where a factor was
};
Result<Header> read_header(Reader& in) {
  Header header;
  std::string_view line;
  while (in.line(line)) {
    const std::string word = keyword(line);
    if (word.starts_with("TILT=")) {
      header.tilt = word.substr(5);
      return header;
    }
    if (word.starts_with("IESNA:LM-63-")) header.generation_type = word.substr(12) >= "2019";
  }
  return in.error("found the end of the file, expected a line TILT=NONE as every IES LM-63 file has");
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

// Brings planes all around to 0 to 360, and those of 180 to 360 to 0 to 180, of which they are the mirror image.
Status complete_planes(const Reader& in, LightProfile& p) {
  std::vector<float>& h = p.horizontal_deg;
  const std::size_t rows = p.vertical_deg.size();
  if (h.front() == 180 && h.back() == 360) {
    std::ranges::reverse(h);
    for (float& angle : h) angle = 360 - angle;
    std::vector<float> mirrored;
    for (std::size_t plane = h.size(); plane-- > 0;)
      mirrored.insert(mirrored.end(), p.candela.begin() + static_cast<std::ptrdiff_t>(plane * rows),
                      p.candela.begin() + static_cast<std::ptrdiff_t>((plane + 1) * rows));
    p.candela = std::move(mirrored);
  }
  // The last plane is the first again, and some files leave it out.
  if (h.front() == 0 && h.back() > 180 && h.back() < 360 && 360 - h.back() < 1.5f * (h.back() - h[h.size() - 2])) {
    h.push_back(360);
    const std::vector<float> first(p.candela.begin(), p.candela.begin() + static_cast<std::ptrdiff_t>(rows));
    p.candela.insert(p.candela.end(), first.begin(), first.end());
  }
  const float h0 = h.front(), h1 = h.back();
  const bool from_zero = h0 == 0 && (h1 == 0 || h1 == 90 || h1 == 180 || h1 == 360);
  if (!from_zero && !(h0 == 90 && h1 == 270))
    return in.error("found horizontal angles from {} to {}, expected 0 alone, 0 to 90, 180 or 360, or 90 to 270", h0,
                    h1);
  if (p.vertical_deg.back() > 180)
    return in.error("found vertical angle {}, expected at most 180", p.vertical_deg.back());
  return {};
}

// The factor for the candela values, and how many angles follow.
struct Heading {
  double factor;
  std::size_t verticals, horizontals;
};

Result<Heading> read_heading(Reader& in, bool generation_type) {
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
  ORIEL_TRY(const double last, in.number("the ballast-lamp factor", 0, kMostCandela));
  const double ballast_lamp = generation_type ? 1 : last;
  ORIEL_TRY_VOID(in.number("the input power, watts", 0, kMostCandela));
  return Heading{multiplier * ballast * ballast_lamp, verticals, horizontals};
}

// Small negative values are noise of the photometer.
Status read_candela(Reader& in, std::size_t count, double factor, IesFile& file) {
  std::size_t negative = 0;
  for (std::size_t i = 0; i < count; ++i) {
    ORIEL_TRY(const double candela,
              in.number(fmt::format("candela value {} of {}", i + 1, count), -kMostCandela, kMostCandela));
    if (!(candela * factor <= kMostCandela))
      return in.error("found {} cd times {}, expected at most {} cd", candela, factor, kMostCandela);
    negative += candela < 0;
    file.profile.candela.push_back(static_cast<float>(std::max(0.0, candela * factor)));
  }
  if (negative > 0)
    file.warnings.push_back(fmt::format("{}: {} of {} candela values are negative: they are taken as 0",
                                        file.profile.name, negative, count));
  return {};
}

}  // namespace

Result<IesFile> parse_ies(std::string_view text, const std::string& name) {
  Reader in(text, name);
  IesFile file;
  LightProfile& profile = file.profile;
  profile.name = name;
  ORIEL_TRY(const Header header, read_header(in));
  in.start_numbers();
  if (header.tilt != "NONE")
    file.warnings.push_back(
        fmt::format("{}: TILT={} is left out: the luminaire shines as if not tilted", name, header.tilt));
  if (header.tilt == "INCLUDE") ORIEL_TRY_VOID(skip_tilt(in));
  ORIEL_TRY(const Heading heading, read_heading(in, header.generation_type));
  ORIEL_TRY(profile.vertical_deg, read_angles(in, heading.verticals, "vertical"));
  ORIEL_TRY(profile.horizontal_deg, read_angles(in, heading.horizontals, "horizontal"));
  const std::size_t count = heading.verticals * heading.horizontals;
  ORIEL_TRY_VOID(read_candela(in, count, heading.factor, file));
  ORIEL_TRY_VOID(complete_planes(in, profile));
  if (!in.at_end()) file.warnings.push_back(fmt::format("{}: what follows the last candela value is left out", name));
  return file;
}

}  // namespace oriel
