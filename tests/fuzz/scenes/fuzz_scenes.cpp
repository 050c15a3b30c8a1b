// Bakes random scenes and holds the baker to what it promises of any scene:
//   fuzz_scenes OPTIONS    --bake PROGRAM --work FOLDER [--first SEED] [--count N] [--time SECONDS] [--late SECONDS]
//                          [--by-cpu] [--shrink] [--write SEED]
// What fails stays in FOLDER/seed-N. Exit code 1 where something does.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "formats/core/file.h"
#include "tests/fuzz/scenes/check_bake.h"

namespace oriel::fuzz {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path bake, work = "fuzz-scenes";
  std::uint64_t first = 1, count = 20;
  Limits limits;
  bool shrink = false;
};

std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string lines(const std::vector<std::string>& wrong) {
  std::string text;
  for (const std::string& line : wrong) text += "  " + line + "\n";
  return text;
}

// Leaves out one part after the other, and the scale and place, as long as something fails.
void shrink(const Options& options, std::uint64_t seed, const fs::path& folder) {
  std::set<std::string> without;
  bool plain_space = false;
  const auto fails = [&] {
    const fs::path trial = folder / "smaller";
    return !check_bake(options.bake, random_scene(seed, without, plain_space), options.limits, trial).empty();
  };
  plain_space = true;
  plain_space = fails();
  for (const std::string& part : random_scene(seed).parts) {
    without.insert(part);
    if (!fails()) without.erase(part);
  }
  const RandomScene smallest = random_scene(seed, without, plain_space);
  const auto wrong = check_bake(options.bake, smallest, options.limits, folder / "smaller");
  fmt::print("  smaller, in {}: scale {:.3g}, {}\n{}", (folder / "smaller").string(), smallest.scale,
             listed(smallest.parts), lines(wrong));
}

bool holds(const Options& options, std::uint64_t seed) {
  const RandomScene scene = random_scene(seed);
  const fs::path folder = options.work / fmt::format("seed-{}", seed);
  const std::vector<std::string> wrong = check_bake(options.bake, scene, options.limits, folder);
  if (wrong.empty()) {
    fs::remove_all(folder);
    return true;
  }
  fmt::print("seed {}: scale {:.3g}, {:.3g} m2, {}\n{}", seed, scene.scale, scene.area_m2, listed(scene.parts),
             lines(wrong));
  if (options.shrink) shrink(options, seed, folder);
  std::fflush(stdout);
  return false;
}

int main_of_fuzz(int argc, char** argv) {
  CLI::App app("Bakes random scenes and holds the baker to what it promises of any scene.");
  Options options;
  std::uint64_t write = 0;
  app.add_option("--bake", options.bake, "oriel-bake")->required();
  app.add_option("--work", options.work, "A folder for scenes that fail");
  app.add_option("--first", options.first, "The first seed");
  app.add_option("--count", options.count, "So many seeds");
  app.add_option("--time", options.limits.time_s, "Of each bake, s");
  app.add_option("--late", options.limits.late_s, "By which that may be missed, beside a tenth of it, s");
  app.add_option("--memory", options.limits.memory_MiB, "At most so much, MiB");
  app.add_flag("--by-cpu", options.limits.by_cpu, "Time is that of all threads over the cores: other work is done too");
  app.add_flag("--shrink", options.shrink, "Leave parts out of what fails");
  app.add_option("--write", write, "Write that seed's scene to the work folder, and bake nothing");
  CLI11_PARSE(app, argc, argv);
  if (write > 0) {
    fs::create_directories(options.work);
    const fs::path file = options.work / fmt::format("seed-{}.glb", write);
    const RandomScene scene = random_scene(write);
    fmt::print("{}: {:.3g} m2, {}\n", file.string(), scene.area_m2, listed(scene.parts));
    return write_file_atomically(file, scene.glb) ? 0 : 2;
  }
  std::uint64_t failed = 0;
  for (std::uint64_t i = 0; i < options.count; ++i) failed += !holds(options, options.first + i);
  fmt::print("{} scenes, {} fail\n", options.count, failed);
  return failed > 0 ? 1 : 0;
}

}  // namespace
}  // namespace oriel::fuzz

int main(int argc, char** argv) {
  return oriel::fuzz::main_of_fuzz(argc, argv);
}
