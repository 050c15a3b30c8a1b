// Finished units: what is found, what is not trusted, who may compute.
#include "bake/jobs/unit_cache.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>
#include <fstream>

#include <numeric>
#include <thread>

#include "bake/jobs/checking_store.h"
#include "bake/jobs/parallel.h"
#include "formats/core/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/waiting.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;
using std::chrono::milliseconds;

class UnitCacheTest : public ::testing::Test {
 protected:
  void warn(const std::string& text) { warnings_.push_back(text); }
  UnitCache cache(const std::string& program = "me") {
    return {folder_.path(), program, [this](const Warning& told) { warn(told.text); }};
  }
  // The files of units.
  std::vector<fs::path> files() const {
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      if (entry.path().extension() == ".unit") out.push_back(entry.path());
    return out;
  }

  testing::TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

const Hash128 kName{1, 2};
KeptUnit unit_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {Bytes(bytes.begin(), bytes.end()), 0.5};
}

TEST_F(UnitCacheTest, FindsWhatWasKept) {
  UnitCache one = cache();
  EXPECT_FALSE(one.find(kName));
  one.keep(kName, unit_of("light"));
  UnitCache other = cache();
  const auto found = other.find(kName);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->results, unit_of("light").results);
  EXPECT_EQ(found->seconds, 0.5);
  EXPECT_FALSE(other.find({1, 3}));
  EXPECT_FALSE(cache("another build").find(kName));
  EXPECT_EQ(other.share().reused, 1);
  EXPECT_EQ(one.share().computed, 1);
}

TEST_F(UnitCacheTest, TrustsNoByteThatIsNotAsWritten) {
  cache().keep(kName, unit_of("light"));
  ASSERT_EQ(files().size(), 1);
  const auto whole = read_file(files()[0]);
  ASSERT_TRUE(whole);
  for (std::size_t size = 0; size < whole->size(); ++size) {
    ASSERT_TRUE(write_file_atomically(files()[0], std::span(*whole).first(size)));
    EXPECT_FALSE(cache().find(kName)) << size << " bytes of it";
  }
  for (std::size_t at = 0; at < whole->size(); ++at) {
    Bytes damaged = *whole;
    damaged[at] ^= std::byte{16};
    ASSERT_TRUE(write_file_atomically(files()[0], damaged));
    EXPECT_FALSE(cache().find(kName)) << "byte " << at;
  }
  ASSERT_TRUE(write_file_atomically(files()[0], *whole));
  EXPECT_TRUE(cache().find(kName));
  const fs::path first = files()[0];
  cache().keep({7, 7}, unit_of("dark"));
  for (const fs::path& file : files())
    if (file != first) {
      ASSERT_TRUE(write_file_atomically(file, *whole));
    }
  EXPECT_FALSE(cache().find({7, 7})) << "another unit's file under its name";
}

TEST_F(UnitCacheTest, AFolderThatCannotBeWrittenWarnsOnceAndHindersNothing) {
  UnitCache nowhere("/proc/no/such/folder", "me", [this](const Warning& told) { warn(told.text); });
  for (std::uint64_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(nowhere.claim({i, 0}));
    nowhere.keep({i, 0}, unit_of("light"));
  }
  EXPECT_EQ(warnings_.size(), 1);
  EXPECT_EQ(nowhere.share().computed, 3);
}

TEST_F(UnitCacheTest, PrunesWhatWasUsedLongestAgo) {
  UnitCache used = cache();
  for (std::uint64_t i = 0; i < 4; ++i) {
    used.keep({i, 0}, unit_of("light"));
    for (const fs::path& file : files()) fs::last_write_time(file, fs::last_write_time(file) - std::chrono::hours(1));
  }
  ASSERT_TRUE(used.find({0, 0}));  // the oldest, but used last
  const auto content = cache_content(folder_.path());
  ASSERT_TRUE(content);
  EXPECT_EQ(content->units, 4);
  ASSERT_TRUE(prune_cache(folder_.path(), content->bytes / 2));
  EXPECT_TRUE(used.find({0, 0}));
  EXPECT_TRUE(used.find({3, 0}));
  EXPECT_FALSE(used.find({1, 0}));
  EXPECT_FALSE(used.find({2, 0}));
}

