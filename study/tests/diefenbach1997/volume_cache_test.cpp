// Shadow volumes that are kept: what is built anew after what moved; and scenes that nobody made for them.
#include "study/diefenbach1997/volume_cache.h"

#include "study/tests/diefenbach1997/passes_fixture.h"
#include "tests/player/mover_fixture.h"

namespace oriel::study {
namespace {
using namespace oriel::testing;

FrameOptions in_cached_passes() {
  FrameOptions options;
  options.mover_lights = MoverLights::kHarmonics;
  options.shade.lights = 0;
  return options;
}

// A floor and a sheet over it, two lamps, a mover.
Pack kept_scene() {
  Pack pack = shadow_scene();
  pack.lightmaps[0] = flat_page(Vec3(0));
  pack.mesh.parts[0].name = "floor";
  add_quad(pack, {1, -1, 1}, {1, 0, 0}, {0, 0, -1}, 1, 0);
  pack.mesh.parts.back().name = "sheet";
  BrightLight second = pack.light_field.lights[0];
  second.position = {1, 1.5f, 1};
  pack.light_field.lights.push_back(second);
  return pack;
}

std::array<std::uint32_t, 4> built(const VolumeStats& s) {
  return {s.built_new, s.built_for_light, s.built_for_object, s.reused};
}
using Built = std::array<std::uint32_t, 4>;

class VolumesKept : public PassesTest {
 protected:
  void SetUp() override {
    PassesTest::SetUp();
    passes_.emplace(device_.dialect, MultiPassSettings());
  }
  void TearDown() override {
    passes_.reset();
    PassesTest::TearDown();
  }
  VolumeStats next(GpuScene& scene, const FrameOptions& options) {
    const View view = make_view(above_floor(0, 0), 32, 24, scene.bounds());
    const auto stats = renderer_->render(scene, view, options, &*passes_);
    EXPECT_TRUE(stats) << (stats ? "" : stats.error().text());
    return passes_->stats().volumes;
  }
  std::optional<MultiPass> passes_;
};

TEST_F(VolumesKept, AreBuiltAnewForWhatMoved) {
  const auto scene = std::move(*GpuScene::create(kept_scene(), device_));
  FrameOptions options = in_cached_passes();
  const VolumeStats first = next(*scene, options);
  EXPECT_EQ(built(first), (Built{6, 0, 0, 0})) << "three objects, two lamps";
  EXPECT_GT(first.bytes, 0u);
  const VolumeStats second = next(*scene, options);
  EXPECT_EQ(built(second), (Built{0, 0, 0, 6}));
  EXPECT_EQ(second.bytes, first.bytes);
  options.poses.push_back(scene->pack().movers[0].rest);
  options.poses[0].position += DVec3(0.5, 0, 0);
  EXPECT_EQ(built(next(*scene, options)), (Built{0, 0, 2, 4})) << "the mover's alone";
  EXPECT_EQ(built(next(*scene, options)), (Built{0, 0, 0, 6}));
  passes_->settings.points = 8;
  EXPECT_EQ(built(next(*scene, options)), (Built{0, 0, 0, 6})) << "points of lamps that have none";
}

// Of light straight on and by a mirror that moves, what the mirror has a part in is built anew.
TEST_F(VolumesKept, AreBuiltAnewForAMirrorThatMoved) {
  Pack pack = kept_scene();
  Reflector reflector;
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) reflector.indices.push_back(i);
  pack.reflectors.push_back(reflector);
  pack.reflectors[0].upper = Vec2(1);
  const auto scene = std::move(*GpuScene::create(pack, device_));
  const FrameOptions options = in_cached_passes();
  next(*scene, options);  // leaves a frame to draw into
  FrameStats stats;
  const View view = make_view(above_floor(0, 0), 32, 24, scene->bounds());
  const FrameContext context{*scene, view, options, stats};
  VolumeCache cache = std::move(*VolumeCache::create(device_.dialect));
  const std::vector<LightSource> sources = sources_of(scene->bright_lights(), 1, 0);
  std::vector<LightMirror> mirrors(1);
  const auto drawn = [&](float wall) {
    mirrors[0].plane = {0, 0, 1, wall};
    cache.begin(context, {}, mirrors);
    for (const LightPath& path : {LightPath{0, {}}, LightPath{0, {0}}}) {
      const std::vector<PathLeg> legs = legs_of(path, sources, mirrors);
      for (std::size_t i = 0; i < legs.size(); ++i) cache.draw({path, i, legs[i]}, view, 0x3f, stats);
    }
    return built(cache.stats());
  };
  EXPECT_EQ(drawn(5), (Built{4, 0, 0, 2})) << "two objects; the first stretch is the light's own";
  EXPECT_EQ(drawn(5), (Built{0, 0, 0, 6}));
  EXPECT_EQ(drawn(4.5f), (Built{0, 2, 0, 4})) << "its image of the lamp has moved";
  EXPECT_EQ(drawn(3), (Built{2, 1, 0, 3})) << "it cuts the floor, of which a part before it throws shadows";
}

// The mover's shadow follows it.
TEST_F(VolumesKept, AreWhereTheMoverIs) {
  Pack pack = kept_scene();
  pack.light_field.lights.resize(1);
  const auto lit = [&](double x) {
    pack.movers[0].rest.position.x = x;
    return draw(pack, above_floor(0.5f, 0), 9, 9, {}, in_cached_passes()).at(4, 4).x;
  };
  EXPECT_EQ(lit(0), 0);
  EXPECT_GT(lit(3), 1);
}

// What is not asked for costs nothing and changes nothing; nor do lamps that are not there.
TEST_F(VolumesKept, WithoutLampsTheFrameIsTheSame) {
  Pack pack = kept_scene();
  pack.lightmaps[0] = flat_page(Vec3(70));
  pack.light_field.lights.clear();
  for (LightProbe& probe : pack.light_field.probes) probe.bright = 0;
  const Picture without = FrameTest::draw(pack, above_floor(0, 0), 33, 25, in_cached_passes());
  const PassPicture with = draw(pack, above_floor(0, 0), 33, 25, {}, in_cached_passes());
  EXPECT_EQ(without.rgb, with.rgb);
  EXPECT_EQ(with.passes.light_passes, 0u);
}

// A lamp in the plane of a surface, triangles without area, and no reflector: finite light.
TEST_F(VolumesKept, OddScenesAreDrawn) {
  Pack pack = kept_scene();
  pack.light_field.lights[0].position = {0, -2, 0.3f};     // on the floor
  pack.light_field.lights[1].position = {1.5f, -1, 0.5f};  // on the sheet
  pack.mesh.indices.insert(pack.mesh.indices.end(), {0, 0, 1, 0, 1, 1});
  pack.mesh.parts.back().index_count += 6;
  EXPECT_TRUE(draw(pack, above_floor(0.2f, 0.2f), 33, 25, {}, in_cached_passes()).finite());
}

// More ways than a frame draws: those by fewest mirrors are drawn, and the rest is told.
TEST_F(VolumesKept, ManyLampsAreCutOff) {
  std::vector<BrightLight> lamps(1000);
  for (std::size_t i = 0; i < lamps.size(); ++i)
    lamps[i].intensity = Vec3(1), lamps[i].position = {0, 1, static_cast<float>(i)};
  const std::vector<LightSource> sources = sources_of(lamps, 1, 0);
  ASSERT_EQ(sources.size(), 1000u);
  std::vector<LightMirror> mirrors(1);
  mirrors[0].plane = {0, 1, 0, 0};
  const LightPaths paths = find_light_paths(sources, mirrors, 2);
  EXPECT_EQ(paths.paths.size(), kMostLightPaths);
  EXPECT_EQ(paths.left_out, 2000 - kMostLightPaths);
  EXPECT_TRUE(paths.paths[999].mirrors.empty());
  EXPECT_TRUE(find_light_paths({}, mirrors, 3).paths.empty());
}

// Both triangles of an edge are cut at the same place, to the bit.
TEST(CutTriangles, ShareTheirNewCorners) {
  const std::vector<Vec3> positions{{-1, 0.3f, 0}, {1.7f, -0.2f, 0.1f}, {0, 1, 0}, {0.2f, -1, 0.7f}};
  const std::vector<UVec3> triangles{{0, 1, 2}, {1, 0, 3}};
  const std::vector<Vec4> planes{{1, 0.1f, 0.2f, -0.13f}};
  const CutTriangles cut = cut_triangles(positions, triangles, planes);
  EXPECT_GT(ShadowMesh(cut.positions, cut.triangles).whole_volumes({0.5f, 0.2f, 9, 1}).sides, 0u);
  for (const Vec3& p : cut.positions) EXPECT_GT(glm::dot(planes[0], Vec4(p, 1)), -1e-6f);
  std::size_t shared = 0;
  for (std::size_t i = 0; i < cut.positions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) shared += cut.positions[i] == cut.positions[j];
  EXPECT_EQ(shared, 2u) << "the corner before the plane and the new one";
  EXPECT_TRUE(cut_triangles(positions, triangles, std::vector<Vec4>{{0, 0, 1, -5}}).triangles.empty());
}

}  // namespace
}  // namespace oriel::study
