// Bakes random scenes and holds the baker to what it promises of any scene:
//   fuzz_scenes OPTIONS    --bake PROGRAM --work FOLDER [--first SEED] [--count N] [--time SECONDS] [--late SECONDS]
//                          [--by-cpu] [--shrink] [--write SEED]
// What fails stays in FOLDER/seed-N. Exit code 1 where something does.
#include <fmt/format.h>

#include "formats/cli/command.h"
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
  Options options;
  std::uint64_t write = 0;
  if (const auto code =
          parse_options(argc, argv, "Bakes random scenes and holds the baker to what it promises of any scene.",
                        {{"--bake", "Options", "oriel-bake", path(options.bake, "FILE"), Use::kRequired},
                         {"--work", "Options", "A folder for scenes that fail", path(options.work, "DIR")},
                         {"--first", "Options", "The first seed", number(options.first, 0, 18446744073709551615.0)},
                         {"--count", "Options", "So many seeds", number(options.count, 0, 1e18)},
                         {"--time", "Options", "Of each bake, s", number(options.limits.time_s, 0, 1e9)},
                         {"--late", "Options", "By which that may be missed, beside a tenth of it, s",
                          number(options.limits.late_s, 0, 1e9)},
                         {"--memory", "Options", "At most so much, MiB", number(options.limits.memory_MiB, 0, 1e9)},
                         {"--by-cpu", "Options", "Time is that of all threads over the cores: other work is done too",
                          flag(options.limits.by_cpu)},
                         {"--shrink", "Options", "Leave parts out of what fails", flag(options.shrink)},
                         {"--write", "Options", "Write that seed's scene to the work folder, and bake nothing",
                          number(write, 0, 18446744073709551615.0)}}))
    return *code;
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
