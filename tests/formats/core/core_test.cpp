// formats/core: small floats, colour, bytes, hashes, files, results.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "formats/core/bytes.h"
#include "formats/core/check.h"
#include "formats/core/color.h"
#include "formats/core/file.h"
#include "formats/core/half.h"
#include "formats/core/hash.h"
#include "formats/core/octahedral.h"
#include "formats/core/result.h"
#include "formats/core/text.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();
const float kTiny = std::numeric_limits<float>::denorm_min();

TEST(OctahedralMap, DirectionsComeBack) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    const Vec2 p = octahedral_from_direction(d);
    EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 1);
    EXPECT_LT(glm::length(glm::normalize(direction_from_octahedral(p)) - d), 1e-6f);
  }
  EXPECT_EQ(octahedral_from_direction(Vec3(0)), Vec2(0));
  EXPECT_EQ(octahedral_from_direction(Vec3(0, 0, -1)), Vec2(1));
}

// Across an edge of the map lies the neighbouring direction.
TEST(OctahedralMap, GoesOnOverItsEdges) {
  constexpr int kDirections = 16;
  const auto direction = [](const IVec2& at) {
    return glm::normalize(direction_from_octahedral((Vec2(at) + 0.5f) / float(kDirections) * 2.0f - 1.0f));
  };
  const float step = 2.0f * 2 / kDirections * 1.5f;  // near the corners of the octahedron's faces texels are the widest
  for (int i = 0; i < kDirections; ++i)
    for (const auto& [inside, outside] : {std::pair(IVec2(0, i), IVec2(-1, i)),
                                          {{i, 0}, {i, -1}},
                                          {{kDirections - 1, i}, {kDirections, i}},
                                          {{i, kDirections - 1}, {i, kDirections}}}) {
      const IVec2 other = wrap_octahedral(outside, kDirections);
      ASSERT_TRUE(other.x >= 0 && other.y >= 0 && other.x < kDirections && other.y < kDirections);
      EXPECT_LT(glm::length(direction(other) - direction(inside)), step) << outside.x << " " << outside.y;
    }
  EXPECT_EQ(wrap_octahedral({5, 6}, kDirections), IVec2(5, 6));
  EXPECT_EQ(wrap_octahedral({-1, -1}, kDirections), IVec2(kDirections - 1, kDirections - 1));
}

TEST(Half, EveryFiniteCodeComesBack) {
  for (std::uint32_t code = 0; code < 0x10000; ++code) {
    if ((code & 0x7c00) == 0x7c00) continue;
    const float value = float_from_half(static_cast<std::uint16_t>(code));
    ASSERT_TRUE(std::isfinite(value));
    ASSERT_EQ(half_from_float(value), code);
  }
}

TEST(Half, PositiveOnesManyAtOnceAreTheSame) {
  for (std::uint16_t code = 0; code < 0x7c00; ++code)
    ASSERT_EQ(float_from_positive_half(code), float_from_half(code)) << code;
}

TEST(Half, ExtremesStayFinite) {
  EXPECT_EQ(half_from_float(kNan), 0);
  EXPECT_EQ(float_from_half(half_from_float(kInf)), kHalfMax);
  EXPECT_EQ(float_from_half(half_from_float(-kInf)), -kHalfMax);
  EXPECT_EQ(float_from_half(half_from_float(65519.0f)), kHalfMax);
  EXPECT_EQ(float_from_half(half_from_float(65520.0f)), kHalfMax);
  EXPECT_EQ(float_from_half(half_from_float(kTiny)), 0.0f);
  EXPECT_EQ(float_from_half(half_from_float(0x1p-24f)), 0x1p-24f);
}

TEST(Half, RelativeErrorBound) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> mantissa(1, 2);
  std::uniform_int_distribution<int> exponent(-14, 14);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const float x = std::ldexp(mantissa(random), exponent(random));
    worst = std::max(worst, std::abs(double{float_from_half(half_from_float(x))} - x) / x);
  }
  EXPECT_LE(worst, 0x1p-11);
  EXPECT_GT(worst, 0x1p-12) << "the bound says nothing if nothing comes near it";
}

