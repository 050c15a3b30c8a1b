// A file that is followed while somebody edits it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "formats/image/png.h"
#include "formats/query/camera.h"
#include "player/gpu/headless.h"
#include "preview/frame/live_scene.h"
#include "preview/frame/preview_renderer.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel {
namespace {

// A triangle, lit by a lamp in front of it at a distance.
std::string lamp_text(float distance) {
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

// Waits for news at most so long.
std::optional<SceneNews> news_of(LiveScene& live, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (true) {
    auto news = live.news();
    if (news || std::chrono::steady_clock::now() >= end) return news;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

double mean_value(const FloatImage& image) {
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
    return mean_value(renderer_.read_mean());
  }

  std::unique_ptr<gpu::HeadlessContext> gl_;
  PreviewRenderer renderer_;
  Context context_;
  test::TempFolder folder_;
};

TEST_F(Live, AHundredEditsOfWhichTwentyAreBroken) {
  const auto file = folder_.write("scene.gltf", lamp_text(1));
  LiveScene live({.file = file, .import = {}}, 1, 1);
  auto news = news_of(live, 30);
  ASSERT_TRUE(news && news->scene);
  double last = light_of(news->scene), slowest_s = 0;
  EXPECT_GT(last, 0);
  std::size_t held = 0;
  int broken = 0;
  for (int i = 1; i <= 100; ++i) {
    const bool breaks = i % 5 == 0;
    const std::string text = lamp_text(1 + 0.02f * static_cast<float>(i));
    const auto saved = std::chrono::steady_clock::now();
    folder_.write("scene.gltf", breaks ? text.substr(0, text.size() / 2) : text);
    news = news_of(live, 30);
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
#ifndef __SANITIZE_ADDRESS__  // which holds what is freed for a while
  EXPECT_LT(resident(), held + (std::size_t{8} << 20));
#endif
}

// What a file is changed by, and what is kept then.
struct Edit {
  const char* what;
  void (*edit)(test::Gltf&);
  bool shape, vertices, images;  // stay
};

// Two texels, as a data URI.
std::string image_of(std::uint8_t grey) {
  const Bytes png = *encode_png({2, 1, 3, {grey, grey, 255, 255, 10, 10}});
  return "data:image/png;base64," + test::base64({reinterpret_cast<const char*>(png.data()), png.size()});
}

// A pane before a half of a triangle with a texture, and a lamp before both.
test::Gltf edited_scene() {
  test::Gltf g;
  for (const float z : {0.0f, -1.0f}) {
    const float left = z < 0 ? -1 : 0;
    const int places = g.floats("VEC3", {left, -1, z, 2, -1, z, left, 2, z}), uv = g.floats("VEC2", {0, 0, 1, 0, 0, 1});
    g.add({{"attributes", {{"POSITION", places}, {"TEXCOORD_0", uv}}}, {"material", z < 0 ? 1 : 0}});
  }
  g.use("KHR_materials_transmission");
  g.use("KHR_lights_punctual");
  g.material() = {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.8, 0.9, 1}}, {"metallicFactor", 0.0}}},
                  {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.7}}}}}};
  g.material() = {{"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"baseColorTexture", {{"index", 0}}}}}};
  g.doc["images"] = {{{"uri", image_of(90)}}};
  g.doc["textures"] = {{{"source", 0}}};
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 10.0}}};
  g.doc["scenes"][0]["nodes"].push_back(g.doc["nodes"].size());
  g.doc["nodes"].push_back(
      {{"translation", {0.3, 0.3, 1.0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return g;
}

const Edit kEdits[] = {
    {"nothing", [](test::Gltf&) {}, true, true, true},
    {"a lamp's place", [](test::Gltf& g) { g.doc["nodes"][2]["translation"][2] = 1.5; }, true, true, true},
    {"a lamp's power",
     [](test::Gltf& g) { g.doc["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 20.0; }, true, true,
     true},
    {"a colour",
     [](test::Gltf& g) {
       g.doc["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.9, 0.2, 0.9, 1};
     },
     true, true, true},
    {"a roughness", [](test::Gltf& g) { g.doc["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0.2; }, true,
     true, true},
    {"an image", [](test::Gltf& g) { g.doc["images"][0]["uri"] = image_of(200); }, true, true, false},
    {"coordinates of textures",
     [](test::Gltf& g) {
       g.doc["meshes"][1]["primitives"][0]["attributes"]["TEXCOORD_0"] = g.floats("VEC2", {1, 1, 0, 0, 0, 1});
     },
     true, false, true},
    {"glass that is none", [](test::Gltf& g) { g.doc["materials"][0].erase("extensions"); }, false, false, true},
    {"a mesh's place",
     [](test::Gltf& g) {
       g.doc["nodes"][0]["translation"] = {0, 0.2, 0};
     },
     false, false, true}};

// To the bit the frames of who never saw the scene before; and not those of the scene before.
TEST_F(Live, AnEditedFileIsSeenWithWhatStaysOfTheLast) {
  const auto frame = [&](PreviewRenderer& renderer, const std::shared_ptr<const PreviewScene>& scene) {
    EXPECT_TRUE(renderer.take(scene));
    EXPECT_TRUE(renderer.look(look_at(Vec3(0, 0, 3), Vec3(0), 0.5f), 64, 48));
    EXPECT_TRUE(renderer.pass({.samples = 1, .antialias = false}, context_));
    return renderer.read_mean().pixels;
  };
  PreviewSceneOptions options{.file = folder_.write("a.gltf", edited_scene().text()), .import = {}};
  const auto first = *load_preview_scene(options, context_);
  for (const Edit& e : kEdits) {
    test::Gltf changed = edited_scene();
    e.edit(changed);
    const std::vector<float> before = frame(renderer_, first);
    options.file = folder_.write("b.gltf", changed.text());
    const auto scene = *load_preview_scene(options, context_, first.get()),
               alone = *load_preview_scene(options, context_);
    EXPECT_EQ(scene->parts.shape == first->parts.shape, e.shape) << e.what;
    EXPECT_EQ(scene->parts.vertices == first->parts.vertices, e.vertices) << e.what;
    EXPECT_EQ(scene->parts.images == first->parts.images, e.images) << e.what;
    PreviewRenderer fresh = *PreviewRenderer::create(*gpu::open_device());
    const std::vector<float> after = frame(renderer_, scene);
    EXPECT_EQ(after, frame(fresh, alone)) << e.what;
    EXPECT_EQ(after == before, std::string(e.what) == "nothing") << e.what;
  }
}

TEST_F(Live, AFileThatGoesAndComesBack) {
  const auto file = folder_.write("scene.gltf", lamp_text(1));
  LiveScene live({.file = file, .import = {}}, 1, 1);
  auto news = news_of(live, 30);
  ASSERT_TRUE(news && news->scene);
  std::filesystem::remove(file);
  news = news_of(live, 30);
  ASSERT_TRUE(news && !news->scene);
  EXPECT_EQ(news->error.code, ErrorCode::kIo);
  folder_.write("scene.gltf", lamp_text(2));
  news = news_of(live, 30);
  ASSERT_TRUE(news && news->scene);
  EXPECT_FALSE(news_of(live, 0.3));  // nothing is new
}

}  // namespace
}  // namespace oriel
