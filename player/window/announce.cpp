#include "player/window/announce.h"

#include "player/session/option_names.h"

namespace oriel {
namespace {

std::string announce_camera(std::size_t camera, const Pack& pack) {
  if (camera >= pack.cameras.size()) return fmt::format("there is no camera {}", camera + 1);
  return fmt::format("camera {}: {}", camera + 1, pack.cameras[camera].name);
}

std::string announce_beside(const ComparisonView& comparison) {
  if (!comparison.on()) return "nothing to compare: open two packs, or a pack and a picture";
  if (comparison.beside == Beside::kSplit) return fmt::format("{} beside {}", comparison.first, comparison.second);
  return comparison.beside == Beside::kFirst ? comparison.first : comparison.second;
}

std::string announce_orbit(const Session& session) {
  if (!session.move.orbit) return "flying";
  return fmt::format("around a point {:.2f} m away", glm::distance(session.camera.eye, *session.move.orbit));
}

}  // namespace

std::string announce(const Command& command, const Pack& pack, const Session& session) {
  switch (command.action) {
    case Action::kKeySheet:
      return session.key_sheet ? "keys" : "keys closed";
    case Action::kPanel:
      return session.panel ? "panel" : "panel closed";
    case Action::kStage:
      return fmt::format("stage {}", name_of(kStages, session.frame.show));
    case Action::kFly:
      return session.move.fly ? "flying" : "walking";
    case Action::kOrbit:
      return announce_orbit(session);
    case Action::kHome:
      return "where it began";
    case Action::kPlayPath:
      if (session.path.keys.empty()) return "there is no path";
      return session.path_time_s >= 0 ? "the path plays" : "the path is stopped";
    case Action::kBrighter:
    case Action::kDarker:
      return fmt::format("EV {:.2f}", session.manual_ev100.value_or(session.shown_ev100));
    case Action::kAutoExposure:
      return "automatic exposure";
    case Action::kMoversBack:
      return pack.movers.empty() ? "nothing moves here" : "all movers back";
    case Action::kFlip:
    case Action::kSplit:
      return announce_beside(session.comparison);
    case Action::kCamera:
      return announce_camera(command.camera, pack);
    case Action::kNextCamera:
      return announce_camera(session.shown_camera, pack);
    case Action::kRecord:
      return session.recording ? "recording" : "";
    case Action::kPresent:
    case Action::kHeld:
    case Action::kGo:
    case Action::kScreenshot:
    case Action::kLightScreenshot:
    case Action::kReload:
      break;
  }
  return {};
}

}  // namespace oriel
