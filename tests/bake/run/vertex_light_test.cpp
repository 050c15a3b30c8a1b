// Diffuse light as vertex colours: where a mesh is divided, and where that ends.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <map>
#include <set>

#include "bake/run/vertex_light.h"
#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/pack/reader.h"
#include "formats/pack/validate.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

constexpr std::uint32_t kTexels = 64;  // a side of a page
constexpr float kSide_m = 2;

// Texel centres are at whole numbers of x and y.
LightmapPage page_of(const std::function<float(float x, float y)>& light) {
  LightmapPage page;
  page.width = page.height = kTexels;
  for (std::uint32_t i = 0; i < kTexels * kTexels; ++i)
    page.irradiance.push_back(Vec3(light(static_cast<float>(i % kTexels), static_cast<float>(i / kTexels))));
  page.standard_error.assign(page.irradiance.size(), Vec3(0));
  page.state.assign(page.irradiance.size(), TexelState::kValid);
  return page;
}

// A square of two triangles over all texel centres of a page, from x on.
void add_square(Mesh& mesh, float x, std::int32_t page) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const float margin = 0.5f / kTexels;
  for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
    mesh.positions.push_back({x + kSide_m * corner.x, kSide_m * corner.y, 0});
    mesh.normals.push_back({0, 0, 1});
    mesh.uvs.push_back(corner);
    mesh.lightmap_uvs.push_back(margin + corner * (1 - 2 * margin));
    mesh.colors.push_back(0xff8040ffu);
  }
  MeshPart part;
  part.first_index = static_cast<std::uint32_t>(mesh.indices.size());
  part.index_count = 6;
  part.lightmap_page = page;
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
  mesh.parts.push_back(part);
}

double longest_texels(const Mesh& mesh, std::size_t triangle, double& shortest) {
  double longest = 0;
  shortest = 1e9;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 a = mesh.lightmap_uvs[mesh.indices[3 * triangle + i]],
               b = mesh.lightmap_uvs[mesh.indices[3 * triangle + (i + 1) % 3]];
    const double length = glm::length(DVec2(b - a)) * kTexels;
    longest = std::max(longest, length), shortest = std::min(shortest, length);
  }
  return longest;
}

