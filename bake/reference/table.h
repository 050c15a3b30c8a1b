// The measured points as a table for spreadsheets.
#pragma once

#include "bake/reference/illuminance.h"

namespace oriel {

// CSV with a header line: x,y,z,nx,ny,nz as given, then lux: total, direct and indirect, each as luminance
// (0.2126 R + 0.7152 G + 0.0722 B) and R, G, B, and the standard error of the total in the same four. Lines end in \n.
std::string lux_csv(std::span<const MeasurePoint> points, std::span<const PointIlluminance> results);

}  // namespace oriel
