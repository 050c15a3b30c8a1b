// A frame beside its reference: regions, components, noise, and references that are none.
#include "formats/image/comparison.h"
#include "formats/core/json.h"

#include <gtest/gtest.h>

namespace oriel {
namespace {

constexpr std::uint32_t kWidth = 20, kHeight = 10;

FloatImage plain(float value) {
  return {kWidth, kHeight, 3, std::vector<float>(std::size_t{kWidth} * kHeight * 3, value)};
}

// D = 3 + 1, S = 2, emission 0; no noise.
LayeredImage reference() {
  LayeredImage image;
  for (const auto& [name, value] : {std::pair{"", 6.0f},
                                    {"direct", 3.0f},
                                    {"indirect", 1.0f},
                                    {"specular", 2.0f},
                                    {"error", 0.0f},
                                    {"diffuse_error", 0.0f},
                                    {"specular_error", 0.0f}})
    image.layers[name] = plain(value);
  return image;
}

// The right half is a mirror.
PlayedFrame played() {
  PlayedFrame frame{plain(6), plain(4), plain(2), {}, {}, 0.25};
  for (std::size_t i = 0; i < std::size_t{kWidth} * kHeight; ++i) frame.mirrors.push_back(i % kWidth >= kWidth / 2);
  frame.glossy.resize(frame.mirrors.size());
  return frame;
}

TEST(Comparison, OfEqualFrames) {
  const Comparison c = *compare(played(), reference(), 0);
  ASSERT_EQ(c.regions.size(), 4u) << "no glossy reflector is in view";
  EXPECT_EQ(c.regions[3].name, "matte");
  EXPECT_EQ(c.regions[3].pixels, std::size_t{kWidth} * kHeight / 2);
  EXPECT_NEAR(c.white, 6 / 0.18, 1e-3);
  for (const RegionComparison& r : c.regions) {
    EXPECT_EQ(r.total.rel_rmse + r.diffuse.rel_rmse + r.mse + r.flip, 0) << r.name;
    EXPECT_NEAR(r.ssim, 1, 1e-6);
  }
  EXPECT_FALSE(c.regions[0].specular);
  EXPECT_EQ(c.regions[1].name, "reflectors");
  EXPECT_EQ(c.regions[2].pixels, std::size_t{kWidth} * kHeight / 2);
  EXPECT_EQ(c.picture.width, 3 * kWidth);
}

TEST(Comparison, TellsComponentsAndRegionsApart) {
  PlayedFrame frame = played();
  for (std::size_t i = 0; i < frame.mirrors.size(); ++i)
    if (frame.mirrors[i])
      for (std::size_t c = 0; c < 3; ++c) {
        frame.specular.pixels[3 * i + c] += 1;
        frame.total.pixels[3 * i + c] += 1;
      }
  const Comparison c = *compare(frame, reference(), 0);
  const double dark = std::sqrt(1 + 1e-4);
  EXPECT_EQ(c.regions[2].diffuse.rel_rmse, 0);
  EXPECT_NEAR(c.regions[2].specular->rel_rmse, 0.5 / dark, 1e-6);
  EXPECT_NEAR(c.regions[2].total.rel_rmse, 1.0 / 6 / dark, 1e-6);
  EXPECT_NEAR(c.regions[0].total.rel_rmse, std::sqrt(0.5) / 6 / dark, 1e-6);
  EXPECT_GT(c.regions[2].flip, c.regions[0].flip);
  EXPECT_EQ(c.regions[3].total.rel_rmse, 0);
  const auto json = Json::parse(comparison_json(c)).value();
  EXPECT_NEAR(json["regions"]["mirrors"]["S"]["relRMSE"].get<double>(), 0.5 / dark, 1e-6);
  EXPECT_EQ(json["holes"], 0.25);
  EXPECT_NE(comparison_text(c).find("25.000 %"), std::string::npos);
  EXPECT_NE(comparison_text(c).find("mirrors"), std::string::npos);
}

TEST(Comparison, RefusesWhatIsNoReference) {
  LayeredImage without = reference();
  without.layers.erase("specular_error");
  EXPECT_NE(compare(played(), without, 0).error().message.find("specular_error"), std::string::npos);
  LayeredImage smaller = reference();
  smaller.layers["direct"] = {2, 2, 3, std::vector<float>(12)};
  EXPECT_EQ(compare(played(), smaller, 0).error().code, ErrorCode::kInvalid);
  LayeredImage grey = reference();
  grey.layers[""] = {kWidth, kHeight, 1, std::vector<float>(std::size_t{kWidth} * kHeight)};
  EXPECT_FALSE(compare(played(), grey, 0));
}

// One value that is no number, in any layer, is an error: neither 0 nor a pass.
TEST(Comparison, RefusesWhatIsNotFinite) {
  constexpr std::size_t kAt = 3 * (2 * kWidth + 7) + 1;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (const auto& [name, layer] : reference().layers) {
      LayeredImage broken = reference();
      broken.layers[name].pixels[kAt] = bad;
      const auto compared = compare(played(), broken, 0);
      ASSERT_FALSE(compared) << name;
      EXPECT_EQ(compared.error().code, ErrorCode::kInvalid);
      EXPECT_NE(compared.error().message.find("\"" + name + "\" holds 1 "), std::string::npos);
      EXPECT_NE(compared.error().message.find("pixel 7, 2"), std::string::npos) << compared.error().message;
    }
    for (FloatImage PlayedFrame::*layer : {&PlayedFrame::total, &PlayedFrame::diffuse, &PlayedFrame::specular}) {
      PlayedFrame broken = played();
      (broken.*layer).pixels[kAt] = bad;
      const auto compared = compare(broken, reference(), 0);
      ASSERT_FALSE(compared);
      EXPECT_EQ(compared.error().code, ErrorCode::kDifferent);
    }
  }
}

}  // namespace
}  // namespace oriel
