// What reflected light of the preview is found from: particles from afar, and elements.
#include <gtest/gtest.h>

#include "preview/frame/elements.h"
#include "tests/preview/sunlit_room.h"

namespace oriel {
namespace {

// A floor that reflects half, in a black room: all that lands on it comes straight from the sun.
class SunByTheWindow : public ::testing::Test {
 protected:
  SunByTheWindow()
      : scene_(test::sunlit_room(Vec3(0))),
        accel_(*Accel::build(scene_, {false, 1})),
        lights_(scene_),
        sources_(scene_, lights_) {
    for (int i = 0; i < 256; ++i) {
      const Vec3 on(-1.9f + 0.25f * static_cast<float>(i % 16), 1e-4f, -1.9f + 0.25f * static_cast<float>(i / 16));
      floor_.push_back({{on, {0, 1, 0}, {0, 1, 0}}, on});
    }
  }

  std::vector<Landing> land(std::span<const EyePoint> eye, std::uint64_t seed) {
    Context context;
    context.seed = seed;
    const auto guided = *GuidedSources::create(transport_, sources_, eye, 0, context);
    return *land_particles(transport_, guided, 0, context);
  }

  // lm that come to the floor.
  static double flux(std::span<const Landing> landings) {
    double sum = 0;
    for (const Landing& l : landings)
      if (std::abs(l.place.y) < 1e-3f) sum += double{l.power.g} * kPiD / 0.5;
    return sum;
  }

  const Scene scene_;
  const Accel accel_;
  const LightSet lights_;
  const Sources sources_;
  const Transport transport_{accel_, lights_, {}};
  std::vector<EyePoint> floor_;
};

TEST_F(SunByTheWindow, IsTheClosedFormWithFewParticles) {
  const double truth = double{test::kSunLux} * test::kWindow_m2 * std::sqrt(0.5);
  double guided = 0, plain = 0;
  std::size_t landed = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const double off = flux(land(floor_, seed)) / truth - 1;
    const std::vector<Landing> unguided = land({}, seed);
    const double off_plain = flux(unguided) / truth - 1;
    landed += static_cast<std::size_t>(
        std::ranges::count_if(unguided, [](const Landing& l) { return std::abs(l.place.y) < 1e-3f; }));
    guided += off * off / 8, plain += off_plain * off_plain / 8;
  }
  std::printf("flux by a window, 2048 particles: off by %.3f with guides, %.2f of 256 without, of which %zu came in\n",
              std::sqrt(guided), std::sqrt(plain), landed);
  EXPECT_LT(std::sqrt(guided), 0.04);
  EXPECT_GT(std::sqrt(plain), 0.5);
}

// Whatever they are brought together to, and whichever of them are taken: all light is there.
TEST_F(SunByTheWindow, ElementsLoseNoLight) {
  const std::vector<Landing> landings = land(floor_, 1);
  double power = 0;
  for (const Landing& l : landings) power += double{l.power.g};
  Context context;
  for (const std::uint32_t count : {6u, 64u, 512u}) {
    std::vector<BounceElement> elements =
        *bounce_elements(landings, std::span(floor_).first(16), count, accel_, context);
    EXPECT_LE(elements.size(), count);
    double sum = 0, taken = 0;
    for (const BounceElement& e : elements) sum += double{e.power.g};
    EXPECT_NEAR(sum, power, 1e-4 * power);
    ASSERT_TRUE(find_importance(elements, std::span(floor_).first(32), accel_, context));
    for (int i = 0; i < 256; ++i)
      for (const BounceElement& e : some_of(elements, 36, (static_cast<float>(i) + 0.5f) / 256))
        taken += double{e.power.g} / 256;
    EXPECT_NEAR(taken, power, 0.02 * power) << count;
  }
}

// The patch on the floor is a 10,000th of what the sun lights, and is what a wall of the room gets its light from.
TEST_F(SunByTheWindow, IsWhatElementsAreTakenFrom) {
  const std::vector<Landing> landings = land(floor_, 1);
  std::vector<EyePoint> wall;
  for (int i = 0; i < 32; ++i) {
    const Vec3 on(-1.9f + 0.12f * static_cast<float>(i), 1.2f, 1.999f);
    wall.push_back({{on, {0, 0, -1}, {0, 0, -1}}, on});
  }
  Context context;
  std::vector<BounceElement> elements = *bounce_elements(landings, wall, 64, accel_, context);
  ASSERT_TRUE(find_importance(elements, wall, accel_, context));
  double inside = 0, all = 0;
  for (const BounceElement& e : elements) {
    const Vec3& at = e.places.front().place;
    if (std::abs(at.x) < 2 && std::abs(at.z) < 2 && at.y > -0.05f) inside += e.importance;
    all += e.importance;
  }
  std::printf("%.2f of what is taken is inside\n", inside / all);
  EXPECT_GT(inside / all, 0.5);  // by power alone: below 0.001
}

}  // namespace
}  // namespace oriel
