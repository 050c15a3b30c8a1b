// Meshes and nodes into triangles: winding, normals, scale, what is dropped.
#include <gtest/gtest.h>

#include "bake/import/repair.h"
#include "bake/scene/edges.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

const std::vector<float> kPentagon{0, 0,    0,    1, 0,     0, 1.3f, 1,
                                   0, 0.5f, 1.6f, 0, -0.3f, 1, 0};  // counter-clockwise from +Z

TEST(Geometry, StripsAndFansFaceAsListsDo) {
  Gltf g;
  const int p = g.floats("VEC3", kPentagon);
  // The same pentagon as a list, a fan, and a strip that zigzags.
  g.add({{"attributes", {{"POSITION", p}}}, {"mode", 4}, {"indices", g.indices({0, 1, 2, 0, 2, 3, 0, 3, 4})}});
  g.add({{"attributes", {{"POSITION", p}}}, {"mode", 6}});
  g.add({{"attributes", {{"POSITION", p}}}, {"mode", 5}, {"indices", g.indices({0, 1, 4, 2, 3})}});
  g.add({{"attributes", {{"POSITION", p}}}, {"mode", 1}});
  g.add({{"attributes", {{"POSITION", p}}}, {"mode", 0}});
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().surfaces.size(), 3u);
  EXPECT_EQ(broken_promise(r.scene()), "");
  double areas[3] = {0, 0, 0};
  for (std::uint32_t t = 0; t < r.scene().triangles.size(); ++t) {
    EXPECT_NEAR(geometric_normal(r.scene(), t).z, 1, 1e-6) << t;
    areas[r.scene().triangle_surface[t]] += triangle_area(r.scene(), t);
  }
  EXPECT_NEAR(areas[1], areas[0], 1e-6);
  EXPECT_NEAR(areas[2], areas[0], 1e-6);
  EXPECT_EQ(r.warnings.size(), 2u);
  EXPECT_TRUE(r.warned("surfaces lie in one place"));
  EXPECT_TRUE(r.warned("2 primitives of points or lines"));
}

TEST(Geometry, MirroredNodesKeepTheirFront) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int n = g.floats("VEC3", {0, 0.6f, 0.8f, 0, 0.6f, 0.8f, 0, 0.6f, 0.8f});
  g.add({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})["scale"] = {-2, 1, 1};
  g.add({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})["scale"] = {1, 1, -1};
  g.add({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})["scale"] = {-1, -1, -1};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(broken_promise(r.scene()), "");
  EXPECT_TRUE(r.warnings.empty());
  EXPECT_NEAR(geometric_normal(r.scene(), 0).z, 1, 1e-6);   // mirrored in its own plane: still faces +Z
  EXPECT_NEAR(geometric_normal(r.scene(), 1).z, -1, 1e-6);  // mirrored along its normal
  EXPECT_NEAR(glm::length(r.scene().normals[r.scene().triangles[0].x] - Vec3(0, 0.6f, 0.8f)), 0, 1e-6);
  EXPECT_NEAR(glm::length(r.scene().normals[r.scene().triangles[1].x] - Vec3(0, 0.6f, -0.8f)), 0, 1e-6);
  EXPECT_NEAR(glm::length(r.scene().normals[r.scene().triangles[2].x] - Vec3(0, -0.6f, -0.8f)), 0, 1e-6);
}

TEST(Geometry, NormalsFollowTheInverseTranspose) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, -1, 0, 1, 0});  // normal (1, 0, 1) / sqrt 2
  const int n = g.floats("VEC3", {1, 0, 1, 1, 0, 1, 1, 0, 1});   // not of unit length
  g.add({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})["scale"] = {4, 1, 1};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  for (const Vec3& normal : r.scene().normals) EXPECT_NEAR(glm::dot(normal, geometric_normal(r.scene(), 0)), 1, 1e-6);
}

