// Skies, and how bright sun and sky are.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

// ISO 15469:2004 (CIE S 011), table 1, types 1 to 15: 1 to 5 overcast, 6 to 10 partly cloudy, 11 to 15 clear; 16 is the
// traditional overcast sky.
inline constexpr int kTraditionalOvercast = 16;

// Luminance of a sky of that type over the zenith's: gradation times indicatrix. Angles in radians: of the sky element
// and of the sun from the zenith, and between the two.
double relative_sky_luminance(int type, double zenith_angle, double sun_zenith_angle, double sun_distance);

// Towards a place of the sky, unit: +Y is up, the horizon's azimuth 0 (north) is -Z, 90° (east) is +X.
DVec3 sky_direction(double elevation_rad, double azimuth_rad);

// A sky of one type and sun.
struct CieSky {
  int type = 12;
  DVec3 to_sun{0, 1, 0};  // unit, not below the horizon

  // Over the zenith's, towards a unit direction of the upper half.
  double luminance(const DVec3& direction) const;
  // What one of zenith luminance 1 cd/m² sheds on level ground, lux.
  double illuminance() const;
};

// Mean daylight: Gillette, Pierpoint and Treado 1984, "A general illuminance model for daylight availability" (Journal
// of the IES 13), which is the Illuminating Engineering Society's recommended practice (RP-21). Of clear, partly cloudy
// and overcast skies, as the type is one of them; an overcast one shows no sun.
struct MeanDaylight {
  double sun_lux = 0;  // on a plane that faces the sun
  double sky_lux = 0;  // on level ground, of the sky without the sun
};
// day: of the year, 1 to 366. Nothing where the sun is at the horizon or below.
MeanDaylight mean_daylight(int sky_type, int day, double elevation_deg);

}  // namespace oriel
