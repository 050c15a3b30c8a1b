#include <gtest/gtest.h>

#include "formats/core/json.h"
#include "scenes/generators.h"
#include "scenes/kit/glb_writer.h"
#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

struct Parsed {
  Json json;
  Bytes binary;
};

Parsed parse(const Bytes& bytes) {
  ByteReader reader(bytes);
  EXPECT_EQ(reader.get<std::uint32_t>(), 0x46546C67u);
  EXPECT_EQ(reader.get<std::uint32_t>(), 2u);
  EXPECT_EQ(reader.get<std::uint32_t>(), bytes.size());
  Parsed parsed;
  const auto json_size = reader.get<std::uint32_t>();
  EXPECT_EQ(json_size % 4, 0u);
  EXPECT_EQ(reader.get<std::uint32_t>(), 0x4E4F534Au);
  const auto text = reader.get_array<char>(json_size);
  parsed.json = Json::parse({text.data(), text.size()}).value_or(Json());
  const auto binary_size = reader.get<std::uint32_t>();
  EXPECT_EQ(binary_size % 4, 0u);
  EXPECT_EQ(reader.get<std::uint32_t>(), 0x004E4942u);
  parsed.binary = reader.get_array<std::byte>(binary_size);
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.remaining(), 0u);
  return parsed;
}

std::vector<double> read_accessor(const Parsed& parsed, const Json& accessor) {
  const auto& view = parsed.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::string type = accessor["type"].get<std::string>();
  const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
  const std::size_t count = accessor["count"].get<std::size_t>() * components;
  const auto offset = view["byteOffset"].get<std::size_t>(), length = view["byteLength"].get<std::size_t>();
  EXPECT_LE(offset + length, parsed.binary.size());
  EXPECT_EQ(offset % 4, 0u);
  ByteReader reader(std::span(parsed.binary).subspan(offset, length));
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    switch (accessor["componentType"].get<int>()) {
      case 5126:
        values.push_back(reader.get<float>());
        break;
      case 5125:
        values.push_back(reader.get<std::uint32_t>());
        break;
      case 5123:
        values.push_back(reader.get<std::uint16_t>());
        break;
      default:
        ADD_FAILURE() << "component type " << accessor["componentType"];
    }
  }
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.remaining(), 0u);
  return values;
}

void expect_valid(const SampleScene& scene) {
  SCOPED_TRACE(scene.name);
  const auto bytes = write_glb(scene);
  ASSERT_TRUE(bytes) << bytes.error().text();
  const Parsed parsed = parse(*bytes);
  ASSERT_TRUE(parsed.json.is_object());
  EXPECT_EQ(parsed.json["buffers"][0]["byteLength"], parsed.binary.size());
  for (const auto& accessor : parsed.json["accessors"]) {
    const std::vector<double> values = read_accessor(parsed, accessor);
    if (!accessor.contains("min")) continue;
    const std::size_t components = accessor["min"].size();
    for (std::size_t c = 0; c < components; ++c) {
      double low = values[c], high = values[c];
      for (std::size_t i = c; i < values.size(); i += components) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      EXPECT_EQ(accessor["min"][c].get<double>(), low);
      EXPECT_EQ(accessor["max"][c].get<double>(), high);
    }
  }
  for (const auto& mesh : parsed.json["meshes"]) {
    const auto& primitive = mesh["primitives"][0];
    const auto& position = parsed.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    EXPECT_TRUE(position.contains("min"));
    for (const double index :
         read_accessor(parsed, parsed.json["accessors"][primitive["indices"].get<std::size_t>()])) {
      ASSERT_LT(index, position["count"].get<double>()) << mesh["name"];
    }
  }
  EXPECT_EQ(*bytes, *write_glb(scene)) << "not deterministic";
}

