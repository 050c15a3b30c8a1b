// Glass in what reflectors show: as the frame of an eye behind the mirror has it.
#include <set>

#include "tests/player/glass_fixture.h"

namespace oriel {
namespace {

using namespace testing;

// A mirror that loses nothing.
std::uint32_t add_silver(Pack& pack) {
  Material silver;
  silver.metallic = 1;
  silver.base_color = Vec3(1);
  silver.fresnel_map = static_cast<std::int32_t>(pack.fresnel_maps.size());
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(1)));
  pack.materials.push_back(silver);
  return static_cast<std::uint32_t>(pack.materials.size() - 1);
}

// A square of 2 `half` around a point, that faces along the normal.
struct Plate {
  Vec3 middle{0}, normal{0, 0, -1};
  float half = 1;

  void add(Pack& pack, std::uint32_t material) const {
    const Vec3 up = glm::normalize(glm::cross(std::fabs(normal.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0), normal));
    const Vec3 right = glm::cross(up, normal);
    add_bare_mirror(pack, middle - half * (right + up), 2 * half * right, 2 * half * up, material);
  }
  // The eye that sees in the plate what this one sees behind it; left and right change places.
  Camera mirror(const Camera& camera) const {
    Camera out = camera;
    out.eye = camera.eye - 2 * glm::dot(camera.eye - middle, normal) * normal;
    out.forward = glm::reflect(camera.forward, normal);
    out.up = glm::reflect(camera.up, normal);
    return out;
  }
};

Picture flipped(Picture picture) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; 2 * x + 1 < picture.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const auto at = [&](int column) -> float& {
          return picture.rgb[static_cast<std::size_t>(3 * (y * picture.width + column) + c)];
        };
        std::swap(at(x), at(picture.width - 1 - x));
      }
  return picture;
}

// The mean over 4 x 4 pixels, which look at parts of a lobe each.
Vec3 mean_at(const Picture& picture, int column, int row) {
  Vec3 sum(0);
  for (int i = 0; i < 16; ++i) sum += picture.at(4 * column + i % 4, 4 * row + i / 4);
  return sum / 16.0f;
}

// The share of a picture's squares that differ by more than `step` cd/m².
double share_off(const Picture& a, const Picture& b, float step) {
  int off = 0, all = 0;
  for (int row = 0; row < a.height / 4; ++row)
    for (int column = 0; column < a.width / 4; ++column, ++all)
      off += max_component(glm::abs(mean_at(a, column, row) - mean_at(b, column, row))) > step;
  return static_cast<double>(off) / all;
}

class GlassMirrorTest : public FrameTest {};

TEST_F(GlassMirrorTest, SlabShiftsWhatLiesBehind) {
  Pack pack = glass_pack(ShiftedEdge::kIor, 0);
  ShiftedEdge::add(pack);
  const Plate plate{{1.5f, 0, 1.2f}, {0, 0, -1}, 1};
  plate.add(pack, add_silver(pack));
  const Camera camera = glass_camera({1.5f, 0, 1.5f}, {0, 0, -1});
  const Picture seen = flipped(draw(pack, plate.mirror(camera), 160, 160));
  ShiftedEdge::expect_in(seen, camera);
  EXPECT_EQ(seen.stats.mirrored_glass, 1u);
}

struct Kind {
  const char* name;
  float roughness;
  bool ball, pane, cup = false;
};
constexpr Kind kKinds[] = {{"block", 0, false, false},
                           {"ball", 0, true, false},
                           {"frosted block", 0.3f, false, false},
                           {"frosted ball", 0.3f, true, false},
                           {"frosted pane", 0.3f, false, true},
                           {"cup", 0, false, false, true}};

// Of green glass in a room of six colours; the frosted pane is clear of colour.
Pack room_with(const Kind& kind) {
  Pack pack = glass_pack(1.5f, kind.roughness, Vec3(2, 0.2f, 1));
  if (kind.pane) {
    pack.solids.clear();
    pack.materials[0].double_sided = true;
    testing::add_quad(pack, {-0.5f, -0.6f, 0}, {1, 0, 0}, {0, 1.2f, 0}, 0, -1);
  } else if (kind.cup) {
    add_cup(pack);
  } else if (kind.ball) {
    add_ball(pack, Vec3(0), 0.6f);
  } else {
    add_box(pack, {-0.5f, -0.6f, -0.4f}, {0.5f, 0.6f, 0.4f});
  }
  add_room(pack, 2);
  return pack;
}

