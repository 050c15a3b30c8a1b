// Damaged files of each format: ORIEL_FUZZ_FILES=500 of them, else a few.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "convert/import_process.h"
#include "formats/core/file.h"
#include "tests/bake/import/gltf_maker.h"
#include "tests/convert/source_text.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;

std::vector<std::pair<std::string, std::string>> seeds() {
  const std::array<float, 9> triangle = {0, 0, 0, 2, 0, 0, 0, 0, 3};
  std::vector<std::pair<std::string, std::string>> out = {
      {"a.ifc", test::ifc_wall("IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)")},
      {"b.ifc", test::ifc4_wall()},
      {"a.dae", test::collada("")},
      {"a.fbx", test::fbx("")},
      {"a.3ds", test::three_ds()},
      {"a.stl", test::binary_stl({reinterpret_cast<const char*>(triangle.data()), sizeof(triangle)})},
      {"a.obj", "mtllib a.mtl\no wall\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 3/1/1\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
       "1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n0 0 3\n3 0 1 2\n"}};
  // A folder of more, which other programs wrote.
  if (const char* folder = std::getenv("ORIEL_FUZZ_SEEDS"))
    for (const auto& entry : fs::directory_iterator(folder))
      if (const auto bytes = read_file(entry.path()))
        out.emplace_back(entry.path().filename().string(),
                         std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
  return out;
}

void mutate(std::string& bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t times = 1 + below(8); times-- > 0 && !bytes.empty();) {
    const std::size_t at = below(bytes.size()), length = std::min(bytes.size() - at, 1 + below(64));
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(below(bytes.size()), bytes.substr(at, length));
        break;
      case 4:
        bytes.replace(at, std::min<std::size_t>(length, 4), "\xFF\xFF\xFF\x7F");
        break;
      default:
        bytes.replace(at, 1, "99999999");
    }
  }
}

TEST(ImportFuzz, DamagedFilesAreReadOrRefusedInTime) {
  const char* wanted = std::getenv("ORIEL_FUZZ_FILES");
  const int count = wanted ? std::atoi(wanted) : 8;
  const auto originals = seeds();
  const test::TempFolder folder;
  int read = 0, refused = 0, limited = 0;
  for (int i = 0; i < count; ++i) {
    std::mt19937 random(static_cast<unsigned>(i));
    auto [name, bytes] = originals[static_cast<std::size_t>(i) % originals.size()];
    mutate(bytes, random);
    const fs::path file = folder.write(name, bytes);
    ImportProcess process;
    process.time_s = 20;
    process.memory_bytes = 2ull << 30;
    const SourceFormat format{"file", name.substr(name.size() - 3), "export glTF"};
    const auto begin = std::chrono::steady_clock::now();
    const auto glb = import_by_process(file, format, process);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(took.count(), process.time_s + 5) << i;
    if (glb) {
      ++read;
      EXPECT_EQ(std::string(reinterpret_cast<const char*>(glb->data()), 4), "glTF") << i;
    } else {
      ++(glb.error().code == ErrorCode::kInvalid ? refused : limited);
      EXPECT_NE(glb.error().text().find(name), std::string::npos) << i << ": " << glb.error().text();
    }
    fs::remove(file);
    EXPECT_TRUE(fs::is_empty(folder.path())) << i;
  }
  if (wanted) fmt::print("{} files: {} read, {} refused, {} over a limit\n", count, read, refused, limited);
}

}  // namespace
}  // namespace oriel
