// Charts laid flat: against what can be said exactly, and on shapes that are hard to lay flat.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bake/atlas/congruent.h"
#include "bake/atlas/flatten.h"
#include "bake/atlas/lscm.h"
#include "bake/atlas/surface_mesh.h"
#include "tests/bake/atlas/checks.h"
#include "tests/bake/atlas/shapes.h"

namespace oriel {
namespace {

using ::testing::HasSubstr;

struct Whole {
  Patch patch;
  std::vector<Triangle3> corners;
};

// A surface as one patch.
Whole whole(const Scene& scene, const Surface& surface) {
  Whole out;
  const auto across = edges_across(build_surface_mesh(scene, surface));
  std::vector<std::uint32_t> faces(surface.triangle_count), slot(surface.triangle_count);
  for (std::uint32_t i = 0; i < faces.size(); ++i) faces[i] = i;
  out.patch = make_patch(std::move(faces), across, slot, [](std::uint32_t) { return true; });
  for (std::uint32_t t = 0; t < surface.triangle_count; ++t) {
    const UVec3 v = scene.triangles[surface.first_triangle + t];
    out.corners.push_back({DVec3(scene.positions[v.x]), DVec3(scene.positions[v.y]), DVec3(scene.positions[v.z])});
  }
  return out;
}

// Rows × columns of quads; at(s, t) with s and t in [0, 1] is a point, front along ds × dt.
template <class At>
Surface& add_sheet(Scene& scene, std::uint32_t columns, std::uint32_t rows, const At& at) {
  std::vector<Vec3> p;
  std::vector<UVec3> t;
  for (std::uint32_t r = 0; r <= rows; ++r)
    for (std::uint32_t c = 0; c <= columns; ++c)
      p.push_back(Vec3(at(static_cast<double>(c) / columns, static_cast<double>(r) / rows)));
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t a = r * (columns + 1) + c, b = a + columns + 1;
      t.push_back({a, a + 1, b + 1});
      if (p[b] != p[b + 1]) t.push_back({a, b + 1, b});  // else a point, as a cone's
    }
  return shapes::add(scene, "sheet", p, t);
}

DVec3 on_sphere(double longitude, double latitude) {
  return {std::cos(latitude) * std::sin(longitude), std::sin(latitude), std::cos(latitude) * std::cos(longitude)};
}

StretchSum stretch_of(const Whole& w, const std::vector<Triangle2>& points) {
  StretchSum sum;
  for (std::size_t i = 0; i < points.size(); ++i) sum.add(w.corners[i], points[i]);
  return sum;
}

TEST(Stretch, OfKnownMaps) {
  const Triangle3 surface{DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0)};
  const auto measured = [&](const DVec2& x, const DVec2& y) {
    StretchSum sum;
    sum.add(surface, {DVec2(0), x, y});
    return sum;
  };
  for (const StretchSum& s : {measured({1, 0}, {0, 1}), measured({0, 3}, {-3, 0}), measured({1, 0}, {0, -1})}) {
    EXPECT_NEAR(s.l2(), 1, 1e-12);  // turned, enlarged, mirrored
    EXPECT_NEAR(s.linf(), 1, 1e-12);
    EXPECT_NEAR(s.angle(), 1, 1e-12);
  }
  const StretchSum wide = measured({2, 0}, {0, 1});  // Γ = 1, γ = 1/2, at the scale that keeps the area √2 and 1/√2
  EXPECT_NEAR(wide.l2(), std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(wide.linf(), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(wide.angle(), 1.25, 1e-12);
  EXPECT_NEAR(wide.area(), 1, 1e-12);
  StretchSum uneven = measured({1, 0}, {0, 1});
  uneven.add(surface, {DVec2(0), DVec2(2, 0), DVec2(0, 2)});
  EXPECT_NEAR(uneven.angle(), 1, 1e-12);
  EXPECT_NEAR(uneven.area(), 0.5 * (1 + 0.5 * (1 + 0.25) * 2.5), 1e-12);
  EXPECT_EQ(measured({1, 0}, {2, 0}).l2(), std::numeric_limits<double>::infinity());
}

TEST(Lscm, UnrollsWhatCanBeUnrolled) {
  Scene scene = shapes::empty_scene();
  // Faceted, both are unrolled exactly: three quarters of a cylinder, half of a cone.
  const Surface cylinder =
      add_sheet(scene, 24, 5, [](double s, double t) { return DVec3(std::sin(4.5 * s), 2 * t, std::cos(4.5 * s)); });
  const Surface cone = add_sheet(
      scene, 24, 5, [](double s, double t) { return DVec3((2 - t) * std::sin(3 * s), t, (2 - t) * std::cos(3 * s)); });
  for (const Surface& surface : {cylinder, cone}) {
    const Whole w = whole(scene, surface);
    const StretchSum sum = stretch_of(w, least_squares_conformal(w.patch, w.corners));
    EXPECT_NEAR(sum.l2(), 1, 1e-5);
    EXPECT_NEAR(sum.linf(), 1, 1e-4);
  }
}

TEST(Lscm, KeepsTheAnglesOfASphere) {
  Scene scene = shapes::empty_scene();
  const Surface patch =
      add_sheet(scene, 40, 40, [](double s, double t) { return on_sphere(2 * s - 1, 1.6 * t - 0.8); });
  const Whole w = whole(scene, patch);
  const StretchSum sum = stretch_of(w, least_squares_conformal(w.patch, w.corners));
  EXPECT_NEAR(sum.angle(), 1, 1e-3);
  EXPECT_GT(sum.area(), 1.005);  // no map of a sphere keeps both
}

TEST(Flatten, RefusesWhatWouldOverlap) {
  Scene scene = shapes::empty_scene();
  const Surface& ramp = shapes::add_spiral(scene, "ramp", 1, 3, 2, 32);
  const Whole w = whole(scene, ramp);
  EXPECT_FALSE(flatten(w.patch, w.corners, {0.1, 1.1, 2}).has_value());
  Scene half = shapes::empty_scene();
  const Surface& turn = shapes::add_spiral(half, "ramp", 1, 3, 1, 32);
  const Whole h = whole(half, turn);
  const auto chart = flatten(h.patch, h.corners, {0.1, 1.1, 2});
  ASSERT_TRUE(chart.has_value());
  EXPECT_FALSE(find_overlap(chart->points, {1e-6, 1e-6}).has_value());
}

TEST(Patch, FansAndOutline) {
  Scene scene = shapes::empty_scene();
  const Surface& sheet = add_sheet(scene, 3, 2, [](double s, double t) { return DVec3(s, t, 0); });
  const Whole w = whole(scene, sheet);
  EXPECT_EQ(number_vertices(w.patch).count, 12u);
  std::vector<Triangle2> points;
  for (const Triangle3& t : w.corners) points.push_back({DVec2(t[0]), DVec2(t[1]), DVec2(t[2])});
  const auto edges = outline(w.patch, points);
  EXPECT_EQ(edges.size(), 10u);
  EXPECT_TRUE(is_simple_outline(edges));
  std::vector<std::uint32_t> label(w.patch.size());
  for (std::size_t i = 0; i < label.size(); ++i) label[i] = i % 6 / 2 == 1;  // the middle column
  EXPECT_EQ(pieces_by_label(w.patch, label).size(), 3u);
}

// Shapes that are round, twisted, closed on themselves or come to a point.
Scene curved_scene(const std::string& shape) {
  Scene scene = shapes::empty_scene();
  const double turn = 2 * kPiD;
  if (shape == "torus")
    add_sheet(scene, 64, 32, [&](double s, double t) {
      const double r = 2 + 0.7 * std::cos(turn * t);
      return DVec3(r * std::sin(turn * s), 0.7 * std::sin(turn * t), r * std::cos(turn * s));
    });
  if (shape == "moebius")
    add_sheet(scene, 120, 6, [&](double s, double t) {
      const double w = t - 0.5, a = turn * s, r = 2 + w * std::cos(a / 2);
      return DVec3(r * std::sin(a), w * std::sin(a / 2), r * std::cos(a));
    });
  if (shape == "cap") add_sheet(scene, 48, 12, [&](double s, double t) { return on_sphere(turn * s, 0.6 + 0.97 * t); });
  if (shape == "cone")
    add_sheet(scene, 48, 12, [&](double s, double t) {
      return DVec3((1 - t) * std::sin(turn * s), 3 * t, (1 - t) * std::cos(turn * s));
    });
  if (shape == "cylinder") shapes::add_cylinder(scene, shape, 1, 3, 64, 6);
  if (shape == "icosphere") shapes::add_icosphere(scene, shape, 1, 4);
  if (shape == "helix") shapes::add_spiral(scene, shape, 1, 3, 4, 48);
  return scene;
}

class CurvedShapes : public ::testing::TestWithParam<const char*> {};

TEST_P(CurvedShapes, AreSoundInFewCharts) {
  const Scene scene = curved_scene(GetParam());
  for (const float texel : {0.5f, 0.1f, 0.02f}) {
    AtlasOptions options;
    options.texel_m = texel;
    const Built built = build(scene, options);
    expect_sound(scene, built);
    EXPECT_LE(built.atlas.report.l2_stretch, 1.1) << texel;
    EXPECT_LE(built.atlas.report.linf_stretch, 2.5) << texel;
    EXPECT_LE(built.atlas.chart_count, 64u) << texel;
    // Charts of less than a quarter texel are drawn larger, those that turn much within a texel finer.
    const double drawn = fragment_area(built.map) * texel * texel / shapes::area_of(scene);
    if (texel < 0.2f) {
      EXPECT_GE(drawn, 0.99) << texel;
    }
    if (texel < 0.05f) {
      EXPECT_LE(drawn, 1.01) << texel;
    }
  }
}

// Tall columns of few sides: a side is no chart where shading says that it is round. A texel of each side's own would
// show the sides as steps.
TEST(Atlas, SidesOfAColumnAreNoCharts) {
  for (const std::uint32_t sides : {12u, 16u, 24u}) {
    AtlasOptions options;
    options.texel_m = 0.1f;
    Scene round = shapes::empty_scene();
    shapes::add_cylinder(round, "column", 0.2f, 12, sides, 1);
    const Built built = build(round, options);
    expect_sound(round, built);
    EXPECT_LE(built.atlas.chart_count, 6u) << sides;  // with its ends
    EXPECT_LE(built.atlas.report.l2_stretch, 1.1) << sides;
  }
}

// A metre of a moulding that turns by 60 degrees in less than a texel.
TEST(Atlas, AMouldingHasTexelsForTheSidesItTurnsTo) {
  for (const double radius : {0.06, 0.02}) {
    Scene scene = shapes::empty_scene();
    add_sheet(scene, 10, 12, [&](double s, double t) {
      const double angle = t * kPiD / 3;
      return DVec3(s, radius * std::sin(angle), radius * std::cos(angle));
    });
    AtlasOptions options;
    options.texel_m = 0.1f;
    const Built built = build(scene, options);
    ASSERT_EQ(built.atlas.chart_count, 1u);
    Vec2 low(1e9f), high(-1e9f);
    for (const auto& triangle : built.atlas.uv)
      for (const Vec2& uv : triangle) low = glm::min(low, uv), high = glm::max(high, uv);
    const Vec2 texels = (high - low) * Vec2(built.atlas.pages[0].width, built.atlas.pages[0].height);
    EXPECT_NEAR(std::max(texels.x, texels.y), 10, 0.3) << "as asked along it";
    // 30 degrees a texel; straight lines fitted to the normals of facets say a little more or less. The thin one is
    // four times finer than asked and no more.
    const double arc = radius * kPiD / 3 / 0.1;
    EXPECT_NEAR(std::min(texels.x, texels.y), radius > 0.05 ? 2.0 : 4 * arc, 0.15) << radius;
  }
}

INSTANTIATE_TEST_SUITE_P(Atlas, CurvedShapes,
                         ::testing::Values("torus", "moebius", "cap", "cone", "cylinder", "icosphere", "helix"),
                         [](const auto& test) { return std::string(test.param); });

TEST(AtlasQuality, FillAndStretchOfASphereOnOnePage) {
  Scene scene = shapes::empty_scene();
  shapes::add_icosphere(scene, "sphere", 1, 5);
  AtlasOptions options;
  options.resolution = 512;
  const Built built = build(scene, options);
  expect_sound(scene, built);
  EXPECT_GT(built.atlas.covered_share, 0.7);
  EXPECT_LT(built.atlas.report.l2_stretch, 1.02);
  EXPECT_LE(built.atlas.chart_count, 32u);
}

// Copies of a mesh share their charts, wherever they stand; what is scaled or folded otherwise has its own.
TEST(AtlasInstances, HaveTheChartsOfTheFirst) {
  Scene scene = shapes::empty_scene();
  for (const float radius : {1.0f, 1.0f, 2.0f, 1.0f}) shapes::add_icosphere(scene, "sphere", radius, 3);
  for (Surface& surface : scene.surfaces) surface.mesh_name = "sphere";
  for (std::uint32_t s = 1; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    for (std::uint32_t v = surface.first_vertex; v < surface.first_vertex + surface.vertex_count; ++v) {
      Vec3& p = scene.positions[v];
      Vec3& n = scene.normals[v];
      p = Vec3(p.z, 0.8f * p.y - 0.6f * p.x, -0.6f * p.y - 0.8f * p.x);
      n = Vec3(n.z, 0.8f * n.y - 0.6f * n.x, -0.6f * n.y - 0.8f * n.x);
      if (s == 3) p.y = std::abs(p.y);
      p += Vec3(5.0f * static_cast<float>(s), 1, 0);
    }
  }
  scene.face_normals.clear();
  keep_face_normals(scene);
  const std::vector<std::uint32_t> all{0, 1, 2, 3};
  EXPECT_EQ(first_congruent(scene, all, nullptr), (std::vector<std::uint32_t>{0, 0, 2, 3}));
  scene.surfaces[1].material = scene.surfaces[0].material;
  const Built built = build(scene);
  expect_sound(scene, built);
}

TEST(AtlasLimits, TimeLimitStillGivesASoundAtlas) {
  Scene scene = shapes::empty_scene();
  shapes::add_icosphere(scene, "sphere", 1, 5);
  shapes::add_spiral(scene, "ramp", 1, 3, 4, 48);
  AtlasOptions options;
  options.time_limit_s = 1e-9;
  const Built built = build(scene, options);
  expect_sound(scene, built);
  EXPECT_TRUE(built.atlas.report.time_limit_struck);
  ASSERT_EQ(built.warnings.size(), 1u);
  EXPECT_THAT(built.warnings[0], HasSubstr("another run may give others"));
  options.time_limit_s = 1e6;
  EXPECT_FALSE(build(scene, options).atlas.report.time_limit_struck);
}

TEST(AtlasLimits, MemorySaysWhichTexelFits) {
  Scene scene = shapes::empty_scene();
  shapes::add_box(scene, "room", Vec3(0), Vec3(6, 3, 5));
  AtlasOptions options;
  options.texel_m = 0.01f;  // 126 m²: 1.26 million texels
  options.memory_bytes = 4 << 20;
  const Error error = build_error(scene, options);
  EXPECT_EQ(error.code, ErrorCode::kRuntime);
  EXPECT_THAT(error.text(), HasSubstr("limit of 4.0 MiB"));
  const std::string text = error.text();
  const std::size_t at = text.find("--texel ");
  ASSERT_NE(at, std::string::npos) << text;
  options.texel_m = std::stof(text.substr(at + 8));
  EXPECT_LT(options.texel_m, 0.25f);  // about 5000 texels
  expect_sound(scene, build(scene, options));
}

}  // namespace
}  // namespace oriel
