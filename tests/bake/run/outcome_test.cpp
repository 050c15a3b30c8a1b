// How a bake ended, as exit code, as report and as log: for pipelines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>

#include "bake/jobs/context.h"
#include "formats/core/file.h"
#include "formats/pack/reader.h"
#include "tests/support/json_schema.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/waiting.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;
using json = Json;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

class BakeOutcome : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(run("oriel-scenes cornell -o cornell.glb"), 0); }
  int run(const std::string& command) const {
    const std::string line = "cd '" + folder_.path().string() + "' && '" + ORIEL_BIN_DIR + "'/" + command + " 2>log";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  int bake(const std::string& options) const {
    return run("oriel-bake cornell.glb -o a.oriel --report report.json --cache off " + options);
  }
  std::string log() const { return text_of(folder_.path() / "log"); }
  // Which fits its schema.
  json report() const {
    const json found = json::parse(text_of(folder_.path() / "report.json")).value_or(Json());
    const testing::JsonSchema schema(
        json::parse(text_of(fs::path(ORIEL_SOURCE_DIR) / "docs/report.schema.json")).value());
    EXPECT_EQ(schema.complaint(found), "");
    return found;
  }
  // Each line of the log is an object with an event and the tool's name.
  void expect_json_log(const std::string& last_event) const {
    std::istringstream in(log());
    std::string event;
    int lines = 0;
    for (std::string line; std::getline(in, line); ++lines) {
      const json parsed = json::parse(line).value_or(Json());
      ASSERT_TRUE(parsed.is_object()) << line;
      EXPECT_EQ(parsed.value("tool", ""), "oriel-bake") << line;
      event = parsed.value("event", "");
      EXPECT_NE(event, "") << line;
    }
    EXPECT_GT(lines, 0);
    EXPECT_EQ(event, last_event) << log();
  }
  testing::TemporaryFolder folder_;
};

TEST_F(BakeOutcome, WhatWasAskedForIsComplete) {
  ASSERT_EQ(bake("--texel 20cm --samples 16 --only radiosity --quiet"), 0) << log();
  const json r = report();
  EXPECT_EQ(r["status"], "complete");
  EXPECT_EQ(r["exit_code"], 0);
  EXPECT_TRUE(r["error"].is_null());
  EXPECT_TRUE(r["plan"].is_object());
  EXPECT_TRUE(r["shortfalls"].empty());
}

// A default bake ends by its share of rays, which is no shortfall; an error that is named is one that is missed.
TEST_F(BakeOutcome, ANamedErrorOrTimeThatIsMissedIsSix) {
  const std::string hurried = "--texel 1cm --time 1s --error 0.1% --quiet ";
  ASSERT_EQ(bake(hurried), 6) << log();
  EXPECT_NE(log().find("is less than what was asked for"), std::string::npos) << log();
  json r = report();
  EXPECT_EQ(r["status"], "partial");
  EXPECT_EQ(r["exit_code"], 6);
  ASSERT_FALSE(r["shortfalls"].empty());
  EXPECT_EQ(r["shortfalls"][0]["kind"], "shortfall");
  EXPECT_NE(r["shortfalls"][0]["fix"], "") << r["shortfalls"][0];
  EXPECT_TRUE(read_pack(folder_.path() / "a.oriel")) << "the pack is there";
  ASSERT_EQ(bake(hurried + "--require nothing"), 0) << log();
  r = report();
  EXPECT_EQ(r["status"], "partial");
  EXPECT_EQ(r["exit_code"], 0);
}

const char* const kQuick = "--texel 20cm --samples 16 --only radiosity --quiet ";