TEST(Geometry, HugeOffsetsLoseNothing) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1e-3f, 0, 0, 0, 1e-3f, 0});
  g.add({{"attributes", {{"POSITION", p}}}})["translation"] = {1e7, -2e7, 3e7};
  g.add({{"attributes", {{"POSITION", p}}}})["translation"] = {1e7 + 0.25, -2e7, 3e7};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  const Scene& s = r.scene();
  ASSERT_EQ(s.triangles.size(), 2u);
  EXPECT_NEAR(s.origin.x, 1e7 + 0.1255, 1e-6);
  for (std::uint32_t t = 0; t < 2; ++t) EXPECT_NEAR(triangle_area(s, t) / 0.5e-6, 1, 1e-4);
  const Vec3 apart = s.positions[s.triangles[1].x] - s.positions[s.triangles[0].x];
  EXPECT_NEAR(apart.x, 0.25, 1e-6);
  EXPECT_NEAR(apart.y, 0, 1e-6);
}

TEST(Geometry, TinyAndHugeScenesImport) {
  for (const double scale : {1e-6, 1e-4, 1.0, 1e6, 1e8}) {
    Gltf g;
    g.add({{"attributes", {{"POSITION", g.floats("VEC3", kPentagon)}}}, {"mode", 6}})["scale"] = {scale, scale, scale};
    const Imported r = import(g);
    ASSERT_TRUE(r.ok()) << scale << r.error();
    EXPECT_EQ(r.scene().triangles.size(), 3u) << scale;
    EXPECT_EQ(broken_promise(r.scene()), "") << scale;
  }
  for (const double scale : {1e-12, 1e12, 1e40, 1e200}) {
    Gltf g = triangle();
    g.doc["nodes"][0]["scale"] = {scale, scale, scale};
    EXPECT_FALSE(import(g).ok()) << scale;
  }
}

TEST(Geometry, DegenerateAndDoubledTrianglesAreDroppedAndCounted) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 1, 0, 0});
  // Good; repeated index; on a line; coinciding corners; the good one again from another corner; its back, which stays.
  g.add({{"attributes", {{"POSITION", p}}},
         {"indices", g.indices({0, 1, 2, 0, 0, 1, 0, 1, 3, 1, 4, 2, 1, 2, 0, 0, 2, 1, 0, 1})}});
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.scene().triangles.size(), 2u);
  EXPECT_TRUE(r.warned("3 degenerate")) << r.warnings.front();
  EXPECT_TRUE(r.warned("1 exact duplicates"));
  EXPECT_TRUE(r.warned("incomplete"));
}

TEST(Geometry, SliversSurvive) {
  Gltf g;
  g.add({{"attributes", {{"POSITION", g.floats("VEC3", {0, 0, 0, 100, 0, 0, 50, 1e-5f, 0})}}}});
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().triangles.size(), 1u);
  EXPECT_NEAR(geometric_normal(r.scene(), 0).z, 1, 1e-6);
}

TEST(Geometry, NothingLeftIsAnError) {
  Gltf degenerate_only;
  degenerate_only.add({{"attributes", {{"POSITION", degenerate_only.floats("VEC3", {0, 0, 0, 1, 0, 0, 2, 0, 0})}}}});
  EXPECT_NE(import(degenerate_only).error().find("no mesh"), std::string::npos);
  Gltf empty;
  EXPECT_NE(import(empty).error().find("no mesh"), std::string::npos);
  Gltf flat = triangle();
  flat.doc["nodes"][0]["scale"] = {1, 0, 1};
  EXPECT_FALSE(import(flat).ok());
}

TEST(Geometry, BadNormalsGiveWayToTheTriangle) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const int n = g.floats("VEC3", {0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 1});
  g.add({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}, {"indices", g.indices({0, 1, 2, 2, 1, 3})}});
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(broken_promise(r.scene()), "");
  EXPECT_TRUE(r.warned("50.0 % of the corners"));
}

TEST(Geometry, MissingNormalsAreFlat) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  g.add({{"attributes", {{"POSITION", p}}}, {"indices", g.indices({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3})}});
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().positions.size(), 12u);
  for (std::uint32_t t = 0; t < 4; ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(glm::dot(r.scene().normals[r.scene().triangles[t][k]], geometric_normal(r.scene(), t)), 1, 1e-6);
}

