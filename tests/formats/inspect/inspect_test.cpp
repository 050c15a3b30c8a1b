// The program itself: exit codes, output and files.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/image/png.h"
#include "formats/pack/index.h"
#include "formats/pack/reader.h"
#include "formats/pack/writer.h"
#include "tests/formats/pack/forge.h"
#include "tests/support/exr.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

struct Outcome {
  int code = -1;
  std::string out, err;
};

std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class Inspect : public ::testing::Test {
 protected:
  void SetUp() override {
    pack_ = folder_.path() / "tiny.oriel";
    const auto written = write_pack(pack_, testing::tiny_mapped_pack());
    ASSERT_TRUE(written) << written.error().text();
  }
  Outcome run(const std::string& arguments) const {
    const auto out = folder_.path() / "out.txt", err = folder_.path() / "err.txt";
    const std::string command = std::string(ORIEL_BIN_DIR) + "/oriel-inspect " + arguments + " >" + out.string() +
                                " 2>" + err.string() + " </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
  }
  // Flips a bit in every section of a kind.
  void damage(std::uint32_t kind) const {
    Bytes bytes = *read_file(pack_);
    const auto index = *read_index(bytes);
    for (const auto& section : index.sections)
      if (section.kind == kind) bytes[section.offset + 5] ^= std::byte{16};
    ASSERT_TRUE(write_file_atomically(pack_, bytes));
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path pack_;
};

TEST_F(Inspect, Usage) {
  EXPECT_EQ(run("").code, 1);
  EXPECT_EQ(run("--bogus").code, 1);
  EXPECT_EQ(run("info").code, 1);
  EXPECT_EQ(run("info --bogus " + pack_.string()).code, 1);
  EXPECT_EQ(run("extract " + pack_.string()).code, 1);
  const Outcome kind = run("extract --kind photo -o x " + pack_.string());
  EXPECT_EQ(kind.code, 1);
  EXPECT_NE(kind.err.find("found 'photo', expected one of lightmap, radiance_map"), std::string::npos) << kind.err;
  EXPECT_TRUE(kind.out.empty());
  const Outcome help = run("--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("Exit codes:"), std::string::npos);
  EXPECT_EQ(run("info --help").code, 0);
  const Outcome version = run("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.find("oriel-inspect "), 0u);
}

TEST_F(Inspect, MissingFileAndBlockedFolder) {
  for (const char* command : {"info", "validate", "extract -o x"})
    EXPECT_EQ(run(std::string(command) + " " + (folder_.path() / "none.oriel").string()).code, 2) << command;
  EXPECT_EQ(run("info " + folder_.path().string()).code, 2);
  EXPECT_EQ(run("extract -o " + (pack_ / "below-a-file").string() + " " + pack_.string()).code, 2);
}

// A pack of a program to come: every command says what it lacks, none guesses.
TEST_F(Inspect, LaterVersionsAreRefusedInWords) {
  testing::Forge later = testing::Forge::from(*read_file(pack_));
  testing::Forge required = later;
  later.version = 2;
  required.find(fourcc("XTRA")).record.flags = 0;
  const auto expect_words = [&](const Bytes& file, const std::string& words) {
    ASSERT_TRUE(write_file_atomically(pack_, file));
    const std::string output = " -o " + (folder_.path() / "x").string();
    for (const std::string command : {"info", "validate", "extract", "report", "export", "diff"}) {
      const bool writes = command == "extract" || command == "report" || command == "export";
      const std::string second = command == "diff" ? " " + pack_.string() : writes ? output : "";
      const Outcome found = run(command + " " + pack_.string() + second);
      EXPECT_EQ(found.code, 3) << command;
      EXPECT_NE((found.out + found.err).find(words), std::string::npos) << command << ": " << found.out << found.err;
    }
  };
  expect_words(later.file(), "header: found format version 2, this program reads version 1");
  expect_words(required.file(),
               "section XTRA (unknown): is of a kind that this program does not know, and is not marked as optional");
}

TEST_F(Inspect, InfoForPeople) {
  const Outcome info = run("info " + pack_.string());
  EXPECT_EQ(info.code, 0) << info.err;
  for (const char* text : {"format version 1", "4 triangles", "LMAP lightmap page", "XTRA unknown", "lightmap 0: 8 x 4",
                           "reflector 0: 'floor'", "radiance map 1: 6 x 4", "2 emitters in closed form",
                           "bytes a pixel as stored", "walk grid 1: 1 x 1 cells of 1 m, 1 m2 walkable", "camera 'door'",
                           "visible sets: 2 groups of triangles in 3 runs, 3 eye cells of 2 x 2 walk cells, 66.7 %",
                           "mover 'door': 2 triangles", "light field: 1 x 1 x 1 cells, 7 of 8 probes", "\"seed\": 7"})
    EXPECT_NE(info.out.find(text), std::string::npos) << text << " in\n" << info.out;
}

TEST_F(Inspect, InfoForPrograms) {
  const Outcome info = run("info --json " + pack_.string());
  ASSERT_EQ(info.code, 0) << info.err;
  const auto json = Json::parse(info.out).value();
  EXPECT_EQ(json["schema"], 2);
  EXPECT_EQ(json["mesh"]["triangles"], 4);
  EXPECT_EQ(json["provenance"]["seed"], 7);
  EXPECT_EQ(json["lightmaps"][0]["texels"]["valid"], 8);
  EXPECT_NEAR(json["lightmaps"][0]["lux"]["max"].get<double>(), 155.9, 0.2);
  EXPECT_EQ(json["movers"][0]["transfer"]["bytes_per_vertex"], 3);
  EXPECT_EQ(json["light_field"]["bright_lights"].size(), 2u);
  EXPECT_EQ(json["radiance_maps"].size(), 3u);
  EXPECT_EQ(json["emitters"][1]["corners"].size(), 3u);
  EXPECT_EQ(json["reflectors"][0]["emitters"], (std::vector<int>{1, 0}));
  EXPECT_EQ(json["walk_grids"][0]["walkable_m2"], 1);
  EXPECT_EQ(json["visible_sets"]["eye_cells"], 3);
  EXPECT_NEAR(json["visible_sets"]["seen_share"].get<double>(), 4.0 / 6, 1e-12);
  EXPECT_EQ(json["visible_sets"]["made_for_this"], true);
  EXPECT_EQ(json["day"]["clock"], "UTC+02:00");
  EXPECT_EQ(json["day"]["hours"][0]["group"], nullptr);
  EXPECT_EQ(json["day"]["hours"][1]["group"], 1);
  EXPECT_EQ(json["sections"].size(), 38u);
  EXPECT_EQ(json["sharp_light"]["lamps"], 2);
  EXPECT_EQ(json["sharp_light"]["texels"], 6);
  EXPECT_EQ(json["frosted_panes"][0]["name"], "screen");
  EXPECT_EQ(json["bytes"], std::filesystem::file_size(pack_));
}

TEST_F(Inspect, AcceptsAValidPack) {
  const Outcome valid = run("validate " + pack_.string());
  EXPECT_EQ(valid.code, 0);
  EXPECT_EQ(valid.out, "valid\n");
  const Outcome json = run("validate --json " + pack_.string());
  EXPECT_EQ(json.code, 0);
  EXPECT_EQ(Json::parse(json.out).value()["valid"], true);
}

TEST_F(Inspect, DamageNamesEverySection) {
  damage(kLightmapSection);
  damage(kMeshSection);
  const Outcome text = run("validate " + pack_.string());
  EXPECT_EQ(text.code, 3);
  EXPECT_NE(text.out.find("error 1: section LMAP 0 (lightmap page): checksum "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("error 1: section MESH (mesh): checksum "), std::string::npos) << text.out;
  const auto json = Json::parse(run("validate --json " + pack_.string()).out).value();
  EXPECT_EQ(json["valid"], false);
  EXPECT_EQ(json["issues"].size(), 3u);  // of both pages
  for (const char* command : {"info", "extract -o x"}) {
    const Outcome refused = run(std::string(command) + " " + pack_.string());
    EXPECT_EQ(refused.code, 3) << command;
    EXPECT_NE(refused.err.find("section MESH (mesh): checksum"), std::string::npos) << refused.err;
    EXPECT_TRUE(refused.out.empty());
  }
}

TEST_F(Inspect, WrongMeaningHasItsNumber) {
  auto forge = testing::Forge::from(*read_file(pack_));
  auto& scene = forge.find(kSceneSection);
  const float sky = -1;
  std::memcpy(scene.stored.data(), &sky, sizeof(sky));
  ASSERT_TRUE(write_file_atomically(pack_, forge.file()));
  const Outcome validate = run("validate " + pack_.string());
  EXPECT_EQ(validate.code, 3);
  EXPECT_EQ(validate.out.find("error 804: section SCNE (scene): found sky radiance (-1, 0.6, 1)"), 0u) << validate.out;
  EXPECT_EQ(run("info " + pack_.string()).code, 3);
}

TEST_F(Inspect, ExtractsEveryMap) {
  const auto to = folder_.path() / "maps" / "deep";
  const Outcome extract = run("extract " + pack_.string() + " -o " + to.string());
  ASSERT_EQ(extract.code, 0) << extract.err;
  const auto pack = read_pack(pack_);
  ASSERT_TRUE(pack);
  const auto index = Json::parse(slurp(to / "index.json")).value();
  std::size_t files = 0;
  const auto count = [&](const auto& entry) {
    for (const auto& [role, name] : entry["files"].items()) {
      EXPECT_TRUE(std::filesystem::exists(to / name.template get<std::string>())) << role << " " << name;
      ++files;
    }
  };
  for (const auto& entry : index["entries"]) {
    count(entry);
    if (entry.contains("incidences"))
      for (const auto& incidence : entry["incidences"]) count(incidence);
  }
  std::size_t in_folder = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(to)) ++in_folder;
  EXPECT_EQ(in_folder, files + 1) << "index.json names every file";

  const auto irradiance = read_exr(to / "lightmap_000.exr");
  ASSERT_TRUE(irradiance) << irradiance.error().text();
  ASSERT_EQ(irradiance->pixels.size(), 96u);
  for (std::size_t i = 0; i < 96; ++i)
    EXPECT_EQ(irradiance->pixels[i], pack->lightmaps[0].irradiance[i / 3][static_cast<int>(i % 3)]);
  const auto valid = read_png(to / "lightmap_000_valid.png");
  ASSERT_TRUE(valid);
  EXPECT_EQ(valid->pixels[0], 0);
  EXPECT_EQ(valid->pixels[1], 85);
  EXPECT_EQ(valid->pixels[3], 255);
  EXPECT_TRUE(read_exr(to / "lightmap_000_error.exr"));
  const auto direction = read_exr(to / "lightmap_000_direction.exr");
  ASSERT_TRUE(direction) << direction.error().text();
  for (std::size_t i = 0; i < 96; ++i)
    EXPECT_EQ(direction->pixels[i], pack->lightmaps[0].direction[i / 3][static_cast<int>(i % 3)]);
  EXPECT_EQ(read_png(to / "normal_texture_000.png")->pixels, pack->normal_textures[0].texels);
  EXPECT_EQ(read_exr(to / "radiance_map_0001_disparity.exr")->channels, 1u);
  EXPECT_EQ(read_exr(to / "brdf_kernel_01.exr")->width, 5u);
  EXPECT_EQ(read_exr(to / "brdf_kernel_01_incidence_1.exr")->width, 3u);
  EXPECT_TRUE(std::filesystem::exists(to / "brdf_kernel_01_radial.csv"));
  EXPECT_FALSE(std::filesystem::exists(to / "brdf_kernel_00_radial.csv")) << "a mirror has no lobe";
  EXPECT_EQ(read_exr(to / "fresnel_map_00_table.exr")->width, 5u);
  EXPECT_EQ(read_png(to / "texture_000.png")->pixels, pack->textures[0].texels);
  ASSERT_FALSE(pack->walk_grids.empty());
  const auto& grid = pack->walk_grids[0];
  const std::string eyes = slurp(to / "walk_grid_00_eyes.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(eyes.begin(), eyes.end(), '\n')),
            1 + static_cast<std::size_t>(std::ranges::count_if(grid.floor_y, [](float y) { return !std::isnan(y); })));
}

TEST_F(Inspect, ExtractsOneKind) {
  const auto to = folder_.path() / "one";
  ASSERT_EQ(run("extract --kind lightmap -o " + to.string() + " " + pack_.string()).code, 0);
  EXPECT_TRUE(std::filesystem::exists(to / "lightmap_000.exr"));
  EXPECT_FALSE(std::filesystem::exists(to / "brdf_kernel_00.exr"));
  EXPECT_EQ(Json::parse(slurp(to / "index.json")).value()["entries"].size(), 2u);
}

TEST_F(Inspect, ReportsAndExports) {
  const auto html = folder_.path() / "page.html", glb = folder_.path() / "tiny.glb";
  const Outcome page = run("report " + pack_.string() + " -o " + html.string());
  EXPECT_EQ(page.code, 0) << page.err;
  EXPECT_NE(slurp(html).find("<h1>tiny.oriel</h1>"), std::string::npos);
  const Outcome shown = run("export " + pack_.string() + " -o " + glb.string());
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_NE(shown.out.find("white: "), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("left out: 1 movers"), std::string::npos) << shown.out;
  EXPECT_EQ(slurp(glb).substr(0, 4), "glTF");
  ASSERT_EQ(run("export --as lightmap " + pack_.string() + " -o " + glb.string()).code, 0);
  const auto exr = read_exr(folder_.path() / "tiny_lightmap_000.exr");
  ASSERT_TRUE(exr) << exr.error().text();
  EXPECT_EQ(slurp(folder_.path() / "tiny_lightmap_000.ktx2").substr(1, 6), "KTX 20");
  EXPECT_EQ(exr->pixels[9], read_pack(pack_)->lightmaps[0].irradiance[3].r);
  EXPECT_EQ(run("export --as photo " + pack_.string() + " -o " + glb.string()).code, 1);
  EXPECT_EQ(run("report " + pack_.string()).code, 1);
  EXPECT_EQ(run("report -o " + (pack_ / "below-a-file").string() + " " + pack_.string()).code, 2);
  damage(kMeshSection);
  for (const char* command : {"report", "export"})
    EXPECT_EQ(run(std::string(command) + " -o x.out " + pack_.string()).code, 3) << command;
}

TEST_F(Inspect, FullDiskIsAnIoError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const std::string command =
      std::string(ORIEL_BIN_DIR) + "/oriel-inspect info " + pack_.string() + " >/dev/full 2>/dev/null";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
}

// The tiny pack's floor is 4 m square about its origin, which is far from the world's.
TEST_F(Inspect, WhySaysWhatLightsAPlace) {
  const DVec3 o = testing::tiny_mapped_pack().mesh.origin;
  const std::string at = fmt::format("--at {:.3f},{:.3f},{:.3f}", o.x + 0.5, o.y + 0.1, o.z + 1.7);
  const Outcome text = run("why " + pack_.string() + " " + at);
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("on 'floor', material 'polished'"), std::string::npos) << text.out;
  const Outcome json = run("why " + pack_.string() + " --json " + at);
  const auto parsed = Json::parse(json.out).value_or(Json());
  ASSERT_TRUE(parsed.is_object()) << json.out;
  EXPECT_EQ(parsed["surface"], "floor");
  EXPECT_EQ(parsed["texel"], Json({2, 0}));
  EXPECT_EQ(run("why " + pack_.string() + " --at 0,900,0").code, 3);
  EXPECT_EQ(run("why " + pack_.string() + " --at here").code, 1);
  EXPECT_EQ(run("why " + pack_.string()).code, 1);
}

}  // namespace
}  // namespace oriel
