// The light and the surfaces around one point of a field.
#pragma once

#include <functional>

#include "bake/trace/sampler.h"
#include "bake/transfer/bright_lights.h"

namespace oriel {

// Radiance that a hit surface sends towards the eye, cd/m², baked: constant cost. Its own emission only on request.
using SurfaceRadiance = std::function<Vec3(const Hit& hit, const Vec3& towards_eye, bool with_emission)>;

struct FieldScene {
  const Accel& accel;
  const LightSet& lights;
  const SurfaceRadiance& radiance;
};

struct ProbeOptions;  // probes.h

// What all probes of a field have in common.
struct ProbeScene : FieldScene {
  const BrightLights& bright;
  const ProbeOptions& options;
  const ShiftedNet& net;  // of options.samples points
  std::uint64_t seed = 1;
  float depth_cap_m = 0;  // at which distances are cut
};

// One probe's results, harmonics as measured: not windowed.
struct MeasuredProbe {
  LightProbe probe;
  double squared_difference = 0, squared_sum = 0;  // of the coefficients from both halves of the rays
};

// The stream numbers the probe.
MeasuredProbe measure_probe(const ProbeScene& scene, const Vec3& position, std::uint64_t stream, std::uint64_t& rays);

}  // namespace oriel
