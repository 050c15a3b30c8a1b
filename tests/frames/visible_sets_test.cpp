// A house with and without its visible sets: the same frames, and no random eye misses a triangle.
#include <gtest/gtest.h>
#include <unistd.h>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/pack/reader.h"
#include "formats/pack/writer.h"
#include "tests/frames/frames.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

class House : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("oriel-visible-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    ASSERT_EQ(test::run(folder_, "oriel-scenes house --triangles 12000 --reflectors 0 -o house.glb"), 0);
    ASSERT_EQ(test::run(folder_,
                        "oriel-bake house.glb -o house.oriel --pvs on --texel 2m --samples 1 --verify off "
                        "--max-reflectors 0 --cache off"),
              0);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static Json stats(const std::string& name) {
    const auto file = read_file(folder_ / name);
    return file ? Json::parse(*file).value() : Json();
  }

  static inline fs::path folder_;
};

TEST_F(House, FramesAreTheSameAndLessIsDrawn) {
  for (const std::string pvs : {"on", "off"})
    ASSERT_EQ(
        test::run(folder_,
                  "oriel-play house.oriel --offscreen --path walk --frames 9 --size 180x120 --exposure 10 --pvs " +
                      pvs + " -o " + pvs + " --stats " + pvs + ".json"),
        0);
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "on")) {
    const auto with = read_file(entry.path()), without = read_file(folder_ / "off" / entry.path().filename());
    ASSERT_TRUE(with && without);
    EXPECT_EQ(*with, *without) << entry.path();
    ++pictures;
  }
  EXPECT_EQ(pictures, 9);
  const auto on = stats("on.json"), off = stats("off.json");
  std::uint64_t drawn = 0, all = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    drawn += on["frames"][i]["triangles"].get<std::uint64_t>();
    all += off["frames"][i]["triangles"].get<std::uint64_t>();
    EXPECT_EQ(off["frames"][i]["groups"], 0);
  }
  EXPECT_LT(10 * drawn, 9 * all);
}

TEST_F(House, RandomEyesMissNothing) {
  EXPECT_EQ(test::run(folder_, "pvs_eyes house.oriel --eyes 60 --seed 3"), 0);
}

TEST_F(House, TheJudgeSeesWhatIsMissing) {
  auto pack = read_pack(folder_ / "house.oriel");
  ASSERT_TRUE(pack) << pack.error().text();
  // Half of the groups of every set are forgotten.
  for (std::uint8_t& byte : pack->visible_sets.seen) byte &= 0x55;
  ASSERT_TRUE(write_pack(folder_ / "forgotten.oriel", *pack));
  EXPECT_EQ(test::run(folder_, "pvs_eyes forgotten.oriel --eyes 3"), 5);
  pack->visible_sets = {};
  ASSERT_TRUE(write_pack(folder_ / "without.oriel", *pack));
  EXPECT_EQ(test::run(folder_, "pvs_eyes without.oriel --eyes 1"), 3);
}

}  // namespace
}  // namespace oriel
