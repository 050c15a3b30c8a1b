// What a reflector's maps show to eyes that they were not planned for, beside what is there.
#pragma once

#include "bake/radiance/capture.h"
#include "bake/radiance/samples.h"

namespace oriel {

// Of the light reflected by one perfect mirror at the sampled points: the maps' colour beside a traced ray's.
struct ReflectedError {
  std::size_t samples = 0;
  double seen = 0;  // share of the samples' weight that some map shows
  double relative_error =
      0;  // rms over samples and channels, relative to what is brighter and 1 % of the mean; holes are black
  double seen_error = 0;  // the same of what is seen: reprojection, resolution and storage alone
};

// Compares the maps of one reflector (captured; of Reflector::first_map on) with light traced for the samples (of
// sample_reflections), bilinear in the map that shows each sharpest. The same for any number of threads. Error
// kStopped.
Result<ReflectedError> judge_light(const LitSurroundings& lit, std::uint32_t reflector,
                                   std::span<const RadianceMap> maps, std::span<const ReflectedSample> samples,
                                   const Stage& stage);

// Samples that were left out, and where to look for the cause.
void tell_dropped(const Accel& accel, std::vector<Warning>& findings);

// One-sided surfaces whose backs the eyes (scene space) see: the most seen ones by name.
void tell_backs(const Accel& accel, std::span<const Vec3> eyes, std::uint64_t seed, std::vector<Warning>& findings);

// What that of the cameras (scene space) which sees least of a reflector sees in its maps: a share of what it sees in
// it. Error kStopped.
Result<double> worst_seen(const ReflectedSurroundings& surroundings, std::uint32_t reflector,
                          std::span<const RadianceMap> own, std::span<const Vec3> cameras, Context& context);

}  // namespace oriel
