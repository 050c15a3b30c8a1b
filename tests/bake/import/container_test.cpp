// The file as bytes: GLB, JSON, URIs, and what hostile ones do.
#include <gtest/gtest.h>

#include "bake/import/container.h"
#include "bake/import/json.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

std::string as_text(const Result<Bytes>& bytes) {
  return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())
               : "error: " + bytes.error().text();
}

TEST(Container, GltfAndGlbGiveTheSameScene) {
  const Gltf g = triangle();
  const Imported text = import(g), glb = import_bytes(g.glb());
  ASSERT_TRUE(text.ok()) << text.error();
  ASSERT_TRUE(glb.ok()) << glb.error();
  EXPECT_EQ(text.scene().positions, glb.scene().positions);
  EXPECT_EQ(broken_promise(text.scene()), "");
}

TEST(Container, OnlyTheSceneFileItselfIsAnIoError) {
  EXPECT_EQ(import_file("/nonexistent/scene.glb").result.error().code, ErrorCode::kIo);
  const TempFolder folder;
  EXPECT_EQ(import_file(folder.path()).result.error().code, ErrorCode::kIo);
  Gltf g = triangle();
  g.doc["buffers"] = {{{"byteLength", 36}, {"uri", "missing.bin"}}};
  const Imported missing = import(g);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.result.error().code, ErrorCode::kInvalid);
  EXPECT_NE(missing.error().find("missing.bin"), std::string::npos);
}

TEST(Container, EveryTruncationOfAGlbIsRefused) {
  const std::string glb = triangle().glb();
  for (std::size_t n = 0; n < glb.size(); ++n) {
    const Imported cut = import_bytes(glb.substr(0, n));
    ASSERT_FALSE(cut.ok()) << n;
    ASSERT_EQ(cut.result.error().code, ErrorCode::kInvalid) << n;
  }
}

// Downloads and exporters leave bytes behind the end, marks before the JSON and zeros after it.
TEST(Container, WhatIsAroundTheFileIsSkippedWithAWord) {
  const Gltf g = triangle();
  const Imported longer = import_bytes(g.glb() + "more");
  ASSERT_TRUE(longer.ok()) << longer.error();
  EXPECT_TRUE(longer.warned("4 bytes after the GLB's end are ignored"));
  const Imported marked = import_bytes("\xEF\xBB\xBF" + g.text());
  ASSERT_TRUE(marked.ok()) << marked.error();
  EXPECT_TRUE(marked.warned("byte order mark"));
  EXPECT_EQ(marked.scene().positions, longer.scene().positions);
  const Imported padded = import_bytes(g.text() + std::string(3, '\0'));
  ASSERT_TRUE(padded.ok()) << padded.error();
  EXPECT_TRUE(padded.warned("zero bytes"));
}

TEST(Container, DeepJsonIsRefusedBeforeAnyoneRecurses) {
  EXPECT_NE(import_bytes(std::string(200000, '[')).error(), "");
  const Imported deep = import_bytes("{\"extras\":" + std::string(200000, '[') + std::string(200000, ']') + "}");
  EXPECT_NE(deep.error().find("deeper"), std::string::npos) << deep.error();
  Gltf g = triangle();
  g.doc["extras"] = std::string(1000, '[');  // brackets in strings do not count
  EXPECT_TRUE(import(g).ok());
}

TEST(Container, Base64IsStrict) {
  const auto decode = [](const std::string& uri) { return as_text(gltf::decode_data_uri(uri, "here")); };
  EXPECT_EQ(decode("data:;base64,"), "");
  EXPECT_EQ(decode("data:;base64,T3JpZWw="), "Oriel");
  EXPECT_EQ(decode("data:application/octet-stream;base64,T3JpZWw="), "Oriel");
  EXPECT_EQ(decode("data:text/plain;charset=utf-8;base64,T3I="), "Or");
  for (const char* bad :
       {"data:;base64,T3JpZWw", "data:;base64,T3J\npZWw=", "data:;base64,T3Jp=Ww=", "data:;base64,=AAA",
        "data:;base64,T3JpZWx=", "data:a/b;;base64,AA==", "data:a;base64,AA==", "data:,Oriel", "data:;base64;AA=="})
    EXPECT_EQ(decode(bad).rfind("error: ", 0), 0u) << bad;
  for (std::size_t n = 0; n < 20; ++n) {
    const std::string text = std::string("Oriel bakes the light").substr(0, n);
    EXPECT_EQ(decode("data:;base64," + base64(text)), text);
  }
}

