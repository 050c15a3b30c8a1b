// What a light field says of a point between its probes: the player's and the baker's one lookup.
#pragma once

#include "formats/assets/light_field.h"

namespace oriel {

struct LocalLight {
  std::vector<float> sh;  // as LightProbe::sh: all light but the shares below
  struct Share {
    std::uint32_t light = 0;  // into LightField::lights
    float share = 1;          // of its light that `sh` leaves out
  };
  std::vector<Share> bright;  // what shines here on its own, with its own shadows
  float trust = 0;            // [0,1]: 0 where every probe around is behind a wall
};

// Blends the eight probes around p (pack space; outside of the grid: at its border) by trilinear weights, validity, and
// what their depth says of p being in sight (Chebyshev's inequality; Majercik et al. 2019, "Dynamic Diffuse Global
// Illumination with Ray-Traced Irradiance Fields"). normal, unit: prefers probes on its side; 0: all sides
// alike. field.bands > 0.
LocalLight light_at(const LightField& field, const Vec3& p, const Vec3& normal = Vec3(0));

}  // namespace oriel
