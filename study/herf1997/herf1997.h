// Herf 1997, "Efficient Generation of Soft Shadow Textures" (CMU-CS-97-138).
#pragma once

#include "study/support/shown_scene.h"

namespace oriel::study {

struct Herf1997Settings {
  int samples = 64;  // of each lamp
  bool bench = false;
};

// Draws a pack whose movers go about with their shadows as textures, and as the player has them, and prints what each
// costs and how far each is from textures of many samples. Errors kUsage, kIo, kRuntime.
Status run_herf1997(const ShownArguments& arguments, const Herf1997Settings& settings);

// Textures a second, errors by samples and by the paper's weights.
void print_herf1997_bench();

}  // namespace oriel::study
