// Materials and textures of other formats.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/image/png.h"
#include "tests/bake/import/gltf_maker.h"
#include "tests/convert/source_text.h"

namespace oriel {
namespace {

using test::Imported;
using test::TempFolder;

std::string as_text(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::string png(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  ByteImage image{2, 2, 3, {}};
  for (int i = 0; i < 4; ++i) image.pixels.insert(image.pixels.end(), {r, g, b});
  return as_text(*encode_png(image));
}
// Half of it is black, half white.
std::string half_mask() {
  return as_text(*encode_png(ByteImage{2, 2, 3, {0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255}}));
}

constexpr const char* kQuad =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";

class ObjMaterials : public ::testing::Test {
 protected:
  Imported read(const std::string& mtl, const std::string& head = "", const char* mtl_name = "a.mtl") {
    folder_.write(mtl_name, "newmtl m\n" + mtl);
    return test::import_file(folder_.write("a.obj", head + "mtllib a.mtl\n" + kQuad));
  }
  SceneMaterial material(const std::string& mtl, const std::string& head = "") {
    const Imported in = read(mtl, head);
    EXPECT_TRUE(in.ok()) << in.error();
    return in.ok() ? in.scene().materials.at(in.scene().surfaces.at(0).material) : SceneMaterial();
  }
  TempFolder folder_;
};

TEST_F(ObjMaterials, PhongToRoughness) {
  const SceneMaterial m = material("Kd 0.5 0.25 0.125\nKs 0.3 0.3 0.3\nNs 30\nillum 2\n");
  EXPECT_NEAR(m.base_color.r, 0.5f, 1e-5f);
  EXPECT_NEAR(m.base_color.b, 0.125f, 1e-5f);
  EXPECT_NEAR(m.roughness, 0.5f, 1e-3f);  // (2 / 32)^(1/4)
  EXPECT_EQ(m.metallic, 0);
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(material("Kd 0.5 0.5 0.5\nNs 900\nillum 1\n").roughness, 1);  // no highlight
}

TEST_F(ObjMaterials, BlackWithABrightHighlightIsMetal) {
  const SceneMaterial m = material("Kd 0 0 0\nKs 0.9 0.7 0.3\nNs 100\nillum 2\n");
  EXPECT_EQ(m.metallic, 1);
  EXPECT_NEAR(m.base_color.g, 0.7f, 1e-5f);
  EXPECT_EQ(material("Kd 0 0 0\nKs 0.5 0.5 0.5\nNs 100\nillum 2\n").metallic, 0);  // plastic
}

TEST_F(ObjMaterials, BlendersOwnNumbers) {
  const char* head = "# Blender 3.4.1\n";
  EXPECT_NEAR(material("Kd 1 1 1\nKs 0.5 0.5 0.5\nNs 490\nillum 2\n", head).roughness, 0.3f, 1e-3f);
  EXPECT_EQ(material("Kd 1 1 1\nKs 0.5 0.5 0.5\nNs 490\nillum 3\n", head).metallic, 1);
}

TEST_F(ObjMaterials, OpacityIsThinGlassThatLetsAsMuchThrough) {
  for (const char* mtl : {"Kd 0 0 0\nd 0.25\n", "Kd 0.5 0.5 0.5\nd 0.25\n", "Kd 1 1 1\nd 0.25\n"}) {
    const SceneMaterial m = material(mtl);
    EXPECT_NEAR(m.transmission * m.base_color.r, 0.75f, 1e-4f) << mtl;
  }
  const SceneMaterial grey = material("Kd 0.5 0.5 0.5\nd 0.25\n");
  EXPECT_NEAR((1 - grey.transmission) * grey.base_color.r, 0.25f * 0.5f, 1e-4f);
}

TEST_F(ObjMaterials, EmissionOfOneIsAWhiteScreen) {
  EXPECT_NEAR(material("Kd 0 0 0\nKe 0 2 1\n").emission.g, 2 * 179, 1e-2f);
}

TEST_F(ObjMaterials, TexturesWhereverTheyLie) {
  folder_.write("wood.png", png(200, 100, 50));
  std::filesystem::create_directories(folder_.path() / "Textures" / "2k");
  folder_.write("Textures/2k/Brick.PNG", png(10, 20, 30));
  for (const auto& [path, red] : {std::pair{"wood.png", 200},
                                  {"./wood.png", 200},
                                  {"WOOD.png", 200},
                                  {"C:\\Users\\me\\wood.png", 200},
                                  {"/home/me/maps/brick.png", 10}}) {
    const Imported in = read(std::string("Kd 0.1 0.1 0.1\nmap_Kd ") + path + "\n");
    ASSERT_TRUE(in.ok()) << in.error();
    ASSERT_EQ(in.scene().images.size(), 1u) << path;
    EXPECT_EQ(in.scene().images[0].texels.at(0), red) << path;
    std::vector<std::string> inputs;
    for (const auto& [name, hash] : in.result->inputs) inputs.push_back(name);
    EXPECT_THAT(inputs,
                ::testing::UnorderedElementsAre("a.obj", "a.mtl", red == 10 ? "Textures/2k/Brick.PNG" : "wood.png"));
    const SceneMaterial& m = in.scene().materials.at(in.scene().surfaces[0].material);
    EXPECT_EQ(m.base_color.r, 1) << "the texture stands for the colour";
    EXPECT_EQ(in.scene().uv0.at(0).y + in.scene().uv0.at(2).y, 1);
  }
}

TEST_F(ObjMaterials, MaterialFileInOtherLetters) {
  const Imported in = read("Kd 0 1 0\n", "", "A.MTL");
  ASSERT_TRUE(in.ok()) << in.error();
  EXPECT_EQ(in.scene().materials.at(in.scene().surfaces[0].material).base_color.g, 1);
}

TEST_F(ObjMaterials, MissingTextureIsAWarning) {
  const Imported in = read("Kd 0.5 0.25 0.125\nmap_Kd gone.png\n");
  ASSERT_TRUE(in.ok()) << in.error();
  EXPECT_TRUE(in.warned("gone.png"));
  EXPECT_TRUE(in.scene().images.empty());
  EXPECT_NEAR(in.scene().materials.at(in.scene().surfaces[0].material).base_color.r, 0.5f, 1e-5f);
}

TEST_F(ObjMaterials, PicturesThatGltfDoesNotKnow) {
  folder_.write("wood.tga", test::tga(200, 100, 50));
  const Imported in = read("map_Kd wood.tga\n");
  ASSERT_TRUE(in.ok()) << in.error();
  ASSERT_EQ(in.scene().images.size(), 1u);
  EXPECT_EQ(in.scene().images[0].texels.at(0), 200);
  EXPECT_EQ(in.scene().images[0].texels.at(2), 50);
  folder_.write("wood.tga", "no picture at all");
  EXPECT_TRUE(read("map_Kd wood.tga\n").warned("wood.tga"));
}

TEST_F(ObjMaterials, OpacityMapsCutOut) {
  folder_.write("leaf.png", png(20, 200, 20));
  folder_.write("mask.png", half_mask());
  const Imported in = read("map_Kd leaf.png\nmap_d mask.png\n");
  ASSERT_TRUE(in.ok()) << in.error();
  EXPECT_EQ(in.scene().materials.at(in.scene().surfaces[0].material).alpha_mode, AlphaMode::kMask);
  ASSERT_EQ(in.scene().images.size(), 1u);
  const auto& texels = in.scene().images[0].texels;
  EXPECT_EQ(texels.at(1), 200);
  EXPECT_EQ(texels.at(3), 0);
  EXPECT_EQ(texels.at(15), 255);
}

TEST_F(ObjMaterials, NormalMapsButNoBumps) {
  folder_.write("n.png", png(128, 128, 255));
  folder_.write("b.png", png(90, 90, 90));
  EXPECT_GE(material("map_Bump n.png\n").normal_texture.image, 0);
  const Imported in = read("map_Bump b.png\n");
  ASSERT_TRUE(in.ok());
  EXPECT_LT(in.scene().materials.at(in.scene().surfaces[0].material).normal_texture.image, 0);
  EXPECT_TRUE(in.warned("bump"));
}

}  // namespace
}  // namespace oriel
