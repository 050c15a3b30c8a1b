// Images that come while frames are drawn.
#include <fstream>

#include "formats/pack/reader.h"
#include "formats/pack/writer.h"
#include "tests/formats/pack/forge.h"
#include "tests/player/frame_fixture.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

using namespace testing;

// Of pages and textures, texels: more than a block of zstd holds, of which the first is decoded when a pack is opened.
constexpr std::uint32_t kSide = 192;

LightmapPage noisy_page(std::uint32_t seed) {
  LightmapPage page;
  page.width = page.height = kSide;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    seed = seed * 1664525 + 1013904223;
    page.irradiance.push_back(Vec3(100 + static_cast<float>(seed >> 20), 200, 300));
  }
  page.standard_error.assign(page.irradiance.size(), Vec3(1));
  page.state.assign(page.irradiance.size(), TexelState::kValid);
  return page;
}

// Six walls behind each other, seen through gaps: each with a page of light and a texture of its own; the first with a
// mirror before it.
Pack walls() {
  Pack pack;
  add_mirror(pack, {{0, 0, -1}, {0.3f, 0, -1}}, kSide, [](const Vec2& p, const Vec3&) {
    return Seen{{200 + 100 * p.x, 200, 200}, 2.0f};
  });
  add_pixel_meshes(pack);
  Material mirror;
  mirror.metallic = 1;
  mirror.roughness = 0;
  mirror.fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.8f)));
  pack.materials.push_back(mirror);
  for (std::uint32_t i = 0; i < 6; ++i) {
    Texture texture;
    texture.width = texture.height = kSide;
    for (std::uint32_t t = 0; t < kSide * kSide; ++t)
      for (const std::uint32_t v : {t * 7 % 256, 40 * i, t / kSide * 3, 255u})
        texture.texels.push_back(static_cast<std::uint8_t>(v));
    pack.textures.push_back(texture);
    Material material;
    material.base_color_texture = static_cast<std::int32_t>(i);
    pack.materials.push_back(material);
    pack.lightmaps.push_back(noisy_page(i));
    const auto step = static_cast<float>(i);
    add_quad(pack, {1.2f + step, -1, -4 * step}, {1, 0, 0}, {0, 2, 0}, i + 1, static_cast<std::int32_t>(i));
  }
  return pack;
}

Camera camera() {
  Camera out;
  out.eye = {0.5f, 0, 3};
  out.forward = {0.4f, 0, -1};
  return out;
}

