// CIE standard skies as latitude-longitude images.
#pragma once

#include "formats/core/result.h"
#include "formats/image/image.h"

namespace oriel::sample {

struct SkyOptions {
  int type = 12;                // 1 to 15 of ISO 15469:2004 (CIE S 011); 16: the traditional overcast sky
  double elevation_deg = 45;    // of the sun, [0, 90]
  double azimuth_deg = 180;     // of the sun, clockwise from north as seen from above; north is -Z, east is +X
  double horizontal_lux = 1e4;  // what the sky alone (no sun) sheds on open level ground
  double zenith_cd_m2 = 0;      // > 0: the zenith's luminance instead
  double ground = 0.2;          // reflectance of the level ground that fills the lower half
  std::uint32_t height = 1024;  // rows; twice as many columns
};

// RGB, cd/m², at texel centres. Row 0 ends at +Y; the centre is +X, and +Z lies to its right. The sun's own disk is
// left out: it is a directional light of the scene. Errors kUsage: a value out of its range.
Result<FloatImage> make_sky(const SkyOptions& options);

}  // namespace oriel::sample
