// oriel-bake --method as a user meets it.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/pack/reader.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

std::string text_of(const std::filesystem::path& file) {
  const auto bytes = read_file(file);
  return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
}

class PublishedMethod : public ::testing::Test {
 protected:
  std::string log() const { return text_of(folder_.path() / "log"); }
  int run(const std::string& command) const {
    const std::string line =
        "cd '" + folder_.path().string() + "' && '" + ORIEL_BIN_DIR + "'/" + command + " >log 2>&1";
    return WEXITSTATUS(std::system(line.c_str()));
  }
  const testing::TemporaryFolder folder_;
};

// Diefenbach & Badler 1997: what lamps give at once is not in the lightmap, the lamps are listed, mirrors have no maps.
TEST_F(PublishedMethod, LeavesLampsToPasses) {
  ASSERT_EQ(run("oriel-scenes gallery -o gallery.glb"), 0) << log();
  const std::string bake = "oriel-bake gallery.glb --no-cache --texel 1m --samples 4 --quiet -o ";
  ASSERT_EQ(run(bake + "all.oriel"), 0) << log();
  ASSERT_EQ(run(bake + "passes.oriel --method diefenbach1997"), 0) << log();
  const Pack all = *read_pack(folder_.path() / "all.oriel"), passes = *read_pack(folder_.path() / "passes.oriel");
  EXPECT_TRUE(passes.radiance_maps.empty() && passes.light_groups.empty());
  EXPECT_EQ(passes.reflectors.size(), all.reflectors.size());
  EXPECT_GT(passes.light_field.lights.size(), 0u);
  EXPECT_EQ(passes.light_field.bands, 2);
  double lux = 0, of_all = 0;
  for (std::size_t p = 0; p < passes.lightmaps.size(); ++p)
    for (std::size_t t = 0; t < passes.lightmaps[p].irradiance.size(); ++t) {
      lux += passes.lightmaps[p].irradiance[t].g;
      of_all += all.lightmaps[p].irradiance[t].g;
    }
  EXPECT_GT(lux, 0.1 * of_all);
  EXPECT_LT(lux, 0.9 * of_all);
  EXPECT_EQ(Json::parse(passes.provenance).value()["options"]["method"], "diefenbach1997");
  for (const char* clash : {"--reflections maps", "--estimator reference", "--radiosity vertices",
                            "--light-groups each", "--hidden-black"}) {
    EXPECT_EQ(run(bake + "passes.oriel --method diefenbach1997 " + clash), 1) << clash;
    EXPECT_NE(log().find("--method"), std::string::npos) << log();
  }
}

}  // namespace
}  // namespace oriel
