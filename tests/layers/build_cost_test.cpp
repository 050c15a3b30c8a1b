// What the build costs, by the record that ninja keeps of it: nothing is compiled here. A machine's speed and what else
// it did meanwhile fall out, as all is measured by a file that never changes and was compiled in the same build.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/layers/root.h"

namespace {

struct Cost {
  double sum = 0, longest = 0;  // of all objects, by the reference's time
  std::string which;            // takes longest
};

constexpr double kCached_s = 0.3;     // a reference that took less came from a cache, and the others as well
constexpr double kOneBuild_s = 3600;  // what was compiled at another time has no reference: the machine was another

struct Compiled {
  double seconds = 0, at_s = 0;  // how long it took, and when it was done
};

// Each object that is there, as it was compiled last.
template <class IsThere>
std::map<std::string, Compiled> compiled_objects(std::istream& log, const IsThere& is_there) {
  std::map<std::string, Compiled> out;
  std::string line;
  while (std::getline(log, line)) {
    std::istringstream words(line);
    double begun_ms = 0, ended_ms = 0, changed_ns = 0;
    std::string output;
    if (words >> begun_ms >> ended_ms >> changed_ns >> output && (output.ends_with(".o") || output.ends_with(".gch")) &&
        is_there(output))
      out[output] = {(ended_ms - begun_ms) / 1000, changed_ns / 1e9};
  }
  return out;
}

// None where the record does not tell: the reference was not compiled, or taken from a cache.
std::optional<Cost> cost_of(const std::map<std::string, Compiled>& objects) {
  std::vector<Compiled> references;
  for (const auto& [output, object] : objects)
    if (output.find("build_reference") != std::string::npos) references.push_back(object);
  std::ranges::sort(references, {}, &Compiled::seconds);
  if (references.empty() || references[references.size() / 2].seconds < kCached_s) return std::nullopt;
  const Compiled reference = references[references.size() / 2];
  Cost out;
  for (const auto& [output, object] : objects) {
    if (std::abs(object.at_s - reference.at_s) > kOneBuild_s) continue;
    const double cost = object.seconds / reference.seconds;
    out.sum += cost;
    if (cost > out.longest) out.longest = cost, out.which = output;
  }
  return out;
}

double recorded(const std::string& name) {
  std::ifstream in(kRoot / "tests/layers/build_cost.txt");
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string found;
    double value = 0;
    if (words >> found >> value && found == name) return value;
  }
  ADD_FAILURE() << "tests/layers/build_cost.txt has no line '" << name << "'";
  return 0;
}

std::string complaints(const Cost& cost) {
  std::ostringstream out;
  if (cost.longest > recorded("longest"))
    out << cost.which << " takes " << cost.longest << " times the reference, at most " << recorded("longest") << "\n";
  if (cost.sum > 1.1 * recorded("sum"))
    out << "all objects take " << cost.sum << " times the reference, " << recorded("sum") << " were recorded\n";
  return out.str();
}

TEST(BuildCost, FailsWhereAnObjectOrTheSumCostsTooMuch) {
  const auto told = [](double reference, double longest, int others) {
    std::ostringstream log;
    log << "# ninja log v5\n0\t" << 1000 * reference << "\t1\tbuild_reference.cpp.o\t2\n0\t9000\t1\tbin/program\t3\n"
        << "0\t99999\t1\tlongest.cpp.o\t4\n0\t" << 1000 * longest << "\t1\tlongest.cpp.o\t4\n";
    for (int i = 0; i < others; ++i) log << "0\t" << 1000 * reference << "\t1\tother" << i << ".cpp.o\t5\n";
    std::istringstream in(log.str());
    return cost_of(compiled_objects(in, [](const std::string&) { return true; }));
  };
  const double longest = recorded("longest");
  const int sum = static_cast<int>(recorded("sum") - longest);
  ASSERT_TRUE(told(1, longest, sum));
  EXPECT_EQ(complaints(*told(1, longest, sum)), "");
  EXPECT_EQ(complaints(*told(3, 3 * longest, sum)), "") << "a machine three times as slow";
  EXPECT_NE(complaints(*told(1, 1.01 * longest, 9)).find("longest.cpp.o"), std::string::npos);
  EXPECT_NE(complaints(*told(1, 1, static_cast<int>(1.12 * recorded("sum")))).find("all objects"), std::string::npos);
  EXPECT_FALSE(told(0.01, 1, 9)) << "from a cache";
}

TEST(BuildCost, OfThisBuildIsAsRecorded) {
#ifndef ORIEL_BUILD_COST
  GTEST_SKIP() << "another build than that of the record: GCC, Release, files joined, one precompiled header";
#endif
  const fs::path build = fs::path(ORIEL_BIN_DIR).parent_path();
  std::ifstream log(build / ".ninja_log");
  if (!log) GTEST_SKIP() << "this build was not made by ninja";
  const std::optional<Cost> cost =
      cost_of(compiled_objects(log, [&](const std::string& output) { return fs::exists(build / output); }));
  if (!cost) GTEST_SKIP() << "objects came from a cache";
  RecordProperty("sum", std::to_string(cost->sum));
  RecordProperty("longest", std::to_string(cost->longest));
  EXPECT_EQ(complaints(*cost), "");
}

}  // namespace
