// What surfaces reflect, without the light of lamps: the rest is their closed form.
#include <gtest/gtest.h>

#include <cstdlib>

#include "bake/run/option_table.h"
#include "formats/pack/writer.h"
#include "study/diefenbach1997/without_lamps.h"
#include "study/support/shown_scene.h"
#include "tests/bake/radiosity/baked.h"
#include "tests/support/temporary_folder.h"

namespace oriel::study {
namespace {

using oriel::test::Baked;
using oriel::test::SceneParts;

const Vec3 kLamp(1.1f, 1.4f, 0.8f);

// 2 m a side, closed, with a point light of 10 cd and nothing else in it.
Scene empty_box(float albedo) {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(albedo));
  parts.quad("floor", wall, {0, 0, 2}, {2, 0, 0}, {0, 0, -2});
  parts.quad("ceiling", wall, {0, 2, 0}, {2, 0, 0}, {0, 0, 2});
  parts.quad("back", wall, {0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  parts.quad("front", wall, {2, 0, 2}, {-2, 0, 0}, {0, 2, 0});
  parts.quad("left", wall, {0, 0, 2}, {0, 0, -2}, {0, 2, 0});
  parts.quad("right", wall, {2, 0, 0}, {0, 0, 2}, {0, 2, 0});
  parts.scene().lights.push_back({.name = "lamp", .type = LightType::kPoint, .position = kLamp, .intensity = Vec3(10)});
  return parts.finish();
}

RadiosityOptions options() {
  RadiosityOptions options = oriel::test::cached_options(0);
  options.samples = 1024;  // of all texels: an error asked for would leave direct light two samples where it is smooth
  options.fit_texels = false;  // texels are means
  options.detail = 1;
  options.stitch = false;
  return options;
}

std::vector<LightmapPage> reflected_in(const Baked& b) {
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  const Transport transport(accel, lights, PathOptions());
  Context context;
  return *bake_reflected({transport, b.atlas, b.texel_map}, options(), context);
}

// The mean over a texel of the lamp's closed form.
double direct(const Baked& b, std::size_t page, std::size_t i) {
  constexpr int kSide = 8;
  double sum = 0;
  for (int k = 0; k < kSide * kSide; ++k) {
    const Vec3 u((static_cast<float>(k % kSide) + 0.5f) / kSide, (static_cast<float>(k / kSide) + 0.5f) / kSide, 0.5f);
    const TexelPoint at = sample_texel(b.atlas, b.texel_map[page], i, u);
    const UVec3& t = b.scene.triangles[at.triangle];
    const DVec3 a(b.scene.positions[t.x]), e1 = DVec3(b.scene.positions[t.y]) - a,
                                           e2 = DVec3(b.scene.positions[t.z]) - a;
    const DVec3 to = DVec3(kLamp) - DVec3(point_on(b.scene, at.triangle, at.barycentric));
    sum += 10 * std::max(0.0, glm::dot(glm::normalize(glm::cross(e1, e2)), to)) / std::pow(glm::length(to), 3);
  }
  return sum / (kSide * kSide);
}

TEST(Indirect, AllLightLessItIsTheClosedFormOfTheLamp) {
  for (const float albedo : {0.0f, 0.5f}) {
    const Baked b = oriel::test::bake(empty_box(albedo), 0.1f, options());
    const std::vector<LightmapPage> pages = reflected_in(b);
    ASSERT_EQ(pages.size(), b.radiosity.pages.size());
    double off = 0, sum = 0, reflected = 0;
    for (std::size_t p = 0; p < b.texel_map.size(); ++p)
      for (std::size_t i = 0; i < b.texel_map[p].texel.size(); ++i) {
        const std::uint32_t t = b.texel_map[p].texel[i];
        const double whole = b.radiosity.pages[p].irradiance[t].g, rest = pages[p].irradiance[t].g;
        const double closed = direct(b, p, i);
        off += std::abs(whole - rest - closed), sum += closed, reflected += rest;
        EXPECT_EQ(pages[p].state[t], b.radiosity.pages[p].state[t]);
        EXPECT_GE(rest, 0);
      }
    EXPECT_LT(off / sum, 0.01) << albedo;
    RecordProperty("off", std::to_string(off / sum));
    // All that is sent out and reflected once and again: 40 pi lm, over the albedo's series.
    EXPECT_NEAR(reflected / sum, albedo / (1 - albedo), 0.02 * albedo) << albedo;
  }
}

// The sun by way of a mirror is the passes', its light on the ceiling too; what the ceiling throws back is baked.
TEST(Indirect, IsWithoutLightByMirrors) {
  SceneParts parts;
  SceneMaterial silver;
  silver.base_color = Vec3(0.9f), silver.metallic = 1, silver.roughness = 0;
  parts.quad("mirror", parts.add(silver), {-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1});
  parts.quad("ceiling", parts.diffuse(Vec3(0)), {0, 2, -1}, {2.5f, 0, 0}, {0, 0, 2});
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = {0.5f, -std::sqrt(0.75f), 0};
  sun.intensity = Vec3(1000);
  parts.scene().lights = {sun};
  const Baked b = oriel::test::bake(parts.finish(), 0.1f, options());
  const std::vector<LightmapPage> pages = reflected_in(b);
  float most = 0, most_indirect = 0;
  for (std::size_t p = 0; p < b.radiosity.pages.size(); ++p)
    for (std::size_t t = 0; t < b.radiosity.pages[p].irradiance.size(); ++t) {
      most = std::max(most, b.radiosity.pages[p].irradiance[t].g);
      most_indirect = std::max(most_indirect, pages[p].irradiance[t].g);
    }
  EXPECT_GT(most, 700);
  EXPECT_LT(most_indirect, 1);
}

class WithoutLamps : public ::testing::Test {
 protected:
  int run(const std::string& command) const {
    return std::system(("cd '" + folder_.path().string() + "' && '" + ORIEL_BIN_DIR + "'/" + command).c_str());
  }
  const oriel::testing::TemporaryFolder folder_;
};

// What lamps give at once is not in the lightmap, the lamps are listed, mirrors have no maps.
TEST_F(WithoutLamps, TheGalleryIsBaked) {
  ASSERT_EQ(run("oriel-scenes gallery -o gallery.glb"), 0);
  BakeOptions options = command_line_defaults();
  options.choose_texel = false, options.atlas.texel_m = 1;
  options.radiosity.samples = 4;
  ASSERT_TRUE(settle(options, {}));
  const std::string scene = folder_.path() / "gallery.glb", kept = folder_.path() / "passes.oriel";
  const Pack all = *open_or_bake(scene, options), passes = *bake_without_lamps(scene, options);
  EXPECT_TRUE(passes.radiance_maps.empty() && passes.light_groups.empty());
  EXPECT_EQ(passes.reflectors.size(), all.reflectors.size());
  EXPECT_GT(passes.light_field.lights.size(), 0u);
  EXPECT_EQ(passes.light_field.bands, 2);
  ASSERT_EQ(passes.lightmaps.size(), all.lightmaps.size());
  double lux = 0, of_all = 0;
  for (std::size_t p = 0; p < passes.lightmaps.size(); ++p) {
    ASSERT_EQ(passes.lightmaps[p].irradiance.size(), all.lightmaps[p].irradiance.size());
    for (std::size_t t = 0; t < passes.lightmaps[p].irradiance.size(); ++t) {
      lux += passes.lightmaps[p].irradiance[t].g;
      of_all += all.lightmaps[p].irradiance[t].g;
    }
  }
  EXPECT_GT(lux, 0.1 * of_all);
  EXPECT_LT(lux, 0.9 * of_all);

  ASSERT_TRUE(write_pack(kept, passes));
  EXPECT_TRUE(open_without_lamps(kept, options));
  ASSERT_TRUE(write_pack(kept, all));
  const auto refused = open_without_lamps(kept, options);
  ASSERT_FALSE(refused) << "it holds the light of lamps";
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalid);
}

}  // namespace
}  // namespace oriel::study
