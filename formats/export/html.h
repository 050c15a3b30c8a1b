// Pieces of a page. Texts of a pack may hold anything: all that is put in here is shortened and escaped.
#pragma once

#include <fmt/core.h>

#include <string>
#include <vector>

#include "formats/core/vec.h"
#include "formats/image/heat.h"

namespace oriel::report {

// At most kLongestText bytes, then "…"; never within a character of UTF-8; & < > " ' escaped.
inline constexpr std::size_t kLongestText = 120;
std::string shown_text(const std::string& text);

// A sentence, which is not cut: up to kLongestLine bytes.
inline constexpr std::size_t kLongestLine = 1000;
std::string shown_line(const std::string& text);

// Four digits, without an exponent where that is shorter.
std::string number_text(double value);

// A table whose cells are texts of any kind.
class Table {
 public:
  explicit Table(const std::vector<std::string>& heads);
  void row(const std::vector<std::string>& cells);
  bool empty() const { return rows_ == 0; }
  std::string html() const { return html_ + "</tbody></table></div>\n"; }

 private:
  std::string html_;
  std::size_t rows_ = 0;
};

// "N more are left out.", or nothing.
std::string left_out(std::size_t all, std::size_t shown, const std::string& what);

// Bars with their names and values; the longest fills the line.
struct Bar {
  std::string name;
  double value = 0;
  std::string text;
};
std::string bars_html(const std::vector<Bar>& bars);

// <svg> of a heat scale with its values.
std::string legend_svg(const HeatScale& scale);

// <svg> of curves over the angle of incidence, 0 to 90°, values [0, 1]: red, green and blue of a reflectance.
std::string curves_svg(const std::string& title, const std::vector<Vec3>& by_angle);

}  // namespace oriel::report
