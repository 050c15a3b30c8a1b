// Plans and bakes of random options that share a cache are those without one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

class SharedCache : public ::testing::Test {
 protected:
  int run(const std::string& command) const {
    return std::system(
        fmt::format("cd '{}' && '{}'/{} >log 2>&1", folder_.path().string(), ORIEL_BIN_DIR, command).c_str());
  }
  std::string text_of(const char* name) const {
    const auto bytes = read_file(folder_.path() / name);
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
  }
  // What a plan predicts but times.
  std::string prediction(const char* name) const {
    const Json plan = Json::parse(text_of(name)).value_or(Json());
    std::string out;
    for (const Json& part : plan["prediction"]["components"])
      out += part["name"].dump() + part["rays"].dump() + part["bytes"].dump() + part["error"].dump() + "\n";
    return out;
  }

  testing::TemporaryFolder folder_;
};

// ORIEL_CACHE_PAIRS=N tries so many.
TEST_F(SharedCache, HoldsForAnyOptions) {
  for (const char* scene : {"cornell", "glass-sphere"})
    ASSERT_EQ(run(fmt::format("oriel-scenes {0} -o {0}.glb", scene)), 0) << text_of("log");
  const char* asked = std::getenv("ORIEL_CACHE_PAIRS");
  const int tries = asked ? std::atoi(asked) : 4;
  std::mt19937 random(1);
  const auto one_of = [&](std::initializer_list<const char*> all) { return *(all.begin() + random() % all.size()); };
  for (int i = 0; i < tries; ++i) {
    const std::string options =
        fmt::format("{}.glb --unit m --texel {} --error {} {} {}", one_of({"cornell", "glass-sphere"}),
                    one_of({"2cm", "4cm", "7cm", "15cm"}), one_of({"5%", "10%", "20%"}),
                    one_of({"", "--bounces 2", "--seed 3", "--light-groups each"}), one_of({"", "--directional on"}));
    SCOPED_TRACE(options);
    ASSERT_EQ(run("oriel-bake plan --quiet --json alone.json " + options), 0) << text_of("log");
    ASSERT_EQ(run("oriel-bake plan --quiet --cache shared --json shared.json " + options), 0) << text_of("log");
    EXPECT_NE(prediction("alone.json"), "");
    EXPECT_EQ(prediction("alone.json"), prediction("shared.json"));
    ASSERT_EQ(run("oriel-bake --quiet --cache off -o alone.oriel " + options), 0) << text_of("log");
    ASSERT_EQ(run("oriel-bake --quiet --cache shared -o shared.oriel " + options), 0) << text_of("log");
    EXPECT_TRUE(text_of("alone.oriel") == text_of("shared.oriel"));
  }
}

}  // namespace
}  // namespace oriel
