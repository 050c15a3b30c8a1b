// The page about a pack: whole for any pack, harmless whatever its texts say, of bounded size, and shown by a browser.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "formats/core/file.h"
#include "formats/export/html.h"
#include "formats/export/picture.h"
#include "formats/export/report.h"
#include "formats/pack/writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel::report {
namespace {
using ::testing::HasSubstr;
using ::testing::Not;

std::string page_of(const Pack& pack, const Limits& limits = {}) {
  const oriel::testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.oriel";
  const auto written = write_pack(path, pack);
  EXPECT_TRUE(written) << written.error().text();
  const auto file = read_file(path);
  const auto index = read_index(*file);
  return page_html(pack, *index, "a.oriel", limits);
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++n;
  return n;
}

Pack full_pack() {
  Pack pack = oriel::testing::tiny_mapped_pack();
  pack.provenance = R"({"tool": "oriel-bake", "options": {"seed": 7}})";
  pack.plan = R"({"scene": {"emitted_lm": [100, 100, 100]}, "radiosity": {"incident_lm": [250, 250, 250]},
    "ledger": {"emitted_lm": 120, "absorbed": {"lm": 90, "standard_error": 0.5}, "escaped": {"lm": 30, "standard_error": 0},
               "closure": 0.001},
    "errors": [{"component": "D", "asked": 0.02, "stated": 0.021, "measured": 0.025,
                "measured_95_interval": [0.02, 0.03]}], "omitted": ["nothing much"]})";
  return pack;
}

TEST(Report, ShowsAllThatAPackHolds) {
  const std::string html = page_of(full_pack());
  for (const char* text : {"<!doctype html>",
                           "<h2>Errors</h2>",
                           "2.5 %",
                           "2 % to 3 %",
                           "<td>100</td>",
                           "<td>250</td>",
                           "<td>90 ± 0.5</td>",
                           "closes within 0.1 %",
                           "nothing much",
                           "<h2>Lightmaps</h2>",
                           "8 × 4, 8 baked texels",
                           "<h2>Surfaces</h2>",
                           "<td>floor</td>",
                           "Radiance maps",
                           "6 × 4",
                           "Surround maps",
                           "Kernels",
                           "Reflectances",
                           "<polyline",
                           "<h2>Sizes</h2>",
                           "lightmap page (2)",
                           "options.seed"})
    EXPECT_THAT(html, HasSubstr(text));
  const Pack pack = full_pack();
  EXPECT_EQ(count(html, "<img "),
            3 * pack.lightmaps.size() + pack.radiance_maps.size() + pack.surround_maps.size() + pack.kernels.size());
  EXPECT_EQ(count(html, "<img "), count(html, "src=\"data:image/png;base64,iVBOR"));
}

// Findings and the worst places come first, with what makes them so and a picture of each.
TEST(Report, FindingsHavePicturesOfTheirPlace) {
  Pack pack = full_pack();
  const DVec3 o = pack.mesh.origin;
  pack.plan = fmt::format(
      R"({{"findings": ["the lightmap is too dark on 'wall'; a finer --texel mends that"], "warnings": ["'nobody' is odd"],
           "radiosity": {{"certificate": {{"worst": [{{"surface": "floor", "at": [{}, {}, {}], "baked_cd_m2": 1.5,
             "measured_cd_m2": 2.5, "share": 0.4}}, 7, {{"at": ["x", 1, 2]}}]}}}}}})",
      o.x + 0.5, o.y, o.z + 1.7);
  const std::string html = page_of(pack);
  for (const char* text : {"<h2>Findings</h2>", "finding:</b> the lightmap is too dark on", "warning:</b>",
                           "baked 1.5 cd/m², unbiased paths find 2.5; 40 % of all squared error"})
    EXPECT_THAT(html, HasSubstr(text));
  EXPECT_EQ(count(html, "the place, ringed"), 2u) << "of the wall and of the floor";
  EXPECT_LT(html.find("<h2>Findings"), html.find("<h2>Lightmaps"));
  EXPECT_THAT(html, HasSubstr("standard error as seen"));
}

