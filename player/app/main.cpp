// oriel-play: shows a pack in a window or in files.
#include <fmt/ranges.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <exception>

#include "formats/pack/deferred.h"
#include "formats/query/day_hours.h"
#include "formats/query/path.h"
#include "player/app/compare.h"
#include "player/app/offscreen.h"
#include "player/app/stop.h"
#include "player/navigation/lamps.h"
#include "player/session/arguments.h"
#include "player/session/idle_options.h"
#include "player/session/light_settings.h"
#include "player/window/window.h"

namespace {
using namespace oriel;

// Where --move may take it from.
void list_lamp(const Pack& pack, const LightGroup& group) {
  const LampShape lamp = shape_of_lamp(pack, group);
  const DVec3 at = DVec3(lamp.centre) + pack.mesh.origin;
  const std::string place = lamp.empty() ? std::string() : fmt::format(" at {:.2f},{:.2f},{:.2f}", at.x, at.y, at.z);
  fmt::print("lights {}{}: {}\n", group.name, place, fmt::join(group.lamps, ", "));
}

void list_day(const Day& day) {
  fmt::print("day {} at {:g},{:g}: --hour {:g} to {:g} ({}), opens at {:g}", day.date, day.latitude_deg,
             day.longitude_deg, day.hours.front().hour, day.hours.back().hour, clock_name(day), day.shown_hour);
  std::vector<std::string> dark;
  for (const DayHour& hour : day.hours)
    if (hour.group == kNight) dark.push_back(fmt::format("{:g}", hour.hour));
  fmt::print("{}\n", dark.empty() ? std::string() : fmt::format("; without a sun at {}", fmt::join(dark, ", ")));
}

void list_cameras(const Pack& pack) {
  for (std::size_t i = 0; i < pack.cameras.size(); ++i) {
    const Camera& camera = pack.cameras[i];
    const DVec3 eye = DVec3(camera.eye) + pack.mesh.origin;
    fmt::print("camera {} {} at {:.2f},{:.2f},{:.2f}\n", i, camera.name, eye.x, eye.y, eye.z);
  }
  for (const CameraPath& path : pack.paths) fmt::print("path {} {:.2f} s\n", path.name, path_duration_s(path));
  for (const Mover& mover : pack.movers) {
    const DVec3 at = DVec3(mover.rest.position) + pack.mesh.origin;
    fmt::print("mover {} at {:.2f},{:.2f},{:.2f}\n", mover.name, at.x, at.y, at.z);
  }
  if (!pack.day.empty()) list_day(pack.day);
  for (const LightGroup& group : pack.light_groups) list_lamp(pack, group);
  if (pack.cameras.empty() && pack.paths.empty()) fmt::print("no cameras and no paths\n");
}

// Lamps as the user wants them, or as the pack has them.
Result<std::vector<LightSetting>> choose_lights(const Pack& pack, const PlayArguments& arguments) {
  std::vector<LightSetting> settings = settings_of(pack);
  if (!arguments.lights_file.empty()) {
    ORIEL_TRY(const std::vector<std::string> changes, read_lights(arguments.lights_file));
    ORIEL_TRY_VOID(set_lights(pack, changes, settings, arguments.lights_file));
  }
  if (arguments.hour) ORIEL_TRY_VOID(set_hour(pack, *arguments.hour, settings));
  ORIEL_TRY_VOID(set_lights(pack, arguments.lights, settings));
  if (const auto hour = shown_hour(pack, settings); hour && is_night(pack.day, *hour))
    fmt::print(stderr, "oriel-play: the sun is down at {} ({}): only lamps shine\n", clock_text(*hour),
               clock_name(pack.day));
  return settings;
}

Status play(PlayArguments arguments, std::chrono::steady_clock::time_point started) {
  auto read = open_pack(arguments.pack);
  // Started from a desktop there is no terminal that would say why.
  if (!read && !arguments.list && !arguments.offscreen && ::isatty(STDERR_FILENO) == 0)
    show_refusal(read.error().text(), stop_requested);
  ORIEL_TRY(DeferredPack pack, std::move(read));
  if (arguments.list) {
    list_cameras(pack.pack);
    return {};
  }
  ORIEL_TRY(arguments.light_settings, choose_lights(pack.pack, arguments));
  for (const std::string& line : idle_options(pack.pack, arguments)) fmt::print(stderr, "oriel-play: {}\n", line);
  arguments.frame.lights = factors_of(pack.pack, arguments.light_settings);
  if (!arguments.reference.empty()) return play_compare(std::move(pack), arguments);
  return arguments.offscreen ? play_offscreen(std::move(pack), arguments)
                             : play_in_window(std::move(pack), arguments, stop_requested, started);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto started = std::chrono::steady_clock::now();
    const auto parsed = parse_arguments(argc, argv);
    if (const int* code = std::get_if<int>(&parsed)) return *code;
    install_stop_handler();
    const Status status = play(std::get<PlayArguments>(parsed), started);
    if (status) return 0;
    fmt::print(stderr, "oriel-play: {}\n", status.error().text());
    return static_cast<int>(status.error().code);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "oriel-play: %s\n", error.what());
    return static_cast<int>(ErrorCode::kRuntime);
  }
}
