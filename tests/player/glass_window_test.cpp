// What glass shows of places that the frame does not: through its window, and from its middle.
#include <optional>

#include "tests/player/glass_fixture.h"

namespace oriel {
namespace {

using namespace testing;

// A basin whose floor has stripes across x, and water in it; a dark deck around hides from the eye what refracted rays
// find.
class Basin {
 public:
  static constexpr float kDepth = 1.5f, kLevel = -0.1f, kIor = 1.33f, kGap = 1e-3f;

  Basin(const Vec2& lower, const Vec2& upper, float stripe) : lower_(lower), upper_(upper), stripe_(stripe) {}

  void add(Pack& pack) const {
    const Vec2 size = upper_ - lower_;
    const std::uint32_t dark = add_lamp(pack, Vec3(0)), bright = add_lamp(pack, Vec3(100)),
                        wall = add_lamp(pack, Vec3(0, 50, 0));
    const auto flat = [&](float x, float z, float width, float length, float y, std::uint32_t material) {
      testing::add_quad(pack, {x, y, z}, {0, 0, length}, {width, 0, 0}, material, -1);
    };
    for (int i = 0; static_cast<float>(i) * stripe_ < size.x; ++i) {
      const float x = static_cast<float>(i) * stripe_;
      flat(lower_.x + x, lower_.y, std::min(stripe_, size.x - x), size.y, -kDepth, i % 2 ? bright : dark);
    }
    flat(-20, -9, 40, lower_.y + 9, 0, dark), flat(-20, upper_.y, 40, 9 - upper_.y, 0, dark);
    flat(-20, lower_.y, lower_.x + 20, size.y, 0, dark), flat(upper_.x, lower_.y, 20 - upper_.x, size.y, 0, dark);
    const Vec3 low(lower_.x, -kDepth, lower_.y), high(upper_.x, -kDepth, upper_.y), up(0, kDepth, 0);
    testing::add_quad(pack, low, {size.x, 0, 0}, up, wall, -1);
    testing::add_quad(pack, low, up, {0, 0, size.y}, wall, -1);
    testing::add_quad(pack, high, {-size.x, 0, 0}, up, wall, -1);
    testing::add_quad(pack, high, up, {0, 0, -size.y}, wall, -1);
    add_box(pack, low + kGap, {upper_.x - kGap, kLevel, upper_.y - kGap});
  }
  // Where on the floor a ray ends; none where it does not enter the water, or meets a wall or the deck.
  std::optional<Vec3> floor_of(const Vec3& eye, const Vec3& d) const {
    if (d.y >= 0) return std::nullopt;
    const Vec3 deck = eye - d * (eye.y / d.y), top = eye + d * ((kLevel - eye.y) / d.y);
    if (!within(deck) || !within(top)) return std::nullopt;
    const Vec3 bent = glm::refract(d, Vec3(0, 1, 0), 1 / kIor);
    const Vec3 end = top - bent * ((kDepth + kLevel) / bent.y);
    return within(end) ? std::optional(end) : std::nullopt;
  }
  // By the deck, along a straight line that goes that way.
  bool is_hidden(const Vec3& end, const Vec3& way) const { return !within(end - way * (end.y / way.y)); }
  // Of 0 to 1 across a stripe, and which it is.
  float across(const Vec3& end) const { return glm::fract((end.x - lower_.x) / stripe_); }
  bool is_bright(const Vec3& end) const { return static_cast<int>((end.x - lower_.x) / stripe_) % 2 == 1; }

 private:
  bool within(const Vec3& p) const { return p.x > lower_.x && p.x < upper_.x && p.z > lower_.y && p.z < upper_.y; }
  Vec2 lower_, upper_;
  float stripe_;
};

class GlassWindowTest : public FrameTest {};

struct Counted {
  int right = 0, total = 0;
};

// Pixels of the water that show floor which is hidden from the eye by the deck: whether its stripe, away from its
// edges, is the one that is foretold.
Counted count_right(const Picture& picture, const Camera& camera, const Basin& basin) {
  Counted counted;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      Vec3 eye = camera.eye, d = pixel_ray(camera, x, y, picture.width, picture.height);
      if (camera.half_height > 0) {  // orthographic: pixel_ray() of a right angle is where it begins
        eye += camera.half_height * (d / glm::dot(d, camera.forward) - camera.forward);
        d = camera.forward;
      }
      const auto end = basin.floor_of(eye, d);
      const bool flat = camera.half_height > 0;
      if (!end || !basin.is_hidden(*end, flat ? d : *end - eye) || std::abs(basin.across(*end) - 0.5f) > 0.3f) continue;
      ++counted.total;
      const Vec3 seen = picture.at(x, y);
      counted.right += seen.y == seen.z && (seen.x > 50) == basin.is_bright(*end);
    }
  return counted;
}

// The near part of a pool's floor lies behind the deck: the screen does not show it, and from the middle of the water
// its tiles are finer than what is known from there.
TEST_F(GlassWindowTest, PoolShowsTheFloorBehindItsEdge) {
  const Basin basin({-12, -3}, {12, 3}, 0.25f);
  Pack pack = glass_pack(Basin::kIor, 0);
  basin.add(pack);
  for (const auto& [eye, target] : {std::pair{Vec3(-13, 1.6f, 0.3f), Vec3(-10, -0.8f, 0)},
                                    {Vec3(-11, 1.6f, -3.5f), Vec3(-9, -0.8f, 0)},
                                    {Vec3(0, 1.7f, 3.4f), Vec3(0.5f, -0.8f, 1)}}) {
    const Camera camera = glass_camera(eye, target, 1);
    const Counted counted = count_right(draw(pack, camera, 240, 160), camera, basin);
    EXPECT_GT(counted.total, 200);
    EXPECT_GT(counted.right, counted.total * 97 / 100) << "of " << counted.total << " from " << eye.x;
  }
}

// An orthographic picture has no window: all that the deck hides is known from the middle of the water, and seen from
// there at small angles.
TEST_F(GlassWindowTest, SurroundingsAreFoundAtSmallAngles) {
  const Basin basin({-4, -2}, {4, 2}, 0.5f);
  Pack pack = glass_pack(Basin::kIor, 0);
  basin.add(pack);
  Camera camera = glass_camera({-7, 1, 0.3f}, {-4, 0.1f, 0.3f}, 0.5f * kPi);
  const Picture picture = [&] {
    Camera flat = camera;
    flat.vertical_fov_rad = 0, flat.half_height = 1;
    return draw(pack, flat, 240, 160);
  }();
  camera.half_height = 1;
  const Counted counted = count_right(picture, camera, basin);
  EXPECT_GT(counted.total, 500);
  EXPECT_GT(counted.right, counted.total * 97 / 100) << "of " << counted.total;
}

}  // namespace
}  // namespace oriel