TEST(VertexLight, FlatLightNeedsNoMoreTriangles) {
  Mesh mesh;
  add_square(mesh, 0, 0);
  const LightmapPage page = page_of([](float, float) { return 300.0f; });
  const DividedMesh divided = divide_by_light(mesh, {&page, 1}, {.error = 1e-6});
  EXPECT_EQ(divided.report.triangles, 2u);
  EXPECT_EQ(divided.light.irradiance, std::vector<Vec3>(4, Vec3(300)));
  EXPECT_EQ(divided.first, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_LT(divided.report.error, 1e-6);
  EXPECT_EQ(divided.report.shortfall(), "");
}

// Interpolation over a triangle is linear, and so is this light.
TEST(VertexLight, AGradientIsExact) {
  Mesh mesh;
  add_square(mesh, 0, 0);
  const LightmapPage page = page_of([](float x, float y) { return 100 + 3 * x + 2 * y; });
  const DividedMesh divided = divide_by_light(mesh, {&page, 1}, {.error = 1e-5});
  EXPECT_EQ(divided.report.triangles, 2u);
  EXPECT_LT(divided.report.error, 1e-6);
  EXPECT_NEAR(divided.light.irradiance[0].r, 100, 1e-3);
  EXPECT_NEAR(divided.light.irradiance[2].r, 100 + 5 * (kTexels - 1), 1e-2);
}

// What no interpolation shows: triangles along it become as small as a texel, and no smaller.
TEST(VertexLight, AStepOfLightEndsAtATexel) {
  Mesh mesh;
  add_square(mesh, 0, 0);
  const LightmapPage page = page_of([](float x, float) { return x < 20.5f ? 10.0f : 1000.0f; });
  const DividedMesh divided = divide_by_light(mesh, {&page, 1}, {.error = 1e-3});
  const VertexLightReport& r = divided.report;
  EXPECT_FALSE(r.full);
  EXPECT_GT(r.coarse, 0u) << "a texel is all that there is";
  EXPECT_GT(r.triangles, kTexels) << "along the step";
  EXPECT_LT(r.triangles, kTexels * kTexels / 2) << "far from it nothing is divided";
  std::size_t small = 0;
  for (std::size_t t = 0; t < r.triangles; ++t) {
    double shortest = 0;
    small += longest_texels(mesh, t, shortest) <= 1 ? 1 : 0;
    EXPECT_GT(shortest, 0.5) << "half of an edge of more than a texel";
  }
  EXPECT_GE(small, r.coarse);
  EXPECT_EQ(divide_by_light(mesh, {&page, 1}, {.error = 1e-3}).report.triangles, r.triangles) << "it was at its end";
}

// Halving what is allowed never makes it worse, and what is stated is what is there.
TEST(VertexLight, IsWithinTheErrorAskedFor) {
  const LightmapPage page =
      page_of([](float x, float y) { return 100 + 90 * std::sin(0.11f * x) * std::cos(0.07f * y); });
  std::size_t before = 2;
  for (const double error : {0.2, 0.1, 0.05, 0.02, 0.01}) {
    Mesh mesh;
    add_square(mesh, 0, 0);
    const DividedMesh divided = divide_by_light(mesh, {&page, 1}, {.error = error});
    EXPECT_LE(divided.report.error, error);
    EXPECT_EQ(divided.report.coarse, 0u);
    EXPECT_GE(divided.report.triangles, before);
    before = divided.report.triangles;
  }
  EXPECT_GT(before, 50u);
}

// Two squares of two charts meet; only one of them has light that bends. An edge between two triangles has no vertex
// of others on it: each edge belongs to two triangles, or lies on the outline.
TEST(VertexLight, LeavesNoCracks) {
  Mesh mesh;
  add_square(mesh, 0, 0);
  add_square(mesh, kSide_m, 1);
  const std::vector<LightmapPage> pages{page_of([](float x, float y) { return x + y > 90 ? 1000.0f : 5.0f; }),
                                        page_of([](float, float) { return 50.0f; })};
  const DividedMesh divided = divide_by_light(mesh, pages, {.error = 0.02});
  EXPECT_GT(divided.first[4] - divided.first[2], 2u) << "the other side of the common edge";
  std::map<std::set<std::array<float, 2>>, int> sides;
  double area = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k % 3]]; };
    area += 0.5 * double{glm::cross(at(1) - at(0), at(2) - at(0)).z};
    for (std::size_t k = 0; k < 3; ++k) ++sides[{{at(k).x, at(k).y}, {at(k + 1).x, at(k + 1).y}}];
  }
  EXPECT_NEAR(area, 2 * kSide_m * kSide_m, 1e-4);
  for (const auto& [ends, count] : sides) {
    const auto a = *ends.begin(), b = *ends.rbegin();
    const bool outline =
        (a[0] == b[0] && (a[0] == 0 || a[0] == 2 * kSide_m)) || (a[1] == b[1] && (a[1] == 0 || a[1] == kSide_m));
    EXPECT_EQ(count, outline ? 1 : 2) << a[0] << " " << a[1] << " to " << b[0] << " " << b[1];
  }
  EXPECT_EQ(divided.first.back(), divided.report.triangles);
  EXPECT_EQ(mesh.parts[1].first_index, 3 * divided.first[2]);
  EXPECT_EQ(mesh.parts[1].index_count, 3 * (divided.first[4] - divided.first[2]));
}