// Exit code 7 and no pack, which a build system would believe.
TEST_F(BakeOutcome, WhatIsRequiredButMissingIsSeven) {
  const fs::path pack = folder_.path() / "a.oriel";
  ASSERT_EQ(bake(kQuick + std::string("--emission-scale 0 --require light")), 7) << log();
  EXPECT_NE(log().find("[no-light]"), std::string::npos) << log();
  EXPECT_EQ(report()["status"], "failed");
  EXPECT_EQ(report()["exit_code"], 7);
  ASSERT_EQ(bake(kQuick + std::string("--require 'error<=0.1%'")), 7) << log();
  EXPECT_NE(log().find("found an error of"), std::string::npos) << log();
  EXPECT_FALSE(fs::exists(pack));
  ASSERT_EQ(bake(kQuick + std::string("--require 'error<=2'")), 1) << log();
  EXPECT_NE(log().find("write 2% or 0.02"), std::string::npos) << log();
  ASSERT_EQ(bake(kQuick + std::string("--require 'error<=90%,light,textures,reflections'")), 7)
      << "--only leaves them out";
  ASSERT_EQ(bake(kQuick + std::string("--require 'error<=90%,light,textures'")), 0) << log();
  EXPECT_TRUE(fs::exists(pack));
  fs::remove(pack);
  ASSERT_EQ(bake("--texel 1cm --time 1s --error 0.1% --quiet --keep none"), 6) << log();
  EXPECT_FALSE(fs::exists(pack));
}

TEST_F(BakeOutcome, WarningsHaveCodesThatCanBeErrors) {
  ASSERT_EQ(bake("--texel 20cm --samples 16 --only radiosity --json-log"), 0) << log();
  EXPECT_NE(log().find("\"id\":\"unit-guessed\""), std::string::npos) << log();
  EXPECT_EQ(report()["warnings"][0]["id"], "unit-guessed");
  fs::remove(folder_.path() / "a.oriel");
  ASSERT_EQ(bake(std::string(kQuick) + "-W error=night,unit-guessed"), 7) << log();
  EXPECT_NE(log().find("[unit-guessed]: expected none"), std::string::npos) << log();
  EXPECT_FALSE(fs::exists(folder_.path() / "a.oriel"));
  ASSERT_EQ(bake(std::string(kQuick) + "-W error=unit-gessed"), 1) << log();
  EXPECT_NE(log().find("\"unit-guessed\""), std::string::npos) << log();
}

// Which the type of a warning asks for; here: each is known to the manual, in order, and to some source.
TEST(WarningCodes, TheManualListsAllInUse) {
  const auto text_below = [](const char* folder, const char* ending) {
    std::string all;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(ORIEL_SOURCE_DIR) / folder))
      if (entry.path().extension() == ending) all += text_of(entry.path());
    return all;
  };
  const std::string manual = text_of(fs::path(ORIEL_SOURCE_DIR) / "docs/pipelines.md"),
                    sources = text_below("bake", ".cpp") + text_below("trade", ".cpp") + text_below("bake", ".h");
  std::size_t last = 0;
  std::istringstream codes{std::string(kWarningCodes)};
  for (std::string code; codes >> code;) {
    const std::size_t at = manual.find(fmt::format("`{}`", code));
    ASSERT_NE(at, std::string::npos) << code;
    EXPECT_GT(at, last) << code;
    last = at;
    const std::string used = fmt::format("\"{}\"", code);
    EXPECT_NE(sources.find(used), std::string::npos) << code << " is not used";
  }
}

TEST_F(BakeOutcome, WhatIsUpToDateIsNotBaked) {
  const fs::path pack = folder_.path() / "a.oriel";
  const auto baked = [&](const std::string& options, const std::string& texel = "20cm") {
    EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --samples 16 --texel " + texel + " " + options), 0) << log();
    return log().find("is up to date") == std::string::npos;
  };
  EXPECT_TRUE(baked(""));
  const auto written = fs::last_write_time(pack);
  EXPECT_FALSE(baked(""));
  EXPECT_GT(fs::last_write_time(pack), written) << "make asks for that";
  EXPECT_FALSE(baked("", "0.2m")) << "the same in other words";
  EXPECT_TRUE(baked("--cache off"));
  EXPECT_TRUE(baked("--report report.json")) << "of which a pack does not know all";
  EXPECT_TRUE(baked("--seed 2"));
  EXPECT_TRUE(baked("--seed 2 --require light")) << "nobody asked before";
  EXPECT_FALSE(baked("--seed 2 --require light"));
  fs::resize_file(pack, fs::file_size(pack) - 1);
  EXPECT_TRUE(baked("--seed 2"));
  const std::string before = text_of(folder_.path() / "cornell.glb");
  std::ofstream(folder_.path() / "cornell.glb", std::ios::app) << '\0';
  EXPECT_TRUE(baked("--seed 2")) << "another file";
}

