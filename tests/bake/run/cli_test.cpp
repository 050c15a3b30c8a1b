// oriel-bake as a user meets it: exit codes, messages, files left behind, bytes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "bake/run/measure.h"
#include "bake/run/options.h"
#include "bake/run/prepare.h"
#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/core/text.h"
#include "formats/image/exr.h"
#include "formats/pack/reader.h"
#include "tests/support/waiting.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

class BakeCli : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("oriel-cli-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    ASSERT_EQ(run("oriel-scenes cornell -o cornell.glb"), 0) << log();
  }
  void TearDown() override { fs::remove_all(folder_); }

  int run(const std::string& command) const {
    const std::string line = "cd '" + folder_.string() + "' && '" + ORIEL_BIN_DIR + "'/" + command + " >log 2>&1";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  std::string log() const {
    const auto bytes = read_file(folder_ / "log");
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
  }
  void write(const std::string& name, const std::string& text) const {
    ASSERT_TRUE(write_file_atomically(folder_ / name, std::as_bytes(std::span(text))));
  }

  fs::path folder_;
};

TEST_F(BakeCli, ExitCodesAndMessages) {
  EXPECT_EQ(run("oriel-bake --help"), 0);
  EXPECT_NE(log().find("Exit codes"), std::string::npos);
  EXPECT_EQ(run("oriel-bake --version"), 0);
  EXPECT_EQ(run("oriel-bake"), 1);
  EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --no-such-option"), 1);
  EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --texel 5parsec"), 1);
  EXPECT_NE(log().find("5parsec"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --only radiosity,teapots"), 1);
  EXPECT_EQ(run("oriel-bake missing.glb -o a.oriel"), 2);
  EXPECT_NE(log().find("missing.glb"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake cornell.glb -o no/such/folder/a.oriel"), 2);
  write("broken.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"meshes\": 7}");
  EXPECT_EQ(run("oriel-bake broken.gltf -o a.oriel"), 3);
  write("empty.gltf", "{\"asset\": {\"version\": \"2.0\"}}");
  EXPECT_EQ(run("oriel-bake empty.gltf -o a.oriel"), 3);
  EXPECT_NE(log().find("mesh"), std::string::npos) << log();
  const auto scene_bytes = fs::file_size(folder_ / "cornell.glb");
  EXPECT_EQ(run("oriel-bake cornell.glb -o ./cornell.glb"), 1) << "the scene must not be overwritten";
  EXPECT_EQ(fs::file_size(folder_ / "cornell.glb"), scene_bytes);
  EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --report a.oriel"), 1);
  EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --report no/such/folder/a.json"), 2);
  EXPECT_EQ(run("oriel-bake cornell.glb -o /proc/1/root/nowhere/a.oriel"), 2) << log();
  EXPECT_FALSE(fs::exists(folder_ / "a.oriel"));
}

// The gallery has reflectors too, so that every stage takes part.
TEST_F(BakeCli, SameBytesForAnyThreads) {
  ASSERT_EQ(run("oriel-scenes gallery -o gallery.glb"), 0) << log();
  const std::string options = " --texel 50cm --samples 16 --reflections maps --map-resolution 64 --quiet";
  ASSERT_EQ(run("oriel-bake gallery.glb --cache off -o one.oriel --threads 1" + options), 0) << log();
  ASSERT_EQ(run("oriel-bake gallery.glb --cache off -o two.oriel --threads 2" + options), 0) << log();
  EXPECT_EQ(log(), "") << "--quiet says nothing unless there is something to warn of";
  const Bytes one = *read_file(folder_ / "one.oriel");
  EXPECT_EQ(one, *read_file(folder_ / "two.oriel"));
  EXPECT_GT(read_pack(folder_ / "one.oriel")->radiance_maps.size(), 10u);
  ASSERT_EQ(run("oriel-bake gallery.glb --cache off -o other.oriel --seed 2" + options), 0) << log();
  EXPECT_NE(one, *read_file(folder_ / "other.oriel")) << "the comparison must be able to fail";
}

TEST_F(BakeCli, OmissionsAreSaidAndRecorded) {
  ASSERT_EQ(run("oriel-bake cornell.glb -o a.oriel --texel 10cm --samples 4 --report a.json"), 0) << log();
  EXPECT_NE(log().find("left out: radiance maps"), std::string::npos) << log();
  const Pack pack = *read_pack(folder_ / "a.oriel");
  EXPECT_TRUE(pack.reflectors.empty());
  const auto plan = Json::parse(pack.plan).value();
  EXPECT_FALSE(plan["omitted"].empty());
  const auto is_storage = [](const auto& error) { return error["component"] == "storage of D"; };
  const auto storage = std::find_if(plan["errors"].begin(), plan["errors"].end(), is_storage);
  ASSERT_NE(storage, plan["errors"].end());
  EXPECT_LT((*storage)["measured"].get<double>(), 1e-3) << "halves have a scale of their own";
  const auto provenance = Json::parse(pack.provenance).value();
  EXPECT_EQ(provenance["options"]["samples"], 4);
  EXPECT_EQ(provenance["inputs"][0]["name"], "cornell.glb");
  const Bytes report = *read_file(folder_ / "a.json");
  EXPECT_TRUE(Json::parse(report).value().contains("stages"));
}

TEST_F(BakeCli, SkiesAndProfilesAreInputs) {
  write("sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n@@@\x81@@@\x81");  // (0.5, 0.5, 0.5)
  const std::string bake = "oriel-bake cornell.glb -o a.oriel --texel 20cm --samples 4 --only radiosity ";
  ASSERT_EQ(run(bake + "--sky sky.hdr --sky-scale 100 --sky-rotation 30 --sun-angle 0.53"), 0) << log();
  const Pack pack = *read_pack(folder_ / "a.oriel");
  EXPECT_NEAR(pack.sky.g, 50, 1e-3);
  const auto provenance = Json::parse(pack.provenance).value();
  EXPECT_EQ(provenance["inputs"].back()["name"], "sky.hdr");
  EXPECT_EQ(provenance["options"]["sky_file"], "sky.hdr");
  EXPECT_EQ(provenance["options"]["sky_scale"], 100);
  EXPECT_NEAR(provenance["options"]["sun_angle_deg"].get<double>(), 0.53, 1e-6);
  EXPECT_EQ(run(bake + "--sky missing.exr"), 2);
  EXPECT_EQ(run(bake + "--sky cornell.glb"), 1) << "neither a radiance nor a name of a sky";
  EXPECT_EQ(run(bake + "--sky sky.hdr --sky-scale -1"), 1);
  EXPECT_EQ(run(bake + "--sun-angle 200"), 1);
  EXPECT_EQ(run(bake + "--ies lamp"), 1);
  EXPECT_EQ(run(bake + "--ies lamp=sky.hdr"), 1);
  EXPECT_NE(log().find("\"lamp\""), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake cornell.glb -o sky.hdr --sky sky.hdr"), 1) << "the sky must not be overwritten";
}

TEST_F(BakeCli, DirectionalWhereANormalMapWantsIt) {
  ASSERT_EQ(run("oriel-bake cornell.glb -o plain.oriel --texel 20cm --samples 1"), 0) << log();
  EXPECT_NE(log().find("left out: directional lightmaps: no material has a normal map"), std::string::npos) << log();
  EXPECT_TRUE(read_pack(folder_ / "plain.oriel")->lightmaps[0].direction.empty());
  ASSERT_EQ(run("oriel-bake cornell.glb -o on.oriel --texel 20cm --samples 1 --directional on"), 0) << log();
  EXPECT_FALSE(read_pack(folder_ / "on.oriel")->lightmaps[0].direction.empty());
  EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --directional up"), 1);

  write("bumpy.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "material": 0}]}],
    "materials": [{"normalTexture": {"index": 0, "scale": 0.5}}], "textures": [{"source": 0}], "images": [{"uri":
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGO41XALAARsAjUQ4/RCAAAAAElFTkSuQmCC"}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 0, "byteOffset": 72, "componentType": 5126, "count": 3, "type": "VEC2"}],
    "bufferViews": [{"buffer": 0, "byteLength": 96}], "buffers": [{"byteLength": 96,
    "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAgD8AAIA/AACAPwAAAAAAAAAA"}]})");
  ASSERT_EQ(run("oriel-bake bumpy.gltf -o auto.oriel --sky 100 --samples 4"), 0) << log();
  EXPECT_EQ(log().find("directional"), std::string::npos) << log();
  const Pack pack = *read_pack(folder_ / "auto.oriel");
  EXPECT_FALSE(pack.lightmaps[0].direction.empty());
  EXPECT_EQ(pack.materials[0].normal_texture, 0);
  EXPECT_EQ(pack.materials[0].normal_scale, 0.5f);
  EXPECT_EQ(pack.normal_textures.size(), 1u);
  EXPECT_EQ(pack.mesh.normal_uvs.size(), pack.mesh.positions.size());
  EXPECT_TRUE(Json::parse(pack.plan).value()["radiosity"]["directional"].get<bool>());
  ASSERT_EQ(run("oriel-bake bumpy.gltf -o off.oriel --sky 100 --samples 4 --directional off"), 0) << log();
  EXPECT_NE(log().find("left out by --directional off"), std::string::npos) << log();
  EXPECT_TRUE(read_pack(folder_ / "off.oriel")->lightmaps[0].direction.empty());
}

TEST_F(BakeCli, NoLightBakesToBlackWithAWarning) {
  write("dark.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36,
    "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  ASSERT_EQ(run("oriel-bake dark.gltf -o dark.oriel"), 0) << log();
  EXPECT_NE(log().find("no light"), std::string::npos) << log();
  const Pack pack = *read_pack(folder_ / "dark.oriel");
  for (const LightmapPage& page : pack.lightmaps)
    for (const Vec3& e : page.irradiance) EXPECT_EQ(e, Vec3(0));
}

TEST_F(BakeCli, JsonLogIsJson) {
  ASSERT_EQ(run("oriel-bake cornell.glb -o a.oriel --texel 10cm --samples 4 --json-log"), 0) << log();
  std::istringstream lines(log());
  int events = 0;
  for (std::string line; std::getline(lines, line); ++events) EXPECT_TRUE(Json::parse(line)) << line;
  EXPECT_GT(events, 2);
}

// SIGINT in the middle of the work: ends with no more work than of a second or two, with 130, and leaves neither a pack
// nor a temporary file.
TEST_F(BakeCli, InterruptLeavesNothing) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::chdir(folder_.c_str()) != 0) ::_exit(99);
    const int file = ::open("log", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDERR_FILENO);
    const std::string program = std::string(ORIEL_BIN_DIR) + "/oriel-bake";
    ::execl(program.c_str(), "oriel-bake", "cornell.glb", "-o", "a.oriel", "--texel", "2mm", "--samples", "65536",
            static_cast<char*>(nullptr));
    ::_exit(98);
  }
  EXPECT_TRUE(testing::wait_until([&] { return log().find("direct light") != std::string::npos; })) << log();
  const double before = testing::cpu_seconds(child);
  ASSERT_EQ(::kill(child, SIGINT), 0) << "the bake ended before it could be interrupted";
  const testing::Ended ended = testing::wait_for_end(child);
  ASSERT_TRUE(WIFEXITED(ended.status)) << ended.status;
  EXPECT_EQ(WEXITSTATUS(ended.status), 130) << log();
  EXPECT_LT(ended.cpu_seconds - before, testing::on_all_processors(2));
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_TRUE(entry.path().filename() == "cornell.glb" || entry.path().filename() == "log" ||
                entry.path().filename() == ".oriel-cache")  // what is finished stays there
        << entry.path();
}

TEST_F(BakeCli, PlanTellsAndFailsWhereFindingsAre) {
  ASSERT_EQ(run("oriel-bake plan cornell.glb --unit m --texel 5cm --quiet --json -"), 0) << log();
  const auto json = Json::parse(log()).value();
  EXPECT_TRUE(json["findings"].empty());
  EXPECT_GT(json["prediction"]["seconds"].get<double>(), 0);
  EXPECT_EQ(run("oriel-bake plan cornell.glb --no-pilot --strict --unit m --json plan.json"), 0) << log();
  EXPECT_NE(log().find("no surround maps"), std::string::npos) << log();
  EXPECT_TRUE(fs::exists(folder_ / "plan.json"));
  EXPECT_EQ(run("oriel-bake plan cornell.glb --no-pilot --strict"), 5) << "a room of 0.55 m";
  EXPECT_NE(log().find("one unit of the file is taken to be 10 m"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake plan cornell.glb --no-pilot --strict --texel 0.1mm"), 5) << "texels";
  EXPECT_NE(log().find("D7 texel density, warning: --texel"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake plan cornell.glb --no-pilot --texel 0.1mm"), 0) << "told, not strict";
  ASSERT_EQ(run("oriel-bake plan cornell.glb --texel 2cm --error 1% --time 0.001s"), 0) << log();
  EXPECT_NE(log().find("INFEASIBLE: --time 0.001 s"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake plan missing.glb"), 2);
  EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --verify much"), 1);
  EXPECT_EQ(run("oriel-bake plan cornell.glb --json ./cornell.glb"), 1) << "an input";
  EXPECT_EQ(run("oriel-bake plan"), 1);
}

TEST_F(BakeCli, LuxPrintsATable) {
  write("points.csv", "x,y,z,nx,ny,nz\n0.1,0,-0.1,0,1,0\n0.3,0.2,-0.3,0,0,-1\n");
  ASSERT_EQ(run("oriel-bake lux cornell.glb --points points.csv -o a.csv --error 5%"), 0) << log();
  const auto lines = [&](const char* name) {
    const Bytes bytes = *read_file(folder_ / name);
    std::istringstream in(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    std::vector<std::string> out;
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
  };
  ASSERT_EQ(lines("a.csv").size(), 3u);
  EXPECT_EQ(lines("a.csv")[0].rfind("x,y,z,nx,ny,nz,E,E_r,", 0), 0u);
  EXPECT_EQ(lines("a.csv")[1].rfind("0.1,0,-0.1,0,1,0,", 0), 0u);
  ASSERT_EQ(run("oriel-bake lux cornell.glb --points points.csv --error 5% --threads 1 --quiet"), 0);
  EXPECT_EQ(lines("log"), lines("a.csv")) << "stdout holds the table and nothing else";
  ASSERT_EQ(run("oriel-bake lux cornell.glb --points points.csv --samples 1000 --quiet"), 0) << log();
}

// A lounger in centimetres of a format that knows no unit.
TEST_F(BakeCli, TheSizeOfAThingWithoutAUnitIsTold) {
  std::string text;
  for (int k = 0; k < 8; ++k) text += fmt::format("v {} {} {}\n", k & 1 ? 95 : 0, k & 2 ? 78 : 0, k & 4 ? 83 : 0);
  text += "f 1 2 6 5\nf 1 2 8 7\n";
  for (const bool named : {false, true}) {
    BakeOptions options;
    options.scene = folder_ / "lounger.obj";
    options.guess_unit = !named;
    ASSERT_TRUE(write_text_atomically(options.scene, text));
    Context context;
    std::string said;
    context.warn = [&](const Warning& warning) { said += warning.text; };
    std::vector<StageTime> times;
    Stopwatch timed(times);
    ASSERT_TRUE(prepare_scene(options, timed, context));
    EXPECT_EQ(said.find("95 x 78 x 83 m large; --unit cm") != std::string::npos, !named) << said;
  }
}

TEST_F(BakeCli, LuxExitCodesAndMessages) {
  write("points.csv", "0.1,0,-0.1,0,1,0\n");
  write("zero.csv", "0.1,0,-0.1,0,1,0\n0.1,0,-0.1,0,0,0\n");
  EXPECT_EQ(run("oriel-bake lux --help"), 0);
  EXPECT_NE(log().find("--grid"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake lux"), 1);
  EXPECT_EQ(run("oriel-bake lux cornell.glb"), 1);
  EXPECT_NE(log().find("--points"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake lux cornell.glb --points points.csv --grid floor,1m,0"), 1);
  EXPECT_EQ(run("oriel-bake lux cornell.glb --grid floor,1m"), 1);
  EXPECT_EQ(run("oriel-bake lux cornell.glb --grid nowhere,1m,0"), 1);
  EXPECT_NE(log().find("nowhere"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake lux cornell.glb --points points.csv --error 5x"), 1);
  EXPECT_EQ(run("oriel-bake --texel 5cm lux cornell.glb --points points.csv"), 1);
  EXPECT_NE(log().find("--texel"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake lux missing.glb --points points.csv"), 2);
  EXPECT_EQ(run("oriel-bake lux cornell.glb --points missing.csv"), 2);
  EXPECT_EQ(run("oriel-bake lux cornell.glb --points zero.csv"), 3);
  EXPECT_NE(log().find("zero.csv:2"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake lux cornell.glb --points points.csv -o points.csv"), 1);
  EXPECT_EQ(run("oriel-bake lux cornell.glb --points points.csv -o cornell.glb"), 1);
}

TEST_F(BakeCli, RenderWritesLayers) {
  ASSERT_EQ(run("oriel-bake render cornell.glb --size 12x8 --samples 8 -o a.exr"), 0) << log();
  const auto frame = read_layered_exr(folder_ / "a.exr");
  ASSERT_TRUE(frame) << frame.error().text();
  EXPECT_EQ(frame->layers.size(), 8u);
  EXPECT_EQ(frame->layers.at("specular_error").width, 12u);
  EXPECT_EQ(frame->layers.at("").pixels.size(), 12u * 8 * 3);
  EXPECT_EQ(frame->attributes.at("oriel.samples"), "8");
  EXPECT_TRUE(frame->attributes.at("oriel.eye").starts_with("2.7")) << "0.27 in the file: a unit is 10 m";
  ASSERT_EQ(run("oriel-bake render cornell.glb --size 12x8 --samples 8 --threads 1 -o b.exr --quiet"), 0) << log();
  EXPECT_EQ(*read_file(folder_ / "a.exr"), *read_file(folder_ / "b.exr"));
  ASSERT_EQ(run("oriel-bake render cornell.glb --size 12x8 --error 20% --sky 100 -o b.exr"), 0) << log();
  EXPECT_LE(std::stod(read_layered_exr(folder_ / "b.exr")->attributes.at("oriel.noise")), 0.2);
}

TEST_F(BakeCli, RenderExitCodesAndMessages) {
  EXPECT_EQ(run("oriel-bake render --help"), 0);
  EXPECT_NE(log().find("specular_error"), std::string::npos) << log();
  EXPECT_EQ(run("oriel-bake render cornell.glb"), 1) << "no -o";
  EXPECT_EQ(run("oriel-bake render cornell.glb -o a.exr --camera nowhere"), 1);
  EXPECT_NE(log().find("expected one of: 0 \""), std::string::npos) << log();
  for (const char* bad : {"--size 12", "--size 0x8", "--size 12x8x3", "--size 99999x8", "--error 0", "--samples 0",
                          "--error 2% --samples 4", "--texel 5cm"})
    EXPECT_EQ(run("oriel-bake render cornell.glb -o a.exr " + std::string(bad)), 1) << bad;
  EXPECT_EQ(run("oriel-bake render missing.glb -o a.exr"), 2);
  EXPECT_EQ(run("oriel-bake render cornell.glb -o nowhere/a.exr"), 2);
  EXPECT_EQ(run("oriel-bake render cornell.glb -o cornell.glb"), 1);
  EXPECT_EQ(run("oriel-bake render cornell.glb -o cornell.png"), 1) << "light is written, as OpenEXR";
  EXPECT_FALSE(fs::exists(folder_ / "a.exr"));
}

TEST(Quantities, ParseAndRefuse) {
  EXPECT_FLOAT_EQ(*parse_length("5cm"), 0.05f);
  EXPECT_FLOAT_EQ(*parse_length("20 mm"), 0.02f);
  for (const char* bad : {"", "cm", "5", "-5cm", "0", "nan", "inf", "5 miles", "1e400m"})
    EXPECT_FALSE(parse_length(bad)) << bad;
  EXPECT_EQ(*parse_bytes("64MiB"), 64u << 20);
  EXPECT_FALSE(parse_bytes("many"));
  EXPECT_EQ(*parse_color("5"), Vec3(5));
  EXPECT_EQ(*parse_color("1,2,3"), Vec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(*parse_share("0.5%"), 0.005);
  EXPECT_DOUBLE_EQ(*parse_share("0.5"), 0.5);
  EXPECT_DOUBLE_EQ(*parse_share("120 %"), 1.2);
  for (const char* bad : {"", "0%", "-1%", "%", "nan%", "1x", "0"}) EXPECT_FALSE(parse_share(bad)) << bad;
  EXPECT_EQ(parse_share("2").error().message, "found 2, expected a share: write 2% or 0.02");
  EXPECT_EQ(parse_share("0.7").error().message, "found 0.7, expected a share: write 0.7% or 70%");
  EXPECT_EQ(parse_grid("a,b,1m,0")->node, "a,b");
  for (const char* bad : {"", "floor", "floor,1m", ",1m,1m", "floor,0m,1m", "floor,1m,-1m", "floor,1,1"})
    EXPECT_FALSE(parse_grid(bad)) << bad;
  for (const char* bad : {"", "1,2", "1,2,3,4", "-1", "a", "1,,2"}) EXPECT_FALSE(parse_color(bad)) << bad;
  EXPECT_EQ(parse_sky("2000")->radiance, Vec3(2000));
  EXPECT_EQ(parse_sky("skies/Noon.EXR")->file, "skies/Noon.EXR");
  EXPECT_TRUE(parse_sky("auto")->clear);
  EXPECT_FALSE(parse_sky("none")->clear);
  EXPECT_EQ(parse_light_scale("683")->factor, 683);
  EXPECT_EQ(parse_light_scale("a=b*=0.5")->names, "a=b*");
  for (const char* bad : {"", "lamp", "=2", "lamp=", "-1", "nan", "2x"}) EXPECT_FALSE(parse_light_scale(bad)) << bad;
  for (const char* bad : {"", "sky.png", "-1", "a"}) EXPECT_FALSE(parse_sky(bad)) << bad;
  EXPECT_EQ(parse_ies_option("a=b=y.ies")->first, "a=b");
  EXPECT_EQ(parse_ies_option("a=b=y.ies")->second, "y.ies");
  for (const char* bad : {"", "lamp", "=a.ies", "lamp="}) EXPECT_FALSE(parse_ies_option(bad)) << bad;
}

TEST_F(BakeCli, MemoryLimitMakesTexelsCoarserOrNamesALengthThatFits) {
  const std::string bake = "oriel-bake cornell.glb -o a.oriel --only radiosity --error 20% --memory-limit 8MiB";
  ASSERT_EQ(run(bake), 0) << log();
  EXPECT_NE(log().find("(--memory-limit)"), std::string::npos) << log();
  EXPECT_NE(log().find("those seen least, get larger ones"), std::string::npos) << log();
  ASSERT_NE(run(bake + " --texel 1mm"), 0);
  const std::string found = log();
  const std::size_t at = found.find("(--texel "), end = found.find(" fits)", at);
  ASSERT_NE(end, std::string::npos) << found;
  EXPECT_EQ(run(bake + " " + found.substr(at + 1, end - at - 1)), 0) << log();
}

TEST_F(BakeCli, SoundLightIsRequiredAndWhatWasFoundIsTold) {
  // Texels of a metre in a room of half a metre: the lightmap cannot hold what particles find.
  const std::string bake =
      "oriel-bake cornell.glb -o a.oriel --unit m --only radiosity --samples 2 --texel 1m --verify off";
  ASSERT_EQ(run(bake + " --require sound"), 7) << log();
  EXPECT_NE(log().find("misses --require sound: the lightmap has"), std::string::npos) << log();
  EXPECT_FALSE(fs::exists(folder_ / "a.oriel"));
  ASSERT_EQ(run(bake + " --require sound --keep partial"), 7) << log();
  EXPECT_NE(log().find("a.oriel: was written, but misses"), std::string::npos) << log();
  EXPECT_TRUE(read_pack(folder_ / "a.oriel"));
  EXPECT_EQ(run(bake), 0) << "a finding is fatal only where it is asked to be";
}

}  // namespace
}  // namespace oriel
