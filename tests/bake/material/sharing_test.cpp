// What sharing may change, and what all maps of a scene with many materials cost.
#include "bake/material/share.h"

#include <gtest/gtest.h>

#include <chrono>

#include "bake/material/materials.h"
#include "formats/pack/index.h"
#include "formats/pack/writer.h"
#include "tests/bake/support/scene_parts.h"

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
  for (const KernelModel model : {KernelModel::kBeckmannDg, KernelModel::kGgxDg})
    for (const double error : {0.01, 0.05}) {
      const float factor = std::exp(static_cast<float>(error) * 2.718281828f / 4);
      const float alpha = 0.02f;
      EXPECT_EQ(group_widths(std::vector<float>{alpha / factor, alpha * factor * 0.999f}, error).values.size(), 1u);
      EXPECT_EQ(group_widths(std::vector<float>{alpha / factor, alpha * factor * 1.001f}, error).values.size(), 2u);
      const KernelOptions fine{.max_size = 201, .energy = 0.99f};
      const BrdfKernel middle = make_kernel(alpha, model, 1, fine);
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

// Fifty materials, each reflecting as no other does.
test::SceneParts fifty_materials() {
  test::SceneParts parts;
  for (int i = 0; i < 50; ++i) {
    SceneMaterial m;
    m.name = "material " + std::to_string(i);
    m.roughness = 0.01f * static_cast<float>(i + 1);  // 0.01 to 0.5: the widest that gets a kernel
    m.metallic = i % 2 == 0 ? 1.0f : 0.0f;
    m.base_color = Vec3(0.5f + 0.01f * static_cast<float>(i), 0.95f - 0.01f * static_cast<float>(i), 0.6f);
    m.ior = 1.2f + 0.03f * static_cast<float>(i);
    parts.add(m);
  }
  return parts;
}

TEST(Sharing, FiftyMaterialsAreBakedAtOnce) {
  const Scene scene = fifty_materials().finish();
  Context context;
  const auto start = std::chrono::steady_clock::now();
  const auto maps = bake_materials(scene, {}, context);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_TRUE(maps);
  std::printf("50 materials: %zu kernels, %zu Fresnel maps, %.2f s\n", maps->kernels.size(), maps->fresnel_maps.size(),
              seconds);
  EXPECT_LT(seconds, 20) << "2 s on an idle machine of two cores";
  for (const std::int32_t kernel : maps->kernel) EXPECT_GE(kernel, 0);

  Pack pack;
  pack.kernels = maps->kernels;
  pack.fresnel_maps = maps->fresnel_maps;
  pack.split_reflectance = make_split_reflectance();
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

}  // namespace
}  // namespace oriel