TEST_F(GlassMirrorTest, IsAsSeenFromBehindTheMirror) {
  const Camera camera = glass_camera({1.2f, 0.7f, 1.5f}, Vec3(0), 0.7f);
  const Plate plate{{0.8f, 0.4f, 1.2f}, {0, 0, -1}, 1.15f};
  for (const Kind& kind : kKinds) {
    Pack pack = room_with(kind);
    plate.add(pack, add_silver(pack));
    const Picture direct = draw(pack, camera, 160, 120);
    const Picture seen = flipped(draw(pack, plate.mirror(camera), 160, 120));
    EXPECT_LT(share_off(direct, seen, 3), 0.003) << kind.name;
    EXPECT_EQ(seen.stats.mirrored_glass, 1u) << kind.name;
  }
}

// One that shows a part of what the eye before sees: the reflector's image is smaller than the frame, and lies aside.
TEST_F(GlassMirrorTest, IsTheSameInASmallMirror) {
  const Camera camera = glass_camera({1.2f, 0.7f, 1.5f}, Vec3(0), 0.7f);
  const Plate plate{{0.93f, 0.57f, 1.2f}, {0, 0, -1}, 0.07f};
  const auto within = [&](int column, int row) {
    const Vec3 d = pixel_ray(camera, 4 * column + 2, 4 * row + 2, 160, 120);
    const Vec3 at = camera.eye + d * ((plate.middle.z - camera.eye.z) / d.z) - plate.middle;
    return std::max(std::fabs(at.x), std::fabs(at.y)) < 0.85f * plate.half;
  };
  for (const Kind& kind : kKinds) {
    Pack pack = room_with(kind);
    plate.add(pack, add_silver(pack));
    const Picture direct = draw(pack, camera, 160, 120);
    const Picture seen = flipped(draw(pack, plate.mirror(camera), 160, 120));
    int off = 0, all = 0;
    for (int row = 0; row < 30; ++row)
      for (int column = 0; column < 40; ++column) {
        if (!within(column, row)) continue;
        off += max_component(glm::abs(mean_at(direct, column, row) - mean_at(seen, column, row))) > 3;
        ++all;
      }
    EXPECT_GT(all, 60);
    EXPECT_LT(off, all / 20) << kind.name << " of " << all;
    EXPECT_EQ(seen.stats.mirrored_glass, 1u) << kind.name;
  }
}

// Two mirrors turn nothing round.
TEST_F(GlassMirrorTest, IsAsSeenFromBehindTwoMirrors) {
  const Camera camera = glass_camera({1.2f, 0.2f, 1.5f}, Vec3(0), 0.4f);
  const Plate first{{0.9f, 0.1f, 1.2f}, {0, 0, -1}, 0.5f};
  const Camera before = first.mirror(camera);
  const Plate second{before.eye + 0.12f * before.forward, glm::normalize(before.forward - Vec3(0, -1, 0)), 0.06f};
  for (const Kind& kind : kKinds) {
    Pack pack = room_with(kind);
    const std::uint32_t silver = add_silver(pack);
    first.add(pack, silver), second.add(pack, silver);
    const Picture direct = draw(pack, camera, 160, 120);
    const Picture seen = draw(pack, second.mirror(before), 160, 120);
    EXPECT_LT(share_off(direct, seen, 6), 0.003) << kind.name;
    EXPECT_GE(seen.stats.mirrored_glass, 1u) << kind.name;
  }
}

