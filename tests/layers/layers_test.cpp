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

namespace {
namespace fs = std::filesystem;

const fs::path kRoot = ORIEL_SOURCE_DIR;

// Each folder and the folders it may include, besides itself: docs/architecture.md draws the same arrows.
const std::map<std::string, std::set<std::string>> kArrows = [] {
  const std::set<std::string> core{"formats/core"};
  const std::set<std::string> assets{"formats/core", "formats/sh", "formats/assets"};
  const auto plus = [](std::set<std::string> a, const std::set<std::string>& b) {
    a.insert(b.begin(), b.end());
    return a;
  };
  std::map<std::string, std::set<std::string>> m;
  m["formats/core"] = {};
  m["formats/cli"] = core;
  m["formats/sh"] = m["formats/image"] = core;
  m["formats/image"].insert("formats/image/bc6h");
  m["formats/image/bc6h"] = plus(core, {"formats/core/threads"});
  m["formats/metrics"] = plus(core, {"formats/image"});
  m["formats/assets"] = plus(core, {"formats/sh"});
  m["formats/camera"] = m["formats/lobes"] = assets;
  m["formats/motion"] = assets;       // where movers stand
  m["formats/light"] = assets;        // baked light at a point, for baker and player
  m["formats/rays"] = assets;         // a mesh met by rays
  m["formats/visibility"] = assets;   // what is seen from where
  m["formats/pack/encoding"] = core;  // bytes and numbers apart from what they mean
  m["formats/pack/rules"] = plus(assets, {"formats/pack", "formats/visibility"});  // the parts of validate()
  m["formats/pack/sections"] =
      plus(assets, {"formats/pack", "formats/pack/encoding", "formats/visibility"});  // what lies inside each
  m["formats/pack"] =
      plus(assets, {"formats/pack/encoding", "formats/pack/rules", "formats/pack/sections", "formats/visibility"});
  m["formats/diff"] =
      plus(assets, {"formats/pack", "formats/image", "formats/metrics"});  // two packs beside each other
  m["formats/why"] = plus(assets, {"formats/pack", "formats/rays"});       // why a place is lit as it is
  m["formats/report"] =
      plus(assets, {"formats/rays", "formats/why", "formats/diff", "formats/pack", "formats/image", "formats/metrics"});
  m["formats/export"] =
      plus(assets, {"formats/camera", "formats/pack", "formats/image", "formats/image/bc6h", "formats/metrics"});
  m["formats/inspect"] = plus(assets, {"formats/diff", "formats/export", "formats/pack", "formats/image",
                                       "formats/rays", "formats/report", "formats/visibility", "formats/why"});
  m["bake/jobs"] = core;
  m["bake/cache"] = plus(core, {"bake/jobs"});  // finished units of work: it knows no stage
  m["bake/scene"] = plus(assets, {"bake/jobs"});
  m["bake/scene/texture"] = plus(assets, {"bake/jobs", "bake/scene"});  // images of the file
  m["bake/scene/optics"] = core;                                        // physics of surfaces: no scene
  m["bake/scene/gltf"] =
      plus(assets, {"bake/jobs", "bake/scene", "bake/scene/optics"});  // the file format apart from the scene
  m["bake/scene/light"] = plus(m["bake/scene/gltf"], {"bake/scene/gltf"});
  m["bake/scene/motion"] = plus(m["bake/scene/gltf"], {"bake/scene/gltf", "formats/motion"});  // what animations move
  m["bake/scene"] = plus(m["bake/scene"], {"bake/scene/gltf", "bake/scene/light", "bake/scene/motion",
                                           "bake/scene/optics", "bake/scene/texture"});
  m["bake/trace"] = m["bake/atlas"] =
      plus(assets, {"bake/jobs", "bake/scene", "bake/scene/light", "bake/scene/optics"});
  m["bake/trace/brdf"] = plus(core, {"bake/scene/optics"});       // reflection models as functions: no scene, no rays
  m["bake/atlas/chart"] = plus(m["bake/atlas"], {"bake/atlas"});  // one chart apart from the pages
  m["bake/atlas"].insert("bake/atlas/chart");
  m["bake/trace"].insert("bake/trace/brdf");
  m["bake/trace/lights"] = plus(m["bake/trace"], {"bake/trace"});     // one kind of light each
  m["bake/trace/particles"] = plus(m["bake/trace"], {"bake/trace"});  // light as particles
  m["bake/direct"] =
      plus(m["bake/trace"], {"bake/trace", "formats/lobes"});  // what the stages that compute irradiance share
  const auto stage = plus(m["bake/trace"], {"bake/trace", "bake/atlas", "bake/direct"});
  m["bake/trace"].insert("bake/trace/lights");
  for (const char* name : {"bake/radiosity", "bake/radiance", "bake/material", "bake/transfer"}) m[name] = stage;
  m["bake/radiance/curved"] = plus(stage, {"bake/radiance"});    // shiny surfaces that no plane holds
  m["bake/radiance/emitters"] = plus(stage, {"bake/radiance"});  // what maps leave out
  m["bake/radiance/mesh"] = plus(stage, {"bake/radiance"});      // their depth as triangles
  m["bake/radiance/plan"] = plus(stage, {"bake/radiance"});      // which viewpoints
  m["bake/radiance/reuse"] = plus(stage, {"bake/radiance", "bake/radiance/plan"});  // maps that an edit leaves
  m["bake/walk"] = plus(m["bake/trace/lights"], {"formats/camera"});                // where eyes can be
  m["bake/visibility"] = plus(m["bake/trace/lights"], {"formats/visibility"});      // what eyes see
  m["bake/lux"] = plus(m["bake/direct"], {"bake/direct"});
  m["bake/reference"] = plus(m["bake/trace"], {"bake/trace", "formats/camera", "formats/image", "formats/metrics"});
  m["bake/radiosity/frames"] = stage;  // pixels that eyes see of the lightmap
  m["bake/radiosity"].insert({"bake/radiosity/cached", "bake/radiosity/detail", "bake/radiosity/frames",
                              "bake/radiosity/paths", "bake/radiosity/texels"});
  m["bake/radiosity/texels"] = stage;  // what both estimators and the stitching know of texels
  m["bake/radiosity/gather"] =
      plus(stage, {"bake/radiosity/texels", "bake/trace/particles"});  // rays into light that texels hold
  m["bake/radiosity/paths"] = plus(stage, {"bake/radiosity", "bake/radiosity/frames", "bake/radiosity/texels"});
  m["bake/radiosity/detail"] = plus(stage, {"bake/radiosity", "bake/radiosity/cached", "bake/radiosity/frames",
                                            "bake/radiosity/gather", "bake/radiosity/texels"});  // between texels
  m["bake/radiosity/cached"] = m["bake/radiosity/detail"];
  m["bake/radiosity/cached"].erase("bake/radiosity/cached");
  m["bake/ledger"] = plus(
      stage, {"bake/radiosity", "bake/radiosity/texels", "bake/trace/particles"});  // a check of what radiosity made
  m["bake/run"] =
      plus(stage, {"bake/radiosity",         "bake/ledger",        "bake/radiance",      "bake/material",
                   "bake/transfer",          "bake/scene/motion",  "bake/lux",           "bake/radiance/curved",
                   "bake/radiance/emitters", "bake/radiance/mesh", "bake/radiance/plan", "bake/radiance/reuse",
                   "bake/radiosity/frames",  "bake/visibility",    "bake/walk",          "formats/cli",
                   "formats/motion",         "formats/pack",       "formats/image",      "formats/visibility"});
  m["bake/plan"] = plus(m["bake/run"], {"bake/run"});
  // Measures the programs from outside: it knows packs and pictures, and no stage.
  m["tools/trade"] =
      plus(assets, {"bake/jobs", "formats/diff", "formats/pack", "formats/image", "formats/metrics", "formats/camera"});
  m["tools/trade/page"] = plus(m["tools/trade"], {"tools/trade"});
  m["bake/cli"] = plus(m["bake/plan"], {"bake/cache", "bake/plan", "bake/reference", "tools/trade", "tools/trade/page",
                                        "formats/camera"});
  m["player/gpu"] = core;
  m["player/view"] = assets;
  m["player/walk"] = plus(assets, {"formats/camera", "formats/pack"});
  m["player/textures"] = plus(assets, {"formats/pack/encoding", "player/gpu"});  // images as the device takes them
  m["player/maps"] =
      plus(m["player/textures"], {"player/textures"});  // one element's radiance maps: no frame, no scene
  m["player/loading"] =
      plus(m["player/maps"], {"formats/pack", "player/maps", "player/view"});  // images: which, how fine, when
  m["player/scene"] =
      plus(m["player/loading"], {"formats/light", "formats/lobes", "formats/visibility", "player/loading"});
  m["player/paths"] = plus(assets, {"formats/camera"});  // walks: files, recorded, smoothed
  m["player/poses"] =
      plus(assets, {"formats/motion", "formats/pack", "formats/rays", "player/view"});  // by clock and user
  m["player/movers"] = plus(m["player/scene"], {"formats/light", "formats/motion", "player/scene"});  // what moves
  m["player/reflections"] = plus(m["player/scene"], {"player/scene"});
  m["player/survey"] = plus(m["player/scene"], {"formats/camera", "formats/image", "player/scene", "player/walk"});
  m["player/passes"] =
      plus(m["player/reflections"], {"player/survey", "formats/image", "formats/motion", "player/movers",
                                     "player/reflections", "player/walk", "formats/camera"});
  // What the user does, without a window; its values by name; what is written of frames; what is drawn over them.
  m["player/session"] = plus(m["player/passes"], {"player/passes", "player/paths", "player/poses", "player/walk",
                                                  "formats/camera", "formats/rays", "formats/why"});
  m["player/options"] = plus(m["player/session"], {"formats/cli", "player/session"});
  m["player/output"] =
      plus(m["player/options"], {"player/options", "formats/image", "formats/metrics", "formats/camera"});
  m["player/panel"] = plus(m["player/options"], {"player/options", "player/survey"});
  // What a frame is shown beside.
  m["player/comparison"] = plus(m["player/output"], {"player/output"});
  m["player/window"] = plus(m["player/comparison"], {"player/comparison", "player/panel"});
  m["player/app"] = plus(m["player/window"], {"player/window"});
  m["scenes/kit"] = core;
  m["scenes"] = plus(core, {"scenes/kit", "formats/image"});
  return m;
}();

// Libraries that must not spread: the folders that may include their headers.
const std::map<std::string, std::set<std::string>> kGuarded = {
    {"embree3/", {"bake/trace"}},
    {"tbb/", {"bake/jobs"}},
    {"OpenImageIO/", {"bake/scene"}},
    {"CGAL/", {"bake/scene"}},
    {"OpenMesh/", {"bake/atlas/chart"}},
    {"Eigen/", {"bake/atlas/chart", "bake/radiosity", "bake/transfer"}},
    {"boost/", {"bake/radiosity", "bake/radiosity/texels"}},
    {"OpenEXR/", {"formats/image"}},
    {"Imf", {"formats/image"}},
    {"GLFW/", {"player/panel", "player/window"}},
    {"imgui", {"player/panel"}},
    {"backends/imgui", {"player/panel"}},
    {"CLI/", {"formats/cli", "formats/inspect", "scenes"}},
    {"epoxy/",
     {"player/gpu", "player/loading", "player/maps", "player/scene", "player/movers", "player/reflections",
      "player/survey", "player/passes", "player/window", "player/app"}},
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
  EXPECT_EQ(objection("bake/radiosity", "bake/trace/accel.h"), "");
}

// But for formats/core/threads, which is part of core.
TEST(Layers, FoldersOfSourcesAreInTheTable) {
  for (const char* top : {"formats", "bake", "player", "scenes", "tools"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      const std::string folder = fs::relative(entry.path().parent_path(), kRoot).string();
      const bool wanted = is_source(entry.path()) && folder != "formats/core/threads";
      EXPECT_TRUE(!wanted || kArrows.contains(folder)) << entry.path();
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

// The player must stay light enough for a kiosk: neither it nor the inspector loads the baker's libraries.
TEST(Layers, PlayerAndInspectorLinkNoBaker) {
  for (const char* program : {"oriel-play", "oriel-inspect"}) {
    const std::string command = "ldd '" + (fs::path(ORIEL_BIN_DIR) / program).string() + "'";
    FILE* pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string libraries;
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe)) libraries += buffer.data();
    ASSERT_EQ(pclose(pipe), 0) << command;
    EXPECT_NE(libraries.find("libzstd"), std::string::npos) << "ldd printed nothing of use";
    for (const char* heavy : {"embree", "tbb", "OpenImageIO", "CGAL", "OpenMesh", "draco"})
      EXPECT_EQ(libraries.find(heavy), std::string::npos) << program << " links " << heavy;
  }
}

}  // namespace
