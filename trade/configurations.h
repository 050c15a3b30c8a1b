// Which configurations a sweep measures: one default, and one knob varied at a time.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "trade/survey.h"

namespace oriel::trade {

// Options and their values.
using Settings = std::map<std::string, std::string>;

struct Configuration {
  std::string knob;     // what is varied: "error", "texel", …; "default" for the default
  std::string setting;  // and to what: "5 %"
  Settings bake, play;  // all options of oriel-bake that matter here, and of oriel-play that are not its defaults
  unsigned paths = 0;   // not 0: no pack, frames path-traced by that many paths a pixel
  Settings preview{};   // not empty: no pack, frames of oriel-preview by these

  std::string name() const { return setting.empty() ? knob : knob + " " + setting; }
};

struct TradePlan {
  std::vector<Configuration> configurations;  // the default first, then those that matter most
  std::vector<std::string> skipped;           // knobs that the scene has no use for, and why
  Settings reference;                         // of the bake that texels are compared with, but for its --texel
  unsigned reference_paths = 0;               // a pixel of the frames that frames are compared with
  int width = 0, height = 0;                  // of those
};

// texel_m: of the default, > 0. quick: few settings of each knob, references of fewer samples, texels of twice the
// size.
TradePlan plan_trade(const SceneFacts& facts, double texel_m, bool quick);

// "20cm", "5mm", as the options take it.
std::string length_text(double metres);

}  // namespace oriel::trade