// Whatever folder it is told to prune: what is not named as units are stays.
TEST_F(UnitCacheTest, PruningLeavesWhatIsNotItsOwn) {
  cache().keep({1, 0}, unit_of("light"));
  const auto foreign = folder_.path() / "ab";
  std::filesystem::create_directories(foreign);
  for (const char* name : {"a.unit", "notes.unit.ts", "0123456789abcdef0123456789abcd.units"})
    std::ofstream(foreign / name) << "theirs";
  ASSERT_TRUE(prune_cache(folder_.path(), 0));
  EXPECT_EQ(cache_content(folder_.path())->units, 0);
  for (const auto& entry : std::filesystem::directory_iterator(foreign)) EXPECT_TRUE(entry.exists());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(foreign), {}), 3);
}

TEST_F(UnitCacheTest, OneClaimsAtATime) {
  Leases a(folder_.path()), b(folder_.path());
  EXPECT_TRUE(a.claim(kName));
  EXPECT_FALSE(a.claim(kName)) << "another thread of the same process";
  EXPECT_FALSE(b.claim(kName));
  EXPECT_TRUE(b.claim({3, 3}));
  a.release(kName);
  EXPECT_TRUE(b.claim(kName));
}

TEST_F(UnitCacheTest, ALeaseThatIsRenewedDoesNotEndAndOneThatIsNotDoes) {
  const milliseconds life(1500);  // a busy machine may let a heart beat late
  Leases living(folder_.path(), life), observer(folder_.path(), life);
  ASSERT_TRUE(living.claim(kName));
  // What processes of another machine left, one after another: no heart beats, and each ends a life later.
  for (std::uint64_t i = 5; i < 8; ++i) {
    const std::string foreign = "another-boot/pid:[1]/7/7 0 1\n";
    ASSERT_TRUE(write_file_atomically(folder_.path() / (to_hex({i, i}) + ".lease"), std::as_bytes(std::span(foreign))));
    EXPECT_FALSE(observer.claim({i, i})) << "it is seen for the first time";
    EXPECT_TRUE(testing::wait_until([&] {
      EXPECT_FALSE(observer.claim(kName));
      return observer.claim({i, i});
    }));
  }
}

TEST_F(UnitCacheTest, TheLeaseOfADeadProcessOfThisMachineEndsAtOnce) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Leases dying(folder_.path());
    ::_exit(dying.claim(kName) ? 0 : 1);  // like a kill: nothing is released
  }
  int status = 1;
  ::waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  EXPECT_TRUE(fs::exists(folder_.path() / (to_hex(kName) + ".lease")));
  EXPECT_TRUE(Leases(folder_.path()).claim(kName));
}

TEST_F(UnitCacheTest, ADoubterComputesItsShareAgainAndTellsWhatDiffers) {
  UnitCache kept = cache();
  for (std::uint64_t i = 0; i < 100; ++i) kept.keep({i, 0}, unit_of("light"));
  CheckingStore half(kept, 0.5, 1), all(kept, 1, 1), none(kept, 0, 1);
  std::size_t found = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    found += half.find({i, 0}).has_value();
    EXPECT_FALSE(all.find({i, 0}));
    EXPECT_TRUE(none.find({i, 0}));
    EXPECT_TRUE(all.claim({i, 0}));
    all.keep({i, 0}, unit_of(i == 7 ? "dark" : "light"));
  }
  EXPECT_GT(found, 25);
  EXPECT_LT(found, 75);
  EXPECT_EQ(all.checked(), 100);
  EXPECT_EQ(all.differing(), 1);
  all.keep({200, 0}, unit_of("new"));
  EXPECT_TRUE(kept.find({200, 0})) << "what nobody knew is kept";
  EXPECT_EQ(all.checked(), 100);
}

// Squares of numbers, as units.
struct Squares {
  std::vector<int> of = std::vector<int>(100);
  std::atomic<int> computed{0};
  std::uint64_t add = 0;