TEST(Rgb9e5, ExtremesStayFinite) {
  EXPECT_EQ(rgb9e5_from_rgb({kNan, -1, -kInf}), 0u);
  EXPECT_EQ(rgb_from_rgb9e5(rgb9e5_from_rgb({kInf, 0, 0})), Vec3(kRgb9e5Max, 0, 0));
  EXPECT_EQ(rgb_from_rgb9e5(rgb9e5_from_rgb(Vec3(std::numeric_limits<float>::max()))), Vec3(kRgb9e5Max));
  EXPECT_EQ(rgb_from_rgb9e5(rgb9e5_from_rgb(Vec3(kTiny))), Vec3(0));
  EXPECT_EQ(rgb_from_rgb9e5(rgb9e5_from_rgb(Vec3(0x1p-24f))), Vec3(0x1p-24f));
  EXPECT_EQ(rgb_from_rgb9e5(rgb9e5_from_rgb({1, 0.5f, 0.25f})), Vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(rgb_from_rgb9e5(0xffffffffu), Vec3(kRgb9e5Max)) << "every code is a finite colour";
}

// OpenGL 4.6 core, 8.25: by logarithm, floor and powers.
TEST(Rgb9e5, IsTheDefinitionsEvenAtItsEdges) {
  const auto defined = [](const Vec3& rgb) {
    const float largest = std::min(max_component(rgb), kRgb9e5Max);
    if (largest <= 0) return 0u;
    int exponent = std::max(-16, std::ilogb(largest)) + 16;
    if (std::floor(std::ldexp(largest, 24 - exponent) + 0.5f) >= 512) ++exponent;
    std::uint32_t code = static_cast<std::uint32_t>(exponent) << 27;
    for (int c = 0; c < 3; ++c)
      code |= static_cast<std::uint32_t>(std::floor(std::ldexp(std::min(rgb[c], kRgb9e5Max), 24 - exponent) + 0.5f))
              << 9 * c;
    return code;
  };
  std::mt19937 random(3);
  std::uniform_int_distribution<int> exponent(-149, 17), steps(-2, 2);
  std::uniform_real_distribution<float> mantissa(1, 2);
  for (int i = 0; i < 200000; ++i) {
    Vec3 rgb;
    for (int c = 0; c < 3; ++c) rgb[c] = std::ldexp(i % 2 ? mantissa(random) : 2.0f, exponent(random));
    if (i % 4 == 0) rgb.g = rgb.r * (1 - 0x1p-10f) + static_cast<float>(steps(random)) * rgb.r * 0x1p-23f;  // rounds up
    ASSERT_EQ(rgb9e5_from_rgb(rgb), defined(rgb)) << rgb.r << " " << rgb.g << " " << rgb.b;
  }
}

TEST(Rgb9e5, ErrorBoundAndStability) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0, 1);
  std::uniform_int_distribution<int> exponent(-14, 15);
  for (int i = 0; i < 200000; ++i) {
    const float scale = std::ldexp(1.99f, exponent(random));
    const Vec3 rgb(unit(random) * scale, unit(random) * scale, unit(random) * scale);
    const std::uint32_t code = rgb9e5_from_rgb(rgb);
    const Vec3 decoded = rgb_from_rgb9e5(code);
    const float bound = std::max(max_component(rgb) * 0x1p-9f, 0x1p-25f);
    for (int c = 0; c < 3; ++c) ASSERT_LE(std::abs(decoded[c] - std::min(rgb[c], kRgb9e5Max)), bound);
    ASSERT_EQ(rgb9e5_from_rgb(decoded), code);
  }
}

TEST(Srgb, EveryCodeComesBack) {
  for (int code = 0; code < 256; ++code) {
    const float linear = linear_from_srgb8(static_cast<std::uint8_t>(code));
    EXPECT_EQ(std::lround(srgb_from_linear(linear) * 255), code);
  }
  EXPECT_EQ(linear_from_srgb8(0), 0.0f);
  EXPECT_EQ(linear_from_srgb8(255), 1.0f);
  EXPECT_NEAR(linear_from_srgb(0.5f), 0.21404114f, 1e-6f);
  EXPECT_EQ(srgb_from_linear(-1.0f), 0.0f);
  EXPECT_EQ(srgb_from_linear(kNan), 0.0f);
  EXPECT_NEAR(luminance(Vec3{1, 1, 1}), 1, 1e-6);
}

