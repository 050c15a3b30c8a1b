// oriel-bake --method as a user meets it.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <map>

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

// Bastos et al. 1999: a hemisphere of 64 behind each element, all maps of one size with the lamps in them, Beckmann's
// D·G.
TEST_F(PublishedMethod, IsInThePack) {
  ASSERT_EQ(run("oriel-scenes gallery -o gallery.glb"), 0) << log();
  const std::string bake = "oriel-bake gallery.glb --no-cache -o a.oriel --texel 1m --samples 4 --method bastos1999 ";
  ASSERT_EQ(run(bake + "--map-resolution 16 --quiet"), 0) << log();
  const Pack pack = *read_pack(folder_.path() / "a.oriel");
  ASSERT_EQ(pack.reflectors.size(), 3u);
  EXPECT_TRUE(pack.emitters.empty() && pack.map_meshes.empty() && pack.curved_reflectors.empty());
  for (const Reflector& r : pack.reflectors) {
    std::map<std::uint32_t, int> of_element;
    for (std::uint32_t m = r.first_map; m < r.first_map + r.map_count; ++m) {
      const RadianceMap& map = pack.radiance_maps[m];
      ++of_element[map.element];
      const Vec3 from_centre = map.eye - Vec3(0.5f * (map.lower + map.upper), 0);
      EXPECT_NEAR(glm::length(from_centre), 0.5f * glm::length(map.upper - map.lower), 1e-4);
      EXPECT_EQ(std::max(map.width, map.height), 16u);
      EXPECT_TRUE(map.has_emission && !map.residual);
    }
    for (const auto& [element, maps] : of_element) EXPECT_EQ(maps, 64) << r.name << " " << element;
  }
  for (const BrdfKernel& kernel : pack.kernels)
    EXPECT_TRUE(kernel.slices.empty() && (kernel.size == 1 || kernel.model == KernelModel::kBeckmann));
  const auto options = Json::parse(pack.provenance).value()["options"];
  EXPECT_EQ(options["method"], "bastos1999");
  EXPECT_EQ(options["views_per_element"], 64);
  EXPECT_EQ(options["orders"], 1);
  for (const char* clash : {"--reflections geometry", "--views planned:8", "--map-price 0", "--facets ggx"}) {
    EXPECT_EQ(run(bake + clash), 1) << clash;
    EXPECT_NE(log().find("bastos1999"), std::string::npos) << log();
  }
  EXPECT_EQ(run("oriel-bake gallery.glb -o a.oriel --facets gaussian"), 1) << "of that method alone";
}

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
  for (const char* clash :
       {"--reflections maps", "--estimator reference", "--light-groups each", "--hidden-black", "--facets gaussian"}) {
    EXPECT_EQ(run(bake + "passes.oriel --method diefenbach1997 " + clash), 1) << clash;
    EXPECT_NE(log().find("--method"), std::string::npos) << log();
  }
}

}  // namespace
}  // namespace oriel
