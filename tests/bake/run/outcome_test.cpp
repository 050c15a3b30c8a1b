// How a bake ended, as exit code, as report and as log: for pipelines.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>

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
    return run("oriel-bake cornell.glb -o a.oriel --report report.json --no-cache " + options);
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
  ASSERT_EQ(bake(hurried + "--accept-partial"), 0) << log();
  r = report();
  EXPECT_EQ(r["status"], "partial");
  EXPECT_EQ(r["exit_code"], 0);
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
