// Six faces as one picture.
#include "player/output/panorama.h"

#include <gtest/gtest.h>

#include "formats/query/camera.h"

namespace oriel {
namespace {

Vec3 light_from(const Vec3& direction) {
  return Vec3(0.5f) + 0.5f * direction;
}

// Faces painted by a smooth function of the direction give that function back, over all seams and poles.
TEST(Panorama, ShowsEachDirectionWhereItBelongs) {
  Camera camera = look_at({3, 1, 2}, {4, 5, 3}, 1);
  const PanoramaViews views = panorama_views(camera, 256);
  std::array<FloatImage, 6> faces;
  const auto size = static_cast<std::uint32_t>(views.size);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::vector<Vec3> pixels;
    for (int y = 0; y < views.size; ++y)
      for (int x = 0; x < views.size; ++x)
        pixels.push_back(
            light_from(pixel_ray(views.cameras[i], static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                                 static_cast<float>(views.size), static_cast<float>(views.size))
                           .direction));
    faces[i] = rgb_image(size, size, pixels);
  }
  const FloatImage picture = panorama(views, faces, 256);
  ASSERT_EQ(picture.height, 128u);
  const float yaw = yaw_of(camera), step = 2 * kPi / 256;
  float worst = 0;
  for (std::uint32_t y = 0; y < 128; ++y)
    for (std::uint32_t x = 0; x < 256; ++x) {
      const Vec3 wanted = light_from(forward_from(yaw + kPi - (static_cast<float>(x) + 0.5f) * step,
                                                  0.5f * kPi - (static_cast<float>(y) + 0.5f) * step));
      const float* p = &picture.pixels[3 * (std::size_t{y} * 256 + x)];
      worst = std::max(worst, glm::length(Vec3(p[0], p[1], p[2]) - wanted));
    }
  // Linear interpolation over pixels of at most `step`, of a function whose second derivative is at most 1.
  EXPECT_LT(worst, step * step);
}

}  // namespace
}  // namespace oriel
