// oriel-bake render beside oriel-play --compare, as a user meets them.
#include <gtest/gtest.h>
#include <unistd.h>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/image/png.h"
#include "tests/frames/frames.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

TEST(CompareFrames, CornellAgreesWithItsReference) {
  const fs::path folder = fs::temp_directory_path() / ("oriel-compare-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto run = [&](const std::string& command) { return test::run(folder, command); };
  ASSERT_EQ(run("oriel-scenes cornell -o a.glb"), 0);
  ASSERT_EQ(run("oriel-bake a.glb -o a.oriel --texel 1cm --samples 512 --only radiosity"), 0);
  ASSERT_EQ(run("oriel-bake render a.glb --size 160x90 --samples 256 -o a.exr"), 0);
  const std::string compare = "oriel-play a.oriel --offscreen --compare a.exr ";
  ASSERT_EQ(run(compare + "--size 640x360 --json a.json -o a.png"), 0);
  const Bytes bytes = *read_file(folder / "a.json");
  const auto json = Json::parse(bytes).value();
  const double flip = json["regions"]["frame"]["flip"].get<double>();
  EXPECT_LT(json["regions"]["frame"]["D"]["net"].get<double>(), 0.05);
  EXPECT_LT(flip, 0.05);
  EXPECT_GT(json["regions"]["frame"]["ssim"].get<double>(), 0.8);
  EXPECT_EQ(read_png(folder / "a.png")->width, 3u * 160);

  EXPECT_EQ(run(compare + "--max-flip 0.5"), 0);
  EXPECT_EQ(run(compare + "--max-flip 0.0001"), 5);
  EXPECT_EQ(run(compare + "--size 100x100"), 1) << "no multiple of the reference's size";
  EXPECT_EQ(run(compare + "--camera all"), 1);
  EXPECT_EQ(run(compare + "--show D"), 1);
  EXPECT_EQ(run(compare + "-o a.jpg"), 1);
  EXPECT_EQ(run("oriel-play a.oriel --offscreen --camera 0 -o b.png --json b.json"), 1);
  EXPECT_EQ(run("oriel-play a.oriel --compare a.exr"), 1) << "not in a window";
  EXPECT_EQ(run("oriel-play a.oriel --offscreen --compare missing.exr"), 2);
  ASSERT_EQ(run("oriel-play a.oriel --offscreen --camera 0 --size 64x64 -o plain.exr"), 0);
  EXPECT_EQ(run("oriel-play a.oriel --offscreen --compare plain.exr --max-flip 0"), 0) << "an earlier frame";
  if (!::testing::Test::HasFailure()) fs::remove_all(folder);
}

}  // namespace
}  // namespace oriel
