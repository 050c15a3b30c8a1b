// Light from sun and sky that what the eye sees gets to see, by way of reflections: particles start there. Of those
// that start anywhere nearly all end outside of a house (importons: Peter & Pietrek 1998, "Importance Driven
// Construction of Photon Maps").
#pragma once

#include "bake/jobs/context.h"
#include "bake/trace/emission.h"
#include "bake/trace/path.h"
#include "preview/frame/eye_points.h"

namespace oriel {

// Lines along which light from afar is known to come in: about one through `place`, to `to_source`.
struct LightGuide {
  Vec3 place{0}, to_source{0, 1, 0};
  float radius = 0;  // of the disk about the line that it stands for, m
};

class GuidedSources {
 public:
  // Follows light backwards from the eye's points, once for each and pass. Error kStopped.
  static Result<GuidedSources> create(const Transport& transport, const Sources& sources, std::span<const EyePoint> eye,
                                      std::uint32_t pass, Context& context);

  const std::vector<SourceKind>& kinds() const { return sources_->kinds(); }
  // As Sources::emit(): its mean over many is the same. From afar three in four particles go along a guide, of those
  // there are; each has the power that its density leaves (balance heuristic).
  Particle emit(SourceKind kind, Sampler& sampler) const;

  std::span<const LightGuide> guides(SourceKind kind) const { return kind == SourceKind::kSky ? sky_ : sun_; }

 private:
  float density(std::span<const LightGuide> guides, const Ray& ray, bool cones) const;

  const Sources* sources_ = nullptr;
  const Transport* transport_ = nullptr;
  std::vector<LightGuide> sun_, sky_;
};

}  // namespace oriel
