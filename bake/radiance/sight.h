// What a ray that leaves a reflector sees: through surfaces that transmit, and by way of further mirrors. Capture and
// planning follow the same rays.
#pragma once

#include <functional>
#include <span>

#include "bake/radiance/reflectors.h"

namespace oriel {

// Transmittance from which a surface hides nothing: depth is that of what lies behind.
inline constexpr float kSeeThrough = 0.5f;

struct SightOptions {
  std::uint32_t orders = 2;             // mirrors a ray may meet, its own reflector counted: at least 1
  float max_chain_roughness = 0.1f;     // of mirrors after the first: wider lobes are not followed
  float min_chain_reflectance = 0.02f;  // below it a reflection is not followed
};
inline void fields(Archive& archive, SightOptions& o) {
  archive(o.orders, o.max_chain_roughness, o.min_chain_reflectance);
}

inline constexpr int kMostSightLayers = 64;  // of surfaces before the first opaque one
// By which rays leave surfaces, relative to the size of coordinates.
inline constexpr float kSightStep = 1.0f / (1 << 20);

// A surface on the way of a ray.
struct SeenSurface {
  const Hit& hit;
  Vec3 towards_eye{0};   // unit, back along the ray
  Vec3 throughput{1};    // share of its light that reaches the reflector, coverage included
  bool mirror = false;   // what it reflects follows, or is too little, and is not to be counted here
  bool emission = true;  // its own light is to be counted; where not, it is an emitter of the reflector's list
  std::uint32_t mirrors_passed = 0;  // on the way, the ray's own reflector not counted
  bool planar = false;               // of a planar reflector
  bool glossy = false;  // its lobe is too wide to be followed but narrow enough that what it shows depends on the eye
  float width_m = 0;    // of the ray's cone there: what a pixel shows of it. 0: a point
  float averaged = 1;   // so many looks like it the frame shows the mean of
  std::uint64_t* rays = nullptr;  // rays that finding its light traces are added to it; may be null
};

struct Sight {
  enum State : std::uint8_t { kNothing = 0, kSurface = 1, kSky = 2 };  // as RadianceMap::valid
  State state = kNothing;
  // From the ray's start to the surface, or to its image where mirrors are on the way; scene space, metres. Of
  // kSurface, and of a back in kNothing.
  Vec3 offset{0};
  bool mirrored = false;  // the offset is that of an image: a mirror is on the way
  bool back = false;      // kNothing because it ended on the back of a one-sided surface
  Vec3 normal{0};         // unit, of the surface, unfolded; scene space
  Vec3 sky_direction{0};  // the last ray's, where it left the scene
  bool backdrop = false;  // kSurface, but a sky of one colour
  Vec3 sky_throughput{0};
  std::uint32_t rays = 0;
};

// What a pixel sees lies in a cone around its ray: as wide as that where it starts, and wider by so much a metre.
struct Cone {
  float width_m = 0, spread = 0;
};

class ReflectedSurroundings {
 public:
  // Both must outlive it.
  ReflectedSurroundings(const Accel& accel, std::span<const FoundReflector> reflectors, const SightOptions& options);

  // Of a surface on the way; returns whether to go on behind the surface that the depth is of, for its reflection's
  // light alone.
  using Visit = std::function<bool(const SeenSurface&)>;

  // The ray from a point on the plane of a reflector (scene space, unit direction to its front). A sky of one colour is
  // a surface that stands around the scene's bounds: so its parallax is that of what it is seen through, and rays that
  // pass a gap beside a window find it where they leave the scene, not where parallel ones from elsewhere end. A sky
  // image is at infinity. Surfaces that let at
  // least half of the light pass in some channel are walked through; the offset is that of what lies behind. A planar
  // mirror is followed to what it reflects, and where it reflects more than half, the offset is that of the image.
  Sight look(std::uint32_t reflector, const Vec3& from, const Vec3& direction, const Visit& visit,
             const Cone& cone = {}) const;

  const Accel& accel() const { return accel_; }
  std::span<const FoundReflector> reflectors() const { return reflectors_; }

 private:
  class Walk;
  // The reflector that the triangle belongs to; null: none.
  const FoundReflector* reflector_at(std::uint32_t triangle) const;

  const Accel& accel_;
  std::span<const FoundReflector> reflectors_;
  SightOptions options_;
  std::vector<std::uint32_t> reflector_of_;  // by triangle: 1 + index; 0: none
};

// Whether the triangle, or its twin, is among these, which ascend.
bool is_among(const Scene& scene, std::span<const std::uint32_t> triangles, std::uint32_t triangle);

}  // namespace oriel
