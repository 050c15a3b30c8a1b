// Bakes that end early: by a signal, by time. What is left is a whole pack with its error, or nothing.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bake/run/fit_maps.h"
#include "bake/run/pipeline.h"
#include "bake/run/prepare.h"
#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/pack/reader.h"
#include "formats/pack/validate.h"
#include "tests/support/waiting.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

class Anytime : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("oriel-anytime-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    const std::string line =
        fmt::format("'{}/oriel-scenes' cornell -o '{}/cornell.glb' >/dev/null", ORIEL_BIN_DIR, folder_.string());
    ASSERT_EQ(std::system(line.c_str()), 0);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // A bake that would take minutes.
  pid_t start() const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    if (::chdir(folder_.c_str()) != 0) ::_exit(99);
    const int file = ::open("log", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDERR_FILENO);
    const std::string program = std::string(ORIEL_BIN_DIR) + "/oriel-bake";
    ::execl(program.c_str(), "oriel-bake", "cornell.glb", "-o", "a.oriel", "--texel", "1cm", "--error", "0.05%",
            "--json-log", static_cast<char*>(nullptr));
    ::_exit(98);
  }
  std::string log() const {
    const auto bytes = read_file(folder_ / "log");
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
  }
  bool says(const std::string& text, const std::string& after = "") const {
    const std::string said = log();
    const std::size_t from = said.find(after);
    return from != std::string::npos && said.find(text, from) != std::string::npos;
  }
  // Direct light after what was gathered: the first light is there, and is refined.
  bool wait_for_refinement() const {
    return testing::wait_until([&] { return says(kDirect, kGathered); });
  }
  static constexpr const char *kGathered = R"("stage":"gather","fraction":1)", *kDirect = R"("stage":"direct light")";
  static int exit_code(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  fs::path pack() const { return folder_ / "a.oriel"; }

  fs::path folder_;
};

void expect_whole(const fs::path& path) {
  const auto pack = read_pack(path);
  ASSERT_TRUE(pack) << pack.error().text();
  for (const Issue& issue : validate(*pack)) EXPECT_NE(issue.severity, Severity::kError) << issue.message;
}

TEST_F(Anytime, TheFirstSignalEndsWithWhatIsThere) {
  const pid_t child = start();
  ASSERT_TRUE(wait_for_refinement()) << log();
  ASSERT_EQ(::kill(child, SIGTERM), 0);
  EXPECT_EQ(exit_code(child), 6) << log();
  EXPECT_NE(log().find("finishing with what is there"), std::string::npos) << log();
  EXPECT_NE(log().find("ended early"), std::string::npos) << log();
  expect_whole(pack());
  const auto plan = Json::parse(read_pack(pack())->plan).value();
  EXPECT_TRUE(plan["radiosity"]["ended_early"].get<bool>());
  EXPECT_GT(plan["radiosity"]["relative_standard_error"].get<double>(), 0.0005) << "the error is that of what is there";
  EXPECT_LT(plan["radiosity"]["relative_standard_error"].get<double>(), 0.2);
}

TEST_F(Anytime, TheSecondSignalStopsAtOnce) {
  const pid_t child = start();
  ASSERT_TRUE(testing::wait_until([&] { return says(kGathered); })) << log();
  ASSERT_EQ(::kill(child, SIGINT), 0);
  ::kill(child, SIGINT);
  const int code = exit_code(child);
  // Signals of one kind that wait are one: then the bake ends with what is there.
  if (code == 6) return expect_whole(pack());
  EXPECT_EQ(code, 130) << log();
  EXPECT_FALSE(fs::exists(pack()));
}

TEST_F(Anytime, AtAnyMomentAWholePackOrNone) {
  // Before anything is said, and as soon as that is.
  for (const std::string moment :
       {"", "warning", "importance", "texel points", "direct light", "lamp paths", "gather"}) {
    fs::remove(pack());
    const pid_t child = start();
    EXPECT_TRUE(testing::wait_until([&] { return moment.empty() || says(moment); })) << moment;
    ::kill(child, SIGTERM);
    const int code = exit_code(child);
    // Before main() installs its handlers the signal ends the process.
    EXPECT_TRUE(code == 0 || code == 6 || code == 130 || code == -1) << code;
    EXPECT_EQ(fs::exists(pack()), code == 0 || code == 6) << moment;
    if (code == 0 || code == 6) expect_whole(pack());
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const std::string name = entry.path().filename();
      EXPECT_TRUE(name == "cornell.glb" || name == "log" || name == "a.oriel" || name == ".oriel-cache") << name;
    }
  }
}

