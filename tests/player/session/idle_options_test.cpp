#include "player/session/idle_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

// They decide what is done, or are refused where they would do nothing.
const std::set<std::string> kNeverIdle = {
    "--accumulate", "--aperture", "--camera", "--compare",     "--focus",   "--fps",      "--frames",  "--gpu-memory",
    "--hour",       "--json",     "--light",  "--lights",      "--list",    "--max-flip", "--move",    "--offscreen",
    "--output",     "--panorama", "--path",   "--quality",     "--samples", "--show",     "--shutter", "--size",
    "--smooth",     "--split",    "--stats",  "--supersample", "--video"};

Pack pack_with_all() {
  Pack pack = testing::tiny_mapped_pack();
  pack.movers.front().keys.resize(2);
  return pack;
}

bool is_idle(const std::string& option, const Pack& pack, PlayArguments arguments) {
  arguments.given = {option};
  return !idle_options(pack, arguments).empty();
}

TEST(IdleOptions, EveryOptionIsInOneOfTheLists) {
  PlayArguments arguments;
  std::set<std::string> known = kNeverIdle, all;
  for (const std::string& name : idle_option_names()) EXPECT_TRUE(known.insert(name).second) << name;
  for (const Option& option : play_options(arguments))
    if (option.name[0] == '-') all.insert(long_name(option));
  EXPECT_EQ(known, all);
}

// The mode in which each option has no effect on a pack with all; none: a pack that is empty leaves it without.
using Mode = void (*)(PlayArguments&);
void offscreen(PlayArguments& a) {
  a.offscreen = true;
}
void light_file(PlayArguments& a) {
  a.offscreen = true, a.output = "a.exr";
}
void one_file(PlayArguments& a) {
  a.output = "a.png";
}
void no_reflections(PlayArguments& a) {
  a.frame.reflections = Reflections::kOff;
}
const std::map<std::string, Mode> kIdleIn = {
    {"--blur", no_reflections},  {"--exposure", light_file}, {"--eye-height", offscreen},  {"--format", one_file},
    {"--log-frames", offscreen}, {"--maps", no_reflections}, {"--orders", no_reflections}, {"--tonemap", light_file}};

TEST(IdleOptions, AreToldOfWhereTheyDoNothing) {
  const Pack all = pack_with_all();
  for (const std::string& name : idle_option_names()) {
    PlayArguments effective;
    if (name == "--format") effective.output = "folder";
    EXPECT_FALSE(is_idle(name, all, effective)) << name;
    const auto mode = kIdleIn.find(name);
    PlayArguments idle;
    if (mode != kIdleIn.end()) mode->second(idle);
    EXPECT_TRUE(is_idle(name, mode != kIdleIn.end() ? all : Pack{}, idle)) << name;
  }
}

TEST(IdleOptions, NothingIsToldOfWhatWasNotGiven) {
  EXPECT_TRUE(idle_options({}, {}).empty());
}

TEST(IdleOptions, TheReasonIsTold) {
  PlayArguments arguments;
  arguments.given = {"--maps"};
  EXPECT_THAT(idle_options({}, arguments),
              ::testing::ElementsAre("--maps has no effect: the pack has no radiance maps"));
  arguments.frame.reflections = Reflections::kGeometry, arguments.given = {"--reflections"};
  Pack mirrors = testing::tiny_mapped_pack();
  mirrors.map_meshes.clear();
  EXPECT_THAT(idle_options(mirrors, arguments),
              ::testing::ElementsAre(
                  "--reflections has no effect: the pack has no radiance maps: its mirrors are drawn as geometry"));
}

}  // namespace
}  // namespace oriel