  Status run(Context& context, std::atomic<std::uint64_t>& rays) {
    UnitLoop loop{.stage = "squares", .count = of.size(), .rays = 1e5};
    loop.inputs = [&](std::size_t i, Archive& key) { key(i, add); };
    loop.compute = [&](std::size_t i) {
      ++computed;
      of[i] = static_cast<int>(i * i + add);
      return i;
    };
    loop.results = [&](std::size_t i, Archive& archive) { archive(of[i]); };
    const StageInputs inputs(context, context.inputs);
    return parallel_units({context, &rays}, loop);
  }
};

TEST_F(UnitCacheTest, WhatNoInputsNameIsNotKept) {
  UnitCache store = cache();
  Context context;
  context.units = &store;
  int computed = 0;
  for (int i = 0; i < 2; ++i)
    ASSERT_TRUE(one_unit(
        context, "nameless", [](Archive&) {}, [&] { return ++computed, Status(); }, [](Archive&) {}));
  EXPECT_EQ(computed, 2);
}

TEST_F(UnitCacheTest, LoopsFindTheirUnitsAndTheirRays) {
  for (const bool warm : {false, true}) {
    UnitCache store = cache();
    Context context;
    context.units = &store;
    Squares squares;
    std::atomic<std::uint64_t> rays{0};
    ASSERT_TRUE(squares.run(context, rays));
    EXPECT_EQ(squares.computed, warm ? 0 : 100);
    EXPECT_EQ(squares.of[99], 99 * 99);
    EXPECT_EQ(rays, 99 * 50);
    EXPECT_EQ(store.share().reused, warm ? 100 : 0);
    Squares other;
    other.add = warm ? 2 : 1;
    ASSERT_TRUE(other.run(context, rays));
    EXPECT_EQ(other.computed, 100) << "of other inputs";
    const StageInputs inputs(context, std::string(warm ? "another stage" : "a stage"));
    Squares elsewhere;
    ASSERT_TRUE(elsewhere.run(context, rays));
    EXPECT_EQ(elsewhere.computed, 100);
  }
}

TEST_F(UnitCacheTest, TwoShareALoop) {
  UnitCache a = cache(), b = cache();
  Squares squares[2];
  std::atomic<std::uint64_t> rays[2] = {0, 0};
  const auto work = [&](int i, UnitCache& store) {
    Context context;
    context.threads = 1;
    context.units = &store;
    EXPECT_TRUE(squares[i].run(context, rays[i]));
  };
  std::thread other([&] { work(1, b); });
  work(0, a);
  other.join();
  EXPECT_EQ(squares[0].of, squares[1].of);
  EXPECT_EQ(rays[0], rays[1]);
  EXPECT_EQ(squares[0].computed + squares[1].computed, 100) << "none twice";
}

TEST(Archive, WhatIsWrittenIsReadAndWhatIsCutOffIsNot) {
  std::vector<std::string> names{"a", "", "bc"};
  std::vector<bool> flags{true, false, true};
  std::pair<Vec3, std::array<std::vector<int>, 2>> mixed{Vec3(1, 2, 3), {std::vector<int>{4}, {}}};
  Bytes bytes;
  Archive write(bytes);
  write(names, flags, mixed);
  const auto read = [](std::span<const std::byte> from, auto names_read) {
    std::vector<bool> f;
    std::pair<Vec3, std::array<std::vector<int>, 2>> m;
    Archive archive(from);
    archive(names_read, f, m);
    return std::tuple{archive.complete(), names_read, f, m};
  };
  EXPECT_EQ(read(bytes, std::vector<std::string>()), (std::tuple{true, names, flags, mixed}));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(std::get<0>(read(std::span(bytes).first(size), std::vector<std::string>()))) << size;
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(std::get<0>(read(bytes, std::vector<std::string>()))) << "one byte too many";
}

TEST(Archive, EveryValueEntersTheHash) {
  EXPECT_EQ(hash_of(1, 2.0f, std::string("a")), hash_of(1, 2.0f, std::string("a")));
  EXPECT_NE(hash_of(1, 2.0f), hash_of(1, 2.5f));
  EXPECT_NE(hash_of(std::string("ab"), std::string("c")), hash_of(std::string("a"), std::string("bc")));
  EXPECT_NE(hash_of(std::vector<int>{0}), hash_of(std::vector<int>{0, 0}));
}

}  // namespace
}  // namespace oriel
