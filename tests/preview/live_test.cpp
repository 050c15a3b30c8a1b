// A file that is followed while somebody edits it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "formats/query/camera.h"
#include "player/gpu/headless.h"
#include "preview/frame/live_scene.h"
#include "preview/frame/preview_renderer.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel {
namespace {

// A triangle, lit by a lamp in front of it at a distance.
std::string lamp_at(float distance) {
  test::Gltf g = test::triangle();
  g.material()["pbrMetallicRoughness"] = {{"metallicFactor", 0.0}};
  g.doc["meshes"][0]["primitives"][0]["material"] = 0;
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 10.0}}};
  const std::size_t node = g.doc["nodes"].size();
  g.doc["nodes"].push_back(
      {{"translation", {0.3, 0.3, distance}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  g.doc["scenes"][0]["nodes"].push_back(node);
  return g.text();
}

// Bytes that the process holds.
std::size_t resident() {
  std::ifstream in("/proc/self/statm");
  std::size_t all = 0, held = 0;
  in >> all >> held;
  return held * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

double mean_of(const FloatImage& image) {
  double sum = 0;
  for (const float v : image.pixels) sum += v;
  return sum / static_cast<double>(image.pixels.size());
}

class Live : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = gpu::HeadlessContext::create();
    if (!context) GTEST_SKIP() << context.error().text();
    gl_ = std::move(*context);
    renderer_ = *PreviewRenderer::create(*gpu::open_device());
  }

  // The light that is seen of a scene.
  double light_of(const std::shared_ptr<const PreviewScene>& scene) {
    EXPECT_TRUE(renderer_.take(scene));
    EXPECT_TRUE(renderer_.look(look_at(Vec3(0, 0, 2), Vec3(0), 0.5f), 64, 48));
    EXPECT_TRUE(renderer_.pass({.samples = 1, .antialias = false}, context_));
    return mean_of(renderer_.read_mean());
  }

  std::unique_ptr<gpu::HeadlessContext> gl_;
  PreviewRenderer renderer_;
  Context context_;
  test::TempFolder folder_;
};

TEST_F(Live, AHundredEditsOfWhichTwentyAreBroken) {
  const auto file = folder_.write("scene.gltf", lamp_at(1));
  LiveScene live({.file = file, .import = {}, .elements = 8}, 1, 1);
  auto news = live.wait_for_news(30);
  ASSERT_TRUE(news && news->scene);
  double last = light_of(news->scene), slowest_s = 0;
  EXPECT_GT(last, 0);
  std::size_t held = 0;
  int broken = 0;
  for (int i = 1; i <= 100; ++i) {
    const bool breaks = i % 5 == 0;
    const std::string text = lamp_at(1 + 0.02f * static_cast<float>(i));
    const auto saved = std::chrono::steady_clock::now();
    folder_.write("scene.gltf", breaks ? text.substr(0, text.size() / 2) : text);
    news = live.wait_for_news(30);
    ASSERT_TRUE(news) << i;
    if (breaks) {
      ASSERT_FALSE(news->scene) << i;
      EXPECT_NE(news->error.text().find("scene.gltf"), std::string::npos) << news->error.text();
      ++broken;
    } else {
      ASSERT_TRUE(news->scene) << i << ": " << news->error.text();
      const double now = light_of(news->scene);
      EXPECT_LT(now, last) << i;  // the lamp goes away
      last = now;
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - saved;
      slowest_s = std::max(slowest_s, took.count());
    }
    if (i == 20) held = resident();
  }
  std::printf("%d edits broken of 100; seen at most %.3f s after saving; %.1f MiB more than after 20\n", broken,
              slowest_s, (static_cast<double>(resident()) - static_cast<double>(held)) / (1 << 20));
  EXPECT_EQ(broken, 20);
  EXPECT_LT(resident(), held + (std::size_t{8} << 20));
}

TEST_F(Live, AFileThatGoesAndComesBack) {
  const auto file = folder_.write("scene.gltf", lamp_at(1));
  LiveScene live({.file = file, .import = {}, .elements = 0}, 1, 1);
  auto news = live.wait_for_news(30);
  ASSERT_TRUE(news && news->scene);
  std::filesystem::remove(file);
  news = live.wait_for_news(30);
  ASSERT_TRUE(news && !news->scene);
  EXPECT_EQ(news->error.code, ErrorCode::kIo);
  folder_.write("scene.gltf", lamp_at(2));
  news = live.wait_for_news(30);
  ASSERT_TRUE(news && news->scene);
  EXPECT_FALSE(live.wait_for_news(0.3));  // nothing is new
}

}  // namespace
}  // namespace oriel