TEST(Bytes, ReadsWhatWasWritten) {
  ByteWriter out;
  out.put(std::uint8_t{7});
  out.put(std::uint32_t{0x01020304});
  out.put(-2.5);
  out.put_string("h\xc3\xa9");
  const std::vector<std::uint16_t> values = {1, 2, 65535};
  out.put_array(std::span<const std::uint16_t>(values));
  const Bytes bytes = out.take();
  EXPECT_EQ(bytes[1], std::byte{4}) << "little-endian";
  ByteReader in(bytes);
  EXPECT_EQ(in.get<std::uint8_t>(), 7);
  EXPECT_EQ(in.get<std::uint32_t>(), 0x01020304u);
  EXPECT_EQ(in.get<double>(), -2.5);
  EXPECT_EQ(in.get_string(), "h\xc3\xa9");
  EXPECT_EQ(in.get_array<std::uint16_t>(3), values);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.remaining(), 0u);
}

TEST(Bytes, ReadsPastTheEndFailForGood) {
  const Bytes bytes(6);
  ByteReader in(bytes);
  EXPECT_EQ(in.get<std::uint64_t>(), 0u);
  EXPECT_FALSE(in.ok());
  EXPECT_EQ(in.remaining(), 0u);
  EXPECT_EQ(in.get<std::uint8_t>(), 0) << "later reads fail too, although bytes are left";
  EXPECT_TRUE(in.get_array<std::uint8_t>(1).empty());
  for (const std::uint64_t count : {std::uint64_t{2}, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
    ByteReader other(bytes);
    EXPECT_TRUE(other.get_array<std::uint32_t>(count).empty());
    EXPECT_FALSE(other.ok());
  }
}

TEST(Hash, KnownValues) {
  // XXH3 of no bytes, as its specification gives it.
  EXPECT_EQ(hash64({}), 0x2d06800538d394c2ull);
  EXPECT_EQ(hash128_hex({}), "99aa06d3014798d86001c324468d497f");
  Bytes bytes(100);
  const auto before = hash64(bytes);
  bytes[50] = std::byte{1};
  EXPECT_NE(hash64(bytes), before);
}

TEST(Files, WholeOrNot) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.bin";
  const Bytes first(1000, std::byte{1}), second(10, std::byte{2});
  ASSERT_TRUE(write_file_atomically(path, first));
  EXPECT_EQ(*read_file(path), first);
  ASSERT_TRUE(write_file_atomically(path, second));
  EXPECT_EQ(*read_file(path), second);
  EXPECT_EQ(read_file(path, 9).error().code, ErrorCode::kIo) << "larger than accepted";
  EXPECT_EQ(read_file(folder.path()).error().code, ErrorCode::kIo);
  EXPECT_EQ(read_file(folder.path() / "none").error().code, ErrorCode::kIo);
  EXPECT_EQ(write_file_atomically(folder.path() / "no" / "folder", first).error().code, ErrorCode::kIo);
  ASSERT_TRUE(write_file_atomically(path, {}));
  EXPECT_TRUE(read_file(path)->empty());
}

TEST(Files, AppearWhenCommitted) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.bin";
  const Bytes ones(10, std::byte{1}), zeros(3);
  {
    auto file = AtomicFile::create(path);
    ASSERT_TRUE(file && file->write(0, ones));
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "nothing stays of what is not committed";
  auto file = AtomicFile::create(path);
  ASSERT_TRUE(file);
  AtomicFile moved = std::move(*file);
  ASSERT_TRUE(moved.write(4, ones));
  ASSERT_TRUE(moved.write(5, zeros));   // over what is there
  ASSERT_TRUE(moved.write(20, zeros));  // a hole at the end
  ASSERT_TRUE(moved.commit());
  Bytes expected(23);
  for (const int i : {4, 8, 9, 10, 11, 12, 13}) expected[static_cast<std::size_t>(i)] = std::byte{1};
  EXPECT_EQ(*read_file(path), expected);
}

