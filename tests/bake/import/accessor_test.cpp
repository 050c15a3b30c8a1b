// Accessors, buffer views and compression.
#include <draco/compression/expert_encode.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <limits>

#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

template <class T>
std::string raw(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// World positions, as origin + stored.
std::vector<Vec3> world(const Scene& scene) {
  std::vector<Vec3> out;
  for (const Vec3& p : scene.positions) out.emplace_back(DVec3(p) + scene.origin);
  return out;
}

void expect_refused(const Gltf& g, const std::string& part) {
  const Imported r = import(g);
  ASSERT_FALSE(r.ok()) << "expected: " << part;
  EXPECT_EQ(r.result.error().code, ErrorCode::kInvalid);
  EXPECT_NE(r.error().find(part), std::string::npos) << r.error();
}

TEST(Accessor, BoundsAreCheckedWithoutOverflow) {
  for (const double count : {4.0, 1e18, 1.8e19, 4611686018427387904.0, -1.0, 2.5}) {
    Gltf g = triangle();
    g.doc["accessors"][0]["count"] = count;
    expect_refused(g, "accessors[0]");
  }
  Gltf offset = triangle();
  offset.doc["accessors"][0]["byteOffset"] = 9007199254740988;
  expect_refused(offset, "accessors[0]");
  Gltf stride = triangle();
  stride.doc["bufferViews"][0]["byteStride"] = 16;
  expect_refused(stride, "accessors[0]");
  Gltf small = triangle();
  small.doc["bufferViews"][0]["byteStride"] = 8;
  expect_refused(small, "byteStride");
}

TEST(Accessor, ZerosWithoutBytesAreBounded) {
  Gltf g;
  g.doc["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 100'000'000}});
  g.add({{"attributes", {{"POSITION", 0}}}});
  expect_refused(g, "without a bufferView");
}

TEST(Accessor, MemoryLimitHolds) {
  ImportOptions options;
  options.max_bytes = 2000;
  Gltf g = triangle();
  g.floats("VEC3", std::vector<float>(300));
  EXPECT_FALSE(import(g, options).ok());
}

TEST(Accessor, InterleavedNormalizedAndSparse) {
  Gltf g;
  // Positions and unsigned-short colours interleaved in 20 bytes.
  std::string bytes;
  const float p[3][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  for (int i = 0; i < 3; ++i)
    bytes += std::string(reinterpret_cast<const char*>(p[i]), 12) + raw<std::uint16_t>({65535, 0, 32768, 65535});
  const int view = g.view(bytes);
  g.doc["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 20;
  const int values = g.view(raw<float>({5, 5, 5})), at = g.view(raw<std::uint8_t>({1}));
  g.doc["accessors"] = {{{"bufferView", view},
                         {"componentType", 5126},
                         {"type", "VEC3"},
                         {"count", 3},
                         {"sparse",
                          {{"count", 1},
                           {"indices", {{"bufferView", at}, {"componentType", 5121}}},
                           {"values", {{"bufferView", values}}}}}},
                        {{"bufferView", view},
                         {"byteOffset", 12},
                         {"componentType", 5123},
                         {"normalized", true},
                         {"type", "VEC4"},
                         {"count", 3}}};
  g.add({{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}});
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(world(r.scene()), (std::vector<Vec3>{{0, 0, 0}, {5, 5, 5}, {0, 2, 0}}));
  EXPECT_EQ(r.scene().colors, std::vector<std::uint32_t>(3, 0xFF8000FFu));

  g.doc["accessors"][0]["sparse"]["count"] = 4;
  expect_refused(g, "sparse");
  g.doc["accessors"][0]["sparse"]["count"] = 2;
  expect_refused(g, "inside of bufferView");  // overrun of one index byte
  g.doc["accessors"][0]["sparse"]["count"] = 1;
  g.buffer.back() = 3;  // index 3 of 3
  expect_refused(g, "sparse.indices");
}

// A hole in a mesh would leak light; a normal, a tangent or a texture coordinate has a stand-in.
TEST(Accessor, NotFiniteIsRefusedInPositionsOnly) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Gltf g;
    g.add({{"attributes", {{"POSITION", g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, bad, 0})}}}});
    expect_refused(g, "NaN or infinity");
    Gltf unread = triangle();
    unread.floats("VEC4", {0, 0, 0, bad});
    const Imported unused = import(unread);
    EXPECT_TRUE(unused.ok() && unused.warnings.empty()) << unused.error();
    Gltf mended;
    mended.material()["normalTexture"] = {{"index", 0}};
    mended.doc["textures"] = {{{"source", 0}}};
    mended.doc["images"] = {{{"uri", "missing.png"}}};
    mended.add({{"material", 0},
                {"attributes",
                 {{"POSITION", mended.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0})},
                  {"NORMAL", mended.floats("VEC3", {0, 0, 1, 0, bad, 1, 0, 0, 1})},
                  {"TANGENT", mended.floats("VEC4", {1, 0, 0, 1, bad, bad, 0, 1, 1, 0, 0, 1})},
                  {"TEXCOORD_0", mended.floats("VEC2", {0, 0, bad, 0, 0, 1})}}}});
    const Imported r = import(mended);
    ASSERT_TRUE(r.ok()) << r.error();
    EXPECT_EQ(broken_promise(r.scene()), "");
    EXPECT_TRUE(r.warned("attributes.NORMAL: 1 numbers are NaN or infinite, the first in element 1"));
    EXPECT_TRUE(r.warned("attributes.TANGENT: 2 numbers"));
    EXPECT_TRUE(r.warned("attributes.TEXCOORD_0: 1 numbers"));
    for (const Vec3& n : r.scene().normals) EXPECT_EQ(n, Vec3(0, 0, 1));
  }
}

