// Bakes that share a cache, as a user meets them: processes that join, leave and die.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/waiting.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;
using testing::count_files;
using testing::wait_until;

class Farm : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(finish("oriel-scenes cornell -o cornell.glb"), 0); }

  // With the environment's variables in front, as a shell has it.
  pid_t start(const std::string& command, const std::string& environment = "") const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    const std::string line = "cd '" + folder_.path().string() + "' && " + environment + " exec '" + ORIEL_BIN_DIR +
                             "'/" + command + " >>log 2>&1";
    ::execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    ::_exit(99);
  }
  static int wait(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  int finish(const std::string& command) const { return wait(start(command)); }

  std::string bake(const std::string& pack, const std::string& more) const {
    const bool named = more.find("--error") != more.npos;
    return "oriel-bake cornell.glb -o " + pack + " --report " + pack + ".json --threads 1" + kScene +
           (named ? "" : kError) + more;
  }
  std::string worker(const std::string& cache) const {
    return "oriel-bake worker cornell.glb --threads 1 --cache " + cache + kOptions;
  }
  Bytes bytes(const std::string& file) const { return read_file(folder_.path() / file).value_or(Bytes()); }
  Json report(const std::string& pack) const { return Json::parse(bytes(pack + ".json")).value(); }
  std::uint64_t units(const std::string& pack, const char* which) const {
    return report(pack)["units"][which].get<std::uint64_t>();
  }

  // Texts of one length.
  void replace_in_scene(const std::string& what, const std::string& by) const {
    Bytes scene = bytes("cornell.glb");
    const std::string_view text(reinterpret_cast<const char*>(scene.data()), scene.size());
    const std::size_t at = text.find(what);
    ASSERT_NE(at, text.npos) << what;
    ASSERT_EQ(what.size(), by.size());
    std::copy_n(std::as_bytes(std::span(by)).begin(), by.size(), scene.begin() + static_cast<long>(at));
    ASSERT_TRUE(write_file_atomically(folder_.path() / "cornell.glb", scene));
  }

  static constexpr const char *kAlbedo = "0.6100000143051147", *kDarker = "0.5100000143051147";  // of its white
  static constexpr const char *kScene = " --texel 6cm --object 'tall block:mover' --probe 80cm --quiet",
                              *kError = " --error 6%";
  const std::string kOptions = std::string(kScene) + kError;
  testing::TemporaryFolder folder_;
};

TEST_F(Farm, ARepeatedBakeComputesNothingAndAnEditWhatItTouches) {
  ASSERT_EQ(finish(bake("plain.oriel", " --cache off")), 0);
  EXPECT_FALSE(fs::exists(folder_.path() / ".oriel-cache"));
  EXPECT_EQ(units("plain.oriel", "computed"), 0);
  ASSERT_EQ(finish(bake("cold.oriel", "")), 0);
  EXPECT_TRUE(fs::exists(folder_.path() / ".oriel-cache"));
  ASSERT_EQ(finish(bake("warm.oriel", "")), 0);
  EXPECT_EQ(bytes("plain.oriel"), bytes("cold.oriel"));
  EXPECT_EQ(bytes("plain.oriel"), bytes("warm.oriel"));
  EXPECT_GT(units("cold.oriel", "computed"), 10);
  EXPECT_EQ(units("warm.oriel", "computed"), 0);

  ASSERT_EQ(finish(bake("memory.oriel", " --memory 1MiB")), 0);
  EXPECT_EQ(units("memory.oriel", "computed"), 0) << "the limit of maps that the scene does not need";
  ASSERT_EQ(finish(bake("finer.oriel", " --error 3%")), 0);
  EXPECT_GT(units("finer.oriel", "reused"), 0) << "the same first rounds";
  EXPECT_GT(units("finer.oriel", "computed"), 0);
  ASSERT_EQ(finish(bake("seed.oriel", " --seed 2")), 0);
  EXPECT_LE(units("seed.oriel", "reused"), 5) << "kernels and the like know no seed";
}

// Where cameras stand is where people's eyes are, and texels and effort follow these; what they frame changes nothing.
TEST_F(Farm, AnotherFieldOfViewComputesNothing) {
  ASSERT_EQ(finish(bake("a.oriel", " --only radiosity")), 0);
  replace_in_scene("0.6860479116439819", "0.4860479116439819");
  ASSERT_EQ(finish(bake("b.oriel", " --only radiosity")), 0);
  EXPECT_EQ(units("b.oriel", "computed"), 0);
  EXPECT_GT(units("b.oriel", "reused"), 0);
}

