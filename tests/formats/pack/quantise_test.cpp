// The encodings of pack numbers: exact where it is promised, within the bound elsewhere, and stable.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "formats/core/half.h"
#include "formats/pack/planes.h"
#include "formats/pack/quantise.h"

namespace oriel {
namespace {

TEST(Octahedral, AxesAreExact) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      Vec3 n(0);
      n[axis] = sign;
      EXPECT_EQ(normal_from_octahedral(octahedral_from_normal(n)), n);
    }
}

TEST(Octahedral, ErrorAndStability) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  double worst = 0;
  for (int i = 0; i < 300000; ++i) {
    Vec3 n = normalize_or({normal(random), normal(random), normal(random)}, {0, 0, 1});
    // Half of them near the edges of the octahedron, where the map folds.
    if (i % 2 == 0) n[i / 2 % 3] *= 1e-5f * normal(random);
    n = normalize_or(n, {0, 0, 1});
    const auto code = octahedral_from_normal(n);
    const Vec3 decoded = normal_from_octahedral(code);
    worst = std::max(worst, glm::length(DVec3(decoded) - DVec3(n)));
    ASSERT_EQ(octahedral_from_normal(decoded), code) << n.x << " " << n.y << " " << n.z;
  }
  EXPECT_LT(worst, 7e-5);
  EXPECT_GT(worst, 1e-5) << "the bound says nothing if nothing comes near it";
}

TEST(Octahedral, EveryCodeGivesAUnitVector) {
  std::mt19937 random(2);
  for (int i = 0; i < 200000; ++i) {
    const std::uint32_t code = i < 5 ? std::uint32_t{0x80008000u} >> i : static_cast<std::uint32_t>(random());
    EXPECT_NEAR(glm::length(DVec3(normal_from_octahedral(code))), 1, 2e-7);
  }
}

TEST(ScaleExponent, BringsTheLargestIntoRange) {
  for (int e = -79; e < 127; ++e)
    for (const float m : {1.0f, 1.3f, 1.99f, 1.9999999f}) {
      const float largest = std::ldexp(m, e);
      const int exponent = scale_exponent(largest, 11);
      const std::uint16_t half = half_from_float(std::ldexp(largest, -exponent));
      EXPECT_GE(float_from_half(half), 16384.0f);
      EXPECT_LE(float_from_half(half), e < 126 ? 32768.0f : 65504.0f);
      const float decoded = std::ldexp(float_from_half(half), exponent);
      EXPECT_EQ(scale_exponent(decoded, 11), exponent) << largest;
      EXPECT_LE(std::abs(decoded - largest), largest * 0x1p-11f);
    }
}

TEST(ScaleExponent, NothingAndNonsense) {
  EXPECT_EQ(scale_exponent(0, 11), 0);
  EXPECT_EQ(scale_exponent(std::numeric_limits<float>::denorm_min(), 11), 0);
  EXPECT_EQ(scale_exponent(std::nanf(""), 11), 0);
  EXPECT_EQ(scale_exponent(std::numeric_limits<float>::max(), 9), kMaxScaleExponent);
}

TEST(Disparity, EndsAreExactAndCodesAreStable) {
  for (int shift = 0; shift <= kMaxDisparityShift; ++shift) {
    EXPECT_EQ(disparity_from_code(0, shift), 0.0f);
    EXPECT_EQ(disparity_from_code(65535, shift), std::ldexp(1.0f, -shift));
    for (int code = 0; code < 65536; ++code)
      ASSERT_EQ(code_from_disparity(disparity_from_code(static_cast<std::uint16_t>(code), shift), shift), code);
  }
  EXPECT_EQ(disparity_shift(1), 0);
  EXPECT_EQ(disparity_shift(0.5f), 1);
  EXPECT_EQ(disparity_shift(0.3f), 1);
  EXPECT_EQ(disparity_shift(0), kMaxDisparityShift);
}

TEST(Disparity, ErrorIsHalfAStep) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int i = 0; i < 100000; ++i) {
    const float largest = std::ldexp(unit(random), -(i % 25)), value = largest * unit(random);
    const int shift = disparity_shift(largest);
    const float decoded = disparity_from_code(code_from_disparity(value, shift), shift);
    EXPECT_LE(std::abs(double{decoded} - value), std::ldexp(1.0 / 131070 + 1e-7, -shift));
    const float top = disparity_from_code(code_from_disparity(largest, shift), shift);
    EXPECT_EQ(disparity_shift(top), shift);
  }
}

TEST(Planes, ComeBackAndRefuseWhatIsNotThere) {
  const std::vector<Vec3> values = {{1, -2, 3}, {1, 2, 1e30f}, {0, 0, -0.0f}};
  ByteWriter out;
  put_planes(out, std::span<const Vec3>(values));
  const Bytes bytes = out.take();
  ASSERT_EQ(bytes.size(), 36u);
  ByteReader in(bytes);
  EXPECT_EQ(get_planes<Vec3>(in, 3), values);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.remaining(), 0u);
  for (const std::uint64_t count : {std::uint64_t{4}, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
    ByteReader short_of(bytes);
    EXPECT_TRUE(get_planes<Vec3>(short_of, count).empty());
    EXPECT_FALSE(short_of.ok());
  }
}

// The bytes that docs/notes/format.md gives as its example.
TEST(Planes, DocumentedExample) {
  const std::vector<std::uint16_t> values = {0x0102, 0x0105, 0x0204};
  ByteWriter out;
  put_planes(out, std::span<const std::uint16_t>(values));
  const unsigned char expected[] = {0x02, 0x03, 0xff, 0x01, 0x00, 0x01};
  const Bytes bytes = out.take();
  ASSERT_EQ(bytes.size(), 6u);
  EXPECT_EQ(std::memcmp(bytes.data(), expected, 6), 0);
}

}  // namespace
}  // namespace oriel
