// Rays aimed at what is bright: with the others they add up to the same light, with less noise.
#include <gtest/gtest.h>

#include "bake/radiosity/gather/bright_texels.h"
#include "bake/radiosity/gather/gather.h"
#include "formats/core/color.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel::test {
namespace {

struct Gathered {
  double flux = 0;      // of all texels, lm
  double variance = 0;  // mean over texels, by the halves' difference, of the mean light
};

Gathered gather_all(const Listed& listed, const CachedLight& cached, std::uint64_t seed) {
  const Transport transport = listed.transport();
  Context context;
  context.seed = seed;
  const CacheQuery query(transport, listed.texels, true, seed);
  const ExtraSamplePoints sample_points({transport, listed.atlas, listed.map}, listed.texels, seed);
  HalfSums sums(listed.texels.count(), false);
  EXPECT_TRUE((FinalGather{sample_points, query, cached}.run(coherent_order(listed.texels), 256, context, sums)));
  Gathered all;
  double m2 = 0;
  for (std::size_t i = 0; i < listed.texels.count(); ++i) {
    const double lit_m2 = listed.texels.area_m2[i] * listed.texels.visible[i];
    const double off = luminance(sums.half(0, i)) - luminance(sums.half(1, i));
    all.flux += lit_m2 * luminance(sums.mean(i)), all.variance += lit_m2 * off * off / 4, m2 += lit_m2;
  }
  all.variance /= m2;
  return all;
}

// A room with a box in it, one light texel in a hundred 300 times as bright as the rest.
void expect_same_light(bool behind_box) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.7f));
  parts.box("room", matt, Vec3(0), Vec3(4, 3, 4), true);
  parts.box("box", matt, {1, 0, 1}, {1.6f, 1.1f, 2.3f});
  const Listed listed(parts.finish(), 0.2f);
  const Transport transport = listed.transport();
  Context context;
  const TexelGraph graph = *find_neighbours(transport, listed.texels, context);
  std::vector<Vec3> light(listed.texels.count(), Vec3(1));
  int bright_ones = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const SamplePoint& point = listed.texels.sample_points[i][0];
    const bool on_floor = point.geometric_normal.y > 0.9f && point.origin.y < 0.1f;
    const Vec2 at(point.origin.x, point.origin.z), spot = behind_box ? Vec2(1.9f, 1.6f) : Vec2(3, 3);
    if (on_floor && glm::distance(at, spot) < 0.4f) light[i] = Vec3(300), ++bright_ones;
  }
  ASSERT_GT(bright_ones, 4);
  CachedLight cached = cache_light(listed.texels, graph, light, context);
  const Gathered alone = gather_all(listed, cached, 2);
  const CacheQuery query(transport, listed.texels, true, 1);
  const ExtraSamplePoints sample_points = listed.sample_points(transport);
  const std::vector<Vec3> gathered(light.size(), Vec3(0.7f));
  const std::vector<float> importance(light.size(), 1.0f);
  const BrightTexels bright(query, {listed.texels, sample_points, cached, gathered, importance}, 1);
  ASSERT_FALSE(bright.empty());
  cached.bright = &bright;
  const Gathered aimed = gather_all(listed, cached, 2);
  EXPECT_NEAR(aimed.flux / alone.flux, 1, 0.005);
  EXPECT_LT(aimed.variance, 0.1 * alone.variance);
}

TEST(BrightTexels, AimedRaysAndOthersAddUpToTheSameLight) {
  expect_same_light(false);
}
TEST(BrightTexels, BesideABoxToo) {
  expect_same_light(true);
}

// Facets of a coarse ball that a bright square shines on from below.
TEST(BrightTexels, RoundedBodiesGetAllOfIt) {
  SceneParts parts;
  const auto black = parts.diffuse(Vec3(0));
  parts.sphere("ball", black, {0, 1, 0}, 0.4f, 1);
  parts.quad("square", parts.diffuse(Vec3(1)), {-0.2f, 0, 0.2f}, {0.4f, 0, 0}, {0, 0, -0.4f});
  parts.quad("rest", black, {1, 0, 2}, {4, 0, 0}, {0, 0, -4});
  const Listed listed(parts.finish(), 0.05f);
  const Transport transport = listed.transport();
  Context context;
  const TexelGraph graph = *find_neighbours(transport, listed.texels, context);
  std::vector<Vec3> light;
  for (const Vec3& albedo : listed.texels.albedo) light.push_back(1000.0f * albedo);
  CachedLight cached = cache_light(listed.texels, graph, light, context);
  const CacheQuery query(transport, listed.texels, true, 1);
  const ExtraSamplePoints sample_points = listed.sample_points(transport);
  const std::vector<Vec3> gathered(light.size(), Vec3(1));
  const std::vector<float> importance(light.size(), 1.0f);
  const BrightTexels bright(query, {listed.texels, sample_points, cached, gathered, importance}, 1);
  ASSERT_FALSE(bright.empty());
  std::vector<std::uint32_t> turned_away;
  for (const std::uint32_t i : listed.floor)
    if (std::ranges::any_of(listed.texels.sample_points[i], [](const SamplePoint& p) {
          const Vec3 to = glm::normalize(-p.origin);  // the middle of the square
          return glm::dot(p.normal, to) > 0 && glm::dot(p.geometric_normal, to) < 0;
        }))
      turned_away.push_back(i);
  const auto flux = [&](std::uint32_t rays) {
    HalfSums sums(light.size(), false);
    EXPECT_TRUE((FinalGather{sample_points, query, cached}.run(turned_away, rays, context, sums)));
    double sum = 0;
    for (const std::uint32_t i : turned_away) sum += listed.texels.area_m2[i] * sums.mean(i).g;
    return sum;
  };
  const double by_other_rays = flux(1 << 16);
  cached.bright = &bright;
  const double aimed = flux(1 << 12);
  ASSERT_GT(turned_away.size(), 50u);
  EXPECT_NEAR(aimed / by_other_rays, 1, 0.005);
}

TEST(BrightTexels, EvenLightHasNone) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.7f)), Vec3(0), Vec3(4, 3, 4), true);
  const Listed listed(parts.finish(), 0.5f);
  const Transport transport = listed.transport();
  const CacheQuery query(transport, listed.texels, true, 1);
  Context context;
  const ExtraSamplePoints sample_points = listed.sample_points(transport);
  const std::vector<float> importance(listed.texels.count(), 1.0f);
  for (const float lux :
       {0.0f, 1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const std::vector<Vec3> even(listed.texels.count(), Vec3(lux));
    CachedLight cached{even, std::vector<CachedTexel>(even.size())};
    for (CachedTexel& texel : cached.texels) texel.radiance = Vec3(lux / kPi);
    EXPECT_TRUE(BrightTexels(query, {listed.texels, sample_points, cached, even, importance}, 1).empty()) << lux;
  }
}

}  // namespace
}  // namespace oriel::test