class Loading : public FrameTest {
 protected:
  void SetUp() override {
    FrameTest::SetUp();
    const auto bytes = encode_pack(walls());
    ASSERT_TRUE(bytes) << bytes.error().text();
    file_ = *bytes;
  }
  std::unique_ptr<GpuScene> scene_of(const Bytes& file, const LoadingOptions& options) {
    EXPECT_TRUE(write_file_atomically(path_, file));
    auto pack = open_pack(path_);
    EXPECT_TRUE(pack) << pack.error().text();
    auto scene = GpuScene::create(std::move(*pack), device_, options);
    EXPECT_TRUE(scene) << scene.error().text();
    return std::move(*scene);
  }
  std::vector<float> frame(GpuScene& scene) {
    const auto stats = renderer_->render(scene, view(scene), {});
    EXPECT_TRUE(stats) << stats.error().text();
    if (stats) stats_ = *stats;
    return renderer_->read_light();
  }
  View view(const GpuScene& scene) const { return make_view(camera(), 64, 48, scene.bounds()); }
  // Frames until nothing is on its way; the errors on the way.
  std::vector<std::string> load(GpuScene& scene, std::vector<std::uint64_t>* used = nullptr) {
    std::vector<std::string> errors;
    for (int i = 0; i < 2000; ++i) {
      EXPECT_TRUE(scene.load_images(view(scene)));
      for (const Error& error : scene.advance(std::chrono::microseconds(200))) errors.push_back(error.text());
      if (used != nullptr) used->push_back(scene.images().state().used);
      frame(scene);
      const LoadingState state = scene.images().state();
      if (!state.busy && !state.checking) return errors;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "still loading";
    return errors;
  }
  Bytes damaged(std::uint32_t kind, std::uint64_t nth) const {
    Bytes out = file_;
    const PackIndex index = *read_index(file_);
    for (const SectionInfo& section : index.sections)
      if (section.kind == kind && section.nth == nth) out[section.offset + section.stored_bytes - 1] ^= std::byte{1};
    EXPECT_NE(out, file_);
    return out;
  }

  Bytes file_;
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "a.oriel";
  FrameStats stats_;
};

TEST_F(Loading, TheFramesAreThoseOfAPackThatWasThereAtOnce) {
  const auto at_once = scene_of(file_, {});
  const std::vector<float> expected = frame(*at_once);
  EXPECT_EQ(stats_.reflectors, 1u);
  const auto whole = GpuScene::create(*read_pack(path_), device_);
  ASSERT_TRUE(whole);
  EXPECT_EQ(frame(**whole), expected) << "not from a file";
  const auto scene = scene_of(file_, {true, kNoLimit});
  const std::vector<float> first = frame(*scene);
  EXPECT_EQ(stats_.reflectors, 0u) << "its maps are not there";
  EXPECT_NE(first, expected) << "else nothing is tested";
  EXPECT_LT(scene->images().state().share(), 1);
  EXPECT_TRUE(load(*scene).empty());
  EXPECT_EQ(scene->images().state().share(), 1);
  EXPECT_EQ(frame(*scene), expected);
  EXPECT_EQ(stats_.reflectors, 1u);
  EXPECT_EQ(stats_.image_bytes, scene->images().state().wanted);
  for (const Texture& texture : scene->pack().textures) EXPECT_EQ(texture.texels.size(), 4u * kSide * kSide);
}

TEST_F(Loading, WhatIsNearComesFirst) {
  const auto scene = scene_of(file_, {true, kNoLimit});
  EXPECT_TRUE(scene->load_images(view(*scene)));
  std::vector<std::uint32_t> order;  // in which pages came
  std::vector<bool> there(6);
  while (order.size() < 6) {
    scene->advance(std::chrono::nanoseconds(1));  // a slice at a time
    for (std::uint32_t i = 0; i < 6; ++i)
      if (!there[i] && scene->images().has({ImageKind::kLight, i})) there[i] = true, order.push_back(i);
  }
  // Several are made ready at a time, so that neighbours may change places.
  EXPECT_LT(order.front(), 3u);
  EXPECT_GT(order.back(), 2u);
}

TEST_F(Loading, NeverAboveTheLimit) {
  const auto all = scene_of(file_, {});
  frame(*all);
  const std::uint64_t bytes = all->images().state().used;
  for (const std::uint64_t limit : {bytes, bytes * 9 / 10, bytes / 2, bytes / 5, bytes / 50, std::uint64_t{1}}) {
    for (const bool background : {true, false}) {
      const auto scene = scene_of(file_, {background, limit});
      std::vector<std::uint64_t> used;
      if (background) {
        EXPECT_TRUE(load(*scene, &used).empty());
      }
      frame(*scene);
      const LoadingState state = scene->images().state();
      used.push_back(state.most_used);
      for (const std::uint64_t u : used) ASSERT_LE(u, limit);
      EXPECT_EQ(state.coarser + state.left_out == 0, limit == bytes);
      EXPECT_TRUE(limit != bytes / 2 || state.used > limit / 4) << "room is used";
      EXPECT_TRUE(limit != 1 || state.used == 0);
      EXPECT_EQ(stats_.coarser_images, state.coarser);
    }
  }
}

// The same place shows the same frame within a limit, wherever one was before.
TEST_F(Loading, FramesWithinALimitDependOnTheirViewAlone) {
  const auto all = scene_of(file_, {});
  frame(*all);
  const LoadingOptions options{false, all->images().state().used / 3};
  const auto scene = scene_of(file_, options);
  const std::vector<float> before = frame(*scene);
  Camera elsewhere = camera();
  elsewhere.eye = {7, 0, -17};
  ASSERT_TRUE(renderer_->render(*scene, make_view(elsewhere, 64, 48, scene->bounds()), {}));
  EXPECT_EQ(frame(*scene), before);
  EXPECT_EQ(frame(*scene_of(file_, options)), before);
}

TEST_F(Loading, WhatIsBrokenIsToldAndTheRestIsShown) {
  struct Case {
    std::uint32_t kind;
    std::uint64_t nth;
    const char* says;
  };
  for (const Case& c : {Case{kLightmapSection, 2, "section LMAP 2 (lightmap page): checksum"},
                        Case{kTextureSection, 1, "section TEXR 1 (texture): checksum"},
                        Case{kRadianceMapSection, 1, "section RMAP 1 (radiance map): checksum"}}) {
    const auto scene = scene_of(damaged(c.kind, c.nth), {true, kNoLimit});
    const std::vector<std::string> errors = load(*scene);
    ASSERT_EQ(errors.size(), 1u) << c.says;
    EXPECT_NE(errors[0].find(path_.string() + ": " + c.says), std::string::npos) << errors[0];
    const LoadingState state = scene->images().state();
    EXPECT_EQ(state.failed, 1u);
    EXPECT_EQ(state.share(), 1) << "all else is there";
    EXPECT_EQ(state.used, state.there);
    EXPECT_EQ(stats_.reflectors, c.kind == kRadianceMapSection ? 0u : 1u);
  }
  auto pack = open_pack(path_);
  auto at_once = GpuScene::create(std::move(*pack), device_);  // the last one's maps are wanted when they are shown
  ASSERT_TRUE(at_once);
  const auto refused = renderer_->render(**at_once, view(**at_once), {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text().find("section RMAP 1"), std::string::npos);
}

// What nobody looks at is checked once all else is there.
TEST_F(Loading, DamageThatNobodySeesIsFoundToo) {
  Pack pack = walls();
  pack.unknown.push_back({0x4b4e4e55, 0, 16, 1, Bytes(16)});  // "UNNK"
  Bytes file = *encode_pack(pack);
  file.back() ^= std::byte{1};
  const auto scene = scene_of(file, {true, kNoLimit});
  const std::vector<std::string> errors = load(*scene);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("checksum"), std::string::npos) << errors[0];
}

// Cut or overwritten in place while images still come: told, and nothing else.
TEST_F(Loading, AFileThatIsCutMeanwhile) {
  const auto scene = scene_of(file_, {true, kNoLimit});
  frame(*scene);
  std::filesystem::resize_file(path_, 2000);
  const std::vector<std::string> errors = load(*scene);
  ASSERT_FALSE(errors.empty());
  for (const std::string& error : errors) EXPECT_NE(error.find("the file was cut"), std::string::npos) << error;
  frame(*scene);
}

TEST_F(Loading, TexelsOfPagesComeWhenTheyAreAskedFor) {
  const auto scene = scene_of(file_, {true, kNoLimit});
  const LightmapPage* page = nullptr;
  for (int i = 0; i < 2000 && page == nullptr; ++i) {
    const auto asked = scene->page(3);
    ASSERT_TRUE(asked) << asked.error().text();
    page = *asked;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(page->standard_error.size(), std::size_t{kSide} * kSide);
  EXPECT_EQ(*scene_of(file_, {})->page(3).map([](const LightmapPage* p) { return p->state.size(); }),
            std::size_t{kSide} * kSide);
}

}  // namespace
}  // namespace oriel
