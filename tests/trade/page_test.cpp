#include <gmock/gmock.h>

#include "formats/core/json.h"
#include "formats/image/png.h"
#include "tests/support/temporary_folder.h"
#include "trade/html.h"
#include "trade/plot.h"
#include "trade/table.h"
#include "trade/thumbnails.h"

namespace oriel::trade {
namespace {
using ::testing::HasSubstr;
using ::testing::Not;

Trade small_trade() {
  Trade trade;
  trade.scene = "a <scene> & more.glb";
  trade.facts.cameras = {"door"};
  Row row;
  row.configuration = {"default", "", {{"--error", "2%"}, {"--texel", "10cm"}}, {}, 0};
  row.measures.bake = BakeCost{1.25, 2.5, 3000};
  row.measures.frame_ms = 20;
  row.measures.frames = {{"door", 0.1, 0.2, 0.3, 0.4, 0.5, 0.01}};
  row.fronts = {"frames_by_ms", "frames_by_bake"};
  trade.rows.push_back(row);
  row.configuration = {"odd", "\"x\", y", {}, {{"--blur", "off"}}, 0};
  row.measures = {};
  row.failure = "exit code 4: no,\nreally";
  row.fronts.clear();
  trade.rows.push_back(row);
  return trade;
}

// Fields of RFC 4180, by line.
std::vector<std::vector<std::string>> read_csv(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& field = lines.back().back();
    if (quoted && text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"')
      field += text[i++];
    else if (text[i] == '"')
      quoted = !quoted;
    else if (!quoted && text[i] == ',')
      lines.back().push_back("");
    else if (!quoted && text.compare(i, 2, "\r\n") == 0)
      lines.push_back({""}), ++i;
    else
      field += text[i];
  }
  lines.pop_back();
  return lines;
}

TEST(Table, CsvHoldsEveryFieldOfEveryRow) {
  const auto lines = read_csv(trade_csv(small_trade()));
  ASSERT_EQ(lines.size(), 3u);
  for (const auto& line : lines) EXPECT_EQ(line.size(), lines[0].size());
  const auto field = [&](std::size_t row, const char* name) {
    const auto at = std::find(lines[0].begin(), lines[0].end(), name) - lines[0].begin();
    return lines[row + 1].at(static_cast<std::size_t>(at));
  };
  EXPECT_EQ(field(0, "bake_s"), "1.25");
  EXPECT_EQ(field(0, "bytes"), "3000");
  EXPECT_EQ(field(0, "frame_S"), "0.3");
  EXPECT_EQ(field(0, "psnr_db"), "20");
  EXPECT_EQ(field(0, "bake_options"), "--error 2% --texel 10cm");
  EXPECT_EQ(field(0, "fronts"), "frames_by_ms frames_by_bake");
  EXPECT_EQ(field(1, "setting"), "\"x\", y");
  EXPECT_EQ(field(1, "bake_s"), "");
  EXPECT_EQ(field(1, "failure"), "exit code 4: no,\nreally");
}

TEST(Table, JsonHoldsTheMeasuresAndTheFronts) {
  const Trade trade = small_trade();
  const auto json = Json::parse(trade_json(trade)).value();
  ASSERT_EQ(json["configurations"].size(), 2u);
  const auto back = measures_from_json(json["configurations"][0].dump());
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(as_json(*back), as_json(trade.rows[0].measures));
  EXPECT_EQ(json["fronts"]["frames_by_ms"]["configurations"], Json::array({0}));
  EXPECT_TRUE(json["fronts"]["texels_by_bake"]["configurations"].empty());
  EXPECT_EQ(json["configurations"][1]["failure"], "exit code 4: no,\nreally");
}

TEST(Html, IsWholeWithoutANetwork) {
  const std::string html = trade_html(small_trade());
  EXPECT_THAT(html, HasSubstr("a &lt;scene&gt; &amp; more.glb"));
  EXPECT_THAT(html, HasSubstr("&quot;x&quot;, y"));
  EXPECT_THAT(html, HasSubstr("<svg"));
  EXPECT_THAT(html, HasSubstr("failed: exit code 4"));
  for (const char* outside : {"http:", "https:", "<link", " src=\"/", "@import"})
    EXPECT_THAT(html, Not(HasSubstr(outside)));
  EXPECT_THAT(trade_html(Trade{}), HasSubstr("</html>")) << "of nothing too";
}

TEST(Plot, DrawsEveryDotWithinTheFrame) {
  Plot plot{"t", "x", "y", {}};
  plot.dots = {{1, 10, "a", "tip <a>", 0, true}, {100, 1, "b", "tip b", 1, true}, {50, 0, "lost", "tip c", 99, false}};
  const std::string svg = plot_svg(plot);
  std::size_t circles = 0;
  for (std::size_t at = 0; (at = svg.find("<circle", at)) != std::string::npos; ++at) ++circles;
  EXPECT_EQ(circles, 3u);
  EXPECT_THAT(svg, HasSubstr("<title>tip &lt;a&gt;</title>"));
  EXPECT_THAT(svg, HasSubstr("class=\"front\""));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(plot_svg(Plot{}), Not(HasSubstr("nan")));
}

TEST(Thumbnails, AreThirdsOfThePicture) {
  const oriel::testing::TemporaryFolder folder;
  ByteImage image{12, 4, 3, {}};
  for (std::uint32_t i = 0; i < 12 * 4 * 3; ++i) image.pixels.push_back(static_cast<std::uint8_t>(i));
  ASSERT_TRUE(write_png(folder.path() / "three.png", image));
  const auto cut = thumbnails(folder.path() / "three.png", 2);
  ASSERT_TRUE(cut) << cut.error().text();
  EXPECT_EQ(cut->width, 2u);
  EXPECT_EQ(cut->height, 2u);
  EXPECT_THAT(cut->flip, ::testing::StartsWith("data:image/png;base64,iVBOR"));
  EXPECT_NE(cut->reference, cut->frame);
  image.width = 11, image.height = 4, image.pixels.resize(11 * 4 * 3);
  ASSERT_TRUE(write_png(folder.path() / "odd.png", image));
  EXPECT_EQ(thumbnails(folder.path() / "odd.png", 2).error().code, ErrorCode::kInvalid);
  EXPECT_EQ(thumbnails(folder.path() / "none.png", 2).error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace oriel::trade