TEST_F(GlassMirrorTest, FrostedPanesBlurByTheDistanceBehind) {
  constexpr float kRoughness = 0.35f;
  const float slopes = slope_width(kRoughness * kRoughness, [](const auto& facet) {
    const Vec3 mirrored = glm::reflect(Vec3(0, 0, -1), facet());
    return Vec3(mirrored.x, mirrored.y, -mirrored.z);
  });
  const Plate plate{{0, 0, 0.8f}, {0, 0, -1}, 1};
  for (const float behind : {0.1f, 0.4f}) {
    Pack pack = glass_pack(1.5f, kRoughness);
    pack.solids.clear();
    pack.materials[0].double_sided = true;
    testing::add_quad(pack, {-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, 0, -1);
    add_boards(pack, -behind);
    plate.add(pack, add_silver(pack));
    const Camera camera = plate.mirror(glass_camera({0, 0, 1}, Vec3(0), kBoardsFov));
    const float found = edge_width(flipped(draw(pack, camera, kBoardsSize, kBoardsSize)), kBoardsSize);
    const float blur = pixels_of(slopes, behind);
    EXPECT_NEAR(found, std::sqrt(blur * blur + 4), 0.15f * blur + 1) << behind << " m behind, alone " << blur;
  }
}

// All that shines is as bright, and what glass shows of the mirror, which is the last part, too. It has a lobe of 0.1.
void make_even(Pack& pack, float cd_m2, bool glossy) {
  for (Material& m : pack.materials)
    if (m.emission != Vec3(0)) m.emission = Vec3(cd_m2);
  pack.lightmaps.push_back(flat_page(Vec3(cd_m2 * kPi)));
  pack.mesh.parts.back().lightmap_page = 0;
  if (!glossy) return;
  BrdfKernel kernel;
  kernel.alpha = 0.1f;
  kernel.size = 9, kernel.half_extent = 0.3f;
  kernel.weights.assign(81, 1.0f / 81);
  pack.kernels.push_back(kernel);
  pack.materials[pack.mesh.parts.back().material].kernel = 0;
}

// What mirrors and glossy reflectors show of glass that neither reflects nor absorbs, in an even light, is that light.
TEST_F(GlassMirrorTest, IsNotSeenInAnEvenLight) {
  for (const bool glossy : {false, true})
    for (const Kind& kind : kKinds) {
      Pack pack = room_with(kind);
      if (!pack.solids.empty()) pack.solids[0].absorption = Vec3(0);
      const Plate plate{{0.8f, 0.4f, 1.2f}, {0, 0, -1}, 1.15f};
      plate.add(pack, add_silver(pack));
      make_even(pack, 80, glossy);
      const Camera camera = plate.mirror(glass_camera({1.2f, 0.7f, 1.5f}, Vec3(0), 0.5f));
      const Picture picture = draw(pack, camera, 64, 48);
      EXPECT_EQ(picture.stats.mirrored_glass, 1u);
      int off = 0;
      for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) off += max_component(glm::abs(picture.at(x, y) - 80.0f)) > 2;
      EXPECT_EQ(off, 0) << kind.name << (glossy ? " in a glossy reflector" : "");
    }
}

// A lobe blurs a frosted pane by how far away that is, as a board that shines like it.
TEST_F(GlassMirrorTest, GlossyReflectorsShowFrostedPanesWhereTheyAre) {
  Picture pictures[2];
  for (const bool board : {false, true}) {
    Pack pack = room_with(kKinds[4]);
    pack.materials[0].base_color = Vec3(0.2f);
    if (board) pack.materials[0].transmission = 0, pack.materials[0].emission = Vec3(1);
    const Plate plate{{0, 0, 0.3f}, {0, 0, -1}, 1.15f};
    plate.add(pack, add_silver(pack));
    make_even(pack, 80, true);
    if (board) pack.materials[0].base_color = Vec3(0), pack.materials[0].emission = Vec3(16);
    pictures[board] = draw(pack, plate.mirror(glass_camera({0, 0, 0.55f}, Vec3(0), 1.6f)), 160, 120);
  }
  EXPECT_EQ(pictures[0].stats.mirrored_glass, 1u);
  EXPECT_LT(share_off(pictures[0], pictures[1], 2), 0.01);
  EXPECT_NEAR(pictures[1].at(80, 60).x, 16, 1);
}

// Light of pixels, and draws, are the same to the last bit with glass that no mirror shows, and without.
TEST_F(GlassMirrorTest, CostsNothingWhereNoneIsSeen) {
  const Plate plate{{0, 0, 1}, {0, 0, -1}, 0.8f};
  const Camera camera = glass_camera({0.1f, 0.2f, -0.5f}, {0, 0, 1}, 1);
  Pack pack = glass_pack(1.5f, 0);
  add_room(pack, 3);
  plate.add(pack, add_silver(pack));
  Pack with = pack;
  add_box(with, {-2.9f, -0.5f, 0.3f}, {-2.5f, 0.5f, 0.7f});
  const Picture without_glass = draw(pack, camera, 64, 48), picture = draw(with, camera, 64, 48);
  EXPECT_EQ(picture.rgb, without_glass.rgb);
  EXPECT_EQ(picture.stats.draws, without_glass.stats.draws);
  EXPECT_EQ(picture.stats.mirrored_glass, 0u);
  EXPECT_EQ(picture.stats.reflectors, 1u);
}