TEST(Nodes, LoopsAndSecondParentsAreRefused) {
  Gltf g = triangle();
  g.doc["nodes"][0]["children"] = {0};
  EXPECT_NE(import(g).error().find("nodes[0]"), std::string::npos);
  g = triangle();
  g.add_triangle();
  g.add_triangle();
  g.doc["scenes"][0]["nodes"] = {0, 1};
  g.doc["nodes"][0]["children"] = {2};
  EXPECT_TRUE(import(g).ok()) << import(g).error();
  g.doc["nodes"][1]["children"] = {2};
  EXPECT_NE(import(g).error().find("one parent"), std::string::npos);
  g.doc["nodes"][1].erase("children");
  g.doc["scenes"][0]["nodes"] = {0, 2};
  EXPECT_NE(import(g).error().find("root node"), std::string::npos);
}

TEST(Nodes, LongChainsDoNotRecurse) {
  Gltf g = triangle();
  for (int i = 1; i < 50000; ++i) {
    g.doc["nodes"][static_cast<std::size_t>(i) - 1]["children"] = {i};
    g.doc["nodes"].push_back(json::object());
  }
  EXPECT_TRUE(import(g).ok());
}

TEST(Nodes, MatricesMustDecompose) {
  Gltf g = triangle();
  json& matrix = g.doc["nodes"][0]["matrix"];
  matrix = {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  const Imported good = import(g);
  ASSERT_TRUE(good.ok()) << good.error();
  EXPECT_NEAR(good.scene().origin.y, 7, 1e-9);
  for (const json& bad : {json{1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, json{1, 2, 3},
                          json{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, "x"}}) {
    matrix = bad;
    EXPECT_NE(import(g).error().find("nodes[0].matrix"), std::string::npos) << bad;
  }
  matrix = {1, 0, 0, 1e-7, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 0.9999999};
  const Imported rounded = import(g);
  ASSERT_TRUE(rounded.ok()) << rounded.error();
  EXPECT_TRUE(rounded.warned("nodes[0].matrix: the last row of the matrix is taken as 0, 0, 0, 1"));
  EXPECT_NEAR(rounded.scene().origin.y, 6.5, 1e-5);
  matrix = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 12, 14, 2};  // homogeneous
  EXPECT_NEAR(import(g).scene().origin.y, 6.5, 1e-9);
  g.add_triangle();
  g.doc["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // flat, as a scale of 0 is
  const Imported flat = import(g);
  ASSERT_TRUE(flat.ok()) << flat.error();
  EXPECT_EQ(flat.scene().triangles.size(), 1u);
}

// KHR_node_visibility: what hangs below a hidden node is hidden too.
TEST(Nodes, HiddenOnesAreNotThere) {
  Gltf g = triangle();
  g.add_triangle()["name"] = "below";
  g.use("KHR_node_visibility", true);
  g.doc["nodes"].push_back(
      {{"name", "hidden"}, {"children", {1}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  g.doc["scenes"][0]["nodes"] = {0, 2};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.scene().surfaces.size(), 1u);
  g.doc["nodes"][2]["extensions"]["KHR_node_visibility"]["visible"] = true;
  EXPECT_EQ(import(g).scene().surfaces.size(), 2u);
}

// glTF forbids it, exporters of other formats write it, and every viewer shows it.
TEST(Nodes, MatricesThatShearStandAsTheyAre) {
  Gltf g = triangle();
  g.doc["nodes"][0]["matrix"] = {1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(broken_promise(r.scene()), "");
  EXPECT_TRUE(r.warned("nodes[0].matrix: the matrix shears"));
  float farthest = 0;  // of (0, 0), (1, 0) and (0, 1) along the diagonal: the second comes to (1, 1)
  for (const Vec3& p : r.scene().positions)
    farthest = std::max(farthest, p.x + p.y - r.scene().lower.x - r.scene().lower.y);
  EXPECT_NEAR(farthest, 2, 1e-6);
}

// glTF forbids both; three.js and Blender take the matrix.
TEST(Nodes, AMatrixStandsBesideATranslation) {
  Gltf g = triangle();
  g.doc["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1};
  g.doc["nodes"][0]["translation"] = {0, 3, 0};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.scene().origin.x + double{r.scene().lower.x}, 7);
  EXPECT_EQ(r.scene().origin.y + double{r.scene().lower.y}, 0);
  EXPECT_TRUE(r.warned("nodes[0].matrix: the matrix is taken"));
}

TEST(Nodes, ScenesAreChosen) {
  Gltf g = triangle();
  g.add_triangle()["name"] = "second";
  g.doc["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  EXPECT_EQ(import(g).scene().surfaces[0].name, "mesh 0/0");
  ImportOptions options;
  options.scene = 1;
  EXPECT_EQ(import(g, options).scene().surfaces[0].name, "second");
  g.doc["scene"] = 1;
  g.doc["scenes"][1]["name"] = "upstairs";
  const Imported by_default = import(g);
  EXPECT_EQ(by_default.scene().surfaces[0].name, "second");
  EXPECT_TRUE(by_default.warned("the file has 2 scenes: number 1, \"upstairs\", is taken"));
  EXPECT_TRUE(import(g, options).warnings.empty()) << "it was asked for";
  options.scene = 2;
  EXPECT_EQ(import(g, options).result.error().code, ErrorCode::kUsage);
  g.doc.erase("scenes");
  g.doc.erase("scene");
  const Imported all = import(g);
  ASSERT_TRUE(all.ok()) << all.error();
  EXPECT_EQ(all.scene().surfaces.size(), 2u);
  EXPECT_TRUE(all.warned("no scene"));
}

TEST(Nodes, InstancesArePlaced) {
  Gltf g = triangle();
  g.use("EXT_mesh_gpu_instancing", true);
  const int t = g.floats("VEC3", {0, 0, 0, 10, 0, 0, 0, 20, 0}), s = g.floats("VEC3", {1, 1, 1, 2, 2, 2, -1, 1, 1});
  g.doc["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", t}, {"SCALE", s}};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().surfaces.size(), 3u);
  EXPECT_NEAR(triangle_area(r.scene(), 1), 2, 1e-6);
  EXPECT_NEAR(geometric_normal(r.scene(), 2).z, 1, 1e-6);
  EXPECT_NEAR(r.scene().upper.x - r.scene().lower.x, 13, 1e-5);
  g.doc["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = g.floats("VEC3", {1, 1, 1});
  EXPECT_FALSE(import(g).ok());
}

// A dish of 20 x 20 quads.
json dish(Gltf& g) {
  std::vector<float> positions;
  std::vector<std::uint16_t> indices;
  for (int y = 0; y <= 20; ++y)
    for (int x = 0; x <= 20; ++x) {
      const float u = 0.1f * static_cast<float>(x) - 1, v = 0.1f * static_cast<float>(y) - 1;
      positions.insert(positions.end(), {u, v, u * u + v * v});
      if (x == 20 || y == 20) continue;
      const auto at = static_cast<std::uint16_t>(21 * y + x);
      for (const int off : {0, 1, 22, 0, 22, 21}) indices.push_back(static_cast<std::uint16_t>(at + off));
    }
  return {{"attributes", {{"POSITION", g.floats("VEC3", positions)}}}, {"indices", g.indices(indices)}};
}

// Where all would take longer than there is time, what stands in many places is coarser, and stands where it did.
TEST(TooManyTriangles, InstancesGetFewer) {
  Gltf g = triangle();
  const json mesh = dish(g);
  g.add(mesh)["translation"] = {0, 0, 0};
  const std::size_t shared = g.doc["meshes"].size() - 1;
  for (int i = 1; i < 50; ++i) {
    g.doc["nodes"].push_back({{"mesh", shared}, {"translation", {3 * i, 0, 0}}});
    g.doc["scenes"][0]["nodes"].push_back(g.doc["nodes"].size() - 1);
  }
  g.doc["nodes"].push_back({{"mesh", 0}, {"translation", {0, 3, 0}}});  // a mesh of one triangle
  g.doc["scenes"][0]["nodes"].push_back(g.doc["nodes"].size() - 1);
  const Imported whole = import(g);
  ASSERT_TRUE(whole.ok()) << whole.error();
  EXPECT_EQ(whole.scene().triangles.size(), 2u + 50 * 800);
  ImportOptions options;
  options.most_triangles = 10'000;
  const Imported coarse = import(g, options);
  ASSERT_TRUE(coarse.ok()) << coarse.error();
  EXPECT_LE(coarse.scene().triangles.size(), 10'000u);
  EXPECT_GE(coarse.scene().triangles.size(), 2'000u);
  EXPECT_EQ(coarse.scene().surfaces.size(), 52u);
  EXPECT_TRUE(coarse.warned("take too long for --time"));
  EXPECT_LT(glm::length(coarse.scene().upper - whole.scene().upper), 0.3f);
  EXPECT_EQ(broken_promise(coarse.scene()), "");
  options.most_triangles = 1'000'000;
  EXPECT_EQ(import(g, options).scene().triangles.size(), whole.scene().triangles.size());
}

TEST(TooManyTriangles, OfOneMeshAreRefused) {
  Gltf g;
  g.add(dish(g));
  ImportOptions options;
  options.most_triangles = 200;
  const Imported r = import(g, options);
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.result.error().code, ErrorCode::kInvalid);
  EXPECT_NE(r.error().find("give more time"), std::string::npos) << r.error();
}

TEST(Edges, OfAllTrianglesAreTogether) {
  // A square of two triangles; its corners are written twice, and once as -0.
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0f, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<std::uint32_t> corners = weld(p);
  EXPECT_EQ(corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 5}));
  std::vector<std::string> edges;
  for_each_edge(edge_uses(corners), [&](std::span<const EdgeUse> uses) {
    std::string& edge = edges.emplace_back(fmt::format("{}-{}:", uses[0].low, uses[0].high));
    for (const EdgeUse& use : uses) edge += fmt::format(" {}{}", use.corner, use.forward ? "+" : "-");
  });
  EXPECT_EQ(edges, (std::vector<std::string>{"0-1: 0+", "0-2: 2- 3+", "0-5: 5-", "1-2: 1+", "2-5: 4+"}));
  EXPECT_TRUE(edge_uses(std::vector<std::uint32_t>{0, 1, 0}).empty());
  EXPECT_TRUE(edge_uses({}).empty());
}

TEST(Repair, SeesWhatIsOddAndNothingElse) {
  using Corners = std::vector<std::uint32_t>;
  const Corners tetrahedron{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  EXPECT_EQ(inspect_soup(tetrahedron).misoriented_triangles, 0u);
  EXPECT_EQ(inspect_soup(tetrahedron).non_manifold_edges, 0u);
  for (std::size_t turned = 0; turned < 4; ++turned) {
    Corners odd = tetrahedron;
    std::swap(odd[3 * turned], odd[3 * turned + 1]);
    EXPECT_EQ(inspect_soup(odd).misoriented_triangles, 1u) << turned;
  }
  Corners fin = tetrahedron;
  fin.insert(fin.end(), {0, 1, 4});
  EXPECT_EQ(inspect_soup(fin).non_manifold_edges, 1u);
}

// Two triangles, of which one shows its back.
TEST(Repair, AdviceThatWasGivenIsNotGivenAgain) {
  const TempFolder folder;
  std::vector<std::string> said;
  Context context;
  context.warn = [&](const Warning& warning) { said.push_back(warning.text); };
  const auto read = [&](float corner, const ImportedScene* last) {
    Gltf g;
    const int places = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, corner});
    g.add({{"attributes", {{"POSITION", places}}}, {"indices", g.indices({0, 1, 2, 1, 2, 3})}});
    said.clear();
    return *import_gltf(folder.write("a.gltf", g.text()), {}, context, last);
  };
  const ImportedScene first = read(0, nullptr);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("face against"), std::string::npos) << said[0];
  read(0, &first);
  EXPECT_EQ(said.size(), 0u);
  read(0.5f, &first);  // another mesh
  EXPECT_EQ(said.size(), 1u);
}

}  // namespace
}  // namespace oriel::test
