#include "player/output/panorama.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "formats/query/camera.h"

namespace oriel {
namespace {

Vec3 pixel_of(const FloatImage& image, int x, int y) {
  const float* p = &image.pixels[3 * (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x))];
  return {p[0], p[1], p[2]};
}

// At a point whose pixels' centres are at whole numbers.
Vec3 interpolated(const FloatImage& image, float x, float y) {
  const int most = static_cast<int>(image.width) - 2;
  const int x0 = std::clamp(static_cast<int>(x), 0, most), y0 = std::clamp(static_cast<int>(y), 0, most);
  const float s = x - static_cast<float>(x0), t = y - static_cast<float>(y0);
  return glm::mix(glm::mix(pixel_of(image, x0, y0), pixel_of(image, x0 + 1, y0), s),
                  glm::mix(pixel_of(image, x0, y0 + 1), pixel_of(image, x0 + 1, y0 + 1), s), t);
}

// The light from a direction.
Vec3 seen(const PanoramaViews& views, const std::array<FloatImage, 6>& faces, const Vec3& direction) {
  std::size_t face = 0;
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (glm::dot(direction, views.cameras[i].forward) > glm::dot(direction, views.cameras[face].forward)) face = i;
  const Camera& camera = views.cameras[face];
  const Vec3 on_plane = direction / glm::dot(direction, camera.forward);
  const auto size = static_cast<float>(views.size);
  const float pixels = 0.5f * size / std::tan(0.5f * camera.vertical_fov_rad), middle = 0.5f * size - 0.5f;
  return interpolated(faces[face], middle + pixels * glm::dot(on_plane, glm::cross(camera.forward, camera.up)),
                      middle - pixels * glm::dot(on_plane, camera.up));
}

}  // namespace

PanoramaViews panorama_views(const Camera& camera, int width) {
  const Vec3 ahead = forward_from(yaw_of(camera), 0), up(0, 1, 0), right = glm::cross(ahead, up);
  const auto face = std::max(std::ceil(static_cast<float>(width) / kPi), 2.0f);
  PanoramaViews views;
  views.size = static_cast<int>(face) + 2;
  const std::array<std::pair<Vec3, Vec3>, 6> axes = {
      {{ahead, up}, {right, up}, {-ahead, up}, {-right, up}, {up, -ahead}, {-up, ahead}}};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    Camera& view = views.cameras[i];
    view.name = camera.name;
    view.eye = camera.eye;
    std::tie(view.forward, view.up) = axes[i];
    view.vertical_fov_rad = 2 * std::atan((face + 2) / face);
  }
  return views;
}

FloatImage panorama(const PanoramaViews& views, const std::array<FloatImage, 6>& faces, std::uint32_t width) {
  const Vec3 ahead = views.cameras[0].forward, right = views.cameras[1].forward;
  const std::uint32_t height = width / 2;
  std::vector<Vec3> pixels;
  pixels.reserve(std::size_t{width} * height);
  for (std::uint32_t y = 0; y < height; ++y) {
    const float elevation = kPi * (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
    for (std::uint32_t x = 0; x < width; ++x) {
      const float azimuth = kPi * (2 * (static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 1);
      const Vec3 level = std::cos(azimuth) * ahead + std::sin(azimuth) * right;
      pixels.push_back(seen(views, faces, std::cos(elevation) * level + Vec3(0, std::sin(elevation), 0)));
    }
  }
  return rgb_image(width, height, pixels);
}

}  // namespace oriel
