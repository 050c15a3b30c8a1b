// The shade of movers by the steps of Barczak 2006: all of them give the player's.
#include "study/barczak2006/shade_steps.h"

#include "study/rooms.h"
#include "tests/player/mover_fixture.h"

namespace oriel::study {
namespace {
using namespace oriel::testing;

// A white floor at y = -2, a square mover that faces up, and a ceiling at y = 2 which sends out 100 lux.
Pack lit_room() {
  Pack pack = mover_pack(even_field(Vec3(1)));
  pack.materials.resize(3);
  pack.materials[1].base_color = Vec3(1);
  pack.materials[2].base_color = Vec3(0.5f);
  pack.lightmaps.push_back(flat_page(Vec3(100)));
  add_quad(pack, {-4, -2, 4}, {8, 0, 0}, {0, 0, -8}, 1, 0);
  pack.lightmaps.push_back(page_of(32, [](std::uint32_t, std::uint32_t) { return Vec3(200); }));
  add_quad(pack, {-8, 2, -8}, {16, 0, 0}, {0, 0, 16}, 2, 1);
  pack.movers[0].rest.rotation = {-std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};
  return pack;
}

class ShadeStepsTest : public FrameTest {
 protected:
  void SetUp() override {
    static const bool added = (gpu::add_shader_sources(shader_sources()), true);
    ASSERT_TRUE(added);
    FrameTest::SetUp();
    auto scene = GpuScene::create(lit_room(), device_);
    ASSERT_TRUE(scene);
    scene_ = std::move(*scene);
    auto steps = ShadeSteps::create(device_.dialect);
    ASSERT_TRUE(steps) << steps.error().text();
    steps_ = std::move(*steps);
    options_.show = Show::kD;
    options_.shade.every_pixel = true;
    options_.poses = {scene_->pack().movers[0].rest};
    view_ = make_view(look_at({5, 1.2f, 5.5f}, {0, -2, 0}, 0.9f), 96, 64, bounds_with_movers(*scene_, options_.poses));
    ASSERT_TRUE(steps_.begin(*scene_, options_));
  }
  StepCost draw(ShadeStep step) {
    const auto cost = steps_.draw(view_, options_, step);
    EXPECT_TRUE(cost) << (cost ? "" : cost.error().text());
    return cost.value_or(StepCost{});
  }

  std::unique_ptr<GpuScene> scene_;
  ShadeSteps steps_;
  FrameOptions options_;
  View view_;
};

TEST_F(ShadeStepsTest, IsTheSameByAllWays) {
  draw(ShadeStep::kEachLight);
  const FloatImage each = steps_.read();
  for (const ShadeStep step : {ShadeStep::kCells, ShadeStep::kFewPixels, ShadeStep::kMerged, ShadeStep::kLists}) {
    draw(step);
    const FloatImage other = steps_.read();
    double squares = 0, taken = 0;
    for (std::size_t i = 0; i < each.pixels.size(); ++i) {
      const double off = double{other.pixels[i]} - each.pixels[i];
      squares += off * off, taken += double{each.pixels[i]} * each.pixels[i];
      // Looks from a light's edge reach a little past what is told from its middle.
      if (step == ShadeStep::kCells) {
        ASSERT_NEAR(off, 0, 0.1) << i;
      }
    }
    EXPECT_GT(taken, 0);
    // Between one of sixteen pixels shade is bilinear.
    EXPECT_LT(std::sqrt(squares / taken), 0.1) << name_of(step);
  }
}

TEST_F(ShadeStepsTest, NothingIsLeftOfTheFrameBefore) {
  draw(ShadeStep::kLists);
  const FloatImage first = steps_.read();
  ASSERT_TRUE(steps_.begin(*scene_, options_));  // maps are drawn anew
  draw(ShadeStep::kLists);
  EXPECT_EQ(steps_.read().pixels, first.pixels);
}

// What the frame is darker than one without shade, on the floor.
TEST_F(ShadeStepsTest, ListsAreWhatThePlayerTakes) {
  draw(ShadeStep::kLists);
  const FloatImage lists = steps_.read();
  ASSERT_TRUE(renderer_->render(*scene_, view_, options_));
  const std::vector<std::int32_t> seen = renderer_->read_reflective();
  const FloatImage shaded = renderer_->read_frame();
  options_.shade.lights = 0;
  ASSERT_TRUE(renderer_->render(*scene_, view_, options_));
  const FloatImage open = renderer_->read_frame();
  int compared = 0;
  for (std::size_t i = 0; i < lists.pixels.size(); i += 4) {
    if (seen[i / 4] != -1 || !(lists.pixels[i] > 0)) continue;
    EXPECT_NEAR(kPi * (open.pixels[i] - shaded.pixels[i]), std::min(lists.pixels[i], 100.0f), 0.05) << i / 4;
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

TEST_F(ShadeStepsTest, PassesBecomeFewer) {
  const StepCost cells = draw(ShadeStep::kCells), merged = draw(ShadeStep::kMerged), each = draw(ShadeStep::kEachLight);
  EXPECT_LT(merged.passes, cells.passes);
  EXPECT_EQ(merged.shade.pairs, cells.shade.pairs);
  EXPECT_GT(cells.shade.pairs, 4u);
  EXPECT_EQ(draw(ShadeStep::kLists).passes, 1u);
  EXPECT_EQ(each.passes, (each.shade.lights + kPublishedLights - 1) / kPublishedLights);
}

}  // namespace
}  // namespace oriel::study