SampleScene one_quad() {
  SampleScene scene;
  scene.name = "quad";
  add_material(scene, SampleMaterial{});
  SampleMesh mesh{"quad", 0};
  add_quad(mesh, {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
  place(scene, std::move(mesh));
  return scene;
}

TEST(Glb, AllScenesAreValidAndDeterministic) {
  expect_valid(one_quad());
  expect_valid(make_cornell());
  expect_valid(make_gallery());
  expect_valid(make_glass());
  expect_valid(make_panels());
  expect_valid(make_room());
  expect_valid(make_room({.closed = false}));
  HouseOptions options;
  options.triangles = 20'000;
  const auto house = make_house(options);
  ASSERT_TRUE(house) << house.error().text();
  expect_valid(*house);
}

TEST(Glb, GeneratorsAreDeterministic) {
  EXPECT_EQ(*write_glb(make_gallery()), *write_glb(make_gallery()));
  EXPECT_EQ(*write_glb(*make_house({})), *write_glb(*make_house({})));
}

TEST(Glb, AnotherUnitChangesNothingButSize) {
  const SampleScene metres = make_gallery();
  SampleScene scene = metres;
  scale_scene(scene, 1000);
  expect_valid(scene);
  EXPECT_EQ(scene.meshes[0].positions[1], 1000.0f * metres.meshes[0].positions[1]);
  EXPECT_EQ(scene.meshes[0].normals, metres.meshes[0].normals);
  EXPECT_EQ(scene.nodes.back().position, 1000.0f * metres.nodes.back().position);
  EXPECT_EQ(scene.cameras[0].eye, 1000.0f * metres.cameras[0].eye);
  EXPECT_EQ(scene.cameras[0].target, 1000.0f * metres.cameras[0].target);
  EXPECT_EQ(scene.cameras[0].vertical_fov_rad, metres.cameras[0].vertical_fov_rad);
  EXPECT_EQ(scene.paths[0].eyes[7], 1000.0f * metres.paths[0].eyes[7]);
  EXPECT_EQ(scene.paths[0].forwards, metres.paths[0].forwards);
  for (std::size_t i = 0; i < metres.materials.size(); ++i)
    EXPECT_EQ(scene.materials[i].emission, metres.materials[i].emission);
}

TEST(Glb, LargeMeshesHaveWideIndices) {
  SampleScene scene = one_quad();
  SampleMesh& mesh = scene.meshes[0];
  mesh.positions.clear();
  mesh.normals.clear();
  mesh.indices.clear();
  add_rounded_box(mesh, Vec3(0), Vec3(1), 0.1f, 120);
  ASSERT_GT(mesh.positions.size(), 65535u);
  expect_valid(scene);
}

TEST(Glb, RefusesAnInconsistentScene) {
  const auto refused = [](auto&& change, const char* why) {
    SampleScene scene = one_quad();
    change(scene);
    const auto bytes = write_glb(scene);
    ASSERT_FALSE(bytes) << why;
    EXPECT_EQ(bytes.error().code, ErrorCode::kInvalid) << why;
  };
  refused([](SampleScene& s) { s.meshes[0].indices[0] = 4; }, "index out of range");
  refused([](SampleScene& s) { s.meshes[0].indices.pop_back(); }, "two thirds of a triangle");
  refused([](SampleScene& s) { s.meshes[0].normals.pop_back(); }, "a normal too few");
  refused([](SampleScene& s) { s.meshes[0].material = 1; }, "no such material");
  refused([](SampleScene& s) { s.nodes[0].mesh = 1; }, "no such mesh");
  refused([](SampleScene& s) { s.materials[0].texture = 0; }, "a texture that is not there");
  refused([](SampleScene& s) { s.meshes[0].positions[0].x = NAN; }, "not a number");
  refused([](SampleScene& s) { s.paths.emplace_back(); }, "a path without keys");
}

TEST(Glb, CamerasLookTheirWay) {
  SampleScene scene = one_quad();
  for (const Vec3& forward : {Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0),
                              Vec3(0, -1, 0), Vec3(0.6f, -0.64f, 0.48f), Vec3(-0.6f, 0.48f, -0.64f)}) {
    scene.cameras.push_back({"camera", Vec3(1, 2, 3), Vec3(1, 2, 3) + forward, 1});
  }
  const Parsed parsed = parse(*write_glb(scene));
  std::size_t camera = 0;
  for (const auto& node : parsed.json["nodes"]) {
    if (!node.contains("camera")) continue;
    const auto q = node["rotation"].get<std::vector<double>>();
    const DVec3 axis(q[0], q[1], q[2]);
    const auto rotate = [&](const DVec3& v) { return v + 2.0 * glm::cross(axis, glm::cross(axis, v) + q[3] * v); };
    const Vec3 wanted = scene.cameras[camera].target - scene.cameras[camera].eye;
    EXPECT_LT(glm::length(Vec3(rotate(DVec3(0, 0, -1))) - wanted), 1e-5f) << camera;
    EXPECT_GE(rotate(DVec3(0, 1, 0)).y, -1e-6) << camera << " is upside down";
    EXPECT_NEAR(glm::dot(axis, axis) + q[3] * q[3], 1, 1e-6);
    ++camera;
  }
  EXPECT_EQ(camera, scene.cameras.size());
}

}  // namespace
}  // namespace oriel::sample