// Sentences are whole, names are cut.
TEST(Report, OmissionsAreNotCut) {
  Pack pack = full_pack();
  const std::string line = "'mirror': " + std::string(180, 'x') + " the end";
  pack.plan = R"({"omitted": [")" + line + R"("]})";
  EXPECT_THAT(page_of(pack), HasSubstr("x the end"));
}

TEST(Report, NeedsNothingFromOutside) {
  const std::string html = page_of(full_pack());
  for (const char* outside : {"http:", "https:", "<script", "@import", "url(", " src=\"/"})
    EXPECT_THAT(html, Not(HasSubstr(outside)));
}

// Each section alone taken away, and all of them.
TEST(Report, EverySectionMayBeAbsent) {
  const std::vector<void (*)(Pack&)> takers = {
      [](Pack& p) { p.provenance.clear(); },
      [](Pack& p) { p.plan.clear(); },
      [](Pack& p) { p.light_groups.clear(), p.page_groups.clear(), p.day = {}; },
      [](Pack& p) {
        p.radiance_maps.clear(), p.map_meshes.clear(), p.reflectors.clear(), p.emitters.clear(),
            p.frosted_panes.clear();
      },
      [](Pack& p) { p.curved_reflectors.clear(), p.surround_maps.clear(); },
      [](Pack& p) {
        p.kernels.clear(), p.fresnel_maps.clear();
        for (Material& m : p.materials) m.kernel = m.fresnel_map = -1;
      },
      [](Pack& p) {
        p.lightmaps.clear();
        for (MeshPart& part : p.mesh.parts) part.lightmap_page = -1;
      },
      [](Pack& p) { p.cameras.clear(), p.paths.clear(), p.movers.clear(), p.light_field = {}; }};
  Pack bare = full_pack();
  for (const auto take : takers) {
    Pack pack = full_pack();
    pack.light_groups.clear(), pack.page_groups.clear(), pack.day = {};  // they tell of all that is taken
    take(pack);
    take(bare);
    EXPECT_THAT(page_of(pack), HasSubstr("</html>"));
  }
  const std::string html = page_of(bare);
  for (const char* gone : {"<h2>Errors", "<h2>Light", "<h2>Surfaces", "<h2>Reflections", "<h2>Materials", "<img "})
    EXPECT_THAT(html, Not(HasSubstr(gone)));
  EXPECT_THAT(page_html(Pack{}, PackIndex{}, ""), HasSubstr("</html>"));
}

TEST(Report, TextsOfThePackAreText) {
  const std::string hostile = "\"><script>alert('x')</script><img src=x onerror=alert(1)>&amp;";
  Pack pack = full_pack();
  for (MeshPart& part : pack.mesh.parts) part.name = hostile;
  for (Material& material : pack.materials) material.name = hostile;
  for (Reflector& reflector : pack.reflectors) reflector.name = hostile;
  pack.provenance = R"({"</details><script>": "<script>alert(2)</script>"})";
  pack.plan = R"({"omitted": ["</ul><script>alert(3)</script>", 5, null],
    "errors": [7, {"component": "<script>", "asked": "<b>", "measured_95_interval": ["<i>", 1]}]})";
  const std::string html = page_html(pack, PackIndex{}, hostile);
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(3)"));
}

TEST(Report, LongTextsEndBetweenCharacters) {
  EXPECT_EQ(shown_text("a & b"), "a &amp; b");
  EXPECT_EQ(shown_text(std::string(kLongestText - 1, 'a') + "éé"), std::string(kLongestText - 1, 'a') + "…");
  EXPECT_EQ(shown_text(std::string(500, '\x80')), "…") << "no character at all";
}

