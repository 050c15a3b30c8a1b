// Two packs in one picture, and in one window.
#include "formats/core/color.h"
#include "formats/core/file.h"
#include "formats/image/png.h"
#include "tests/support/exr.h"
#include "tests/support/play_program.h"

namespace oriel {
namespace {
using namespace testing;

// tiny.oriel beside the same with half of its light.
class Beside : public Play {
 protected:
  void SetUp() override {
    Play::SetUp();
    write_darker(folder());
  }
  static void write_darker(const std::filesystem::path& folder) {
    Pack darker = tiny_pack();
    for (LightmapPage& page : darker.lightmaps)
      for (Vec3& e : page.irradiance) e *= 0.5f;
    ASSERT_TRUE(write_pack(folder / "dark.oriel", darker));
  }
};

TEST_F(Beside, AnOffscreenPictureIsPartedWhereItIsTold) {
  const std::string draw = "--offscreen --size 33x17 --camera 0 --exposure 5 -o ";
  ASSERT_EQ(run("tiny.oriel " + draw + "a.exr").code, 0);
  ASSERT_EQ(run("dark.oriel " + draw + "b.exr").code, 0);
  ASSERT_TRUE(ends(run("tiny.oriel dark.oriel --split 0.4 " + draw + "both.exr"), 0, "both.exr"));
  const auto a = read_exr(folder() / "a.exr"), b = read_exr(folder() / "b.exr"), both = read_exr(folder() / "both.exr");
  ASSERT_TRUE(a && b && both);
  ASSERT_NE(a->pixels, b->pixels);
  for (std::size_t i = 0; i < both->pixels.size(); ++i)
    ASSERT_EQ(both->pixels[i], (i / 3 % 33 < 13 ? a : b)->pixels[i]) << i;
  // A picture of the first beside the first: the same as the first alone, also as shown.
  ASSERT_EQ(run("tiny.oriel " + draw + "a.png").code, 0);
  ASSERT_EQ(run("tiny.oriel a.png " + draw + "beside.png").code, 0);
  EXPECT_EQ(read_png(folder() / "a.png")->pixels, read_png(folder() / "beside.png")->pixels);
  // Its camera is the one it was taken with.
  ASSERT_TRUE(ends(run("tiny.oriel a.exr --offscreen --size 33x17 --exposure 5 -o again.exr"), 0, "again.exr"));
  EXPECT_EQ(read_exr(folder() / "again.exr")->pixels, a->pixels);
}

TEST_F(Beside, SaysWhyThereIsNothingBeside) {
  EXPECT_TRUE(ends(run("tiny.oriel absent.oriel --offscreen -o a.png"), 2, "absent.oriel"));
  EXPECT_TRUE(ends(run("tiny.oriel script.txt --offscreen -o a.png"), 1, "expected a pack (.oriel) or a picture"));
  ASSERT_TRUE(write_file_atomically(folder() / "broken.oriel", Bytes(100)));
  EXPECT_TRUE(ends(run("tiny.oriel broken.oriel --offscreen -o a.png"), 3, "broken.oriel"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "a.png"));
  EXPECT_TRUE(ends(run("tiny.oriel --split 0.3"), 1, "--split"));
  EXPECT_EQ(run("tiny.oriel dark.oriel --offscreen -o a.png --split 1.1").code, 1);
  EXPECT_TRUE(ends(run("tiny.oriel dark.oriel --offscreen --compare a.png"), 1, "dark.oriel"));
  EXPECT_TRUE(ends(run("tiny.oriel dark.oriel --offscreen --panorama -o a.png"), 1, "--panorama"));
}

TEST_F(Beside, APackIsComparedWithAnother) {
  const std::string compare = "tiny.oriel --offscreen --size 33x17 --camera 0 --max-flip 0 --json a.json --compare ";
  EXPECT_TRUE(ends(run(compare + "tiny.oriel"), 0, "33x17: 0 pixels changed"));
  EXPECT_TRUE(ends(run(compare + "dark.oriel -o flip.png"), 5, "found a FLIP of"));
  EXPECT_TRUE(ends(shell("cat a.json"), 0, "\"passed\": false"));
  EXPECT_EQ(read_png(folder() / "flip.png")->width, 33u);
  EXPECT_TRUE(ends(run(compare + "absent.oriel"), 2, "absent.oriel"));
}

// The mean of the pixels of a frame so many times as large, as light; and as the display shines.
TEST_F(Beside, SupersampledPicturesAreMeans) {
  const std::string draw = "tiny.oriel --offscreen --camera 0 --exposure 5 ";
  ASSERT_EQ(run(draw + "--size 48x27 --samples 1 -o large.exr").code, 0);
  ASSERT_EQ(run(draw + "--size 48x27 --samples 1 -o large.png").code, 0);
  ASSERT_EQ(run(draw + "--size 16x9 --supersample 3 -o small.exr").code, 0);
  ASSERT_EQ(run(draw + "--size 16x9 --supersample 3 -o small.png").code, 0);
  const auto large = read_exr(folder() / "large.exr"), small = read_exr(folder() / "small.exr");
  const auto large_png = read_png(folder() / "large.png"), small_png = read_png(folder() / "small.png");
  ASSERT_TRUE(large && small && large_png && small_png);
  ASSERT_EQ(small->width, 16u);
  ASSERT_EQ(small_png->height, 9u);
  for (std::size_t i = 0; i < small->pixels.size(); ++i) {
    const std::size_t x = i / 3 % 16, y = i / 48, c = i % 3;
    double light = 0, shone = 0;
    for (std::size_t j = 0; j < 9; ++j) {
      const std::size_t at = ((3 * y + j / 3) * 48 + 3 * x + j % 3) * 3 + c;
      light += double{large->pixels[at]} / 9;
      shone += double{linear_from_srgb8(large_png->pixels[at])} / 9;
    }
    ASSERT_NEAR(small->pixels[i], light, 1e-5 * (1 + light));
    ASSERT_NEAR(small_png->pixels[i], 255 * srgb_from_linear(static_cast<float>(shone)), 0.51);
  }
  EXPECT_TRUE(ends(run(draw + "--size 30000x9 --supersample 16 -o a.png"), 1, "480000x144"));
  EXPECT_EQ(run(draw + "--supersample 0 -o a.png").code, 1);
  EXPECT_TRUE(ends(run(draw + "--panorama --supersample 2 -o a.png"), 1, "--supersample"));
}

class BesideWindow : public PlayWindow {};

// The keys and the divider under the mouse, each as a screenshot.
TEST_F(BesideWindow, KeysAndTheDividerChooseWhatIsSeen) {
  Pack darker = tiny_pack();
  for (LightmapPage& page : darker.lightmaps)
    for (Vec3& e : page.irradiance) e *= 0.5f;
  ASSERT_TRUE(write_pack(folder() / "dark.oriel", darker));
  std::string start = kStart;
  start.replace(start.find("tiny.oriel"), 10, "tiny.oriel dark.oriel --camera 0 --exposure 5");
  const Outcome r = in_display(start + R"(
key F12
key v; key F12
key v; key F12
key b; drag 80 30 20 30; key F12
quit
)");
  ASSERT_TRUE(ends(r, 0, "oriel-003.png"));
  std::vector<std::vector<std::uint8_t>> shots;
  for (int i = 0; i < 4; ++i) {
    const auto shot = read_png(folder() / ("oriel-00" + std::to_string(i) + ".png"));
    ASSERT_TRUE(shot) << shot.error().text();
    ASSERT_EQ(shot->width, 160u);
    shots.push_back(shot->pixels);
  }
  const auto& first = shots[1];
  const auto& second = shots[2];
  ASSERT_NE(first, second);
  const auto parted = [&](std::size_t column) {
    std::vector<std::uint8_t> out = second;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (i / 3 % 160 < column) out[i] = first[i];
    return out;
  };
  EXPECT_EQ(shots[0], parted(80));
  EXPECT_EQ(shots[3], parted(20)) << "the divider was dragged";
}

}  // namespace
}  // namespace oriel
