// Broken scene files through the whole program, as they are and as .glb: a message and an exit code, no pack, no crash.
// ORIEL_TEST_ASSETS names a folder that holds them in invalid/; without it the test is skipped.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "formats/core/file.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

// A .gltf's text as the JSON chunk of a .glb.
Bytes as_glb(const Bytes& json) {
  const std::size_t padded = (json.size() + 3) / 4 * 4;
  const std::array<std::uint32_t, 5> header{0x46546C67, 2, static_cast<std::uint32_t>(20 + padded),
                                            static_cast<std::uint32_t>(padded), 0x4E4F534A};
  Bytes glb(sizeof(header) + padded, std::byte{' '});
  std::memcpy(glb.data(), header.data(), sizeof(header));
  std::copy(json.begin(), json.end(), glb.begin() + sizeof(header));
  return glb;
}

class InvalidScenes : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* assets = std::getenv("ORIEL_TEST_ASSETS");
    if (!assets || !fs::exists(fs::path(assets) / "invalid"))
      GTEST_SKIP() << "ORIEL_TEST_ASSETS names no folder of assets";
    fs::copy(fs::path(assets) / "invalid", folder_.path(), fs::copy_options::recursive);
  }
  void expect_refusal(const fs::path& scene) const {
    const auto pack = folder_.path() / "out.oriel", log = folder_.path() / "log";
    const std::string command = "'" ORIEL_BIN_DIR "/oriel-bake' '" + scene.string() + "' -o '" + pack.string() +
                                "' --cache off >'" + log.string() + "' 2>&1 </dev/null";
    const int status = std::system(command.c_str());
    const Bytes bytes = read_file(log).value_or(Bytes{});
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 3) << scene << ": " << status << "\n" << text;
    EXPECT_NE(text.find(scene.filename().string()), std::string::npos) << text;
    EXPECT_FALSE(fs::exists(pack)) << scene;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(InvalidScenes, AreRefusedByTheBaker) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    const fs::path scene = entry.path();
    if (scene.extension() != ".gltf" && scene.extension() != ".glb") continue;
    ++files;
    expect_refusal(scene);
    if (scene.extension() == ".glb") continue;
    // Told by its first bytes, not its name; it lies beside the files that it refers to.
    const fs::path wrapped = folder_.path() / (scene.stem().string() + ".wrapped");
    ASSERT_TRUE(write_file_atomically(wrapped, as_glb(*read_file(scene))));
    expect_refusal(wrapped);
  }
  EXPECT_GT(files, 30);
}

}  // namespace
}  // namespace oriel
