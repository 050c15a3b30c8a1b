// Texels without light of their own.
#include "bake/radiosity/texels/nearest.h"

#include <gtest/gtest.h>

#include "tests/bake/radiosity/baked.h"
#include "tests/bake/radiosity/listed.h"
#include "tests/bake/radiosity/rooms.h"

namespace oriel::test {
namespace {

const SamplePoint& first_point(const Texels& texels, std::uint32_t i) {
  return texels.sample_points[i][0];
}

TEST(NearestTexels, AreNearAndFaceTheSameWay) {
  Listed listed(room(Feature::kMatt), 0.05f);
  Texels& texels = listed.texels;
  std::vector<std::uint32_t> unfinished;
  for (std::uint32_t i = 0; i < texels.count(); ++i)
    if (texels.visible[i] > 0 && i % 3 != 0) unfinished.push_back(i);
  leave_out(unfinished, texels);
  for (const std::uint32_t i : unfinished) {
    const std::uint32_t by = texels.shown_by(i);
    ASSERT_NE(by, kNoTexel);
    ASSERT_GT(texels.visible[by], 0);
    EXPECT_EQ(texels.visible[i], 0);
    EXPECT_GT(glm::dot(first_point(texels, i).geometric_normal, first_point(texels, by).geometric_normal), 0.5f);
    EXPECT_LT(glm::distance(first_point(texels, i).origin, first_point(texels, by).origin), 0.4f);
  }
  // Those that showed the light of what is left out now, show another's.
  std::vector<std::uint32_t> more;
  for (std::uint32_t i = 0; i < texels.count(); ++i)
    if (texels.visible[i] > 0 && i % 2 != 0) more.push_back(i);
  leave_out(more, texels);
  for (std::uint32_t i = 0; i < texels.count(); ++i)
    EXPECT_TRUE(texels.shown_by(i) == i || texels.visible[texels.shown_by(i)] > 0);
}

TEST(NearestTexels, OfWallsAreNoneOfSmallThings) {
  Listed listed(room(Feature::kMatt), 0.05f);
  Texels& texels = listed.texels;
  std::vector<std::uint32_t> unfinished;
  for (std::uint32_t i = 0; i < texels.count(); ++i) {
    if (i % 9 == 0) texels.area_m2[i] *= 1e-3f;
    if (texels.visible[i] > 0 && i % 3 != 0) unfinished.push_back(i);
  }
  leave_out(unfinished, texels);
  for (const std::uint32_t i : unfinished) EXPECT_GE(texels.area_m2[texels.shown_by(i)], 0.5f * texels.area_m2[i]);
}

TEST(NearestTexels, ShowTheLightOfThoseThatWereDoneInTime) {
  Listed listed(room(Feature::kMatt), 0.02f);
  const Transport transport = listed.transport();
  const Texels late = *list_texels({transport, listed.atlas, listed.map}, listed.context, {.seconds = 0});
  std::size_t done = 0;
  for (std::uint32_t i = 0; i < late.count(); ++i) done += late.shown_by(i) == i;
  EXPECT_GT(done, 1000u) << "some are there however late it is";
  EXPECT_LT(done, late.count() / 2);
  for (std::uint32_t i = 0; i < late.count(); ++i) EXPECT_NE(late.shown_by(i), kNoTexel);
}

// A lightmap for which no time was left is a rough one, and says so.
TEST(LateLightmap, IsNearTheLightThatMoreTimeGives) {
  const Baked whole = bake(room(Feature::kMatt), 0.1f, cached_options(0.05));
  RadiosityOptions options = cached_options(0.05);
  const ElapsedTime clock;
  options.left = [&] { return -clock.spent(); };
  options.enough = [&] { return options.late(); };
  options.left_of_all = options.left;
  const Baked late = bake(room(Feature::kMatt), 0.008f, options);
  const auto mean = [](const Baked& baked) {
    double sum = 0, count = 0;
    baked.each_texel(
        [&](const LightmapPage& page, std::uint32_t t, std::uint32_t) { sum += page.irradiance[t].g, ++count; });
    return sum / count;
  };
  const RadiosityReport& report = late.radiosity.report;
  EXPECT_GT(report.assumed, 0u);
  EXPECT_GT(report.relative_error, 4 * whole.radiosity.report.relative_error);
  EXPECT_LT(std::abs(mean(late) / mean(whole) - 1), report.relative_error) << "the error is stated";
}

}  // namespace
}  // namespace oriel::test
