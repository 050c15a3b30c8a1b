#include "trade/units.h"

#include <gtest/gtest.h>

#include "formats/core/file.h"
#include "tests/support/temporary_folder.h"

namespace oriel::trade {
namespace {

class Sweeping : public ::testing::Test {
 protected:
  // Four units, two of them the same; as a sweep runs them: counted first.
  std::size_t sweep(double time_s = 0) {
    Units units(
        store_, context_, [&](const std::string& line) { lines_.push_back(line); }, time_s);
    for (const bool counting : {true, false}) {
      units.count(counting);
      for (const char* name : {"a", "b", "a", "c"}) {
        const auto measured = units.once("kind", name, store_.key({name}), [&]() -> Result<Measures> {
          ++ran_;
          if (name == fails_) return fail(ErrorCode::kRuntime, name, "found nothing");
          if (name == stops_) context_.stop = true;
          if (context_.stopped()) return fail(ErrorCode::kStopped, "", "stopped");
          Measures m;
          m.frame_ms = 5;
          return m;
        });
        if (!measured) {
          EXPECT_EQ(measured.error().where, fails_);
        }
      }
    }
    EXPECT_EQ(units.total(), 3u);
    left_ = units.left();
    return units.started();
  }

  oriel::testing::TemporaryFolder folder_;
  Store store_{folder_.path(), "inputs"};
  Context context_;
  std::vector<std::string> lines_;
  std::string_view fails_, stops_;
  int ran_ = 0;
  std::size_t left_ = 0;
};

TEST_F(Sweeping, RunsEachOnceAndNothingAgain) {
  EXPECT_EQ(sweep(), 3u);
  EXPECT_EQ(ran_, 3);
  EXPECT_EQ(lines_.size(), 3u);
  EXPECT_EQ(sweep(), 0u);
  EXPECT_EQ(ran_, 3);
  EXPECT_EQ(store_.find(store_.key({"a"}))->frame_ms, 5);
}

TEST_F(Sweeping, GoesOnWhereItWasStopped) {
  stops_ = "b";
  sweep();
  EXPECT_EQ(ran_, 2);
  EXPECT_EQ(left_, 2u);
  stops_ = {};
  context_.stop = false;
  EXPECT_EQ(sweep(), 2u) << "b and c";
  EXPECT_EQ(left_, 0u);
}

TEST_F(Sweeping, StartsNothingAfterItsTime) {
  EXPECT_EQ(sweep(1e-9), 0u);
  EXPECT_EQ(left_, 3u);
}

TEST_F(Sweeping, KeepsNoFailure) {
  fails_ = "b";
  EXPECT_EQ(sweep(), 3u);
  fails_ = {};
  EXPECT_EQ(sweep(), 1u);
}

TEST_F(Sweeping, DoesAgainWhatIsBroken) {
  sweep();
  const std::string half = "{\"bake\": {";
  ASSERT_TRUE(write_file_atomically(store_.file(store_.key({"c"}), ".json"), std::as_bytes(std::span(half))));
  EXPECT_EQ(sweep(), 1u);
}

TEST(Hash, KnowsTheSceneItsFilesAndTheOptions) {
  const oriel::testing::TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    EXPECT_TRUE(write_file_atomically(folder.path() / name, std::as_bytes(std::span(text))));
    return folder.path() / name;
  };
  const auto scene = write("scene.gltf", R"({"buffers": [{"uri": "data.bin"}, {"uri": 3}, 4], "images": {}})");
  const auto sky = write("sky.exr", "dawn").string();
  const auto hash = [&](const std::vector<std::string>& options) { return *hash_of(scene, options, {}); };
  std::set<std::string> seen{hash({}), hash({"--sky", "5"}), hash({"--sky", sky})};
  seen.insert(hash({"--ies", fmt::format("lamp={}", sky)}));
  EXPECT_EQ(seen.size(), 4u);
  EXPECT_TRUE(seen.contains(hash({}))) << "the same twice";
  write("data.bin", "geometry");
  EXPECT_TRUE(seen.insert(hash({})).second);
  write("sky.exr", "noon");
  EXPECT_TRUE(seen.insert(hash({"--ies", fmt::format("lamp={}", sky)})).second);
  EXPECT_EQ(hash_of(folder.path() / "none.glb", {}, {}).error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace oriel::trade
