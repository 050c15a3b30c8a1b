#include "trade/configurations.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/support/tiny_pack.h"

namespace oriel::trade {
namespace {
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

SceneFacts everything() {
  return {10, 100, true, true, true, true, {"0"}};
}

std::set<std::string> knobs(const TradePlan& plan) {
  std::set<std::string> out;
  for (const Configuration& c : plan.configurations) out.insert(c.knob);
  return out;
}

TEST(Configurations, WithoutReflectorsAndMoversVaryTheLightAlone) {
  SceneFacts bare;
  bare.cameras = {"0"};
  for (const bool quick : {true, false}) {
    const TradePlan plan = plan_trade(bare, 0.1, quick);
    EXPECT_THAT(knobs(plan),
                ElementsAre("default", "error", "no bake", "reference estimator", "reference paths", "texel"));
    for (const Configuration& c : plan.configurations) {
      EXPECT_TRUE(c.play.empty()) << c.name();
      for (const char* option : {"--views", "--map-resolution", "--sh-bands"}) EXPECT_FALSE(c.bake.contains(option));
    }
    EXPECT_THAT(plan.skipped, Contains(HasSubstr("no reflector")));
    EXPECT_THAT(plan.skipped, Contains(HasSubstr("nothing moves")));
  }
}

TEST(Configurations, OfASceneWithEverythingVaryEveryKnob) {
  const TradePlan plan = plan_trade(everything(), 0.1, false);
  EXPECT_THAT(plan.skipped, IsEmpty());
  for (const char* knob :
       {"reflections", "views", "maps", "map resolution", "blur", "sh bands", "mover lights", "shade"})
    EXPECT_THAT(knobs(plan), Contains(knob));
}

TEST(Configurations, DifferFromTheDefaultAndFromOneAnother) {
  for (const bool quick : {true, false}) {
    const TradePlan plan = plan_trade(everything(), 0.1, quick);
    EXPECT_EQ(plan.configurations[0].knob, "default");
    std::set<std::string> names;
    std::set<std::tuple<Settings, Settings, Settings, unsigned>> settings;
    for (const Configuration& c : plan.configurations) {
      EXPECT_TRUE(names.insert(c.name()).second) << c.name();
      EXPECT_TRUE(settings.insert({c.bake, c.play, c.preview, c.paths}).second) << c.name();
      EXPECT_FALSE(c.bake.contains("--samples") && c.bake.contains("--error")) << c.name();
    }
  }
  EXPECT_LT(plan_trade(everything(), 0.1, true).configurations.size(),
            plan_trade(everything(), 0.1, false).configurations.size());
}

TEST(Configurations, OfMirrorsOrCurvesAloneLeaveOutWhatTheyDoNotHave) {
  SceneFacts mirrors = everything();
  mirrors.glossy = false;
  const TradePlan plan = plan_trade(mirrors, 0.1, false);
  EXPECT_THAT(knobs(plan), Not(Contains("blur")));
  for (const Configuration& c : plan.configurations) EXPECT_FALSE(c.play.contains("--blur")) << c.name();
  SceneFacts curves = everything();
  curves.planar = false;
  EXPECT_THAT(knobs(plan_trade(curves, 0.1, false)), Not(Contains("views")));
  EXPECT_THAT(knobs(plan_trade(curves, 0.1, false)), Contains("map resolution"));
}

// 100 m² are 2500 texels of 20 cm.
TEST(Configurations, SmallScenesHaveBetterReferences) {
  SceneFacts facts = everything();
  EXPECT_EQ(plan_trade(facts, 0.1, true).reference.at("--samples"), "16384");
  facts.area_m2 = 1300;
  EXPECT_EQ(plan_trade(facts, 0.1, true).reference.at("--samples"), "1024");
  for (const double area : {0.0, 1e9}) {
    facts.area_m2 = area;
    const int samples = std::stoi(plan_trade(facts, 0.1, false).reference.at("--samples"));
    EXPECT_EQ(samples, area == 0 ? 16384 : 512);
  }
}

TEST(Configurations, LengthsAreThoseThatTheBakeTakes) {
  EXPECT_EQ(length_text(0.2), "20cm");
  EXPECT_EQ(length_text(0.025), "2.5cm");
  EXPECT_EQ(length_text(0.005), "5mm");
}

TEST(Survey, TexelsFitTheScene) {
  EXPECT_DOUBLE_EQ(fitting_texel_m(20), 0.1);
  EXPECT_DOUBLE_EQ(fitting_texel_m(0.95), 0.01);
  EXPECT_DOUBLE_EQ(fitting_texel_m(0.21), 0.002);
  for (const double nothing : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(fitting_texel_m(nothing), 0.1);
}

TEST(Survey, TellsWhatAPackHolds) {
  const Pack pack = oriel::testing::tiny_mapped_pack();
  const SceneFacts facts = survey(pack, 4);
  EXPECT_TRUE(facts.planar && facts.curved && facts.movers && facts.glossy);
  EXPECT_GT(facts.diagonal_m, 4);
  EXPECT_NEAR(facts.area_m2, 4 * 4 + 4 * 3, 1e-5);
  EXPECT_EQ(facts.cameras.size(), pack.cameras.size());
  EXPECT_EQ(facts.cameras[0], pack.cameras[0].name);
  EXPECT_EQ(survey(pack, 1).cameras.size(), 1u);
  const SceneFacts none = survey(Pack{}, 2);
  EXPECT_FALSE(none.planar || none.curved || none.movers || none.glossy);
  EXPECT_EQ(none.cameras.size(), 1u) << "some view of it there always is";
}

// In world metres.
TEST(Survey, WithoutCamerasLooksAsThePlayerDoes) {
  Pack pack = oriel::testing::tiny_mapped_pack();
  pack.cameras.clear();
  const SceneFacts facts = survey(pack, 2);
  ASSERT_EQ(facts.cameras.size(), 1u);
  EXPECT_EQ(std::count(facts.cameras[0].begin(), facts.cameras[0].end(), ','), 5) << facts.cameras[0];
}

}  // namespace
}  // namespace oriel::trade
