// Cubes and tables for engines, beside what they are made of.
#include "formats/export/probes.h"

#include <gtest/gtest.h>

#include <cstring>

#include "formats/core/half.h"
#include "formats/core/octahedral.h"
#include "formats/image/encode.h"

namespace oriel {
namespace {

// A sky that is brighter by 1 + x, 1 + y, 1 + z of the direction.
SurroundMap sky(std::uint32_t size) {
  SurroundMap map;
  map.size = size;
  for (std::uint32_t i = 0; i < size * size; ++i) {
    const Vec2 at = (Vec2(i % size, i / size) + 0.5f) / static_cast<float>(size) * 2.0f - 1.0f;
    map.radiance.push_back(50.0f * (1.0f + glm::normalize(direction_from_octahedral(at))));
    map.valid.push_back(1);
  }
  return map;
}

std::vector<Vec3> light_of(const ProbeCube& cube) {
  const Ktx2Texture& t = cube.texture;
  const std::size_t face = t.level.size() / 6;
  std::vector<Vec3> out;
  for (std::size_t f = 0; f < 6; ++f) {
    const auto bytes = std::span<const std::byte>(t.level).subspan(f * face, face);
    if (t.coding == TexelCoding::kBc6h) {
      const auto light = rgb_from_bc6h(bytes, t.width, t.height);
      out.insert(out.end(), light.begin(), light.end());
      continue;
    }
    for (std::size_t i = 0; i < face; i += 4) {
      std::uint32_t packed = 0;
      std::memcpy(&packed, &bytes[i], 4);
      out.push_back(rgb_from_rgb9e5(packed));
    }
  }
  for (Vec3& v : out) v *= cube.scale;
  return out;
}

// OpenGL's table 8.19: the face is the largest component's, u and v grow as it says.
TEST(ProbeCube, FacesLieAsOpenGlHasThem) {
  const Vec2 middle(0.5f);
  const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t face = 0; face < 6; ++face) EXPECT_EQ(cube_direction(face, middle), axes[face]);
  EXPECT_EQ(cube_direction(0, {1, 0.5f}), Vec3(1, 0, -1));
  EXPECT_EQ(cube_direction(0, {0.5f, 1}), Vec3(1, -1, 0));
  EXPECT_EQ(cube_direction(2, {0.5f, 1}), Vec3(0, 1, 1));
  EXPECT_EQ(cube_direction(4, {1, 0.5f}), Vec3(1, 0, 1));
  EXPECT_EQ(cube_direction(5, {1, 0.5f}), Vec3(-1, 0, -1));
}

// RGB9E5 within its steps and the map's; BC6H, one line of colour for three that vary, by what it says.
TEST(ProbeCube, HoldsTheMapsLightByDirection) {
  for (const TexelCoding coding : {TexelCoding::kRgb9e5, TexelCoding::kBc6h}) {
    const ProbeCube cube = probe_cube(sky(64), coding);
    ASSERT_EQ(cube.texture.width, 32u);
    ASSERT_EQ(cube.texture.faces, 6u);
    const auto light = light_of(cube);
    ASSERT_EQ(light.size(), 6u * 32 * 32);
    double squares = 0;
    for (std::uint32_t i = 0; i < light.size(); ++i) {
      const std::uint32_t face = i / 1024, x = i % 32, y = i / 32 % 32;
      const Vec3 d = glm::normalize(cube_direction(face, (Vec2(x, y) + 0.5f) / 32.0f)), was = 50.0f * (1.0f + d);
      const float off = glm::length(light[i] - was) / max_component(was);
      if (coding == TexelCoding::kRgb9e5) {
        EXPECT_LT(off, 0.01f) << face << " " << x << " " << y;
      }
      squares += off * off / (3 * light.size());
    }
    EXPECT_NEAR(std::sqrt(squares), cube.rounding, 0.001);
    EXPECT_EQ(cube.scale, 1);
  }
}

TEST(ProbeCube, BacksTakeTheLightAround) {
  SurroundMap map = sky(16);
  for (std::size_t i = 0; i < map.radiance.size(); ++i) map.radiance[i] = Vec3(7);
  for (std::size_t i = 0; i < 60; ++i) map.radiance[i] = Vec3(0), map.valid[i] = 0;
  for (const Vec3& v : light_of(probe_cube(map, TexelCoding::kRgb9e5))) EXPECT_NEAR(v.r, 7, 0.02f);
  map.valid.assign(256, 0), map.radiance.assign(256, Vec3(0));
  for (const Vec3& v : light_of(probe_cube(map, TexelCoding::kBc6h))) EXPECT_EQ(v, Vec3(0)) << "nothing is known";
}

TEST(ProbeCube, TheSunIsScaled) {
  SurroundMap map = sky(8);
  for (Vec3& v : map.radiance) v = Vec3(1e9f, 2e8f, 0);
  for (const TexelCoding coding : {TexelCoding::kRgb9e5, TexelCoding::kBc6h}) {
    const ProbeCube cube = probe_cube(map, coding);
    EXPECT_EQ(cube.scale, 16384);
    for (const Vec3& v : light_of(cube)) EXPECT_NEAR(v.r, 1e9f, 4e6f);
  }
}

}  // namespace
}  // namespace oriel
