// Light as particles that leave its sources.
#pragma once

#include "bake/trace/lights.h"
#include "bake/trace/sampler.h"

namespace oriel {

// A share of a source's power on its way: its mean over many is all that the source sends.
struct Particle {
  Ray ray;
  Vec3 power{0};            // lm
  bool punctual = false;    // from a point, spot or directional light
  bool from_afar = false;   // by the sky or a directional light, through a disk as large as the scene
  std::uint32_t group = 0;  // of lamps, into Scene::light_groups: of a near source
};

enum class SourceKind : std::uint8_t { kNear, kDirectional, kSky };

// The sources of a scene by kind: emissive triangles, point and spot lights; directional lights; the sky, image or
// constant. Holds references to scene and lights. Immutable.
class Sources {
 public:
  Sources(const Scene& scene, const LightSet& lights);

  const std::vector<SourceKind>& kinds() const { return kinds_; }  // that shine at all
  // A particle of one of kinds(): lamps by power, points and directions on them by what leaves them there.
  Particle emit(SourceKind kind, Sampler& sampler) const;
  // Of the disk across their way that particles from afar come through, about the scene's middle, m.
  float afar_radius() const;

 private:
  struct Near {
    bool punctual;
    std::uint32_t index;  // of a triangle or of Scene::lights
  };
  struct Choice {
    std::size_t index;
    float probability;
  };
  static Choice choose(const std::vector<double>& cdf, float u);
  Particle emit_near(Sampler& sampler) const;
  Particle emit_triangle(std::uint32_t triangle, Sampler& sampler) const;
  Particle emit_punctual(const Light& light, const Vec2& v) const;
  Particle from_afar(const Vec3& to_source, const Vec3& irradiance, const Vec2& v) const;

  const Scene& scene_;
  const LightSet& lights_;
  std::vector<SourceKind> kinds_;
  std::vector<Near> near_;
  std::vector<double> near_cdf_;  // cumulative lumens
  std::vector<std::uint32_t> directional_;
  std::vector<double> directional_cdf_;  // cumulative lux
};

}  // namespace oriel