TEST(Container, UrisAreRelativeAndDecoded) {
  const auto path = [](const char* uri) {
    const auto p = gltf::path_from_uri(uri, "here");
    return p ? p->string() : "error: " + p.error().text();
  };
  EXPECT_EQ(path("a%20b.bin"), "a b.bin");
  EXPECT_EQ(path("a b.bin"), "a b.bin");
  EXPECT_EQ(path("%E2%9D%A4.png"), "❤.png");
  EXPECT_EQ(path("❤.png"), "❤.png");
  EXPECT_EQ(path("textures/../x.png"), "textures/../x.png");
  EXPECT_EQ(path("dir/a:b.png"), "dir/a:b.png");
  for (const char* bad : {"", "http://example.org/a.bin", "file:///etc/passwd", "/etc/passwd", "%2Fetc/passwd",
                          "C:/a.bin", "\\\\host\\a", "a%2", "a%zz", "a%00b"})
    EXPECT_EQ(path(bad).rfind("error: ", 0), 0u) << bad;
}

TEST(Container, DevicesAndPipesAreNotRead) {
  Gltf g = triangle();
  g.doc["buffers"] = {{{"byteLength", 36}, {"uri", "../../../../../../../../dev/zero"}}};
  const Imported zero = import(g);
  EXPECT_NE(zero.error().find("regular"), std::string::npos) << zero.error();
}

TEST(Container, ExternalFilesAreHashed) {
  Gltf g = triangle();
  const std::string bin = g.buffer;
  g.doc["buffers"] = {{{"byteLength", bin.size()}, {"uri", "part%20one.bin"}}};
  const TempFolder folder;
  folder.write("part one.bin", bin);
  const Imported scene = import_file(folder.write("s.gltf", g.text()));
  ASSERT_TRUE(scene.ok()) << scene.error();
  ASSERT_EQ(scene.result->inputs.size(), 2u);
  EXPECT_EQ(scene.result->inputs[0].first, "s.gltf");
  EXPECT_EQ(scene.result->inputs[1].first, "part one.bin");
  EXPECT_EQ(scene.result->inputs[1].second.size(), 32u);
}

TEST(Json, FirstMistakeIsKeptWithItsPath) {
  const std::string text = R"({"a":[1,{"b":"x"}],"n":1e300,"i":3.0,"neg":-1})";
  auto doc = gltf::JsonDocument::parse(std::as_bytes(std::span(text)), "f");
  ASSERT_TRUE(doc);
  const gltf::JsonAt root = doc->root();
  EXPECT_EQ(root["i"].integer(0), 3u);
  EXPECT_TRUE(doc->status());
  EXPECT_EQ(root["a"].at(1)["b"].number(7), 7);
  root["n"].integer(0);
  root["neg"].integer(0);
  EXPECT_EQ(doc->status().error().text(), "f: a[1].b: found \"x\", expected a number");
}

TEST(Json, WhatIsNotJsonIsNamed) {
  for (const char* bad : {"", "[]", "{", "{\"asset\":{\"version\":\"2.0\"}", "{\"a\":1e999}", "{\"a\":\"\xFF\"}",
                          "\xEF\xBB\xBF{}", "PK\x03\x04"}) {
    const Imported r = import_bytes(bad);
    ASSERT_FALSE(r.ok()) << bad;
    EXPECT_EQ(r.result.error().code, ErrorCode::kInvalid) << bad;
    EXPECT_NE(r.error().find("scene.gltf"), std::string::npos) << r.error();
  }
}

// Mutations of a small file that uses most of the reader: whatever comes out, it comes out.
TEST(Fuzz, MutatedGlbNeverCrashesAndNeverBreaksAPromise) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1}),
            n = g.floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int uv = g.floats("VEC2", {0, 0, 1, 0, 0, 1, 1, 1});
  json& node = g.add({{"attributes", {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", uv}}},
                      {"indices", g.indices({0, 1, 2, 2, 1, 3})},
                      {"material", 0}});
  node["rotation"] = {0, 0, 0.6, 0.8};
  node["scale"] = {1, -1, 2};
  g.material() =
      json::parse(
          R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0},"emissiveFactor":[1,1,1]})")
          .value();
  const std::string good = g.glb();
  ASSERT_TRUE(import_bytes(good).ok()) << import_bytes(good).error();
  std::uint64_t state = 1;
  const auto next = [&] { return (state = state * 6364136223846793005ull + 1442695040888963407ull) >> 33; };
  int accepted = 0, refused = 0;
  for (int i = 0; i < 600; ++i) {
    std::string bad = good;
    for (std::uint64_t k = 0; k <= next() % 4; ++k) {
      const std::size_t at = next() % bad.size();
      // Digits for digits half of the time, so that the JSON stays well-formed and its meaning changes.
      const bool digit = bad[at] >= '0' && bad[at] <= '9' && next() % 2 == 0;
      bad[at] = static_cast<char>(digit ? '0' + next() % 10 : next() % 256);
    }
    const Imported r = import_bytes(bad);
    ++(r.ok() ? accepted : refused);
    if (r.ok()) {
      ASSERT_EQ(broken_promise(r.scene()), "") << i;
    }
    if (!r.ok()) {
      ASSERT_FALSE(r.error().empty()) << i;
    }
  }
  EXPECT_GT(accepted, 20);  // else the mutations never get past the syntax
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace oriel::test
