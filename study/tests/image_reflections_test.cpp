// Reflections by points, a kernel and a sphere map: a mirror at z = 0 before a wall at z = 3 with a red square on it.
#include "formats/query/camera.h"
#include "study/bastos1999/reflections.h"
#include "study/rooms.h"
#include "tests/player/frame_fixture.h"

namespace oriel::study {
namespace {
using namespace oriel::testing;

constexpr float kWall = 3;
const Vec3 kRed(40, 2, 2), kGrey(10, 10, 10);

bool in_square(const Vec2& p) {
  return p.x > -0.2f && p.x < 0.6f && p.y > -0.3f && p.y < 0.5f;
}

Seen wall(const Vec2& on_plane, const Vec3& direction) {
  return {in_square(on_plane + Vec2(direction) * (kWall / direction.z)) ? kRed : kGrey, kWall};
}

// The mirror of add_mirror, whose maps the pack does not have.
BakedMethod baked_mirror(const std::function<Seen(const Vec2&, const Vec3&)>& seen = wall,
                         const std::vector<Vec3>& eyes = {
                             {0, 0, -1}, {0.5f, 0, -1}, {-0.5f, 0, -1}, {0, 0.5f, -1}, {0, -0.5f, -1}}) {
  BakedMethod out;
  out.pack.materials.resize(1);
  out.pack.materials[0].metallic = 1;
  out.pack.materials[0].roughness = 0;
  out.pack.materials[0].fresnel_map = 0;
  out.pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.5f)));
  add_mirror(out.pack, eyes, 128, seen);
  Reflector& reflector = out.pack.reflectors[0];
  out.maps = std::move(out.pack.radiance_maps);
  BakedReflector one{
      group_by_element(reflector, out.maps), 3, {}, make_sphere_map(16, [](double) { return Vec3(0.5f, 0.5f, 1); })};
  one.kernel.weights = {1};
  out.reflectors.push_back(std::move(one));
  reflector.first_map = reflector.map_count = reflector.elements_x = reflector.elements_y = 0;
  out.pack.radiance_maps.clear();
  return out;
}

void add_study_shaders() {
  static const bool added = [] {
    gpu::add_shader_sources(shader_sources());
    return true;
  }();
  ASSERT_TRUE(added);
}

TEST(ImageMethodShaders, CompileInBothDialects) {
  add_study_shaders();
  for (const gpu::Dialect dialect : {gpu::Dialect::kDesktop330, gpu::Dialect::kEs300}) {
    const auto context = gpu::HeadlessContext::create(dialect);
    ASSERT_TRUE(context) << context.error().text();
    for (const char* name : {"bastos1999_points", "screen_bastos1999_kernel", "bastos1999_compose"}) {
      const auto program = gpu::Program::create(name, dialect);
      EXPECT_TRUE(program) << program.error().text();
    }
  }
}

class ImageMethod : public FrameTest {
 protected:
  void SetUp() override {
    add_study_shaders();
    FrameTest::SetUp();
  }
  Picture draw_method(const BakedMethod& baked, const Camera& camera, const IVec2& size, FrameOptions options = {},
                      int cells = 16) {
    auto scene = GpuScene::create(baked.pack, device_);
    auto extension = ImageReflections::create(device_, baked, cells);
    EXPECT_TRUE(scene && extension);
    if (!scene || !extension) return {};
    const View view = make_view(camera, size.x, size.y, (*scene)->bounds());
    const auto stats = renderer_->render(**scene, view, options, extension->get());
    EXPECT_TRUE(stats) << (stats ? "" : stats.error().text());
    return stats ? Picture{size.x, size.y, renderer_->read_light(), *stats} : Picture{};
  }
};

Camera camera_to_mirror(const Vec3& eye) {
  return look_at(eye, Vec3(0), 1.4f);
}

// Where a pixel's ray meets the mirror, and the wall behind it.
struct Way {
  Vec2 on_mirror{9}, on_wall{0};
  Vec3 direction{0};
};
Way way_of(const Camera& camera, int x, int y, const IVec2& size) {
  const View view = make_view(camera, size.x, size.y, {});
  const Vec2 ndc((static_cast<float>(x) + 0.5f) / static_cast<float>(size.x) * 2 - 1,
                 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(size.y) * 2);
  Way out;
  out.direction = glm::normalize(glm::transpose(Mat3(view.view_from_pack)) * Vec3(ndc * view.tangents, -1));
  if (out.direction.z >= 0) return out;
  out.on_mirror = Vec2(camera.eye) + Vec2(out.direction) * (camera.eye.z / -out.direction.z);
  out.on_wall = out.on_mirror + Vec2(out.direction) * (kWall / -out.direction.z);
  return out;
}

