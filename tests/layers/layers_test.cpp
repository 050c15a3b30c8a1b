// The architecture as a test: who may include whom, which program links what, and how large a file may grow.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/layers/root.h"

namespace {

using Arrows = std::map<std::string, std::set<std::string>>;

// Each folder and those it rests on: docs/architecture.md draws the same arrows.
const Arrows kRestsOn = {
    {"formats/core", {}},
    {"formats/cli", {"formats/core"}},
    {"formats/image", {"formats/core"}},
    {"formats/assets", {"formats/core"}},
    {"formats/query", {"formats/assets"}},
    {"formats/pack", {"formats/query"}},
    {"formats/analysis", {"formats/pack", "formats/image"}},
    {"formats/export", {"formats/analysis"}},
    {"formats/inspect", {"formats/export", "formats/cli"}},
    {"convert", {"formats/core"}},
    {"convert/importer", {"convert", "formats/cli", "formats/image"}},  // a process of its own: nothing links it
    {"bake/jobs", {"formats/core"}},
    {"bake/brdf", {"formats/core"}},
    {"bake/scene", {"bake/jobs", "bake/brdf", "formats/query"}},
    {"bake/import", {"bake/scene", "convert", "formats/query"}},
    {"bake/trace", {"bake/scene", "formats/query"}},
    {"bake/atlas", {"bake/scene"}},
    {"bake/radiosity/texels", {"bake/trace", "bake/atlas"}},
    {"bake/radiosity/gather", {"bake/radiosity/texels"}},
    {"bake/radiosity/estimators", {"bake/radiosity/gather"}},
    {"bake/radiosity", {"bake/radiosity/estimators"}},
    {"bake/radiance", {"bake/trace"}},
    {"bake/material", {"bake/trace"}},
    {"bake/transfer", {"bake/trace"}},
    {"bake/visibility", {"bake/trace"}},
    {"bake/reference", {"bake/trace", "formats/image"}},
    {"bake/run",
     {"bake/import", "bake/radiosity", "bake/radiance", "bake/material", "bake/transfer", "bake/visibility",
      "bake/reference", "formats/cli", "formats/pack"}},
    {"bake/plan", {"bake/run"}},
    {"trade", {"bake/jobs", "formats/analysis"}},  // measures the programs from outside: it knows no stage
    {"bake/cli", {"bake/plan", "trade"}},
    {"player/gpu", {"formats/core"}},
    {"player/navigation", {"formats/pack"}},
    {"player/images", {"player/gpu", "player/navigation"}},
    {"player/scene", {"player/images"}},
    {"player/movers", {"player/scene"}},
    {"player/reflections", {"player/scene"}},
    {"player/passes", {"player/movers", "player/reflections", "formats/image"}},
    {"player/session", {"player/passes", "formats/analysis", "formats/cli"}},
    {"player/output", {"player/session"}},
    {"player/window", {"player/output"}},
    {"player/app", {"player/window"}},
    {"preview/frame", {"bake/import", "bake/reference", "player/passes"}},  // they meet here
    {"preview", {"preview/frame", "bake/run", "player/window"}},
    {"scenes/kit", {"formats/core"}},
    {"scenes", {"scenes/kit", "formats/image", "formats/cli"}},
};

// Each folder and all that it may include, besides itself: what it rests on, and what that rests on.
Arrows closed(const Arrows& direct) {
  Arrows all = direct;
  for (bool grew = true; grew;) {
    grew = false;
    for (auto& [folder, below] : all)
      for (const std::string& one : std::set<std::string>(below))
        for (const std::string& more : all.at(one)) grew |= below.insert(more).second;
  }
  return all;
}

const Arrows kArrows = closed(kRestsOn);

// Libraries that must not spread: the folders that may include their headers.
const std::map<std::string, std::set<std::string>> kGuarded = {
    {"embree3/", {"bake/trace"}},
    {"tbb/", {"bake/jobs"}},
    {"OpenImageIO/", {"bake/import", "convert/importer"}},
    {"assimp/", {"convert/importer"}},
    {"CGAL/", {"bake/import"}},
    {"OpenMesh/", {"bake/atlas"}},
    {"Eigen/", {"bake/atlas", "bake/radiosity", "bake/transfer"}},
    {"boost/", {"bake/scene"}},
    {"OpenEXR/", {"formats/image"}},
    {"Imf", {"formats/image"}},
    {"GLFW/", {"player/window"}},
    {"imgui", {"player/window", "preview"}},
    {"backends/imgui", {"player/window"}},
    {"nlohmann/", {"formats/core"}},
    {"CLI/", {"formats/cli"}},
    {"epoxy/",
     {"player/gpu", "player/images", "player/scene", "player/movers", "player/reflections", "player/passes",
      "player/window", "player/app"}},
};

bool is_source(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

std::string folder_of(const std::string& include) {
  const std::size_t slash = include.rfind('/');
  return slash == std::string::npos ? "" : include.substr(0, slash);
}

// Why `file` of `folder` may not include `include`; empty where it may.
std::string objection(const std::string& folder, const std::string& include) {
  for (const auto& [prefix, folders] : kGuarded)
    if (include.rfind(prefix, 0) == 0 && !folders.contains(folder)) return "only for " + *folders.begin();
  if (include.starts_with("study/")) return "nothing needs the study";
  const std::string target = folder_of(include);
  if (!kArrows.contains(target) || target == folder) return "";
  return kArrows.at(folder).contains(target) ? "" : "against the arrows";
}

// Types that a source declares with a body, as namespace::Name; those of anonymous namespaces and inside classes are
// its own affair.
std::vector<std::string> declared_types(std::istream& in) {
  static const std::regex opens(R"(^namespace\s*([\w:]*)\s*\{)"), closes(R"(^\}\s*// namespace.*)"),
      type(R"(^(?:template\s*<.*>\s*)?(?:class|struct|union|enum(?:\s+class)?)\s+(\w+)(?!\w|::|<)([^;{]*)(\{.*)?$)");
  std::vector<std::string> names, spaces;
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (std::regex_search(line, match, opens)) spaces.push_back(match[1]);
    if (std::regex_match(line, closes) && !spaces.empty()) spaces.pop_back();
    if (!std::regex_match(line, match, type)) continue;
    if (std::count(spaces.begin(), spaces.end(), "") > 0) continue;
    std::ostringstream name;
    for (const std::string& space : spaces) name << space << "::";
    name << match[1];
    names.push_back(name.str());
  }
  return names;
}

template <class Visit>
void each_source(const Visit& visit) {
  for (const auto& [folder, allowed] : kArrows) {
    if (!fs::exists(kRoot / folder)) continue;
    for (const auto& entry : fs::directory_iterator(kRoot / folder))
      if (is_source(entry.path())) visit(folder, entry.path());
  }
}

TEST(Layers, TheCheckerSeesAForbiddenInclude) {
  EXPECT_NE(objection("formats/core", "bake/scene/scene.h"), "");
  EXPECT_NE(objection("bake/atlas", "bake/trace/accel.h"), "");
  EXPECT_NE(objection("player/scene", "bake/jobs/context.h"), "");
  EXPECT_NE(objection("bake/radiosity", "embree3/rtcore.h"), "");
  EXPECT_NE(objection("bake/run", "nlohmann/json.hpp"), "");
  EXPECT_NE(objection("bake/import", "assimp/scene.h"), "");
  EXPECT_NE(objection("bake/import", "convert/importer/textures.h"), "");
  EXPECT_NE(objection("player/passes", "study/rooms.h"), "");
  EXPECT_NE(objection("bake/radiosity/texels", "bake/radiosity/radiosity.h"), "");
  EXPECT_EQ(objection("bake/radiosity", "bake/trace/accel.h"), "");
}

TEST(Layers, TheCheckerSeesACircle) {
  const Arrows circle = closed({{"a", {"b"}}, {"b", {"c"}}, {"c", {"a"}}, {"d", {"a"}}});
  EXPECT_TRUE(circle.at("a").contains("a"));
  EXPECT_FALSE(circle.at("d").contains("d"));
}

TEST(Layers, ArrowsHaveNoCircles) {
  for (const auto& [folder, below] : kArrows) EXPECT_FALSE(below.contains(folder)) << folder;
}

TEST(Layers, FoldersOfSourcesAreInTheTable) {
  for (const char* top : {"formats", "convert", "bake", "player", "preview", "scenes", "trade"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      const std::string folder = fs::relative(entry.path().parent_path(), kRoot).string();
      EXPECT_TRUE(!is_source(entry.path()) || kArrows.contains(folder)) << entry.path();
    }
}

// What of a source is code: comments may cite where something comes from.
std::string without_comments(const fs::path& path) {
  std::ifstream in(path);
  std::string code;
  for (std::string line; std::getline(in, line);) code += line.substr(0, line.find("//")) + "\n";
  return code;
}

TEST(Layers, MethodsOfOthersAreInTheStudyAlone) {
  const std::regex names("published|bastos|barczak|diefenbach|\\bherf|udeshi", std::regex::icase);
  EXPECT_TRUE(std::regex_search("Method::kBastos1999", names));
  for (const char* top : {"formats", "convert", "bake", "player", "preview", "scenes", "trade", "shaders", "web/src"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top))
      if (entry.is_regular_file()) {
        const std::string code = without_comments(entry.path());
        std::smatch found;
        EXPECT_FALSE(std::regex_search(code, found, names)) << entry.path() << ": " << found.str();
      }
}

TEST(Layers, FoldersOfTheTableAreThere) {
  for (const auto& [folder, allowed] : kArrows) {
    EXPECT_TRUE(fs::is_directory(kRoot / folder)) << folder;
    for (const std::string& target : allowed)
      EXPECT_TRUE(fs::is_directory(kRoot / target)) << folder << " to " << target;
  }
}

TEST(Layers, IncludesFollowTheArrows) {
  const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  int seen = 0;
  each_source([&](const std::string& folder, const fs::path& path) {
    std::ifstream in(path);
    std::smatch match;
    for (std::string line; std::getline(in, line);)
      if (std::regex_search(line, match, include)) {
        ++seen;
        EXPECT_EQ(objection(folder, match[1]), "") << path << " includes " << match[1];
      }
  });
  EXPECT_GT(seen, 200);
}

TEST(Layers, TheCheckerSeesTypes) {
  std::istringstream in(R"(
class Forward;
namespace oriel {
struct One {
  struct Inner { int i; };
};
enum class Two : int { kA };
enum Three { kB };
template <class T>
struct Four {
};
template <>
struct Four<int> {};
class Five final
    : public One {
};
class One::Inner {};
namespace {
class Own {};
}  // namespace
class Six {};
}  // namespace oriel
namespace oriel::gpu {
struct One {};
}  // namespace oriel::gpu)");
  EXPECT_EQ(declared_types(in), (std::vector<std::string>{"oriel::One", "oriel::Two", "oriel::Three", "oriel::Four",
                                                          "oriel::Five", "oriel::Six", "oriel::gpu::One"}));
}

// Two types of one name that meet in one program are undefined behaviour, which no compiler tells: the linker keeps
// one's inline functions for both. In two namespaces they merely mislead readers.
TEST(Layers, TypeNamesAreDeclaredOnce) {
  std::map<std::string, std::set<fs::path>> places;
  each_source([&](const std::string&, const fs::path& path) {
    std::ifstream in(path);
    for (const std::string& name : declared_types(in))
      places[name.substr(name.rfind(':') + 1)].insert(path.lexically_relative(kRoot));
  });
  EXPECT_GT(places.size(), 500u);
  for (const auto& [name, paths] : places) {
    std::string list;
    for (const fs::path& path : paths) list.append(" ").append(path.string());
    EXPECT_EQ(paths.size(), 1u) << name << ":" << list;
  }
}

TEST(Layers, FilesStaySmall) {
  each_source([&](const std::string&, const fs::path& path) {
    std::ifstream in(path);
    int lines = 0;
    for (std::string line; std::getline(in, line);) ++lines;
    EXPECT_LE(lines, 400) << path << " is two concepts";
  });
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests"))
    if (is_source(entry.path())) {
      std::ifstream in(entry.path());
      int lines = 0;
      for (std::string line; std::getline(in, line);) ++lines;
      EXPECT_LE(lines, 400) << entry.path();
    }
}

std::string libraries_of(const std::string& program) {
  const std::string command = "ldd '" + (fs::path(ORIEL_BIN_DIR) / program).string() + "'";
  FILE* pipe = popen(command.c_str(), "r");
  std::string libraries;
  std::array<char, 4096> buffer{};
  while (pipe && std::fgets(buffer.data(), buffer.size(), pipe)) libraries += buffer.data();
  EXPECT_EQ(pipe ? pclose(pipe) : -1, 0) << command;
  return libraries;
}

// What other formats' readers do to a process must not be done to a bake.
TEST(Layers, TheImporterAloneLinksAssimp) {
  for (const char* program : {"oriel-bake", "oriel-preview", "oriel-play", "oriel-inspect"})
    EXPECT_EQ(libraries_of(program).find("assimp"), std::string::npos) << program;
  EXPECT_NE(libraries_of("oriel-import").find("assimp"), std::string::npos);
}

// The player must stay light enough for a kiosk: neither it nor the inspector loads the baker's libraries.
TEST(Layers, PlayerAndInspectorLinkNoBaker) {
  for (const char* program : {"oriel-play", "oriel-inspect"}) {
    const std::string libraries = libraries_of(program);
    EXPECT_NE(libraries.find("libzstd"), std::string::npos) << "ldd printed nothing of use";
    for (const char* heavy : {"embree", "tbb", "OpenImageIO", "CGAL", "OpenMesh", "draco"})
      EXPECT_EQ(libraries.find(heavy), std::string::npos) << program << " links " << heavy;
  }
}

}  // namespace
