// Scenes of each format come in with their size, their way up, their parts and their names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bake/import/gltf_maker.h"
#include "tests/convert/source_text.h"

namespace oriel {
namespace {

using test::Imported;
using test::TempFolder;

// The corner of the world that the scene begins at, and the one it ends at.
Vec3 low(const Imported& in) {
  return Vec3(in.scene().origin) + in.scene().lower;
}
Vec3 high(const Imported& in) {
  return Vec3(in.scene().origin) + in.scene().upper;
}

void expect_near(const Vec3& found, const Vec3& expected, float within = 1e-4f) {
  EXPECT_LE(max_component(glm::abs(found - expected)), within)
      << "found " << found.x << " " << found.y << " " << found.z << ", expected " << expected.x << " " << expected.y
      << " " << expected.z;
}

Imported read(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  Imported in = test::import_file(folder.write(name, bytes));
  EXPECT_TRUE(in.ok()) << in.error();
  return in;
}

constexpr const char* kMetreZUp = R"(<unit meter="1"/><up_axis>Z_UP</up_axis>)";

TEST(OtherFormats, Collada) {
  const Imported in = read("a.dae", test::collada(R"(<unit meter="0.01"/><up_axis>Z_UP</up_axis>)"));
  ASSERT_TRUE(in.ok());
  expect_near(low(in), Vec3(0));
  expect_near(high(in), Vec3(0.02f, 0.03f, 0));
  EXPECT_EQ(in.scene().surfaces.at(0).node_path, "vs/house/wall");
  const SceneMaterial& paint = in.scene().materials.at(0);
  EXPECT_EQ(paint.name, "paint");
  expect_near(paint.base_color, Vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(paint.metallic, 0);
  EXPECT_NEAR(paint.roughness, 0.5f, 1e-3f);  // (2 / 32)^(1/4)
  const Imported metres = read("a.dae", test::collada(kMetreZUp)), y_up = read("a.dae", test::collada(""));
  expect_near(high(metres), Vec3(2, 3, 0));
  expect_near(high(y_up), Vec3(2, 0, 3));
}

TEST(OtherFormats, LampsAndCamerasOfCollada) {
  const Imported in = read("a.dae", test::collada(kMetreZUp));
  ASSERT_TRUE(in.ok());
  ASSERT_EQ(in.scene().lights.size(), 2u);
  const Light &lamp = in.scene().lights[0], &beam = in.scene().lights[1];
  EXPECT_EQ(lamp.name, "lamp");
  expect_near(lamp.intensity, 179 * kPi * Vec3(2, 1, 1), 0.1f);
  expect_near(Vec3(in.scene().origin) + lamp.position, Vec3(0, 2, 0));
  EXPECT_EQ(beam.type, LightType::kSpot);
  expect_near(beam.direction, Vec3(0, -1, 0));
  EXPECT_NEAR(beam.outer_cone_rad, kPi / 6, 1e-4f);
  ASSERT_EQ(in.scene().cameras.size(), 1u);
  const Camera& eye = in.scene().cameras[0];
  EXPECT_EQ(eye.name, "eye");
  expect_near(eye.forward, Vec3(0, 0, -1));
  expect_near(Vec3(in.scene().origin) + eye.eye, Vec3(0, 1, 4));
  EXPECT_NEAR(std::tan(eye.vertical_fov_rad / 2), 0.5f, 1e-4f);  // 90° across, twice as wide as high
}

// By Blender they have watts.
TEST(OtherFormats, LampsOfBlender) {
  const Imported in = read("a.dae", test::collada("<contributor><authoring_tool>Blender 3.4.1</authoring_tool>"
                                                  "</contributor>" +
                                                  std::string(kMetreZUp)));
  ASSERT_TRUE(in.ok());
  expect_near(in.scene().lights.at(0).intensity, 179 / (4 * kPi) * Vec3(2, 1, 1), 0.01f);
}

std::string axis(int up, int up_sign, int front, int front_sign, double unit) {
  std::string out;
  const auto add = [&](const char* name, int value) {
    out += fmt::format("\t\tP: \"{}\", \"int\", \"Integer\", \"\",{}\n", name, value);
  };
  add("UpAxis", up), add("UpAxisSign", up_sign), add("FrontAxis", front), add("FrontAxisSign", front_sign);
  add("CoordAxis", 0), add("CoordAxisSign", 1);
  return out + fmt::format("\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\",{}\n", unit);
}

TEST(OtherFormats, FbxByItsUnitAndAxes) {
  expect_near(high(read("a.fbx", test::fbx(axis(1, 1, 2, 1, 1)))), Vec3(2, 1, 0));
  expect_near(high(read("a.fbx", test::fbx(axis(1, 1, 2, 1, 2.54)))), Vec3(5.08f, 2.54f, 0));
  expect_near(high(read("a.fbx", test::fbx(axis(1, 1, 2, 1, 100)))), Vec3(200, 100, 0));
  const Imported z_up = read("a.fbx", test::fbx(axis(2, 1, 1, -1, 1)));
  expect_near(low(z_up), Vec3(0, 0, -1));
  expect_near(high(z_up), Vec3(2, 0, 0));
  EXPECT_EQ(z_up.scene().surfaces.at(0).name, "wall");
}

TEST(OtherFormats, IfcByItsUnit) {
  const Imported in = read("a.ifc", test::ifc_wall("IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)"));
  ASSERT_TRUE(in.ok());
  expect_near(low(in), Vec3(1, 0, -2.2f));
  expect_near(high(in), Vec3(5, 3, -2));
  EXPECT_THAT(in.scene().surfaces.at(0).node_path, ::testing::HasSubstr("North"));
  expect_near(in.scene().materials.at(in.scene().surfaces[0].material).base_color, Vec3(0.8f, 0.2f, 0.1f));
  const Imported mm = read("a.ifc", test::ifc_wall("IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"));
  expect_near(high(mm), Vec3(0.005f, 0.003f, -0.002f));
}

TEST(OtherFormats, IfcInFeet) {
  const Imported feet = read("a.ifc", test::ifc_wall("IFCCONVERSIONBASEDUNIT(#90,.LENGTHUNIT.,'FOOT',#91);\n"
                                                     "#90=IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);\n"
                                                     "#91=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(0.3048),#92);\n"
                                                     "#92=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)"));
  ASSERT_TRUE(feet.ok());
  expect_near(high(feet), 0.3048f * Vec3(5, 3, -2));
}

// What assimp does not read: styles without an assignment, no owners, tessellated and polygonal face sets, furniture.
TEST(OtherFormats, Ifc4) {
  const Imported in = read("a.ifc", test::ifc4_wall());
  ASSERT_TRUE(in.ok());
  expect_near(low(in), Vec3(0, 0, -2.2f));
  expect_near(high(in), Vec3(5, 3, 0));
  std::uint32_t table = 0;
  for (const Surface& surface : in.scene().surfaces) {
    if (surface.node_path.find("Table") == std::string::npos) continue;
    table += surface.triangle_count;
    if (surface.triangle_count == 4 && in.scene().materials[surface.material].name == "Brick")
      expect_near(in.scene().materials[surface.material].base_color, Vec3(0.8f, 0.2f, 0.1f));
  }
  EXPECT_EQ(table, 8u);
}

TEST(OtherFormats, ThreeDs) {
  const Imported in = read("a.3ds", test::three_ds());
  ASSERT_TRUE(in.ok());
  expect_near(high(in), Vec3(10, 4, 0));
  expect_near(in.scene().materials.at(in.scene().surfaces.at(0).material).base_color, Vec3(0, 0, 1));
}

TEST(OtherFormats, PlyWithColoursStandsOnZ) {
  const Imported in =
      read("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
           "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n2 0 0 255 0 0\n0 0 3 255 0 "
           "0\n3 0 1 2\n");
  ASSERT_TRUE(in.ok());
  expect_near(high(in), Vec3(2, 3, 0));
  EXPECT_EQ(in.scene().colors.at(0) & 0xFFFFFFu, 0x0000FFu);
}

TEST(OtherFormats, StlAsTextAndBinary) {
  const Imported text = read("a.stl",
                             "solid wall\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 0 3\n"
                             "endloop\nendfacet\nendsolid wall\n");
  expect_near(high(text), Vec3(2, 3, 0));
  const std::array<float, 9> triangle = {0, 0, 0, 2, 0, 0, 0, 0, 3};
  const Imported binary =
      read("A.STL", test::binary_stl({reinterpret_cast<const char*>(triangle.data()), sizeof(triangle)}));
  expect_near(high(binary), Vec3(2, 3, 0));
  expect_near(binary.scene().materials.at(0).base_color, Vec3(0.8f));
}

TEST(OtherFormats, ObjStandsOnYAndHasItsGroups) {
  const Imported in = read("a.obj", "o wall\nv 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nf 1 2 3 4\no lid\nv 0 0 1\nf 1 2 5\n");
  ASSERT_TRUE(in.ok());
  expect_near(high(in), Vec3(2, 3, 1));
  ASSERT_EQ(in.scene().surfaces.size(), 2u);
  EXPECT_EQ(in.scene().surfaces[0].name, "wall");
  EXPECT_EQ(in.scene().surfaces[1].name, "lid");
}

TEST(OtherFormats, ObjOfProgramsThatSayWhoTheyAre) {
  const std::string square = "v 0 0 0\nv 2000 0 0\nv 2000 0 3000\nf 1 2 3\n";
  expect_near(high(read("a.obj", "# Created by FreeCAD <http://www.freecadweb.org>\n" + square)), Vec3(2, 3, 0));
  expect_near(high(read("a.obj", "#\n# Generated by Sweet Home 3D version 7.0.2\n#\n" + square)), Vec3(20, 0, 30));
}

// What it is counts, not what it is called.
TEST(OtherFormats, ByContent) {
  expect_near(high(read("scene.dat", test::fbx(axis(1, 1, 2, 1, 1)))), Vec3(2, 1, 0));
  expect_near(high(read("scene.gltf", test::collada(kMetreZUp))), Vec3(2, 3, 0));
}

TEST(OtherFormats, DeepHierarchy) {
  std::string models, connections = "\tC: \"OO\",1000,20\n";
  for (int i = 0; i < 10000; ++i) {
    models += fmt::format("\tModel: {}, \"Model::n{}\", \"Null\" {{\n\t}}\n", 1000 + i, i);
    if (i > 0) connections += fmt::format("\tC: \"OO\",{},{}\n", 1000 + i, 999 + i);
  }
  const TempFolder folder;
  const Imported in = test::import_file(folder.write("a.fbx", test::fbx(axis(1, 1, 2, 1, 1), models, connections)));
  if (in.ok())
    expect_near(high(in), Vec3(2, 1, 0));
  else
    EXPECT_THAT(in.error(), ::testing::HasSubstr("a.fbx"));
}

}  // namespace
}  // namespace oriel
