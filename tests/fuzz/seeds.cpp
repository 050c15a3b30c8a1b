// fuzz_seeds FOLDER: small files with one of everything, from which the fuzzer starts: FOLDER/pack and FOLDER/gltf.
#include <cstdio>
#include <fstream>

#include "formats/pack/writer.h"
#include "tests/bake/import/gltf_maker.h"
#include "tests/formats/pack/forge.h"
#include "tests/support/tiny_pack.h"

namespace {

namespace fs = std::filesystem;
using namespace oriel;

void write(const fs::path& path, std::string_view bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string_view text(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void write_packs(const fs::path& folder) {
  write(folder / "tiny.oriel", text(encode_pack(testing::tiny_pack()).value()));
  const Bytes mapped = encode_pack(testing::tiny_mapped_pack()).value();
  write(folder / "mapped.oriel", text(mapped));
  // The same without compression: the fuzzer's own mutations then change values.
  auto plain = testing::Forge::from(mapped);
  for (auto& section : plain.sections)
    if (section.record.codec == 1) testing::Forge::set_raw(section, testing::Forge::raw(section));
  write(folder / "plain.oriel", text(plain.file()));
}

// Two triangles with everything that a vertex can have, under materials with every extension's parameters.
test::Gltf quad() {
  test::Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1});
  const int n = g.floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int t = g.floats("VEC4", {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
  const int uv = g.floats("VEC2", {0, 0, 1, 0, 0, 1, 1, 1});
  const int color = g.accessor(std::string(16, '\x80'), 5121, "VEC4", 4, true);
  test::json& node = g.add(
      {{"attributes",
        {{"POSITION", p}, {"NORMAL", n}, {"TANGENT", t}, {"TEXCOORD_0", uv}, {"TEXCOORD_1", uv}, {"COLOR_0", color}}},
       {"indices", g.indices({0, 1, 2, 2, 1, 3})},
       {"material", 0}});
  node["name"] = "quad";
  node["rotation"] = {0, 0, 0.6, 0.8};
  node["scale"] = {1, -1, 2};
  g.material() = test::json::parse(R"({"name":"all","alphaMode":"MASK","alphaCutoff":0.4,"doubleSided":true,
    "pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0.3,"roughnessFactor":0.2,
      "baseColorTexture":{"index":0,"texCoord":1,"extensions":{"KHR_texture_transform":{"offset":[0.5,0],"scale":[2,2],"rotation":1}}}},
    "normalTexture":{"index":0,"scale":0.5},"emissiveTexture":{"index":0},"emissiveFactor":[1,1,1],
    "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":5},"KHR_materials_ior":{"ior":1.4},
      "KHR_materials_specular":{"specularFactor":0.5},"KHR_materials_transmission":{"transmissionFactor":0.5},
      "KHR_materials_volume":{"thicknessFactor":0.1,"attenuationDistance":2,"attenuationColor":[1,0.5,0]},
      "KHR_materials_clearcoat":{"clearcoatFactor":1},"KHR_materials_anisotropy":{"anisotropyStrength":0.5},
      "KHR_materials_sheen":{"sheenColorFactor":[0.1,0.1,0.1]}}})")
                     .value();
  return g;
}

// The same with an image, lamps, a camera, an animated node and a sparse accessor.
test::Gltf room() {
  test::Gltf g = quad();
  // A PNG of 1 x 1 texels.
  g.doc["images"] = {
      {{"uri",
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9"
        "awAAAABJRU5ErkJggg=="}}};
  g.doc["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  g.doc["textures"] = {{{"source", 0}, {"sampler", 0}}};
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] =
      test::json::parse(
          R"([{"type":"point","intensity":100},{"type":"spot","intensity":50,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.5}},
          {"type":"directional","color":[1,0.9,0.8]}])")
          .value();
  g.doc["cameras"] =
      test::json::parse(
          R"([{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}},{"type":"orthographic","orthographic":{"xmag":2,"ymag":1,"znear":0,"zfar":9}}])")
          .value();
  const auto add_node = [&](test::json node) {
    g.doc["nodes"].push_back(std::move(node));
    g.doc["scenes"][0]["nodes"].push_back(g.doc["nodes"].size() - 1);
    return static_cast<int>(g.doc["nodes"].size()) - 1;
  };
  for (int light = 0; light < 3; ++light)
    add_node({{"translation", {0, 2, light}}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
  test::animate(g, add_node({{"camera", 0}}), "translation", {0, 1}, {0, 0, 0, 1, 1, 1}, "LINEAR");
  add_node({{"camera", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}}});
  test::animate(g, 0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0}, "STEP");
  return g;
}

void write_scenes(const fs::path& folder) {
  write(folder / "triangle.glb", test::triangle().glb());
  write(folder / "quad.glb", quad().glb());
  write(folder / "room.glb", room().glb());
  write(folder / "room.gltf", room().text());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
    return 1;
  }
  write_packs(fs::path(argv[1]) / "pack");
  write_scenes(fs::path(argv[1]) / "gltf");
  return 0;
}