// Boxes cover up to two of a map's pixels where they are turned, each 0.0625 m of the wall. Where no map's frustum
// reaches it is black, but not for an eye opposite a map's.
TEST_F(ImageMethod, PointsAreWhereGeometrySays) {
  const BakedMethod baked = baked_mirror();
  for (const Vec3& eye :
       {Vec3(0, 0, 1), Vec3(0.5f, 0.3f, 1.5f), Vec3(-0.8f, -0.4f, 0.7f), Vec3(0.01f, 0, 0.05f), Vec3(0, 0, 2.9f)}) {
    const Camera camera = camera_to_mirror(eye);
    const IVec2 size(160, 120);
    const Picture p = draw_method(baked, camera, size);
    ASSERT_TRUE(p.finite());
    EXPECT_EQ(p.stats.reflectors, 1u);
    EXPECT_EQ(p.stats.maps, 2u);
    int red = 0, wrong = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const Way way = way_of(camera, x, y, size);
        if (std::max(std::fabs(way.on_mirror.x), std::fabs(way.on_mirror.y)) > 0.99f) continue;
        constexpr float kMargin = 0.125f;
        const bool is_red = in_square(way.on_wall);
        bool sure = true;
        for (const Vec2& off : {Vec2(1, 1), Vec2(-1, 1), Vec2(1, -1), Vec2(-1, -1)})
          sure = sure && in_square(way.on_wall + kMargin * off) == is_red;
        if (!sure) continue;
        red += is_red;
        if (eye != Vec3(0, 0, 1) && p.at(x, y) == Vec3(0)) continue;
        wrong += glm::length(p.at(x, y) / Vec3(0.5f, 0.5f, 1) - (is_red ? kRed : kGrey)) > 1e-3f;
      }
    EXPECT_GT(red, 40) << eye.x << " " << eye.y << " " << eye.z;
    EXPECT_EQ(wrong, 0) << eye.x << " " << eye.y << " " << eye.z;
  }
}

TEST_F(ImageMethod, StagesAreShownAlone) {
  const BakedMethod baked = baked_mirror([](const Vec2&, const Vec3&) { return Seen{kGrey, kWall}; });
  const Camera camera = camera_to_mirror({0.2f, 0.1f, 1.2f});
  for (const auto& [show, r] :
       {std::pair{Show::kMKR, Vec3(0.5f, 0.5f, 1)}, {Show::kM, Vec3(1)}, {Show::kMK, Vec3(1)}}) {
    FrameOptions options;
    options.show = show;
    EXPECT_NEAR(glm::length(draw_method(baked, camera, {80, 60}, options).at(40, 30) - kGrey * r), 0, 1e-3f);
  }
}

// What no map tells of stays black, and a kernel for all of the image reaches over its edge.
TEST_F(ImageMethod, HolesStayBlackAndAreCounted) {
  BakedMethod half = baked_mirror([](const Vec2&, const Vec3&) { return Seen{Vec3(10), 3}; }, {{0, 0, -1}});
  RadianceMap& map = half.maps[0];
  for (std::uint32_t i = 0; i < map.width * map.height; ++i) map.valid[i] = i % map.width >= map.width / 2;
  const Camera camera{.name = "", .eye = {0, 0, 1}, .forward = {0, 0, -1}, .up = {0, 1, 0}, .vertical_fov_rad = 2.2f};
  FrameOptions options;
  options.show = Show::kMK;
  options.count_holes = true;
  const Picture sharp = draw_method(half, camera, {120, 90}, options);
  EXPECT_EQ(sharp.at(50, 45).x, 0);
  EXPECT_NEAR(sharp.at(70, 45).x, 10, 0.01);
  EXPECT_NEAR(static_cast<double>(sharp.stats.holes) / static_cast<double>(sharp.stats.reflected_pixels), 0.5, 0.03);
  BrdfKernel& kernel = half.reflectors[0].kernel;
  kernel.size = 3;
  kernel.weights.assign(9, 1.0f / 9);
  kernel.half_extent = 0.2f;
  const Picture blurred = draw_method(half, camera, {120, 90}, options);
  EXPECT_EQ(blurred.at(50, 45).x, 0);
  EXPECT_GT(blurred.at(59, 45).x, 1);
  EXPECT_LT(blurred.at(59, 45).x, 9);
  EXPECT_NEAR(blurred.at(70, 45).x, 10, 0.01);
}

