// A whole bake ends within its time, whatever the scene.
#include <gtest/gtest.h>

#include <ctime>

#include "bake/run/pipeline.h"
#include "formats/pack/validate.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel {
namespace {

// A ring of `around` by 10 quads, its axis along y.
Json ring(test::Gltf& g, int around, float radius, float thickness) {
  std::vector<float> positions;
  std::vector<std::uint16_t> indices;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < 10; ++k) {
      const float a = 2 * kPi * static_cast<float>(i) / static_cast<float>(around),
                  b = 0.2f * kPi * static_cast<float>(k);
      const float from_axis = radius + thickness * std::cos(b);
      positions.insert(positions.end(), {from_axis * std::cos(a), thickness * std::sin(b), -from_axis * std::sin(a)});
      const int next = (i + 1) % around, up = (k + 1) % 10;
      for (const int v : {10 * i + k, 10 * next + k, 10 * next + up, 10 * i + k, 10 * next + up, 10 * i + up})
        indices.push_back(static_cast<std::uint16_t>(v));
    }
  return {{"attributes", {{"POSITION", g.floats("VEC3", positions)}}}, {"indices", g.indices(indices)}};
}

// A thousand copies of a ring, lit by twenty thousand emissive triangles.
test::Gltf thousand_rings() {
  test::Gltf g;
  g.add(ring(g, 20, 0.1f, 0.04f))["translation"] = {-1, 1, 0};
  for (int i = 0; i < 999; ++i) {
    g.doc["nodes"].push_back({{"mesh", 0},
                              {"translation", {0.4 * (i % 10), 0.4 * (i / 10 % 10), 0.4 * (i / 100)}},
                              {"rotation", {std::sin(1.0 * i), 0, 0, std::cos(1.0 * i)}}});
    g.doc["scenes"][0]["nodes"].push_back(g.doc["nodes"].size() - 1);
  }
  g.material() = {{"emissiveFactor", {1, 1, 1}},
                  {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2000}}}}}};
  g.use("KHR_materials_emissive_strength");
  for (int i = 0; i < 20; ++i) {
    Json tube = ring(g, 50, 0.3f, 0.02f);
    tube["material"] = 0;
    g.add(tube)["translation"] = {0.3 * i - 1, 5, 1.5};
  }
  return g;
}

// By the CPU's time, of one thread: others may use the machine. Before stages ended with what there is, it took 16 s.
void expect_in_time(test::Gltf scene, float texel_m, bool lit) {
  const test::TempFolder folder;
  BakeOptions options;
  options.scene = folder.write("rings.gltf", scene.text());
  options.atlas.texel_m = texel_m;
  options.radiosity = {.estimator = Estimator::kCached, .samples = 4096, .error = 0.2, .detail = kMostCellSide};
  options.time_s = 2;
  Context context;
  context.threads = 1;
  const std::clock_t begun = std::clock();
  const auto made = bake(options, context);
  const double took = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
  ASSERT_TRUE(made);
  EXPECT_LE(took, 1.1 * options.time_s + 1);
  EXPECT_TRUE(validate(made->pack).empty());
  EXPECT_EQ(made->radiosity.mean.g > 0, lit);
  EXPECT_FALSE(made->shortfalls.empty()) << "what there was no time for is told";
}

TEST(WithinTime, ManyInstancesAndLampsAre) {
  expect_in_time(thousand_rings(), 0.05f, true);
}

TEST(WithinTime, ManyDarkTexelsAre) {
  test::Gltf g = thousand_rings();
  g.doc["materials"][0].erase("emissiveFactor");
  expect_in_time(std::move(g), 0.02f, false);
}

}  // namespace
}  // namespace oriel
