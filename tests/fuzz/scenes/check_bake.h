// Bakes a random scene with the real program, and says what about it is not as promised.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formats/pack/pack.h"
#include "tests/fuzz/scenes/random_scene.h"

namespace oriel::fuzz {

struct Limits {
  double time_s = 10;   // of --time
  double late_s = 1.5;  // beside a tenth of it: the process starts, the system writes
  // Time is that of the clock; or on machines with other work, where a bake cannot know what it will be given, that of
  // its threads over the number of cores.
  bool by_cpu = false;
  double memory_MiB = 2048;
};

// What running a program showed.
struct Ran {
  int code = 0;            // exit code; -signal where it was killed
  double seconds = 0;      // by the clock
  double cpu_seconds = 0;  // of all its threads
  double memory_MiB = 0;   // at its peak
  std::string log;         // standard error
};

// Runs arguments[0] with its output in `log`; it is killed after that many seconds.
Ran run_limited(const std::vector<std::string>& arguments, const std::filesystem::path& log, double kill_after_s);

// The largest irradiance that light from these sources can bring to a texel of at least that size, lux. Surfaces only:
// with emission L_e and directional reflectance ρ the light of a furnace L = L_e / (1 - ρ) is an upper bound
// everywhere, whatever the other surfaces are made of, as long as they are passive; within glass of index n it is n²
// times as much. Lamps that are points bring at most all of their power to one texel, over and over: 1 / (1 - ρ) times,
// or as many times as paths are followed.
double irradiance_bound(const Sources& sources, double texel_m);

// What is wrong with numbers of a pack; empty: nothing.
std::vector<std::string> check_pack_numbers(const Pack& pack, double irradiance_bound);
// Of a run: its exit code, time, memory, and what it printed.
std::vector<std::string> check_run(const Ran& ran, const Limits& limits);

// Bakes the scene in `folder`, whose files are replaced.
std::vector<std::string> check_bake(const std::filesystem::path& oriel_bake, const RandomScene& scene,
                                    const Limits& limits, const std::filesystem::path& folder);

}  // namespace oriel::fuzz
