// bake/transfer/compress.h: what is lost is what is said, and low ranks lose nothing.
#include "bake/transfer/compress.h"

#include <gtest/gtest.h>

#include <random>

namespace oriel {
namespace {

// Vertices in `groups` groups, each around a mean of its own with `rank` directions to move in.
VertexTransfer made_of(int groups, int rank, std::size_t vertices) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  VertexTransfer t;
  t.bands = 5;
  t.channels = 3;
  std::vector<std::vector<float>> basis(static_cast<std::size_t>(groups * (rank + 1)), std::vector<float>(t.stride()));
  for (std::size_t b = 0; b < basis.size(); ++b)
    for (float& x : basis[b]) x = normal(random) * (b % static_cast<std::size_t>(rank + 1) == 0 ? 10.0f : 0.3f);
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto* group = &basis[v % static_cast<std::size_t>(groups) * static_cast<std::size_t>(rank + 1)];
    std::vector<float> row = group[0];
    for (int k = 1; k <= rank; ++k) {
      const float w = normal(random);
      for (std::size_t i = 0; i < row.size(); ++i) row[i] += w * group[k][i];
    }
    t.coefficients.insert(t.coefficients.end(), row.begin(), row.end());
  }
  return t;
}

double error_of(const VertexTransfer& t, const CompressedTransfer& c) {
  std::vector<float> row(t.stride());
  double difference = 0, whole = 0;
  for (std::size_t v = 0; v < t.vertices(); ++v) {
    c.expand(v, row);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double exact = t.coefficients[v * t.stride() + i];
      difference += (row[i] - exact) * (row[i] - exact);
      whole += exact * exact;
    }
  }
  return std::sqrt(difference / whole);
}

TEST(CompressTransfer, ClustersOfLowRankComeBack) {
  const VertexTransfer t = made_of(4, 3, 4000);
  Context context;
  const auto c = compress_transfer(t, {.clusters = 4, .components = 3}, context).value();
  EXPECT_LT(c.error, 1e-4);
  EXPECT_EQ(c.bytes_per_vertex(), 7);
  EXPECT_NEAR(error_of(t, c), c.error, 1e-6);
  const auto fewer = compress_transfer(t, {.clusters = 4, .components = 2}, context).value();
  EXPECT_GT(fewer.error, 10 * c.error);
  EXPECT_NEAR(error_of(t, fewer), fewer.error, 1e-6);
  const auto one = compress_transfer(t, {.clusters = 1, .components = 3}, context).value();
  EXPECT_GT(one.error, 10 * c.error);
}

TEST(CompressTransfer, TakesAsFewComponentsAsTheErrorAllows) {
  const VertexTransfer t = made_of(8, 12, 4000);
  Context context;
  const auto loose = compress_transfer(t, {.max_error = 0.1f}, context).value();
  const auto tight = compress_transfer(t, {.max_error = 1e-3f}, context).value();
  EXPECT_LE(loose.error, 0.1f);
  EXPECT_LE(tight.error, 1e-3f);
  EXPECT_LT(loose.components, tight.components);
  const auto bounded = compress_transfer(t, {.max_error = 0, .max_bytes = 9}, context).value();
  EXPECT_EQ(bounded.bytes_per_vertex(), 9);
}

TEST(CompressTransfer, TheSameForAnyNumberOfThreads) {
  const VertexTransfer t = made_of(5, 4, 3000);
  Context one, two;
  one.threads = 1;
  two.threads = 2;
  const auto a = compress_transfer(t, {}, one).value(), b = compress_transfer(t, {}, two).value();
  EXPECT_EQ(a.weight, b.weight);
  EXPECT_EQ(a.basis, b.basis);
}

TEST(CompressTransfer, FewOrEqualVertices) {
  VertexTransfer t = made_of(1, 1, 1);
  Context context;
  const auto single = compress_transfer(t, {}, context).value();
  EXPECT_EQ(single.clusters, 1);
  EXPECT_LT(single.error, 1e-6);
  std::fill(t.coefficients.begin(), t.coefficients.end(), 0.0f);
  EXPECT_EQ(compress_transfer(t, {}, context).value().error, 0);
}

}  // namespace
}  // namespace oriel
