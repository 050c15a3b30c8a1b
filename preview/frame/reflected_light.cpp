#include "preview/frame/reflected_light.h"

#include <algorithm>

#include "bake/trace/sampler.h"
#include "formats/core/color.h"
#include "preview/frame/elements.h"
#include "preview/frame/streams.h"

namespace oriel {
namespace {

constexpr std::uint32_t kEyePoints = 512;               // from which light is followed backwards
constexpr std::size_t kImportant = 16, kShadowed = 32;  // of those, that tell which landings and which elements matter

// Of an element's disk, what is added to squares of distances: as little of the light near it is lost as noise allows,
// and in the mean over passes nothing.
float softness(std::uint32_t pass) {
  return 2 / (2 + static_cast<float>(pass));
}

}  // namespace

Result<std::vector<LampPoint>> reflecting_points(const PreviewScene& scene, const SeenPoints& seen,
                                                 const ReflectedOptions& options, std::uint32_t pass,
                                                 Context& context) {
  std::vector<LampPoint> points;
  if (options.elements == 0) return points;
  const Transport transport = scene.transport();
  const std::vector<EyePoint> eye = eye_points(seen, *scene.accel, kEyePoints, context.seed, pass);
  if (eye.empty()) return points;
  const auto first = [&](std::size_t n) { return std::span(eye).first(std::min(n, eye.size())); };
  ORIEL_TRY(const auto sources, GuidedSources::create(transport, *scene.sources, eye, pass, context));
  ORIEL_TRY(const auto landings, land_particles(transport, sources, pass, context));
  ORIEL_TRY(std::vector<BounceElement> found,
            bounce_elements(landings, first(kImportant), options.elements, *scene.accel, context));
  ORIEL_TRY_VOID(find_importance(found, first(kShadowed), *scene.accel, context));
  Sampler sampler(context.seed, kReflectionStream, pass);
  for (const BounceElement& e : some_of(found, options.points, sampler.next1())) {
    const auto chosen = static_cast<std::size_t>(sampler.next1() * static_cast<float>(e.places.size()));
    const BounceElement::Place& at = e.places[std::min(chosen, e.places.size() - 1)];
    const float brighter = std::max(1.0f, luminance(at.power) / std::max(luminance(e.power), 1e-30f));
    points.push_back(lamp_at(at, std::max(softness(pass) * brighter * e.area / kPi, 1e-12f)));
  }
  return points;
}

}  // namespace oriel