// Once there is enough nothing more is refined: of a round at work only the groups of texels that threads have begun.
TEST_F(Anytime, EnoughEndsARoundAtOnce) {
  const auto rays_of = [&](std::function<bool()> enough) {
    BakeOptions options;
    options.scene = folder_ / "cornell.glb";
    options.atlas.texel_m = 0.04f;
    Context context;
    std::vector<StageTime> times;
    Stopwatch timed(times);
    auto prepared = *prepare_scene(options, timed, context);
    EXPECT_TRUE(lay_out_lightmap(options, timed, context, prepared));
    const LightSet lights(prepared.scene());
    RadiosityOptions radiosity{.estimator = Estimator::kCached, .samples = 4096, .error = 0.01};
    radiosity.verify = 0;
    radiosity.enough = std::move(enough);
    auto made = bake_radiosity({{*prepared.accel, lights, {}}, prepared.atlas, prepared.texel_map}, radiosity, context);
    EXPECT_TRUE(made);
    EXPECT_TRUE(context.finishable);
    return made->report;
  };
  const RadiosityReport all = rays_of([] { return false; }), none = rays_of([] { return true; });
  std::atomic<int> asked{0};
  const RadiosityReport some = rays_of([&] { return ++asked > 20; });
  EXPECT_FALSE(all.ended_early);
  EXPECT_LE(all.relative_error, 0.01 * 1.3);
  EXPECT_TRUE(none.ended_early);
  EXPECT_TRUE(some.ended_early);
  EXPECT_LT(none.rays, all.rays / 2);
  EXPECT_GT(some.rays, none.rays) << "what a round had done counts";
  EXPECT_LT(some.rays, all.rays / 2);
  EXPECT_GT(none.relative_error, all.relative_error);
}

// The time is that of the whole bake: what a limit cuts off is refinement, and with it the error asked for.
TEST_F(Anytime, TimeEndsTheRefinementBeforeTheErrorAskedFor) {
  const auto report_of = [&](double time_s) {
    BakeOptions options;
    options.scene = folder_ / "cornell.glb";
    options.atlas.texel_m = 0.02f;
    options.radiosity = {.estimator = Estimator::kCached, .samples = 4096, .error = 0.01, .verify = 0};
    options.time_s = time_s;
    Context context;
    std::string warnings;
    context.warn = [&](const Warning& said) { warnings += said.text; };
    auto made = bake(options, context);
    EXPECT_TRUE(made);
    EXPECT_EQ(warnings.find("--error 1 % was not reached") != std::string::npos, made->radiosity.ended_early)
        << warnings;
    return made->radiosity;
  };
  const RadiosityReport hurried = report_of(0.01), whole = report_of(3600);
  EXPECT_TRUE(hurried.ended_early);
  EXPECT_FALSE(whole.ended_early) << "whichever comes first";
  EXPECT_LE(whole.relative_error, 0.013);
  EXPECT_GT(hurried.relative_error, whole.relative_error);
}

TEST(MirrorGeometry, IsWhatMirrorsAreWithoutTimeForMaps) {
  PlannedReflections planned;
  FoundReflector& mirror = planned.all.found.reflectors.emplace_back();
  mirror.reflector.name = "mirror";
  mirror.triangles = {1};
  mirror.reflector.elements_x = mirror.reflector.elements_y = 1;
  mirror.reflector.map_count = 2;
  planned.plan.maps.resize(2);
  planned.all.curved.reflectors.resize(3);
  AssembledMesh mesh;
  mesh.first_index = {0, 3};
  mesh.mesh.indices = {0, 1, 2, 2, 1, 3};
  const BakedReflections pack = mirror_geometry(std::move(planned), mesh, {"no time", "time-over"});
  const ReflectionReport& report = pack.report;
  ASSERT_EQ(pack.reflectors.size(), 1u);
  EXPECT_EQ(pack.reflectors[0].map_count, 0u);
  EXPECT_EQ(pack.reflectors[0].elements_x, 0u);
  EXPECT_EQ(pack.reflectors[0].indices, (std::vector<std::uint32_t>{2, 1, 3}));
  EXPECT_TRUE(pack.radiance_maps.empty() && pack.curved_reflectors.empty());
  EXPECT_EQ(report.ways, std::vector<std::string>{"no time"});
  ASSERT_EQ(report.omissions.size(), 2u) << "that maps are left out, and curved reflectors";
  for (const Warning& omission : report.omissions) EXPECT_EQ(omission.code, WarningCode("time-over"));
}

TEST(FittingMaps, AreHalvedUntilTheirCaptureFits) {
  PlannedReflections planned;
  planned.plan.maps.resize(2);
  for (RadianceMap& map : planned.plan.maps) map.width = 256, map.height = 64;
  planned.capture_s = 16;
  shrink_maps(20, planned);
  EXPECT_EQ(planned.plan.maps[0].width, 256u) << "they fit";
  EXPECT_TRUE(planned.plan.omitted.empty());
  shrink_maps(1, planned);
  EXPECT_EQ(planned.plan.maps[0].width, 64u);
  EXPECT_EQ(planned.plan.maps[1].height, 16u);
  EXPECT_LE(planned.capture_s, 1);
  ASSERT_EQ(planned.plan.omitted.size(), 1u) << "and that is said";
  shrink_maps(0, planned);
  EXPECT_GE(planned.plan.maps[0].height, 16u) << "never to nothing";
}

}  // namespace
}  // namespace oriel
