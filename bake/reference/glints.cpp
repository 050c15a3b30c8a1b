#include "bake/reference/glints.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "formats/query/camera.h"

namespace oriel {
namespace {

constexpr double kSamplesAPixel = 64;  // of a disk
constexpr std::uint32_t kLeastSamples = 64, kMostSamples = 1u << 20;

// pixel_ray() the other way round.
class Screen {
 public:
  Screen(const Camera& camera, const ReferenceOptions& options)
      : eye_from_pack_(glm::transpose(DMat3(pack_from_eye_axes(camera)))),
        width_(options.width),
        height_(options.height),
        half_(std::tan(0.5 * double{camera.vertical_fov_rad})) {}

  struct Pixel {
    std::size_t index = 0;
    double steradians = 0;
  };
  std::optional<Pixel> at(const Vec3& direction) const {
    const DVec3 d = eye_from_pack_ * DVec3(direction);
    if (!(d.z < 0)) return std::nullopt;
    const double x = 0.5 * (width_ - height_ * d.x / (d.z * half_)), y = 0.5 * height_ * (1 + d.y / (d.z * half_));
    if (!(x >= 0 && x < width_ && y >= 0 && y < height_)) return std::nullopt;
    return Pixel{static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x),
                 solid_angle(-d.z)};
  }
  // Of a pixel whose direction has that cosine to the middle's.
  double solid_angle(double cosine) const { return std::pow(2 * half_ / height_, 2) * cosine * cosine * cosine; }

 private:
  DMat3 eye_from_pack_;
  double width_, height_, half_;
};

std::uint32_t samples_of(const Light& light, const Screen& screen) {
  if (!(light.angular_radius_rad > 0)) return 1;
  const double pixels = 2 * kPiD * (1 - std::cos(double{light.angular_radius_rad})) / screen.solid_angle(1);
  const auto wanted = static_cast<std::uint32_t>(std::min<double>(kSamplesAPixel * pixels, kMostSamples));
  return std::clamp(std::bit_ceil(wanted), kLeastSamples, kMostSamples);
}

void add(FloatImage& image, std::size_t pixel, const Vec3& light) {
  for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * pixel + c] += light[static_cast<int>(c)];
}

}  // namespace

std::uint64_t add_glints(const Transport& t, const Camera& camera, const ReferenceOptions& options, std::uint64_t seed,
                         ReferenceFrame& frame) {
  const VirtualLights& mirrored = t.lights.mirrored();
  std::uint64_t rays = 0;
  if (mirrored.empty() || !(camera.vertical_fov_rad > 0)) return 0;
  const Screen screen(camera, options);
  for (std::uint32_t i = 0; i < mirrored.size(); ++i) {
    if (mirrored[i].order > t.options.max_bounces) continue;
    const std::uint32_t samples = samples_of(t.accel.scene().lights[mirrored[i].light], screen);
    for (std::uint32_t k = 0; k < samples; ++k) {
      Sampler sampler(seed + 0x611f7, i, k);
      const MirroredSample s = mirrored.sample(i, t.lights, camera.eye, sampler.next2());
      if (s.legs == 0) continue;
      const auto pixel = screen.at(s.direction);
      if (!pixel) continue;
      const Vec3 light = s.endless * s.share * t.accel.transmittance_of_all(s.rays(), rays) /
                         static_cast<float>(pixel->steradians * samples);
      if (!is_usable(light)) {
        t.accel.dropped().add(mirrored.mirrors()[mirrored[i].mirror[0]].triangles.front());
        continue;
      }
      add(frame.specular, pixel->index, light);
      add(frame.total, pixel->index, light);
    }
  }
  return rays;
}

}  // namespace oriel
