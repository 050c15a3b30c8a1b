#include "player/session/reflection_options.h"

#include <cmath>

#include "player/session/option_names.h"

namespace oriel {

namespace {

OptionValue budget(float& ms) {
  OptionValue value = number(ms, 0, 1e6);
  value.type = "MS|none";
  value.set = [&ms, set = value.set](const std::string& typed) -> Status {
    if (typed != "none") return set(typed);
    ms = std::numeric_limits<float>::infinity();
    return {};
  };
  value.get = [&ms] { return ms == kBudgetOfDevice ? "" : std::isinf(ms) ? "none" : fmt::format("{}", ms); };
  value.json = [&ms] { return ms == kBudgetOfDevice ? Json() : std::isinf(ms) ? Json("none") : Json(ms); };
  return value;
}

}  // namespace

std::vector<Option> reflection_options(const char* group, PlayArguments& out) {
  return {
      {"--reflections", group,
       "What reflectors show: as the bake chose, which is their radiance maps where they have some and no lamp has "
       "moved, "
       "the mirrored scene drawn again, or nothing",
       choice(out.frame.reflections, kReflections), Use::kRare, "reflections"},
      {"--orders", group,
       "Reflectors on the way of a reflection: 1 shows a mirror in a mirror as its diffuse light only. Without it: 2, "
       "and on while all on the way are mirrors that leave half of the light",
       number(out.frame.orders, 1, 16), Use::kRare, "orders"},
      {"--frame-budget", group,
       "Milliseconds that the images of planar reflectors may take at 1280x720: those that show most for their price "
       "are "
       "drawn, the others show their mean light; none draws all, as in films and panoramas. Without it 200 on a "
       "processor, 8 on a graphics card; an eighth while something moves",
       budget(out.frame.image_budget_ms), Use::kRare, "frame_budget"},
      {"--maps", group,
       "Radiance maps drawn for each reflector element in view before others fill their gaps; 0 shows none",
       number(out.frame.maps_per_element, 0, 64), Use::kRare, "maps"},
      {"--blur", group, "K's width in the image: by the distance of what is reflected, or as sharp as a mirror",
       choice(out.frame.blur, kBlurs), Use::kRare, "blur"},
  };
}

}  // namespace oriel
