// Few lights that stand for all light of a scene that comes from everywhere: what surfaces reflect of the light that
// the bake found on them, what of them shines and is no bright light, and the sky. Where Keller 1997 and Barczak 2006
// (section 4.1) place lights by random walks from the lamps, the lightmap already knows what all bounces bring, and
// rays from where the light is wanted tell which of its texels matter there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "formats/assets/lightmap.h"
#include "formats/query/live_lights.h"
#include "formats/query/page_points.h"

namespace oriel {

enum class ScatterSource : std::uint8_t { kTexel, kEmission, kSky };

// Shines as LiveLight does: with intensity · cosine from its front; the sky's to all sides, from far away.
struct ScatteredLight {
  LiveLight light;  // as its sources shone when it was made
  ScatterSource source = ScatterSource::kTexel;
  // Whose change its own follows. A texel: page, and place in its irradiance. Emission: material. Sky: nothing.
  std::uint32_t index = 0, texel = 0;
  Vec3 before{1};  // what it followed then: lux of the texel; else 1
};

struct ScatteredScene {
  const LampScene& scene;  // of no lamp
  std::span<const LightmapPage> pages;
  std::span<const std::vector<PagePoint>> points;  // by page: page_points()
  std::span<const Vec3> emission;                  // by material, cd/m²
  std::span<const std::uint8_t> left_out;          // by part of the mesh: it shines as a bright light does
};

// Small pieces of surface that send light out, in an order in which what lies together and faces alike comes together.
class ScatterSources {
 public:
  ScatterSources() = default;
  // Reads textures.
  explicit ScatterSources(const ScatteredScene& scene);

  // At most `count` lights: those that matter in some places, spheres about points in the open. What is seen from there
  // is found by rays; a light is drawn as often as it brings light there, and stands for as much more as it is drawn
  // rarely. So of all that passes the places the lights' sum is right on average, and elsewhere it need not be. The sky
  // has its share of them, for directions from which it is seen. around: what was read; sky: cd/m².
  std::vector<ScatteredLight> draw(const LampScene& around, const Vec3& sky, std::span<const Vec4> places,
                                   std::uint32_t count) const;
  Vec3 flux() const;  // that they send out, lm

 private:
  struct Source {
    Vec3 position{0}, normal{0}, flux{0};  // lm
    float area = 0;                        // m²
    ScatterSource kind = ScatterSource::kTexel;
    std::uint32_t index = 0, texel = 0;
    Vec3 lux{1};  // of a texel
  };
  struct Seen;
  void add_texels(const ScatteredScene& in);
  void add_emission(const ScatteredScene& in, float longest);
  void add_pieces(const Vec3& a, const Vec3& ab, const Vec3& ac, float longest, const Source& like);
  std::uint64_t code_of(ScatterSource kind, const Vec3& position, const Vec3& normal) const;
  std::size_t block() const;  // sources of one
  std::optional<std::size_t> nearest(ScatterSource kind, const Vec3& position, const Vec3& normal) const;
  static float open_share(const Source& source, std::span<const Vec4> places);
  Seen look_around(const LampScene& around, std::span<const Vec4> places) const;
  void draw_surfaces(const Seen& seen, std::uint32_t count, std::vector<ScatteredLight>& out) const;
  void draw_sky(const Seen& seen, const Vec3& sky, std::uint32_t count, std::vector<ScatteredLight>& out) const;

  std::vector<Source> sources_;
  std::vector<std::uint8_t> shines_;  // by material
  std::vector<std::uint64_t> codes_;  // of each, ascending
  Vec3 lower_{0}, upper_{0};
};

}  // namespace oriel