TEST(Files, MapsWhatIsThere) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.bin";
  const Bytes first(10000, std::byte{1}), second(10, std::byte{2});
  ASSERT_TRUE(write_file_atomically(path, first));
  const auto mapped = MappedFile::open(path);
  ASSERT_TRUE(mapped);
  ASSERT_TRUE(write_file_atomically(path, second));  // another file under the name: the mapped one stays
  EXPECT_TRUE(std::ranges::equal(mapped->bytes(), first));
  EXPECT_TRUE(std::ranges::equal(MappedFile::open(path)->bytes(), second));
  ASSERT_TRUE(write_file_atomically(path, {}));
  EXPECT_TRUE(MappedFile::open(path)->bytes().empty());
  EXPECT_EQ(MappedFile::open(folder.path()).error().code, ErrorCode::kIo);
  EXPECT_EQ(MappedFile::open(folder.path() / "none").error().code, ErrorCode::kIo);
}

TEST(Hash, PiecesAreTheWhole) {
  Bytes bytes(5000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 7);
  Hasher64 hasher;
  for (int round = 0; round < 2; ++round) {
    hasher.reset();
    for (std::size_t i = 0; i < bytes.size(); i += 611)
      hasher.add(std::span(bytes).subspan(i, std::min<std::size_t>(611, bytes.size() - i)));
    EXPECT_EQ(hasher.result(), hash64(bytes));
  }
}

TEST(Results, TextAndTry) {
  const auto half = [](int x) -> Result<int> {
    if (x % 2 != 0) return invalid("number", "found {}, expected an even one", x);
    return x / 2;
  };
  const auto quarter = [&](int x) -> Result<int> {
    ORIEL_TRY(const int h, half(x));
    ORIEL_TRY(const int q, half(h));
    return q;
  };
  EXPECT_EQ(*quarter(12), 3);
  EXPECT_EQ(quarter(6).error().text(), "number: found 3, expected an even one");
  EXPECT_EQ(quarter(6).error().code, ErrorCode::kInvalid);
}

TEST(ChecksDeathTest, PrintBothValues) {
  EXPECT_DEATH(ORIEL_CHECK_EQ(2 + 2, 5), "2 \\+ 2 == 5 \\(found 4 and 5\\)");
}

TEST(Vectors, DirectionsOfExtremeVectors) {
  EXPECT_EQ(normalize_or({0, 0, 0}, {0, 1, 0}), Vec3(0, 1, 0));
  EXPECT_EQ(normalize_or({kNan, 0, 0}, {0, 1, 0}), Vec3(0, 1, 0));
  EXPECT_EQ(normalize_or({kInf, 0, 0}, {0, 1, 0}), Vec3(0, 1, 0));
  EXPECT_EQ(normalize_or({1e-30f, 0, 0}, {0, 1, 0}), Vec3(1, 0, 0));
  EXPECT_EQ(normalize_or({0, 0, 3e38f}, {0, 1, 0}), Vec3(0, 0, 1));
}

TEST(Vectors, FramesAreOrthonormal) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 n = i == 0 ? Vec3(0, 0, -1) : normalize_or({normal(random), normal(random), normal(random)}, {0, 0, 1});
    const Mat3 frame = frame_from_normal(n);
    EXPECT_EQ(frame[2], n);
    EXPECT_NEAR(glm::dot(frame[0], frame[1]), 0, 1e-6);
    EXPECT_NEAR(glm::dot(frame[0], n), 0, 1e-6);
    EXPECT_NEAR(glm::length(frame[0]), 1, 1e-6);
    EXPECT_NEAR(glm::determinant(frame), 1, 1e-5);
  }
}

TEST(Base64, IsThatOfTheStandard) {
  const auto of = [](const std::string& text) { return base64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe"), "//4=");
}

TEST(Escaped, MarksUpNothing) {
  EXPECT_EQ(escaped("<a href=\"x\">'&amp;'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(escaped(""), "");
}

TEST(Text, PatternsStandForTexts) {
  for (const char* fitting : {"*", "desk *", "*lamp", "d*k*l*p", "desk ?amp", "desk lamp", "**desk lamp**"})
    EXPECT_TRUE(fits_pattern(fitting, "desk lamp")) << fitting;
  for (const char* other : {"", "desk", "lamp*", "desk lamp?", "*lamps", "Desk*"})
    EXPECT_FALSE(fits_pattern(other, "desk lamp")) << other;
  EXPECT_TRUE(fits_pattern("", "") && fits_pattern("*", "") && !fits_pattern("?", ""));
  EXPECT_FALSE(fits_pattern(std::string(40, '*') + "*a*a*a*a*a*a*a*a*b", std::string(5000, 'a'))) << "in no time";
}

}  // namespace
}  // namespace oriel
