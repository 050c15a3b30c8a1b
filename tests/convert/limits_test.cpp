// Whatever happens to the process that reads a file of another format, it is an error that says what to do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "convert/import_process.h"
#include "formats/core/file.h"
#include "tests/bake/import/gltf_maker.h"
#include "tests/convert/source_text.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;
using ::testing::HasSubstr;

const SourceFormat kObj{"OBJ", "obj", "export glTF from the program that wrote it"};

class ImportLimits : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    program_ = folder_.path() / "oriel-import";
  }
  // What becomes of the file with a shell script in the importer's place.
  Result<Bytes> with(const std::string& script, double time_s = 60) {
    folder_.write("oriel-import", "#!/bin/sh\n" + script + "\n");
    fs::permissions(program_, fs::perms::owner_all);
    ImportProcess process;
    process.program = program_;
    process.time_s = time_s;
    process.stopped = [this] { return stop_; };
    process.warn = [this](const std::string& text) { warnings_.push_back(text); };
    return import_by_process(file_, kObj, process);
  }
  TempFolder folder_;
  fs::path file_, program_;
  bool stop_ = false;
  std::vector<std::string> warnings_;
};

TEST_F(ImportLimits, WhatItWritesAndSays) {
  const auto glb = with("echo 'oriel-import: warning: one thing' >&2; echo noise >&2; printf glTF");
  ASSERT_TRUE(glb) << glb.error().text();
  EXPECT_EQ(*glb, bytes_of_text("glTF"));
  EXPECT_THAT(warnings_, ::testing::ElementsAre("one thing"));
}

TEST_F(ImportLimits, ItsOwnError) {
  const auto failed = with("echo 'oriel-import: error: a.obj: no triangle' >&2; exit 3");
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kInvalid);
  EXPECT_EQ(failed.error().text(), "a.obj: no triangle");
}

TEST_F(ImportLimits, Crash) {
  const auto failed = with("kill -SEGV $$");
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kInvalid);
  EXPECT_THAT(failed.error().text(), HasSubstr("a.obj: the reader of OBJ files crashed on it (Segmentation fault)"));
  EXPECT_THAT(failed.error().text(), HasSubstr("export glTF"));
}

TEST_F(ImportLimits, KilledForMemory) {
  EXPECT_THAT(with("kill -KILL $$").error().text(), HasSubstr("want of memory"));
}

TEST_F(ImportLimits, NothingWritten) {
  EXPECT_THAT(with("exit 0").error().text(), HasSubstr("wrote nothing"));
  EXPECT_THAT(with("exit 7").error().text(), HasSubstr("code 7"));
}

TEST_F(ImportLimits, HangIsEndedAndGone) {
  const auto begin = std::chrono::steady_clock::now();
  const auto failed = with("echo $$ >" + (folder_.path() / "pid").string() + "; exec sleep 600", 0.3);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kRuntime);
  EXPECT_THAT(failed.error().text(), HasSubstr("--time 1h"));
  std::string pid;
  std::ifstream(folder_.path() / "pid") >> pid;
  EXPECT_FALSE(fs::exists("/proc/" + pid));
}

TEST_F(ImportLimits, StopsWhenTheUserDoes) {
  stop_ = true;
  EXPECT_EQ(with("exec sleep 600").error().code, ErrorCode::kStopped);
}

TEST_F(ImportLimits, MissingProgram) {
  ImportProcess process;
  process.program = folder_.path() / "none";
  const auto failed = import_by_process(file_, kObj, process);
  ASSERT_FALSE(failed);
  EXPECT_THAT(failed.error().text(), HasSubstr("install oriel-tools"));
}

// The program itself, in its own limits.
TEST_F(ImportLimits, Memory) {
  ImportProcess process;
  process.memory_bytes = 150u << 20;  // enough to start, not for a million vertices
  std::string big;
  for (int i = 0; i < 1'000'000; ++i) big += "v 1 2 3\nv 4 5 6\n";
  const auto failed = import_by_process(folder_.write("big.obj", big), kObj, process);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kRuntime);
  EXPECT_THAT(failed.error().text(), HasSubstr("--memory 32GiB"));
}

TEST_F(ImportLimits, HostileFilesAreErrorsAndLeaveNothing) {
  const std::string ifc = test::ifc_wall("IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)"), dae = test::collada(""),
                    three_ds = test::three_ds();
  const std::string huge =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
      "property float y\nproperty float z\nelement face 4000000000\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::vector<std::pair<const char*, std::string>> files = {{"a.fbx", ""},
                                                                  {"a.obj", ""},
                                                                  {"a.dae", ""},
                                                                  {"a.3ds", ""},
                                                                  {"a.ply", ""},
                                                                  {"a.stl", ""},
                                                                  {"a.ifc", ""},
                                                                  {"a.fbx", "Kaydara FBX Binary  "},
                                                                  {"b.fbx", test::fbx("").substr(0, 300)},
                                                                  {"b.obj", "f 1 2 3\n"},
                                                                  {"b.dae", dae.substr(0, dae.size() / 2)},
                                                                  {"b.3ds", three_ds.substr(0, three_ds.size() / 2)},
                                                                  {"b.ifc", ifc.substr(0, ifc.size() / 2)},
                                                                  {"b.ply", huge},
                                                                  {"b.stl", std::string(84, '\xFF')},
                                                                  {"c.obj", "v 0 0 0\nf 1 99999999 4000000000\n"},
                                                                  {"c.stl", std::string(84, ' ')}};
  for (const auto& [name, bytes] : files) {
    const test::Imported in = test::import_file(folder_.write(name, bytes));
    EXPECT_FALSE(in.ok()) << name << " of " << bytes.size() << " bytes";
    EXPECT_THAT(in.error(), HasSubstr(name));
    fs::remove(folder_.path() / name);
  }
  fs::remove(file_);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(ImportLimits, TheProgramWritesWholeFiles) {
  const std::string program = std::string(ORIEL_BIN_DIR) + "/oriel-import ", glb = folder_.path() / "a.glb";
  EXPECT_EQ(std::system((program + file_.string() + " -o " + glb).c_str()), 0);
  EXPECT_TRUE(test::import_file(glb).ok());
  const std::string bad = folder_.write("bad.obj", "nothing");
  EXPECT_NE(std::system((program + bad + " -o " + (folder_.path() / "b.glb").string() + " 2>/dev/null").c_str()), 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "b.glb"));
}

}  // namespace
}  // namespace oriel