TEST_F(BakeOutcome, AKeyNamesAllThatABakeFollowsFrom) {
  const auto key = [&](const std::string& options) {
    EXPECT_EQ(run("oriel-bake key cornell.glb " + options + " >key"), 0) << log();
    const std::string found = text_of(folder_.path() / "key");
    EXPECT_EQ(found.size(), 33u) << found;
    return found;
  };
  const std::string first = key("--texel 10cm");
  EXPECT_EQ(key("--texel 0.1m --threads 1"), first);
  EXPECT_NE(key("--texel 9cm"), first);
  EXPECT_NE(key("--texel 10cm --seed 2"), first);
  std::ofstream(folder_.path() / "cornell.glb", std::ios::app) << '\0';
  EXPECT_NE(key("--texel 10cm"), first);
  ASSERT_EQ(run("oriel-bake --version >version"), 0);
  EXPECT_THAT(text_of(folder_.path() / "version"), ::testing::ContainsRegex("commit .*, build [0-9a-f]+, "));
}

TEST_F(BakeOutcome, TwoBakesIntoOneFileAreTold) {
  const fs::path pack = folder_.path() / "a.oriel";
  {
    const auto lock = OutputLock::take(pack);
    ASSERT_TRUE(lock);
    ASSERT_EQ(bake(kQuick), 2);
    EXPECT_NE(log().find(fmt::format("is being written by process {}", ::getpid())), std::string::npos) << log();
    EXPECT_FALSE(fs::exists(pack));
  }
  std::ofstream(folder_.path() / "a.oriel.lock") << "1";  // as a process leaves it that was killed
  ASSERT_EQ(bake(kQuick), 0) << log();
  EXPECT_FALSE(fs::exists(folder_.path() / "a.oriel.lock"));
}

TEST_F(BakeOutcome, TheReportIsThereOnFailureToo) {
  std::ofstream(folder_.path() / "broken.glb") << "no glTF";
  ASSERT_EQ(run("oriel-bake broken.glb -o a.oriel --report report.json"), 3) << log();
  json r = report();
  EXPECT_EQ(r["status"], "failed");
  EXPECT_EQ(r["exit_code"], 3);
  EXPECT_EQ(r["error"]["code"], 3);
  EXPECT_NE(r["error"]["where"].get<std::string>().find("broken.glb"), std::string::npos);
  ASSERT_EQ(run("oriel-bake missing.glb -o a.oriel --report report.json"), 2) << log();
  EXPECT_EQ(report()["exit_code"], 2);
  ASSERT_EQ(run("oriel-bake cornell.glb -o nowhere/a.oriel --report report.json"), 2) << log();
  EXPECT_EQ(report()["exit_code"], 2);
}

// Warnings and findings say where in the file their object is.
TEST_F(BakeOutcome, RecordsNameTheNodePath) {
  // Two triangles and one without area, on a node below another.
  std::ofstream(folder_.path() / "nested.gltf")
      << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"name":"house","children":[1]},{"children":[2]},{"name":"wall","mesh":0}],)"
         R"("meshes":[{"name":"plaster","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
         R"({"bufferView":1,"componentType":5123,"count":9,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":18}],)"
         R"("buffers":[{"byteLength":66,"uri":"data:application/octet-stream;base64,)"
         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAAAAABAAIAAQADAAIAAAAAAAEA"}]})";
  ASSERT_EQ(run("oriel-bake nested.gltf -o a.oriel --sky 10 --texel 20cm --samples 16 --quiet --report report.json"), 0)
      << log();
  const json r = report();
  const auto& warnings = r["warnings"];
  const auto found =
      std::find_if(warnings.begin(), warnings.end(), [](const json& w) { return w["object"] == "plaster"; });
  ASSERT_NE(found, warnings.end()) << warnings;
  EXPECT_EQ((*found)["node"], "house/nodes[1]/wall");
}

