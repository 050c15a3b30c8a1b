// Movers through the whole bake: out of the static mesh, into sections of their own, lit by the field.
#include <gtest/gtest.h>

#include "bake/run/pipeline.h"
#include "formats/pack/validate.h"
#include "formats/query/light_at.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel {
namespace {

using test::Gltf;

// A floor in the plane z = 0 with its front to +Z, and a triangle like it 3 m above, under a sky of 100 cd/m².
Result<BakeResult> bake_floor_and_mover(const std::function<void(Gltf&, BakeOptions&)>& change) {
  Gltf g = test::triangle();
  g.add_triangle()["name"] = "kite";
  g.doc["nodes"][1]["translation"] = {0, 0, 3};
  g.doc["nodes"][1]["extras"]["oriel"]["mover"] = true;
  const test::TempFolder folder;
  BakeOptions options;
  options.import.sky = Vec3(100);
  options.atlas.texel_m = 0.25f;
  options.radiosity.error = 0.05;
  options.with_radiance = options.with_material = false;
  change(g, options);
  options.scene = folder.write("scene.gltf", g.text());
  Context context;
  return bake(options, context);
}

TEST(BakeMovers, LeaveTheMeshAndAreLitByTheField) {
  const auto result = bake_floor_and_mover([](Gltf&, BakeOptions&) {});
  ASSERT_TRUE(result) << result.error().text();
  const Pack& pack = result->pack;
  for (const Issue& issue : validate(pack)) EXPECT_NE(issue.severity, Severity::kError) << issue.message;
  EXPECT_EQ(pack.mesh.indices.size(), 3u);
  ASSERT_EQ(pack.movers.size(), 1u);
  const Mover& mover = pack.movers[0];
  EXPECT_EQ(mover.name, "kite");
  EXPECT_EQ(mover.mesh.indices.size(), 3u);
  // It shares its material with the floor: a copy of its own is there.
  ASSERT_EQ(pack.materials.size(), 2u);
  EXPECT_EQ(mover.mesh.parts[0].material, 1u);
  // All that its front sees is the sky: Σ T L is the sky's radiance.
  std::vector<float> t(mover.transfer.stride());
  mover.transfer.expand(0, t);
  const LocalLight light = light_at(pack.light_field, mover.rest.position + mover.mesh.positions[0]);
  float sent = 0;
  for (std::size_t i = 0; i < t.size(); ++i) sent += t[i] * light.sh[i];
  EXPECT_NEAR(sent, 100, 2);
}

TEST(BakeMovers, StandStillWhereTransferIsLeftOut) {
  const auto result = bake_floor_and_mover([](Gltf&, BakeOptions& options) { options.with_transfer = false; });
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_EQ(result->pack.mesh.indices.size(), 6u);
  EXPECT_TRUE(result->pack.movers.empty());
  EXPECT_EQ(result->pack.light_field.bands, 0);
}

TEST(BakeMovers, AloneTheyAreRefused) {
  const auto result =
      bake_floor_and_mover([](Gltf& g, BakeOptions&) { g.doc["nodes"][0]["extras"]["oriel"]["mover"] = true; });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalid);
}

}  // namespace
}  // namespace oriel
