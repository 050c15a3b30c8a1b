// Small packs made in memory, drawn offscreen and read back.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "player/gpu/headless.h"
#include "player/passes/frame.h"

namespace oriel::testing {

// A quad of two triangles with one part of its own: corner, corner + right, …; its normal is right x up.
void add_quad(Pack& pack, const Vec3& corner, const Vec3& right, const Vec3& up, std::uint32_t material,
              std::int32_t page);

// A page of side² texels, lux, by their place.
LightmapPage page_of(std::uint32_t side, const std::function<Vec3(std::uint32_t x, std::uint32_t y)>& light);
// A page of one colour, lux.
LightmapPage flat_page(const Vec3& irradiance);

// The mirror: x, y in [-1, 1] on the plane z = 0, looking towards +z, material 0 of `pack`, with radiance maps from
// `eyes` (reflector space = pack space, z < 0), pixels computed by `seen`: the light and the z of what the ray from a
// point of the plane along a direction meets (infinite: the sky).
struct Seen {
  Vec3 radiance{0};
  float z = 1;
};
void add_mirror(Pack& pack, const std::vector<Vec3>& eyes, std::uint32_t size,
                const std::function<Seen(const Vec2& on_plane, const Vec3& direction)>& seen);

// A mirror without maps: a quad of `material` over corner, right, up, whose normal is right x up.
void add_bare_mirror(Pack& pack, const Vec3& corner, const Vec3& right, const Vec3& up, std::uint32_t material = 0);

// A reflectance that is the same at every angle.
FresnelMap flat_reflectance(const Vec3& reflectance);

// A mesh for each map: every pixel that saw something as a square at its disparity.
void add_pixel_meshes(Pack& pack);

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb;
  FrameStats stats;
  // Row 0 is the top.
  Vec3 at(int x, int y) const;
  bool finite() const;
};

class FrameTest : public ::testing::Test {
 protected:
  void SetUp() override;
  // Draws a pack, with add_pixel_meshes() where it has none; a failure fails the test and gives an empty picture.
  Picture draw(Pack pack, const Camera& camera, int width, int height, const FrameOptions& options = {});

  std::unique_ptr<gpu::HeadlessContext> context_;
  gpu::Device device_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace oriel::testing
