// Paths of one texel or pixel alone are those of the bake and of the frame.
#include "bake/run/replay.h"

#include <gtest/gtest.h>

#include <sstream>

#include "bake/run/pipeline.h"
#include "tests/bake/support/scene_parts.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

class Replay : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string line = "'" ORIEL_BIN_DIR "/oriel-scenes' cornell -o '" + file().string() + "' >/dev/null 2>&1";
    ASSERT_EQ(std::system(line.c_str()), 0);
  }
  std::filesystem::path file() const { return folder_.path() / "cornell.glb"; }

  testing::TemporaryFolder folder_;
  Context context_;
};

// The three numbers behind the last "paths: ".
Vec3 mean_of(const std::string& text) {
  const std::size_t at = text.rfind("paths: ");
  EXPECT_NE(at, std::string::npos) << text;
  std::istringstream numbers(text.substr(at + 7));
  Vec3 mean(0);
  numbers >> mean.r >> mean.g >> mean.b;
  return mean;
}

void expect_same(const Vec3& a, const Vec3& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-4f * b[c]);
}

TEST_F(Replay, ATexelsPathsAreThoseOfTheReferenceEstimator) {
  BakeOptions options;
  options.scene = file();
  options.atlas.texel_m = 0.1f;
  options.with_radiance = options.with_material = false;
  options.radiosity.estimator = Estimator::kReference;
  options.radiosity.samples = 16;
  options.radiosity.stitch = false;
  options.radiosity.verify = 0;
  const auto baked = bake(options, context_);
  ASSERT_TRUE(baked) << baked.error().text();
  const LightmapPage& page = baked->pack.lightmaps[0];
  int compared = 0;
  for (std::uint32_t i = 0; i < page.state.size() && compared < 3; i += 7) {
    if (page.state[i] != TexelState::kValid) continue;
    const auto text = replay_texel(options, {0, i % page.width, i / page.width}, {0, 16}, context_);
    ASSERT_TRUE(text) << text.error().text();
    if (text->find("left out") != std::string::npos) continue;  // the bake has fewer paths then, too
    expect_same(mean_of(*text), page.irradiance[i]);
    EXPECT_NE(text->find("from lamps"), std::string::npos) << *text;
    ++compared;
  }
  EXPECT_EQ(compared, 3);
  EXPECT_EQ(replay_texel(options, {9, 0, 0}, {}, context_).error().code, ErrorCode::kUsage);
  EXPECT_EQ(replay_texel(options, {0, 1u << 20, 0}, {}, context_).error().code, ErrorCode::kUsage);
}

TEST_F(Replay, APixelsPathsAreThoseOfTheFrame) {
  test::SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f), Vec3(1, 2, 3)), Vec3(-1), Vec3(1), true);
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const Transport transport{accel, lights, {}};
  const Camera camera{.name = "", .eye = {0, 0.2f, 0.9f}, .forward = {0, -0.3f, -1}};
  const ReferenceOptions frame{.width = 8, .height = 6, .samples = 8};
  const ReferenceFrame whole = *render_reference(transport, camera, frame, context_);
  const auto text = replay_pixel(transport, camera, frame, {context_.seed, 3, 2, 0}, 8);
  ASSERT_TRUE(text) << text.error().text();
  const float* pixel = &whole.total.pixels[3 * (2 * 8 + 3)];
  expect_same(mean_of(*text), {pixel[0], pixel[1], pixel[2]});
  EXPECT_EQ(replay_pixel(transport, camera, frame, {1, 8, 0, 0}, 1).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace oriel
