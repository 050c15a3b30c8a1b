// The program itself: a limit of memory, broken packs and files that change under the window.
#include <gtest/gtest.h>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/pack/index.h"
#include "tests/support/play_program.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;
using namespace testing;

// A page of more than one block of zstd, so that its damage is not met when the pack is opened.
Pack pack_with_a_large_page() {
  Pack pack = testing::tiny_pack();
  LightmapPage& page = pack.lightmaps[0];
  page.width = page.height = 256;
  page.cell.clear(), page.detail.clear(), page.detail_width = page.detail_height = 0;
  page.irradiance.clear();
  std::uint32_t random = 1;
  for (int i = 0; i < 256 * 256; ++i) {
    random = random * 1664525 + 1013904223;
    page.irradiance.push_back(Vec3(1 + static_cast<float>(random >> 16)));
  }
  page.standard_error.assign(page.irradiance.size(), Vec3(1));
  page.state.assign(page.irradiance.size(), TexelState::kValid);
  return pack;
}

class PlayLoading : public PlayWindow {
 protected:
  // Not PlayWindow's, which skips all where there is no virtual display.
  void SetUp() override { ASSERT_TRUE(write_pack(folder() / "tiny.oriel", pack_with_a_large_page())); }
  void damage_the_page() {
    const fs::path path = folder() / "tiny.oriel";
    Bytes file = *read_file(path);
    const PackIndex index = *read_index(file);
    for (const SectionInfo& section : index.sections)
      if (section.kind == kLightmapSection) file[section.offset + section.stored_bytes - 1] ^= std::byte{1};
    ASSERT_TRUE(write_file_atomically(path, file));
  }
};

TEST_F(PlayLoading, AMemoryLimitIsHeldAndTold) {
  for (const char* bad : {"0MB", "-1GB", "12", "many", "1e99GB", "nan", "''", "5 parsecs"})
    EXPECT_TRUE(ends(run(std::string("tiny.oriel --offscreen -o a.png --gpu-memory ") + bad), 1, "--gpu-memory"))
        << bad;
  ASSERT_TRUE(ends(run("tiny.oriel --offscreen -o a.png --gpu-memory 1GiB --stats a.json"), 0, "a.png"));
  ASSERT_TRUE(ends(run("tiny.oriel --offscreen -o b.png --gpu-memory 100B --stats b.json"), 0, "left out"));
  const auto whole = Json::parse(*read_file(folder() / "a.json")).value()["frames"][0];
  EXPECT_EQ(whole["coarser_images"], 0);
  EXPECT_GT(whole["image_bytes"].get<double>(), 100);
  const auto limited = Json::parse(*read_file(folder() / "b.json")).value();
  EXPECT_EQ(limited["options"]["gpu_memory"], 100);
  EXPECT_LE(limited["frames"][0]["most_image_bytes"].get<double>(), 100);
  EXPECT_GT(limited["frames"][0]["missing_images"].get<double>(), 0);
}

TEST_F(PlayLoading, OffscreenABrokenPageIsAnError) {
  damage_the_page();
  EXPECT_TRUE(ends(run("tiny.oriel --offscreen -o a.png"), 3, "section LMAP 0 (lightmap page): checksum"));
  EXPECT_FALSE(fs::exists(folder() / "a.png"));
  EXPECT_TRUE(ends(run("tiny.oriel --list"), 0, "camera 0")) << "which looks at no page";
}

TEST_F(PlayLoading, TheWindowTellsABrokenPageAndStays) {
  if (!has_display()) GTEST_SKIP() << "xvfb-run or xdotool is not installed";
  damage_the_page();
  const Outcome r = in_display("\"$PLAY\" tiny.oriel --size 160x90 --frames 20\n");
  EXPECT_TRUE(ends(r, 0, "section LMAP 0 (lightmap page): checksum"));
  EXPECT_NE(r.out.find("first frame after"), std::string::npos) << r.out;
}

// Cut in place while it is shown, which would end who looks at a mapping; F5 then says why it cannot be shown again.
TEST_F(PlayLoading, AFileThatIsCutUnderTheWindow) {
  if (!has_display()) GTEST_SKIP() << "xvfb-run or xdotool is not installed";
  const Outcome r = in_display(std::string(kOpen) + R"(
truncate -s 1000 tiny.oriel
xdotool windowfocus "$window"; wait_for ready
kill -0 $pid && echo "still there"
key F5
quit
)");
  EXPECT_TRUE(ends(r, 0, "still there"));
  EXPECT_NE(r.out.find("not loaded again"), std::string::npos) << r.out;
}

}  // namespace
}  // namespace oriel