// A frame depends on nothing that was drawn before.
TEST_F(GlassMirrorTest, IsTheSameAfterOtherFrames) {
  Pack pack = room_with(kKinds[2]);
  const Plate plate{{0.8f, 0.4f, 1.2f}, {0, 0, -1}, 1.15f};
  plate.add(pack, add_silver(pack));
  const Camera camera = plate.mirror(glass_camera({1.2f, 0.7f, 1.5f}, Vec3(0), 0.7f));
  const Picture first = draw(pack, camera, 101, 77);
  for (const int width : {33, 250, 64})
    draw(pack, plate.mirror(glass_camera({0.9f, 0.1f, 1.6f}, {0.1f, 0, 0}, 1)), width, 90);
  EXPECT_EQ(draw(pack, camera, 101, 77).rgb, first.rgb);
}

// Of a picture of 1280 x 720, glass that covers about 10 x 10 pixels is a pane as before; likewise after two mirrors.
TEST_F(GlassMirrorTest, IsThinWhereLittleIsSeenOfIt) {
  Pack pack = glass_pack(1.5f, 0);
  add_room(pack, 3);
  add_box(pack, Vec3(-0.02f), Vec3(0.02f));
  const Plate plate{{0, 0, 1}, {0, 0, -1}, 0.8f};
  plate.add(pack, add_silver(pack));
  const Camera camera = plate.mirror(glass_camera({0, 0, 2.9f}, Vec3(0), 1));
  EXPECT_EQ(draw(pack, camera, 128, 72).stats.mirrored_glass, 0u);
}

TEST_F(GlassMirrorTest, NoFrameDrawsItAfterManyMirrors) {
  Pack pack = glass_pack(1.5f, 0);
  add_room(pack, 3);
  add_box(pack, {-0.3f, -0.3f, -0.1f}, {0.3f, 0.3f, 0.1f});
  const std::uint32_t silver = add_silver(pack);
  Plate{{0, 0, -1}, {0, 0, 1}, 1}.add(pack, silver);
  Plate{{0, 0, 1}, {0, 0, -1}, 1}.add(pack, silver);
  FrameOptions options;
  const Camera camera = glass_camera({0.5f, 0.4f, 0}, {0.3f, 0.2f, 1}, 1);
  std::vector<std::uint32_t> drawn;
  for (const int orders : {1, 2, 3, 6}) {
    options.orders = orders;
    const Picture picture = draw(pack, camera, 96, 72, options);
    EXPECT_TRUE(picture.finite());
    drawn.push_back(picture.stats.mirrored_glass);
  }
  EXPECT_GT(drawn[0], 0u);
  EXPECT_GT(drawn[1], drawn[0]);
  EXPECT_EQ(drawn[2], drawn[1]);
  EXPECT_EQ(drawn[3], drawn[1]);
}

// A body that the mirror's plane cuts, one that the mirror lies in, and an eye in glass before a mirror; orthographic
// ones too.
TEST_F(GlassMirrorTest, IsFiniteWhereMirrorsAndGlassMeet) {
  const Camera cameras[] = {glass_camera({0.1f, 0.2f, -1.4f}, {0, 0, 1}, 1),
                            glass_camera({0.1f, 0.1f, 0}, {0, 0.1f, 1}, 1.2f),
                            glass_camera({0.3f, 0.2f, 0.99f}, {0, 0, 1}, 1)};
  for (const Kind& kind : kKinds)
    for (const float at : {-0.3f, 0.4f}) {
      Pack pack = room_with(kind);
      const std::uint32_t silver = add_silver(pack);
      Plate{{0, 0, at}, {0, 0, -1}, 0.9f}.add(pack, silver);
      Plate{{0, 0, -1.9f}, {0, 0, 1}, 0.9f}.add(pack, silver);
      for (Camera camera : cameras)
        for (const float half_height : {0.0f, 1.0f}) {
          if (half_height > 0) camera.vertical_fov_rad = 0, camera.half_height = half_height;
          EXPECT_TRUE(draw(pack, camera, 48, 36).finite()) << kind.name << " mirror at " << at;
        }
    }
}

}  // namespace
}  // namespace oriel
