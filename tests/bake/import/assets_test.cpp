// Real and hostile files. ORIEL_TEST_ASSETS names a folder with Khronos' sample models in features/, broken files in
// invalid/ and scenes beside them; without it these tests are skipped.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> scene_files(const fs::path& folder) {
  std::set<fs::path> found;
  if (!fs::exists(folder)) return {};
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") found.insert(entry.path());
  return {found.begin(), found.end()};
}

class Assets : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("ORIEL_TEST_ASSETS");
    if (!folder || !fs::exists(folder)) GTEST_SKIP() << "ORIEL_TEST_ASSETS names no folder of assets";
    root_ = folder;
  }
  fs::path root_;
};

TEST_F(Assets, InvalidFilesAreRefusedWithAReason) {
  int files = 0;
  for (const fs::path& file : scene_files(root_ / "invalid")) {
    const Imported r = import_file(file);
    ++files;
    ASSERT_FALSE(r.ok()) << file;
    EXPECT_EQ(r.result.error().code, ErrorCode::kInvalid) << file;
    EXPECT_NE(r.error().find(file.filename().string()), std::string::npos) << r.error();
    EXPECT_NE(r.error().find("found"), std::string::npos) << r.error();
  }
  EXPECT_GT(files, 30);
}

TEST_F(Assets, FeatureModelsImport) {
  int files = 0;
  for (const fs::path& file : scene_files(root_ / "features")) {
    const Imported r = import_file(file);
    ++files;
    ASSERT_TRUE(r.ok()) << file << r.error();
    EXPECT_EQ(broken_promise(r.scene()), "") << file;
  }
  EXPECT_GT(files, 30);
}

TEST_F(Assets, ScenesImport) {
  for (const auto& entry : fs::directory_iterator(root_)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || name == "invalid" || name == "features") continue;
    for (const fs::path& file : scene_files(entry.path())) {
      const Imported r = import_file(file);
      ASSERT_TRUE(r.ok()) << file << r.error();
      EXPECT_EQ(broken_promise(r.scene()), "") << file;
    }
  }
}

TEST_F(Assets, EmittersAndLightsAreRead) {
  const fs::path features = root_ / "features";
  const Imported strength = import_file(features / "EmissiveStrengthTest" / "EmissiveStrengthTest.glb");
  ASSERT_TRUE(strength.ok()) << strength.error();
  std::set<float> radiances;
  for (const SceneMaterial& m : strength.scene().materials) radiances.insert(max_component(m.emission));
  for (const float expected : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f})
    EXPECT_TRUE(radiances.contains(static_cast<float>(0.9 * static_cast<double>(expected)))) << expected;
  const Imported lamp = import_file(features / "LightsPunctualLamp" / "LightsPunctualLamp.gltf");
  ASSERT_TRUE(lamp.ok()) << lamp.error();
  EXPECT_EQ(lamp.scene().lights.size(), 5u);
}

TEST_F(Assets, CompressedBoxesEqualThePlainOne) {
  const fs::path features = root_ / "features";
  const Imported box = import_file(features / "Box" / "Box.glb");
  ASSERT_TRUE(box.ok()) << box.error();
  for (const fs::path& file : {features / "Box-Draco" / "Box.gltf", features / "BoxMeshopt" / "BoxMeshopt.glb",
                               features / "BoxInterleaved" / "BoxInterleaved.glb"}) {
    const Imported other = import_file(file);
    ASSERT_TRUE(other.ok()) << other.error();
    ASSERT_EQ(other.scene().triangles.size(), box.scene().triangles.size()) << file;
    double area = 0;
    for (std::uint32_t t = 0; t < other.scene().triangles.size(); ++t) area += triangle_area(other.scene(), t);
    EXPECT_NEAR(area, 6, 1e-3) << file;
    EXPECT_TRUE(other.warnings.empty()) << file;
  }
}

}  // namespace
}  // namespace oriel::test
