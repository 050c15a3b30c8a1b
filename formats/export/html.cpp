#include "formats/export/html.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/core/text.h"

namespace oriel::report {

namespace {

std::string shortened(const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return escaped(text);
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return escaped(text.substr(0, end)) + "…";
}

}  // namespace

std::string shown_text(const std::string& text) {
  return shortened(text, kLongestText);
}

std::string shown_line(const std::string& text) {
  return shortened(text, kLongestLine);
}

std::string number_text(double value) {
  return std::abs(value) >= 1000 && std::abs(value) < 1e7 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

Table::Table(const std::vector<std::string>& heads) : html_("<div class=\"wide\"><table><thead><tr>") {
  for (const std::string& head : heads) html_ += "<th>" + shown_text(head) + "</th>";
  html_ += "</tr></thead><tbody>\n";
}

void Table::row(const std::vector<std::string>& cells) {
  html_ += "<tr>";
  for (const std::string& cell : cells) html_ += "<td>" + shown_text(cell) + "</td>";
  html_ += "</tr>\n";
  ++rows_;
}

std::string left_out(std::size_t all, std::size_t shown, const std::string& what) {
  if (all <= shown) return {};
  return fmt::format("<p class=\"quiet\">{} more {} are left out.</p>\n", all - shown, escaped(what));
}

std::string bars_html(const std::vector<Bar>& bars) {
  double most = 0;
  for (const Bar& bar : bars) most = std::max(most, bar.value);
  std::string html = "<div class=\"bars\">\n";
  for (const Bar& bar : bars)
    html += fmt::format("<span>{}</span><i style=\"width:{:.1f}%\"></i><span>{}</span>\n", shown_text(bar.name),
                        most > 0 ? 100 * bar.value / most : 0, shown_text(bar.text));
  return html + "</div>\n";
}

namespace {

// The next of 1, 2, 5, 10, … times the decade, which it keeps up.
double next_step(double value, double& decade) {
  const double share = value / decade;
  if (share < 1.5) return 2 * decade;
  if (share < 3) return 5 * decade;
  decade *= 10;
  return decade;
}

}  // namespace

std::string legend_svg(const HeatScale& scale) {
  constexpr int kWidth = 360, kSteps = 60, kLeft = 20;
  std::string svg = fmt::format("<svg class=\"legend\" viewBox=\"0 0 {} 34\" width=\"{}\" height=\"34\">\n",
                                kWidth + 2 * kLeft + 100, kWidth + 2 * kLeft + 100);
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 c = heat((static_cast<float>(i) + 0.5f) / kSteps) * 255.0f;
    svg += fmt::format("<rect x=\"{}\" y=\"0\" width=\"{}\" height=\"14\" fill=\"rgb({:.0f},{:.0f},{:.0f})\"/>",
                       kLeft + i * kWidth / kSteps, kWidth / kSteps + 1, c.r, c.g, c.b);
  }
  // 1, 2 and 5 of each decade where these are few.
  const bool fine = scale.highest < 150 * scale.lowest;
  for (double decade = std::pow(10, std::floor(std::log10(double{scale.lowest}) + 1e-6)), value = decade;
       value < 1.001 * double{scale.highest}; value = fine ? next_step(value, decade) : value * 10) {
    if (value < 0.999 * double{scale.lowest}) continue;
    svg += fmt::format("\n<text x=\"{:.1f}\" y=\"29\" text-anchor=\"middle\">{}</text>",
                       kLeft + kWidth * double{share_of(scale, static_cast<float>(value))}, number_text(value));
  }
  return svg + fmt::format("\n<text x=\"{}\" y=\"12\">{}</text></svg>\n", kLeft + kWidth + 8, escaped(scale.unit));
}

std::string curves_svg(const std::string& title, const std::vector<Vec3>& by_angle) {
  constexpr double kWidth = 200, kHeight = 120, kLeft = 26, kTop = 20;
  constexpr std::array<const char*, 3> kStrokes = {"#c0392b", "#1e8449", "#2471a3"};
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 240 164\" width=\"240\" height=\"164\"><text x=\"{}\" y=\"13\">{}"
      "</text>\n<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"frame\"/>\n",
      kLeft, shown_text(title), kLeft, kTop, kWidth, kHeight);
  for (const int degrees : {0, 30, 60, 90})
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}°</text>", kLeft + kWidth * degrees / 90,
                       kTop + kHeight + 14, degrees);
  svg += fmt::format(
      "<text x=\"{0}\" y=\"{1}\" text-anchor=\"end\">1</text><text x=\"{0}\" y=\"{2}\" "
      "text-anchor=\"end\">0</text>\n",
      kLeft - 4, kTop + 8, kTop + kHeight);
  for (std::size_t c = 0; c < 3 && by_angle.size() > 1; ++c) {
    svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" points=\"", kStrokes[c]);
    for (std::size_t i = 0; i < by_angle.size(); ++i)
      svg += fmt::format("{:.1f},{:.1f} ", kLeft + kWidth * static_cast<double>(i) / double(by_angle.size() - 1),
                         kTop + kHeight * (1 - std::clamp(double{by_angle[i][static_cast<int>(c)]}, 0.0, 1.0)));
    svg += "\"/>\n";
  }
  return svg + "</svg>\n";
}

}  // namespace oriel::report