// Nothing can be written after a kill: what was written before says what it is.
TEST_F(BakeOutcome, AReportOfAKilledBakeSaysThatItRuns) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c",
            ("cd '" + folder_.path().string() + "' && exec '" + ORIEL_BIN_DIR +
             "'/oriel-bake cornell.glb -o a.oriel --texel 1cm --error 0.05% --report report.json --json-log 2>log")
                .c_str(),
            static_cast<char*>(nullptr));
    ::_exit(98);
  }
  EXPECT_TRUE(testing::wait_until([&] { return !log().empty(); }));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  const json r = report();
  EXPECT_EQ(r["status"], "running");
  EXPECT_TRUE(r["exit_code"].is_null());
  EXPECT_EQ(r["running"]["pid"], child);
  EXPECT_NE(r["running"]["text"].get<std::string>().find("it was killed"), std::string::npos);
}

TEST_F(BakeOutcome, EveryLineOfTheLogIsJson) {
  ASSERT_EQ(bake("--texel 20cm --samples 16 --json-log"), 0) << log();
  expect_json_log("note");
  EXPECT_EQ(run("oriel-bake missing.glb -o a.oriel --json-log"), 2);
  expect_json_log("error");
  EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --json-log --no-such-thing"), 1);
  expect_json_log("error");
  EXPECT_EQ(run("oriel-bake cornell.glb -o a.oriel --json-log --texel 5parsec"), 1);
  expect_json_log("error");
}

// SIGTERM while the light is refined: an end within ten seconds, exit code 6, a whole pack, JSON lines alone.
TEST_F(BakeOutcome, SigtermEndsItWithinTenSeconds) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c",
            ("cd '" + folder_.path().string() + "' && exec '" + ORIEL_BIN_DIR +
             "'/oriel-bake cornell.glb -o a.oriel --texel 1cm --error 0.05% --report report.json --json-log 2>log")
                .c_str(),
            static_cast<char*>(nullptr));
    ::_exit(98);
  }
  // Direct light after what is gathered: the first light is there, and is refined.
  const auto refines = [&] {
    const std::string text = log();
    const auto gathered = text.find("\"stage\":\"gather\",\"fraction\":1");
    return gathered != std::string::npos && text.find("\"stage\":\"direct light\"", gathered) != std::string::npos;
  };
  EXPECT_TRUE(testing::wait_until(refines)) << log();
  EXPECT_EQ(report()["status"], "running");
  const double before = testing::cpu_seconds(child);
  ASSERT_EQ(::kill(child, SIGTERM), 0);
  const testing::Ended ended = testing::wait_for_end(child);
  EXPECT_LT(ended.cpu_seconds - before, testing::on_all_processors(10)) << "of a machine of its own";
  ASSERT_TRUE(WIFEXITED(ended.status)) << ended.status;
  EXPECT_EQ(WEXITSTATUS(ended.status), 6) << log();
  expect_json_log("error");
  const json r = report();
  EXPECT_EQ(r["status"], "partial");
  EXPECT_NE(r["shortfalls"].dump().find("ended early, as asked"), std::string::npos) << r["shortfalls"];
  EXPECT_TRUE(read_pack(folder_.path() / "a.oriel"));
}

TEST(JsonSchemaTest, SeesWhatDoesNotFit) {
  const testing::JsonSchema schema(json::parse(
                                       R"({"type": "object", "required": ["a"], "additionalProperties": false,
          "properties": {"a": {"type": ["integer", "null"]}, "b": {"type": "array", "items": {"enum": ["x"]}}}})")
                                       .value());
  EXPECT_EQ(schema.complaint({{"a", 1}, {"b", {"x"}}}), "");
  EXPECT_EQ(schema.complaint({{"a", nullptr}}), "");
  for (const json& bad : {json::object(), json{{"a", "1"}}, json{{"a", 1}, {"b", {"y"}}}, json{{"a", 1}, {"c", 1}}})
    EXPECT_NE(schema.complaint(bad), "") << bad;
}

}  // namespace
}  // namespace oriel