TEST(Accessor, IndicesAreChecked) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  g.add({{"attributes", {{"POSITION", p}}}, {"indices", g.indices({0, 1, 3})}});
  expect_refused(g, "found 3 as index 2, expected one below 3");
  g.doc["meshes"][0]["primitives"][0]["indices"] = g.indices({0, 1, 65535});
  expect_refused(g, "restart");
  g.doc["meshes"][0]["primitives"][0]["indices"] = p;
  expect_refused(g, "unsigned");
}

TEST(Accessor, QuantizedPositionsNeedTheExtension) {
  Gltf g;
  const int p = g.accessor(raw<std::int16_t>({0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0}), 5122, "VEC3", 3, true);
  g.doc["bufferViews"][0]["byteStride"] = 8;
  g.add({{"attributes", {{"POSITION", p}}}});
  expect_refused(g, "KHR_mesh_quantization");
  g.use("KHR_mesh_quantization", true);
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(world(r.scene()), (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
}

// A grid of 5 x 5 vertices, plain and as meshoptimizer's own encoders write it.
struct Grid {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  std::string vertex_data, triangle_data, sequence_data;

  Grid() {
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 5; ++x)
        positions.insert(positions.end(),
                         {static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y % 3)});
    for (std::uint32_t a = 0; a < 19; ++a)
      if (a % 5 != 4) indices.insert(indices.end(), {a, a + 1, a + 5, a + 5, a + 1, a + 6});
    const auto out = [](std::string& s) { return reinterpret_cast<unsigned char*>(s.data()); };
    vertex_data.resize(meshopt_encodeVertexBufferBound(25, 12));
    vertex_data.resize(meshopt_encodeVertexBuffer(out(vertex_data), vertex_data.size(), positions.data(), 25, 12));
    triangle_data.resize(meshopt_encodeIndexBufferBound(indices.size(), 25));
    triangle_data.resize(
        meshopt_encodeIndexBuffer(out(triangle_data), triangle_data.size(), indices.data(), indices.size()));
    sequence_data.resize(meshopt_encodeIndexSequenceBound(indices.size(), 25));
    sequence_data.resize(
        meshopt_encodeIndexSequence(out(sequence_data), sequence_data.size(), indices.data(), indices.size()));
  }

  Gltf plain() const {
    Gltf g;
    g.add({{"attributes", {{"POSITION", g.floats("VEC3", positions)}}},
           {"indices", g.accessor(raw(indices), 5125, "SCALAR", indices.size())}});
    return g;
  }

  Gltf compressed(bool as_sequence) const {
    Gltf g;
    g.use("EXT_meshopt_compression", true);
    const int v = compressed_view(g, vertex_data, 25, 12, "ATTRIBUTES");
    const int i = compressed_view(g, as_sequence ? sequence_data : triangle_data, indices.size(), 4,
                                  as_sequence ? "INDICES" : "TRIANGLES");
    g.doc["accessors"] = {{{"bufferView", v}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 25}},
                          {{"bufferView", i}, {"componentType", 5125}, {"type", "SCALAR"}, {"count", indices.size()}}};
    g.add({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    g.doc["buffers"] = {{{"byteLength", g.buffer.size()}, {"uri", "data:;base64," + base64(g.buffer)}},
                        {{"byteLength", 1000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return g;
  }

 private:
  static int compressed_view(Gltf& g, const std::string& data, std::size_t count, std::size_t stride,
                             const char* mode) {
    const int v = g.view(data);
    json& view = g.doc["bufferViews"][static_cast<std::size_t>(v)];
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", view["byteOffset"]},
                                                     {"byteLength", data.size()},
                                                     {"byteStride", stride},
                                                     {"count", count},
                                                     {"mode", mode}};
    view["buffer"] = 1;
    view["byteOffset"] = 0;
    view["byteLength"] = count * stride;
    return v;
  }
};

double total_area(const Scene& scene) {
  double area = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) area += triangle_area(scene, t);
  return area;
}

TEST(Compression, MeshoptGivesBackWhatWentIn) {
  const Grid grid;
  const Imported expected = import(grid.plain());
  ASSERT_TRUE(expected.ok()) << expected.error();
  for (const bool as_sequence : {false, true}) {
    Gltf g = grid.compressed(as_sequence);
    const Imported r = import(g);
    ASSERT_TRUE(r.ok()) << r.error();
    // The index codec may start a triangle at another corner, so vertices may come in another order.
    EXPECT_EQ(r.scene().triangles.size(), expected.scene().triangles.size());
    EXPECT_NEAR(glm::length(r.scene().upper - expected.scene().upper), 0, 1e-6f);
    EXPECT_NEAR(total_area(r.scene()), total_area(expected.scene()), 1e-6);
    g.doc["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 1'000'000'000;
    expect_refused(g, "bufferViews[0]");
  }
}

TEST(Compression, DamagedMeshoptDataIsAnErrorOrOtherDataButNoCrash) {
  for (const bool as_sequence : {false, true}) {
    Gltf g = Grid().compressed(as_sequence);
    for (std::size_t k = 0; k < g.buffer.size(); k += 3) {
      std::string bad = g.buffer;
      bad[k] = static_cast<char>(bad[k] ^ 0x5A);
      g.doc["buffers"][0]["uri"] = "data:;base64," + base64(bad);
      const Imported damaged = import(g);
      if (damaged.ok()) {
        ASSERT_EQ(broken_promise(damaged.scene()), "");
      }
    }
  }
}

TEST(Compression, DracoGivesBackWhatWentIn) {
  draco::Mesh mesh;
  mesh.set_num_points(4);
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id = mesh.AddAttribute(attribute, true, 4);
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (std::uint32_t i = 0; i < 4; ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), corners[i]);
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)});
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(2), draco::PointIndex(3)});
  draco::ExpertEncoder encoder(mesh);
  draco::EncoderBuffer encoded;
  ASSERT_TRUE(encoder.EncodeToBuffer(&encoded).ok());
  Gltf g;
  g.use("KHR_draco_mesh_compression", true);
  const int view = g.view(std::string(encoded.data(), encoded.size()));
  g.doc["accessors"] = {{{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}},
                        {{"componentType", 5125}, {"type", "SCALAR"}, {"count", 6}}};
  g.add({{"attributes", {{"POSITION", 0}}},
         {"indices", 1},
         {"extensions",
          {{"KHR_draco_mesh_compression",
            {{"bufferView", view}, {"attributes", {{"POSITION", mesh.attribute(id)->unique_id()}}}}}}}});
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().triangles.size(), 2u);
  EXPECT_NEAR(triangle_area(r.scene(), 0) + triangle_area(r.scene(), 1), 1, 1e-6);
  EXPECT_NEAR(geometric_normal(r.scene(), 0).z, 1, 1e-6);
  const std::string good = g.buffer;
  for (std::size_t k = 0; k < good.size(); ++k) {
    g.buffer = good;
    g.buffer[k] = static_cast<char>(g.buffer[k] ^ 0xFF);
    const Imported damaged = import(g);
    if (damaged.ok()) {
      ASSERT_EQ(broken_promise(damaged.scene()), "");
    }
  }
  g.buffer = good;
  g.doc["accessors"][0]["count"] = 5;
  expect_refused(g, "Draco's 4 vertices");
}

}  // namespace
}  // namespace oriel::test