TEST_F(Farm, WorkersThatDieAndWhoseClocksAreWrongMakeTheSameBytes) {
  ASSERT_EQ(finish(bake("plain.oriel", " --cache off")), 0);
  const std::string cache = " --cache shared";
  std::vector<pid_t> workers;
  for (int i = 0; i < 3; ++i) workers.push_back(start(worker("shared")));
  const fs::path faketime = "/usr/lib/x86_64-linux-gnu/faketime/libfaketime.so.1";
  if (fs::exists(faketime))
    workers.push_back(start(worker("shared"), "LD_PRELOAD=" + faketime.string() + " FAKETIME=-3d"));
  ASSERT_TRUE(wait_until([&] { return count_files(folder_.path() / "shared", ".unit") > 3; })) << "they work";
  ::kill(workers[0], SIGKILL);
  ASSERT_EQ(finish(bake("farm.oriel", cache)), 0);
  EXPECT_EQ(bytes("plain.oriel"), bytes("farm.oriel"));
  EXPECT_GT(units("farm.oriel", "reused"), 0);
  wait(workers[0]);
  for (std::size_t i = 1; i < workers.size(); ++i) EXPECT_EQ(wait(workers[i]), 0);
  if (!fs::exists(faketime)) GTEST_SKIP() << "the wrong clock: libfaketime is not installed";
}

TEST_F(Farm, APackIsVerifiedAgainstTheSceneAndStaleOnesAreTold) {
  ASSERT_EQ(finish(bake("a.oriel", " --only radiosity --seed 7")), 0);
  const std::string verify = "oriel-bake verify a.oriel cornell.glb --sample 50%";
  EXPECT_EQ(finish(verify), 0) << "the pack knows its options";
  EXPECT_EQ(finish(verify + " --seed 2 --texel 7cm"), 5);
  const auto logged = [&](const char* text) {
    const Bytes log = bytes("log");
    return std::string(reinterpret_cast<const char*>(log.data()), log.size()).find(text) != std::string::npos;
  };
  EXPECT_TRUE(logged("differs from that bake in options.seed (7, not 2), options.texel_m (0.05999"));
  EXPECT_EQ(finish("oriel-bake verify a.oriel missing.glb"), 2);
  EXPECT_EQ(finish("oriel-inspect validate a.oriel --scene cornell.glb"), 0);
  replace_in_scene(kAlbedo, kDarker);
  EXPECT_EQ(finish(verify), 5) << "another albedo";
  EXPECT_TRUE(logged("differs from that bake in the file cornell.glb"));
  EXPECT_EQ(finish("oriel-inspect validate a.oriel --scene cornell.glb"), 5);
  EXPECT_EQ(finish("oriel-inspect validate a.oriel --scene missing.glb"), 2);
}

TEST_F(Farm, ASubmissionIsAScriptOfWorkersAndAPack) {
  ASSERT_EQ(finish("oriel-bake submit --slurm -N 3 \"a b.glb\" -o c.oriel --cache shared --error 1% --hidden-black "
                   "--dry-run"),
            0);
  const Bytes log = bytes("log");
  const std::string text(reinterpret_cast<const char*>(log.data()), log.size());
  for (const char* part : {"--array=0-2", "worker", "a b.glb", "--error", "1%", "--hidden-black", "c.oriel",
                           "--dependency=afterany:\"$workers\""})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
  EXPECT_EQ(text.find("--dry-run"), std::string::npos);
  EXPECT_EQ(finish("oriel-bake submit cornell.glb -o c.oriel --cache shared"), 1) << "which scheduler";
  EXPECT_EQ(finish("oriel-bake submit --slurm cornell.glb -o c.oriel"), 1) << "no folder to share";
}

TEST_F(Farm, CachesAreListedAndPruned) {
  EXPECT_EQ(finish("oriel-bake cache nowhere"), 2);
  ASSERT_EQ(finish(bake("a.oriel", " --only radiosity")), 0);
  EXPECT_EQ(finish("oriel-bake cache .oriel-cache --list"), 0);
  EXPECT_EQ(finish("oriel-bake cache .oriel-cache --prune 3parsec"), 1);
  EXPECT_EQ(finish("oriel-bake cache .oriel-cache --prune 1KiB"), 0);
  ASSERT_EQ(finish(bake("b.oriel", " --only radiosity")), 0);
  EXPECT_EQ(bytes("a.oriel"), bytes("b.oriel"));
  EXPECT_GT(units("b.oriel", "computed"), 0);
}

}  // namespace
}  // namespace oriel
