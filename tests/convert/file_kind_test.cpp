// Files that are no scene for Oriel are called what their users call them.
#include "convert/file_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/core/bytes.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel {
namespace {

using namespace std::string_literals;

std::string said_of(const std::string& name, const std::string& bytes) {
  const auto format = source_format(name, bytes_of_text(bytes));
  return !format ? format.error().text() : *format ? "reads " + (*format)->name : "glTF";
}

TEST(FileKind, ReadsByContentThenByName) {
  EXPECT_EQ(said_of("a.FBX", "Kaydara FBX Binary  \0"s), "reads FBX");
  EXPECT_EQ(said_of("a.bin", "Kaydara FBX Binary  \0"s), "reads FBX");
  EXPECT_EQ(said_of("a.obj", "v 0 0 0\n"), "reads OBJ");
  EXPECT_EQ(said_of("a.xml", "<?xml?><COLLADA version=\"1.4.1\">"), "reads Collada file");
  EXPECT_EQ(said_of("a.ifc", "ISO-10303-21;\nFILE_SCHEMA(('IFC4'));"), "reads IFC");
  EXPECT_EQ(said_of("a.step", "ISO-10303-21;\nFILE_SCHEMA(('IFC4'));"), "reads IFC");
  EXPECT_EQ(said_of("a.stl", "binary"), "reads STL");
  EXPECT_EQ(said_of("a.3ds", "MM\x06\0\0\0"s), "reads 3DS");
  EXPECT_EQ(said_of("a.fbx", "glTF\x02\0\0\0"s), "glTF");
  EXPECT_EQ(said_of("a.obj", " \n{\"asset\": {}}"), "glTF");
  EXPECT_EQ(said_of("a.glb", ""), "glTF");  // whose reader says that it is empty
}

TEST(FileKind, OthersByTheProgramThatExportsThem) {
  const std::string ole = "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", zip = "PK\x03\x04";
  const std::vector<std::array<std::string, 4>> cases = {
      {"a.blend", "BLENDER-v304", "this is a .blend", "File > Export > glTF 2.0"},
      {"a.blend", "\x28\xB5\x2F\xFD....", "this is a compressed .blend", "Blender"},
      {"a.glb", "BLENDER-v304", "this is a .blend", "Blender"},
      {"a.skp", "\xFF\xFE\xFF\x0E" + "S\0k\0"s, "SketchUp", "File > Export"},
      {"a.rvt", ole, "Revit", "IFC"},
      {"a.max", ole, "3ds Max", "FBX"},
      {"a.ma", "//Maya ASCII 2022", "Maya", "FBX"},
      {"a.c4d", "QC4DC4D6", "Cinema 4D", "glTF"},
      {"a.usda", "#usda 1.0", "USD", "Blender"},
      {"a.usdz", zip, "USD", "Blender"},
      {"a.usdc", "PXR-USDC", "USD", "Blender"},
      {"a.step", "ISO-10303-21;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));", "STEP", "FreeCAD"},
      {"a.dwg", "AC1032", "AutoCAD", "FreeCAD"},
      {"a.dxf", "  0\nSECTION", "DXF", "FreeCAD"},
      {"a.3dm", "3D Geometry File Format", "Rhino", "glTF"},
      {"a.zip", zip, "ZIP", "unpack"},
      {"a.unknown", zip, "ZIP", "unpack"},
      {"a.sh3d", zip, "Sweet Home 3D", "OBJ"},
      {"a.mtl", "newmtl m", "material file", ".obj"},
      {"a.png", "\x89PNG", "picture", "--sky"},
  };
  for (const auto& [name, bytes, what, cure] : cases) {
    const std::string said = said_of(name, bytes);
    EXPECT_THAT(said, ::testing::HasSubstr(what)) << name;
    EXPECT_THAT(said, ::testing::HasSubstr(cure)) << name;
    EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr("0x"))) << name;
  }
}

TEST(FileKind, TheImporterSaysSo) {
  const test::TempFolder folder;
  EXPECT_THAT(test::import_file(folder.write("a.blend", "BLENDER-v304")).error(),
              ::testing::HasSubstr("a.blend: this is a .blend: export glTF from Blender"));
  const std::string unknown = test::import_file(folder.write("a.xyz", "words")).error();
  EXPECT_THAT(unknown, ::testing::HasSubstr("expected .glb or .gltf"));
  EXPECT_THAT(unknown, ::testing::Not(::testing::HasSubstr("0x")));
}

}  // namespace
}  // namespace oriel