// What touches the mirror is blurred as much as what is far away.
TEST_F(ImageMethod, OneKernelBlursAllAlike) {
  BakedMethod baked = baked_mirror(wall, {{0, 0, -1}});
  RadianceMap& map = baked.maps[0];
  for (std::uint32_t i = 0; i < map.width * map.height; ++i) {
    map.radiance[i] = i % map.width < map.width / 2 ? Vec3(40) : Vec3(0);
    map.disparity[i] = i / map.width < map.height / 2 ? 0.999f : 0.1f;  // below, on the mirror; above, far away
  }
  BrdfKernel& kernel = baked.reflectors[0].kernel;
  kernel.size = 9;
  kernel.half_extent = 0.4f;
  kernel.weights.assign(81, 1.0f / 81);
  FrameOptions options;
  options.show = Show::kMK;
  const Picture p = draw_method(baked, camera_to_mirror({0, 0, 1}), {160, 120}, options);
  const auto rise = [&](int y) {  // pixels over which the edge goes from a tenth to nine
    int between = 0;
    for (int x = 40; x < 120; ++x) between += p.at(x, y).x > 4 && p.at(x, y).x < 36;
    return between;
  };
  EXPECT_GT(rise(40), 4);
  EXPECT_NEAR(rise(40), rise(95), 4);
}

// From a coin to a kilometre, from straight before to edge-on: no number that is none.
TEST_F(ImageMethod, EverySizeAndAngleIsFinite) {
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    BakedMethod baked = baked_mirror();
    for (Vec3& p : baked.pack.mesh.positions) p *= scale;
    Reflector& r = baked.pack.reflectors[0];
    r.lower *= scale, r.upper *= scale;
    for (RadianceMap& map : baked.maps) map.eye *= scale, map.lower *= scale, map.upper *= scale;
    for (ReflectorElement& e : baked.reflectors[0].elements) e.lower *= scale, e.upper *= scale;
    for (const Vec3& eye : {Vec3(0, 0, 1), Vec3(3, 0, 1e-3f), Vec3(3, 0, 1e-6f), Vec3(0, 0, 0), Vec3(0.2f, 0, -1),
                            Vec3(0, 0, 3000), Vec3(900, 0, 1)}) {
      const Camera camera = look_at(eye * scale, {0.01f * scale, 0, 0}, 1.2f);
      EXPECT_TRUE(draw_method(baked, camera, {48, 32}).finite()) << scale << " " << eye.x << " " << eye.z;
    }
  }
}

// R = cosθ from a sphere map: right at the corners of its cells, so that many cells show it and one does not.
TEST_F(ImageMethod, SphereMapsAreLookedUpAtVertices) {
  BakedMethod baked = baked_mirror([](const Vec2&, const Vec3&) { return Seen{kGrey, kWall}; }, {{0.2f, 0.1f, -0.5f}});
  baked.reflectors[0].sphere = make_sphere_map(128, [](double c) { return Vec3(static_cast<float>(c)); });
  const Camera camera = camera_to_mirror({0.2f, 0.1f, 0.5f});
  const IVec2 size(80, 60);
  const auto worst = [&](int cells) {
    FrameOptions options;
    options.show = Show::kMKR;
    const Picture p = draw_method(baked, camera, size, options, cells);
    float error = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const Way way = way_of(camera, x, y, size);
        if (std::max(std::fabs(way.on_mirror.x), std::fabs(way.on_mirror.y)) > 0.99f) continue;
        if (p.at(x, y) == Vec3(0)) continue;  // between points
        error = std::max(error, std::fabs(p.at(x, y).x / kGrey.x + way.direction.z));
      }
    return error;
  };
  EXPECT_LT(worst(64), 0.02f);
  EXPECT_LT(worst(16), 0.04f);
  EXPECT_GT(worst(1), 0.2f);
}

}  // namespace
}  // namespace oriel::study
