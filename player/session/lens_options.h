// How a picture is exposed: a lens that is open for a while, as frames that are added up (Bastos et al. 1999, section
// 8; Haeberli & Akeley 1990, "The Accumulation Buffer").
#pragma once

#include "formats/cli/option.h"

namespace oriel {

struct LensSettings {
  int frames = 1;        // that a picture is the mean of
  float aperture_m = 0;  // diameter of the lens; 0: a pinhole, all is in focus
  float focus_m = 0;     // along the view, of what is in focus; 0: of what is in the middle of the picture
  float shutter_s = 0;   // for how long it is open, around the picture's time

  bool open() const { return aperture_m > 0 || shutter_s > 0; }
};

// group: that help lists them in.
std::vector<Option> lens_options(const char* group, LensSettings& out);

// As 1.6m, 25cm or 25mm; none where it is 0, which has a word of its own or no word.
OptionValue length(float& metres, const std::string& zero = {});

}  // namespace oriel
