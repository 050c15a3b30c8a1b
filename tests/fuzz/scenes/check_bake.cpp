#include "tests/fuzz/scenes/check_bake.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <regex>
#include <thread>

#include "formats/core/file.h"
#include "formats/pack/reader.h"

namespace oriel::fuzz {

namespace {

constexpr double kMostBounces = 4096;  // after which paths and sweeps give up (bake/trace/path.h)
constexpr double kGrazing = 4;         // more is reflected at grazing angles than straight on
constexpr double kNoise = 64;          // few samples a texel
constexpr double kDetail = 0.1;        // side of what parts have many of, in units of theirs

double series(double albedo) {
  return std::min(kMostBounces, 1 / std::max(1 - albedo, 1e-9));
}

void check_light(const char* what, const std::vector<Vec3>& values, double bound, std::vector<std::string>& wrong) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Vec3& v = values[i];
    if (is_finite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0 && max_component(v) <= bound) continue;
    wrong.push_back(fmt::format("{} {}: ({}, {}, {}), expected within [0, {:.4g}]", what, i, v.x, v.y, v.z, bound));
    return;
  }
}

// What the bake took a unit of the file to be: a power of ten, told from the surfaces.
double unit_of(const Pack& pack, double area_m2) {
  double area = 0;
  const auto& p = pack.mesh.positions;
  const auto& v = pack.mesh.indices;
  for (std::size_t i = 0; i + 2 < v.size(); i += 3)
    area += 0.5 * glm::length(glm::cross(DVec3(p[v[i + 1]]) - DVec3(p[v[i]]), DVec3(p[v[i + 2]]) - DVec3(p[v[i]])));
  return area > 0 && area_m2 > 0 ? std::pow(10, std::round(0.5 * std::log10(area / area_m2))) : 1;
}

std::vector<std::string> check_files(const std::filesystem::path& pack, const std::filesystem::path& report,
                                     const RandomScene& scene) {
  const auto text = read_file(report);
  if (!text) return {text.error().text()};
  const auto json = Json::parse(*text);
  std::vector<std::string> wrong;
  if (!json) wrong.emplace_back("the report is no JSON");
  const auto read = read_pack(pack);  // with every rule of the format, which want finite numbers
  if (!read) wrong.push_back(read.error().text());
  if (read && json) {
    // Beside a dome of many kilometres texels are larger than whole parts, and hold only what there is of these.
    const double texel_m = (*json)["plan"]["atlas"].value("texel_m", 1e-3) / unit_of(*read, scene.area_m2);
    const double bound = irradiance_bound(scene.sources, std::min(texel_m, kDetail * scene.scale));
    const auto more = check_pack_numbers(*read, bound);
    wrong.insert(wrong.end(), more.begin(), more.end());
  }
  return wrong;
}

}  // namespace

Ran run_limited(const std::vector<std::string>& arguments, const std::filesystem::path& log, double kill_after_s) {
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(Clock::now() - begun).count(); };
  const pid_t child = ::fork();
  if (child == 0) {
    const int fd = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(fd, 1);
    ::dup2(fd, 2);
    std::vector<char*> argv;
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  Ran ran;
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, WNOHANG, &usage) == 0) {
    if (spent() > kill_after_s) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ran.seconds = spent();
  ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  ran.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  ran.memory_MiB = static_cast<double>(usage.ru_maxrss) / 1024;
  if (const auto text = read_file(log)) ran.log.assign(reinterpret_cast<const char*>(text->data()), text->size());
  return ran;
}

double irradiance_bound(const Sources& s, double texel_m) {
  const double surfaces =
      kPiD * s.index * s.index * s.radiance * std::min(kMostBounces, kGrazing * series(s.lamp_albedo));
  const double points = s.power_lm / (texel_m * texel_m) + s.illuminance;
  return surfaces + kNoise * points * series(s.albedo);
}

std::vector<std::string> check_pack_numbers(const Pack& pack, double irradiance_bound) {
  std::vector<std::string> wrong;
  for (const LightmapPage& page : pack.lightmaps) {
    check_light("irradiance of texel", page.irradiance, irradiance_bound, wrong);
    check_light("standard error of texel", page.standard_error, irradiance_bound, wrong);
  }
  // A map's pixel is a mean of few samples too, of what reflects at most all of it.
  for (const RadianceMap& map : pack.radiance_maps)
    check_light("radiance of pixel", map.radiance, irradiance_bound, wrong);
  // A point, spot or sun is all in one pixel of an octahedron's map, 4/n sr of it at least (sky beside it too).
  for (const SurroundMap& map : pack.surround_maps)
    check_light("radiance of a surround map's pixel", map.radiance,
                irradiance_bound * static_cast<double>(map.radiance.size()) / 4, wrong);
  return wrong;
}

std::vector<std::string> check_run(const Ran& ran, const Limits& limits) {
  std::vector<std::string> wrong;
  if (ran.code != 0 && ran.code != 3)
    wrong.push_back(fmt::format("exit code {}, expected 0, or 3 at import", ran.code));
  const double most = 1.1 * limits.time_s + limits.late_s;
  const double took = limits.by_cpu ? ran.cpu_seconds / std::max(1u, std::thread::hardware_concurrency()) : ran.seconds;
  if (took > most) wrong.push_back(fmt::format("took {:.1f} s, expected at most {:.1f} s", took, most));
  if (ran.memory_MiB > limits.memory_MiB)
    wrong.push_back(fmt::format("took {:.0f} MiB, expected at most {:.0f}", ran.memory_MiB, limits.memory_MiB));
  static const std::regex kNotNumber(R"((^|[^A-Za-z])[-+]?(nan|inf)([^A-Za-z]|$))");
  std::smatch match;
  if (std::regex_search(ran.log, match, kNotNumber)) wrong.push_back("printed '" + match.str() + "'");
  return wrong;
}

std::vector<std::string> check_bake(const std::filesystem::path& oriel_bake, const RandomScene& scene,
                                    const Limits& limits, const std::filesystem::path& folder) {
  const auto glb = folder / "scene.glb", pack = folder / "scene.oriel", report = folder / "scene.json";
  std::filesystem::create_directories(folder);
  if (const Status status = write_file_atomically(glb, scene.glb); !status) return {status.error().text()};
  const Ran ran = run_limited({oriel_bake.string(), glb.string(), "-o", pack.string(), "--report", report.string(),
                               "--cache", "off", "--require", "nothing", "--time", fmt::format("{}s", limits.time_s)},
                              folder / "log", 5 * limits.time_s + 60);
  std::vector<std::string> wrong = check_run(ran, limits);
  if (ran.code == 0) {
    const auto more = check_files(pack, report, scene);
    wrong.insert(wrong.end(), more.begin(), more.end());
  }
  return wrong;
}

}  // namespace oriel::fuzz
