// Made-up causes of dark and odd places, and what is said of each.
#include "formats/analysis/why.h"

#include <gtest/gtest.h>

namespace oriel {
namespace {

// A scene of rectangles, each with a page of 8 x 8 texels of its own, baked with `lux` all over.
class WhyTest : public ::testing::Test {
 protected:
  WhyTest() {
    pack_.materials.resize(3);
    pack_.materials[0].name = "plaster";
    pack_.materials[1].name = "lamp glass";
    pack_.materials[1].emission = Vec3(1000);
    pack_.materials[2].name = "sign";
    pack_.materials[2].unlit = true;
  }
  // Counter-clockwise seen from its front: right x up.
  std::size_t add(const std::string& name, const Vec3& corner, const Vec3& right, const Vec3& up, float lux = 100,
                  std::uint32_t material = 0) {
    Mesh& mesh = pack_.mesh;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec2& uv : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
      mesh.positions.push_back(corner + uv.x * right + uv.y * up);
      mesh.lightmap_uvs.push_back(uv);
    }
    const auto from = static_cast<std::uint32_t>(mesh.indices.size());
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
    const bool bare = pack_.materials[material].unlit || pack_.materials[material].name == "soot";
    mesh.parts.push_back({name, from, 6, material, bare ? -1 : static_cast<std::int32_t>(pack_.lightmaps.size())});
    if (bare) return 0;
    pack_.lightmaps.push_back({8, 8, std::vector<Vec3>(64, Vec3(100)), std::vector<Vec3>(64, Vec3(1)),
                               std::vector<TexelState>(64, TexelState::kValid)});
    // Dark beside the rest of the page: its first texel alone.
    pack_.lightmaps.back().irradiance[0] = Vec3(lux);
    return pack_.lightmaps.size() - 1;
  }
  void add_floor(float lux = 100) { add("floor", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, lux); }
  void add_lamp(const Vec3& corner = {-0.5f, 2.5f, -0.5f}) { add("lamp", corner, {1, 0, 0}, {0, 0, 1}, 100, 1); }
  void add_box(const std::string& name, const Vec3& low, const Vec3& high) {
    const Vec3 d = high - low;
    add(name, low, {d.x, 0, 0}, {0, 0, d.z});                       // bottom, seen from below
    add(name, {low.x, high.y, high.z}, {d.x, 0, 0}, {0, 0, -d.z});  // top
    add(name, {low.x, low.y, high.z}, {d.x, 0, 0}, {0, d.y, 0});    // +z
    add(name, {high.x, low.y, low.z}, {-d.x, 0, 0}, {0, d.y, 0});   // -z
    add(name, {high.x, low.y, high.z}, {0, 0, -d.z}, {0, d.y, 0});  // +x
    add(name, {low.x, low.y, low.z}, {0, 0, d.z}, {0, d.y, 0});     // -x
  }
  // The first texel of the floor is at its corner -2, 0, 2.
  static constexpr Vec3 kCorner{-1.8f, 0, 1.8f};
  const Reason* reason(Cause cause, const Vec3& at = kCorner, const WhyOptions& options = {}) {
    why_ = why_at(pack_, at, options);
    EXPECT_TRUE(why_);
    if (!why_) return nullptr;
    for (const Reason& r : why_->reasons)
      if (r.cause == cause) return &r;
    return nullptr;
  }
  std::string said() const { return why_ ? why_text(*why_) : ""; }
  Pack pack_;
  std::optional<Why> why_;
};

TEST_F(WhyTest, LitPlacesHaveNoReasonAndTheirLight) {
  add_floor();
  add_lamp();
  why_ = why_at(pack_, kCorner + Vec3(0, 0.1f, 0));
  ASSERT_TRUE(why_);
  EXPECT_EQ(why_->surface, "floor");
  EXPECT_NEAR(why_->off_m, 0.1f, 1e-4f);
  EXPECT_EQ(why_->texel, IVec2(0));
  EXPECT_NEAR(why_->side_m, 0.5f, 1e-4f);
  EXPECT_FALSE(why_->dark);
  EXPECT_TRUE(why_->reasons.empty()) << said();
  ASSERT_EQ(why_->lights.size(), 1u);
  EXPECT_EQ(why_->lights[0].kind, LightVerdict::Kind::kLights);
  EXPECT_NE(said().find("'lamp' lights it: 100 %"), std::string::npos) << said();
}

TEST_F(WhyTest, NothingIsThere) {
  add_floor();
  EXPECT_FALSE(why_at(pack_, {0, 3, 0}));
}

TEST_F(WhyTest, UnderAThingThatLiesOnIt) {
  add_floor(0);
  add_lamp();
  add("rug", {-2, 0.01f, 2}, {4, 0, 0}, {0, 0, -4});
  add("rug", {-2, 0.003f, 2}, {0, 0, -4}, {4, 0, 0});  // its underside
  const Reason* r = reason(Cause::kCovered);
  ASSERT_TRUE(r) << said();
  EXPECT_EQ(r->object, "rug");
  EXPECT_NE(r->text.find("2.8 mm before it"), std::string::npos) << r->text;
}

TEST_F(WhyTest, InsideABox) {
  add_floor(0);
  add_lamp();
  add_box("plinth", {-2, -0.1f, 1}, {-1, 1, 2});
  const Reason* r = reason(Cause::kInside);
  ASSERT_TRUE(r) << said();
  EXPECT_EQ(r->object, "plinth");
}

TEST_F(WhyTest, CoincidentWithAnother) {
  add_floor();
  add_lamp();
  add("parquet", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  const Reason* r = reason(Cause::kCoincident);
  ASSERT_TRUE(r) << said();
  EXPECT_EQ(r->object, "parquet");
  // A millimetre more is enough.
  for (std::size_t i = 8; i < 12; ++i) pack_.mesh.positions[i].y = 1e-3f;
  EXPECT_FALSE(reason(Cause::kCoincident));
}

TEST_F(WhyTest, FacingAwayFromTheLight) {
  add("ceiling", {-2, 0, -2}, {4, 0, 0}, {0, 0, 4}, 0);  // looks down, the lamp is over it
  add_lamp();
  const Reason* r = reason(Cause::kFacesAway, {-1.8f, 0, -1.8f});
  ASSERT_TRUE(r) << said();
  EXPECT_EQ(why_->lights[0].kind, LightVerdict::Kind::kFacesAway);
}

TEST_F(WhyTest, InTheShadowOfAScreen) {
  add_floor(0);
  add_lamp();
  add("screen", {-2, 1, 2}, {4, 0, 0}, {0, 0, -4});
  add("screen", {-2, 1, 2}, {0, 0, -4}, {4, 0, 0});
  const Reason* r = reason(Cause::kShadow);
  ASSERT_TRUE(r) << said();
  EXPECT_EQ(r->object, "screen");
  EXPECT_NE(said().find("'lamp' is hidden by 'screen'"), std::string::npos) << said();
}

TEST_F(WhyTest, UnlitMaterials) {
  add("exit sign", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0, 2);
  const Reason* r = reason(Cause::kUnlit);
  ASSERT_TRUE(r) << said();
  EXPECT_EQ(r->object, "sign");
}

TEST_F(WhyTest, BlackMattMaterialsAreNotUnlit) {
  pack_.materials.emplace_back().name = "soot";
  add("chimney", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0, static_cast<std::uint32_t>(pack_.materials.size() - 1));
  const Reason* r = reason(Cause::kBlack);
  ASSERT_TRUE(r) << said();
  EXPECT_EQ(r->object, "soot");
  EXPECT_EQ(why_->reasons.size(), 1u);
}

TEST_F(WhyTest, FilledFromNeighbours) {
  add_floor();
  add_lamp();
  for (int i = 0; i < 2; ++i) pack_.lightmaps[0].state[static_cast<std::size_t>(i)] = TexelState::kDilated;
  const Reason* r = reason(Cause::kFilled);
  ASSERT_TRUE(r) << said();
  EXPECT_NE(r->text.find("the nearest at 0, 1"), std::string::npos) << r->text;
}

TEST_F(WhyTest, NoLightAtAll) {
  add_floor(0);
  EXPECT_TRUE(reason(Cause::kNoLight)) << said();
  // A plan that counts lights and does not tell where they are.
  pack_.plan = R"({"scene": {"punctual_lights": 2}})";
  EXPECT_FALSE(reason(Cause::kNoLight));
  pack_.plan = R"({"lights": [{"name": "spot", "at": [0, 2, 0]}, {"name": "sun", "towards": [0, 1, 0]}, 7]})";
  why_ = why_at(pack_, kCorner);
  ASSERT_EQ(why_->lights.size(), 2u);
  EXPECT_EQ(why_->lights[0].kind, LightVerdict::Kind::kFacesAway) << "a sun from below";
  EXPECT_EQ(why_->lights[1].kind, LightVerdict::Kind::kLights);
  // A spot that shines down beside it.
  pack_.plan = R"({"lights": [{"name": "spot", "at": [0, 2, 0], "towards": [0, -1, 0], "outer_cone_rad": 0.5}]})";
  why_ = why_at(pack_, kCorner);
  EXPECT_EQ(why_->lights.at(0).kind, LightVerdict::Kind::kTurnedAway);
  EXPECT_EQ(why_at(pack_, {0.1f, 0, 0.1f})->lights.at(0).kind, LightVerdict::Kind::kLights);
}

TEST_F(WhyTest, SeenFromBehind) {
  add_floor();
  add_lamp();
  const Reason* r = reason(Cause::kSeenBehind, kCorner, {.reach_m = 0.5f, .eye = Vec3(0, -1, 0)});
  ASSERT_TRUE(r) << said();
  EXPECT_EQ(r->object, "plaster");
  EXPECT_FALSE(reason(Cause::kSeenBehind, kCorner, {.reach_m = 0.5f, .eye = Vec3(0, 1, 0)}));
}

TEST_F(WhyTest, AmongBacksThatReflectNothing) {
  add_floor(0);
  add_lamp({-0.5f, 40, -0.5f});
  // A tent of walls that look outward.
  add("west", {-4, 0, -4}, {0, 0, 8}, {0, 30, 0});
  add("east", {4, 0, 4}, {0, 0, -8}, {0, 30, 0});
  add("north", {4, 0, -4}, {-8, 0, 0}, {0, 30, 0});
  add("south", {-4, 0, 4}, {8, 0, 0}, {0, 30, 0});
  add("roof", {-4, 30, 4}, {8, 0, 0}, {0, 0, -8});
  EXPECT_TRUE(reason(Cause::kSeesBacks)) << said();
}

// However a texel came to nothing, something is said.
TEST_F(WhyTest, DarkTexelsAlwaysHaveAReason) {
  add_floor(0);
  add_lamp();
  why_ = why_at(pack_, kCorner);
  ASSERT_TRUE(why_);
  EXPECT_TRUE(why_->dark);
  ASSERT_EQ(why_->reasons.size(), 1u);
  EXPECT_EQ(why_->reasons[0].cause, Cause::kIndirect);
}

TEST_F(WhyTest, TellsOfSharpLightAtThePlace) {
  add_floor();
  SharpLamp sun;
  sun.sun = true;
  sun.direction = {0, -1, 0};
  sun.intensity = Vec3(70);
  pack_.sharp_light.lamps = {sun};
  const std::uint32_t edges = 7u << kSharpEdgeShift;
  pack_.sharp_light.words = {0, 1, SharpShine{0, false, 1}.code(), edges};
  pack_.sharp_light.triangles = {{Vec3(-3, 1, 3), Vec3(-3, 1, 1.7f), Vec3(3, 1, 1.7f)}};
  LightmapPage& page = pack_.lightmaps[0];
  page.sharp.assign(64, Vec3(50)), page.sharp_at.assign(64, 1);
  page.sharp_at[63] = 0;
  EXPECT_NEAR(why_at(pack_, {-1.8f, 0, 1.6f})->sharp_lux.value(), 70, 1e-3);
  EXPECT_EQ(why_at(pack_, {-1.8f, 0, 1.8f})->sharp_lux, 0);
  EXPECT_FALSE(why_at(pack_, {1.9f, 0, -1.9f})->sharp_lux);
  EXPECT_NE(why_text(*why_at(pack_, {-1.8f, 0, 1.6f})).find("sharp   70 lux"), std::string::npos);
}

}  // namespace
}  // namespace oriel
