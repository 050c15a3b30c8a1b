// What sharing may change, and what all maps of a scene with many materials cost.
#include "bake/material/share.h"

#include <gtest/gtest.h>

#include "bake/material/materials.h"
#include "formats/pack/index.h"
#include "formats/pack/writer.h"
#include "tests/bake/material/fifty_materials.h"
#include "tests/bake/material/lobe_integrals.h"

namespace oriel {
namespace {

double l1(const BrdfKernel& a, const BrdfKernel& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.weights.size(); ++i) sum += std::abs(a.weights[i] - b.weights[i]);
  return sum;
}

TEST(Sharing, WidthsAreGroupedByTheErrorAsked) {
  const std::vector<float> alphas{0.1f, 0.2f, 0.1004f, 0.0f, 0.101f, 0.3f, -1.0f};
  const Groups exact = group_widths(alphas, 0);
  EXPECT_EQ(exact.values, (std::vector<float>{0, 0.1f, 0.1004f, 0.101f, 0.2f, 0.3f}));
  const Groups coarse = group_widths(alphas, 0.02);
  EXPECT_EQ(coarse.of, (std::vector<std::uint32_t>{1, 2, 1, 0, 1, 3, 0}));
  EXPECT_EQ(coarse.values[0], 0);
  EXPECT_NEAR(coarse.values[1], std::sqrt(0.1f * 0.101f), 1e-7);
  EXPECT_EQ(coarse.values[2], 0.2f) << "one alone keeps its own";
  EXPECT_TRUE(group_widths({}, 0.02).values.empty());
}

// The kernels of a group's ends differ from the group's by no more than was asked.
TEST(Sharing, GroupsKeepTheError) {
  for (const FacetModel model : {FacetModel::kBeckmann, FacetModel::kGgx})
    for (const double error : {0.01, 0.05}) {
      const float factor = std::exp(static_cast<float>(error) * 2.718281828f / 4);
      const float alpha = 0.02f;
      EXPECT_EQ(group_widths(std::vector<float>{alpha / factor, alpha * factor * 0.999f}, error).values.size(), 1u);
      EXPECT_EQ(group_widths(std::vector<float>{alpha / factor, alpha * factor * 1.001f}, error).values.size(), 2u);
      const KernelOptions fine{.max_size = 201, .energy = 0.99f};
      const BrdfKernel middle = make_kernel(alpha, lobe_of(model), 1, fine);
      // The end's lobe over the same directions.
      BrdfKernel end = middle;
      double sum = 0;
      for (std::uint32_t i = 0; i < end.weights.size(); ++i) {
        const DVec2 at = (DVec2(i % end.size, i / end.size) + 0.5) / double(end.size) * 2.0 - 1.0;
        sum += end.weights[i] =
            static_cast<float>(lobe_density(model, alpha * factor, 1, at * double{end.half_extent}));
      }
      for (float& w : end.weights) w = static_cast<float>(w / sum);
      EXPECT_LE(l1(middle, end), error * 1.02) << error;
      EXPECT_GE(l1(middle, end), error * 0.3) << error << ": the bound is not wasteful";
    }
}

TEST(Sharing, ReflectancesAreGroupedByTheirTables) {
  const auto map = [](float f0) { return make_fresnel_map({.base = {Vec3(f0), 1, 0.04f}}); };
  const std::vector<FresnelMap> maps{map(0.5f), map(0.505f), map(0.04f), map(0.0405f), map(0.515f)};
  EXPECT_EQ(group_reflectances(maps, 0.02).of, (std::vector<std::uint32_t>{0, 0, 2, 2, 4}));
  EXPECT_EQ(group_reflectances(maps, 0).of, (std::vector<std::uint32_t>{0, 1, 2, 2, 4}));
}

// An index of 1 reflects nothing, and one of 1.0001 everything at grazing angles.
TEST(Sharing, IndicesNextToOneKeepTheirOwnReflectance) {
  test::SceneParts parts;
  for (const float ior : {1.0f, 1.0001f, 1.0001f}) {
    SceneMaterial m;
    m.ior = ior;
    m.metallic = m.roughness = 0;
    parts.add(m);
  }
  Context context;
  const auto maps = bake_materials(parts.finish(), {}, context);
  ASSERT_TRUE(maps);
  EXPECT_EQ(maps->fresnel_map, (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_EQ(maps->fresnel_maps[0].table.front(), Vec3(0));
  EXPECT_EQ(maps->fresnel_maps[1].table.front(), Vec3(1));
}

TEST(Sharing, FiftyDifferentMaterialsFitAMegabyte) {
  Context context;
  const auto maps = bake_materials(test::fifty_materials(), {}, context);
  ASSERT_TRUE(maps);
  std::printf("50 materials: %zu kernels, %zu Fresnel maps\n", maps->kernels.size(), maps->fresnel_maps.size());
  for (const std::int32_t kernel : maps->kernel) EXPECT_GE(kernel, 0);
  EXPECT_EQ(maps->fresnel_maps.size(), 50u);

  Pack pack;
  pack.kernels = maps->kernels;
  pack.fresnel_maps = maps->fresnel_maps;
  const auto file = encode_pack(pack);
  ASSERT_TRUE(file) << file.error().text();
  const auto index = read_index(*file);
  ASSERT_TRUE(index);
  std::uint64_t bytes = 0;
  for (const SectionInfo& section : index->sections) {
    std::printf("  %-40s %7llu of %7llu bytes\n", section.label.c_str(),
                static_cast<unsigned long long>(section.stored_bytes),
                static_cast<unsigned long long>(section.raw_bytes));
    bytes += section.stored_bytes;
  }
  EXPECT_LT(bytes, 1'000'000u);
}

// One map for all materials that are the same, and no kernel for those too rough to reflect an image.
TEST(Sharing, TheSameMaterialsCostNoMore) {
  test::SceneParts parts;
  for (int i = 0; i < 50; ++i) {
    SceneMaterial m;
    m.metallic = 0;
    m.roughness = i % 2 == 0 ? 0.2f : 0.8f;
    parts.add(m);
  }
  Context context;
  const auto maps = bake_materials(parts.finish(), {}, context);
  ASSERT_TRUE(maps);
  EXPECT_EQ(maps->kernels.size(), 1u);
  EXPECT_EQ(maps->fresnel_maps.size(), 2u);
}

TEST(Sharing, ReflectancesThatDifferBetweenCoarseEntriesAreKept) {
  FresnelMap coarse, fine;
  coarse.table.assign(65, Vec3(0.5f));
  fine.table.assign(129, Vec3(0.5f));
  EXPECT_EQ(group_reflectances(std::vector{coarse, fine}, 0.02).of, (std::vector<std::uint32_t>{0, 0}));
  fine.table[3] = Vec3(0.6f);
  EXPECT_EQ(group_reflectances(std::vector{coarse, fine}, 0.02).of, (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace oriel
