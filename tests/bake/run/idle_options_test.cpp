#include "bake/run/idle_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "bake/run/option_table.h"

namespace oriel {
namespace {

// They decide what is done in any scene, or are refused where they would do nothing.
const std::set<std::string> kAlwaysEffective = {
    "--atlas",        "--bounces",       "--day",         "--directional",  "--double-sided", "--error",
    "--estimator",    "--eye-height",    "--eyes",        "--hidden-black", "--hours",        "--ies",
    "--light-groups", "--memory-limit",  "--move",        "--object",       "--only",         "--padding",
    "--pvs",          "--reproducible",  "--resolution",  "--samples",      "--scene",        "--sky",
    "--sky-type",     "--texel",         "--texel-means", "--time",         "--unit",         "--max-reflectors",
    "--lamp-scale",   "--emission-scale"};
constexpr IdleFacts kAll{true, true, true, true, true};

BakeOptions with(const std::string& option) {
  BakeOptions o = command_line_defaults();
  o.import.sky_file = "sky.exr";
  o.given = {option};
  return o;
}

TEST(IdleBakeOptions, EveryOptionIsInOneOfTheLists) {
  BakeOptions o;
  std::set<std::string> known = kAlwaysEffective, all;
  for (const std::string& name : idle_bake_option_names()) EXPECT_TRUE(known.insert(name).second) << name;
  for (const Option& option : bake_options(o)) all.insert(long_name(option));
  EXPECT_EQ(known, all);
}

TEST(IdleBakeOptions, AreToldOfWhereTheSceneHasNothingForThem) {
  for (const std::string& name : idle_bake_option_names()) {
    BakeOptions o = with(name);
    EXPECT_TRUE(idle_options(o, kAll).empty()) << name;
    o.import.sky_file.clear();
    o.radiosity.estimator = Estimator::kReference;
    EXPECT_EQ(idle_options(o, {}).size(), 1) << name;
  }
}

TEST(IdleBakeOptions, TheReasonIsTold) {
  EXPECT_THAT(idle_options(with("--sun-angle"), {}),
              ::testing::ElementsAre("--sun-angle has no effect: the scene has no directional lights"));
  BakeOptions o = with("--target");
  o.ways = WaysWanted::kGeometry;
  EXPECT_THAT(idle_options(o, kAll), ::testing::ElementsAre("--target has no effect: --reflections decides"));
  o = with("--probe");
  o.with_transfer = false;
  EXPECT_THAT(idle_options(o, kAll), ::testing::ElementsAre("--probe has no effect: --only leaves movers out"));
}

}  // namespace
}  // namespace oriel
