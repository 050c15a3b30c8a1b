#include "trade/process.h"

#include <gmock/gmock.h>

#include <thread>

#include "formats/core/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/waiting.h"

namespace oriel::trade {
namespace {
using ::testing::HasSubstr;

class Process : public ::testing::Test {
 protected:
  Result<Finished> run(const std::vector<std::string>& arguments) {
    return run_program(arguments, folder_.path() / "log", stop_);
  }
  oriel::testing::TemporaryFolder folder_;
  std::atomic<bool> stop_{false};
};

TEST_F(Process, RunsWithItsArgumentsAsTheyAre) {
  const auto done = run({"/bin/echo", "a  b", "$HOME", "'"});
  ASSERT_TRUE(done) << done.error().text();
  const auto log = read_file(folder_.path() / "log");
  ASSERT_TRUE(log);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(log->data()), log->size()), "a  b $HOME '\n");
}

TEST_F(Process, SaysWhyItFailed) {
  const auto failed = run({"/bin/sh", "-c", "echo first; echo because >&2; exit 3"});
  ASSERT_FALSE(failed);
  EXPECT_THAT(failed.error().text(), HasSubstr("exit code 3: because"));
  EXPECT_THAT(run({"/nowhere/program"}).error().text(), HasSubstr("cannot be started"));
  EXPECT_THAT(run({"/bin/sh", "-c", "kill -9 $$"}).error().text(), HasSubstr("signal 9"));
}

TEST_F(Process, IsStopped) {
  std::thread later([&] {
    oriel::testing::wait_until(
        [&] { return std::filesystem::exists(folder_.path() / "log"); });  // it runs, or is about to
    stop_ = true;
  });
  const auto stopped = run({"/bin/sleep", "60"});
  later.join();
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kStopped);
  EXPECT_EQ(run({"/bin/true"}).error().code, ErrorCode::kStopped) << "nothing starts after that";
}

}  // namespace
}  // namespace oriel::trade