TEST(Report, SizeIsBoundedAndTheRestIsSaid) {
  Pack pack = full_pack();
  const RadianceMap map = pack.radiance_maps[0];
  const MeshPart part = pack.mesh.parts[0];
  pack.radiance_maps.assign(3000, map);
  pack.map_meshes.clear();
  pack.mesh.parts.assign(20000, part);
  for (MeshPart& p : pack.mesh.parts) p.name = std::string(3000, 'n');
  LightmapPage page;
  page.width = page.height = 2048;
  page.irradiance.resize(2048 * 2048);
  for (std::size_t i = 0; i < page.irradiance.size(); ++i)  // as hard to compress as noise
    page.irradiance[i] = Vec3(static_cast<float>(i * 2654435761u % 1000));
  page.standard_error.assign(2048 * 2048, Vec3(1));
  page.state.assign(2048 * 2048, TexelState::kValid);
  pack.lightmaps.push_back(std::move(page));
  std::string plan = R"({"omitted": [)";
  for (int i = 0; i < 5000; ++i) plan += "\"" + std::string(1000, 'o') + "\",";
  pack.plan = plan + "1]}";
  Limits limits;
  limits.surface_points = 1;
  const std::string html = page_html(pack, PackIndex{}, "large", limits);
  EXPECT_LT(html.size(), 4u << 20);
  for (const char* text : {"2976 more radiance maps are left out", "19800 more surfaces", "4601 more omissions"})
    EXPECT_THAT(html, HasSubstr(text));
}

TEST(Picture, IsTheMeanOfWhatIsKnown) {
  const Raster raster = reduced(
      4, 2, 2, [](std::size_t i) { return Vec3(static_cast<float>(i)); }, [](std::size_t i) { return i % 4 < 2; });
  ASSERT_EQ(raster.light.width, 2u);
  ASSERT_EQ(raster.light.height, 1u);
  EXPECT_EQ(raster.light.pixels[0], (0 + 1 + 4 + 5) / 4.0f);
  EXPECT_EQ(raster.known[0], 1);
  EXPECT_EQ(raster.known[1], 0);
  const Raster odd = reduced(
      5, 1, 2, [](std::size_t) { return Vec3(3); }, [](std::size_t) { return true; });
  EXPECT_EQ(odd.light.width, 2u);
  EXPECT_EQ(odd.light.pixels[3], 3);
  Raster two = reduced(
      1, 2, 9, [](std::size_t i) { return Vec3(static_cast<float>(i)); }, [](std::size_t i) { return i == 1; });
  two = flipped(two);
  EXPECT_EQ(two.light.pixels[0], 1);
  EXPECT_EQ(two.known[0], 1);
  EXPECT_EQ(two.known[1], 0);
}

// A browser has nothing to complain of: neither errors on its console nor something to load.
TEST(Report, OpensInABrowser) {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0) GTEST_SKIP() << "chromium is not installed";
  const oriel::testing::TemporaryFolder folder;
  const auto console = [&](const std::string& html) {
    EXPECT_TRUE(write_file_atomically(folder.path() / "page.html", bytes_of_text(html)));
    const std::string command =
        "timeout 60 chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr --v=0 "
        "--user-data-dir=" +
        (folder.path() / "profile").string() + " --dump-dom file://" + (folder.path() / "page.html").string() + " >" +
        (folder.path() / "dom.txt").string() + " 2>" + (folder.path() / "log.txt").string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream log(folder.path() / "log.txt");
    std::string complaints;
    for (std::string line; std::getline(log, line);)
      if (line.find("CONSOLE") != std::string::npos) complaints += line + "\n";
    return complaints;
  };
  EXPECT_NE(console("<script>console.error('seen')</script>"), "") << "the console is not read";
  EXPECT_EQ(console(page_of(full_pack())), "");
  std::ifstream dom(folder.path() / "dom.txt");
  std::ostringstream text;
  text << dom.rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("<h2>Surfaces</h2>"));
}

}  // namespace
}  // namespace oriel::report