TEST(VertexLight, EndsWithAsManyTrianglesAsAreAllowed) {
  const LightmapPage page = page_of([](float x, float y) { return static_cast<int>(x + y) % 2 == 0 ? 10.0f : 900.0f; });
  for (const std::size_t most : {std::size_t{1}, std::size_t{2}, std::size_t{50}, std::size_t{1000}}) {
    Mesh mesh;
    add_square(mesh, 0, 0);
    const DividedMesh divided = divide_by_light(mesh, {&page, 1}, {.error = 0.01, .most_triangles = most});
    EXPECT_TRUE(divided.report.full);
    EXPECT_LE(divided.report.triangles, std::max(most, std::size_t{2}));
    EXPECT_GT(divided.report.coarse, 0u);
    EXPECT_NE(divided.report.shortfall().find(std::to_string(divided.report.triangles)), std::string::npos);
    Pack pack;
    pack.mesh = mesh;
    pack.materials.resize(1);
    pack.lightmaps = {page};
    pack.vertex_light = divided.light;
    for (const Issue& issue : validate(pack)) EXPECT_NE(issue.severity, Severity::kError) << issue.message;
  }
}

// As a user meets it.
TEST(VertexLight, IsInThePack) {
  const testing::TemporaryFolder folder;
  const auto log = [&] {
    const auto bytes = read_file(folder.path() / "log");
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
  };
  const auto run = [&](const std::string& command) {
    const std::string line = "cd '" + folder.path().string() + "' && '" + ORIEL_BIN_DIR + "'/" + command + " >log 2>&1";
    return WEXITSTATUS(std::system(line.c_str()));
  };
  ASSERT_EQ(run("oriel-scenes gallery -o gallery.glb"), 0) << log();
  const std::string bake =
      "oriel-bake gallery.glb --no-cache --texel 1m --samples 4 --quiet --only radiosity,radiance ";
  ASSERT_EQ(run(bake + "-o texture.oriel"), 0) << log();
  ASSERT_EQ(run(bake + "-o vertices.oriel --pvs on --radiosity vertices:20%"), 0) << log();
  const Pack plain = *read_pack(folder.path() / "texture.oriel"), pack = *read_pack(folder.path() / "vertices.oriel");
  EXPECT_TRUE(plain.vertex_light.irradiance.empty());
  EXPECT_EQ(pack.vertex_light.irradiance.size(), pack.mesh.positions.size());
  EXPECT_GT(pack.mesh.indices.size(), plain.mesh.indices.size());
  ASSERT_EQ(pack.lightmaps.size(), plain.lightmaps.size());
  EXPECT_EQ(pack.lightmaps[0].irradiance, plain.lightmaps[0].irradiance) << "the lightmap stays what it is";
  EXPECT_TRUE(made_for(pack.visible_sets, pack.mesh, pack.materials, pack.walk_grids));
  // Reflectors are made of triangles of the mesh.
  std::set<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t i = 0; i < pack.mesh.indices.size(); i += 3)
    triangles.insert({pack.mesh.indices[i], pack.mesh.indices[i + 1], pack.mesh.indices[i + 2]});
  ASSERT_FALSE(pack.reflectors.empty());
  for (const Reflector& r : pack.reflectors)
    for (std::size_t i = 0; i < r.indices.size(); i += 3)
      EXPECT_TRUE(triangles.contains({r.indices[i], r.indices[i + 1], r.indices[i + 2]})) << r.name;
  const auto plan = Json::parse(pack.plan).value()["radiosity"]["vertices"];
  EXPECT_EQ(plan["error_asked"], 0.2);
  EXPECT_EQ(plan["triangles"], pack.mesh.indices.size() / 3);
  EXPECT_EQ(Json::parse(pack.provenance).value()["options"]["radiosity"], "vertices:20%");
  for (const char* bad : {"mesh", "vertices:", "vertices:0%", "vertices:-1%", "vertices:much", "texture:5%"}) {
    EXPECT_EQ(run(bake + "-o bad.oriel --radiosity " + bad), 1) << bad;
    EXPECT_NE(log().find("--radiosity"), std::string::npos) << log();
  }
}

}  // namespace
}  // namespace oriel
