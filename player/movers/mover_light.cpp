#include "player/movers/mover_light.h"

#include <array>

#include "formats/core/sh.h"
#include "formats/query/mover_pose.h"
#include "player/movers/light_samples.h"

namespace oriel {
namespace {

constexpr float kInside = 0.7f;        // of the mover's box: where light is asked
constexpr float kLeastWeight = 0.02f;  // of a corner that no probe sees
constexpr float kFlatness = 0.05f;     // pulls gradients that little is known of towards 0

// Adds a light, unshadowed and times `share`, as harmonics about p.
void add_as_harmonics(const BrightLight& light, float share, const Vec3& p, int bands, std::vector<float>& sh) {
  const auto count = static_cast<std::size_t>(sh_count(bands));
  const LightSamples samples = sample_light(light);
  std::vector<float> y(count);
  for (std::size_t i = 0; i < samples.at.size(); ++i) {
    Vec3 towards;
    const Vec3 lux = facing_irradiance(samples, i, p, towards) * (share / static_cast<float>(samples.at.size()));
    evaluate_sh(towards, y);
    for (int c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < count; ++k) sh[static_cast<std::size_t>(c) * count + k] += lux[c] * y[k];
  }
}

// Weighted least squares of values at the eight corners by (1, q).
class CornerFit {
 public:
  explicit CornerFit(const std::array<float, 8>& weights) {
    Mat4 normal(0);
    for (std::size_t i = 0; i < 8; ++i) normal += weights[i] * glm::outerProduct(row(i), row(i));
    for (int axis = 1; axis < 4; ++axis) normal[axis][axis] += kFlatness * normal[0][0];
    const Mat4 inverse = glm::inverse(normal);
    for (std::size_t i = 0; i < 8; ++i) columns_[i] = weights[i] * (inverse * row(i));
  }
  template <class Value>
  Vec4 fit(Value value) const {
    Vec4 sum(0);
    for (std::size_t i = 0; i < 8; ++i) sum += columns_[i] * value(i);
    return sum;
  }
  static Vec4 row(std::size_t corner) {
    const auto side = [&](std::size_t bit) { return (corner & bit) != 0 ? kInside : -kInside; };
    return {1, side(1), side(2), side(4)};
  }

 private:
  std::array<Vec4, 8> columns_;
};

// Each cluster's basis vectors times the light, `count` coefficients a colour.
void fill_table(const CompressedTransfer& transfer, const std::vector<Vec4>& light, std::size_t count,
                std::vector<Vec4>& table) {
  const auto known = static_cast<std::size_t>(sh_count(transfer.bands));
  const auto entries = static_cast<std::size_t>(transfer.components + 1);
  for (std::size_t row = 0; row < table.size() / 3; ++row) {
    const std::size_t cluster = row / entries, k = row % entries;
    const float scale = k == 0 ? 1 : transfer.weight_scale[cluster * (entries - 1) + k - 1];
    for (std::size_t c = 0; c < 3; ++c) {
      const float* basis = transfer.basis.data() + row * transfer.stride() + (transfer.channels == 3 ? c * known : 0);
      Vec4 sum(0);
      for (std::size_t i = 0; i < known; ++i) sum += basis[i] * light[c * count + i];
      table[3 * row + c] = scale * sum;
    }
  }
}

}  // namespace

MoverLight light_mover(const LightField& field, const CompressedTransfer& transfer, const Bounds& box,
                       const MoverPose& pose, bool all_in_harmonics) {
  MoverLight out;
  const auto entries = static_cast<std::size_t>(transfer.components + 1);
  out.table.assign(static_cast<std::size_t>(transfer.clusters) * entries * 3, Vec4(0));
  if (field.bands == 0 || box.empty()) return out;

  const DMat4 pack_from = pack_from_object(pose);
  std::array<LocalLight, 8> corners;
  std::array<float, 8> weights{};
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec3 q = Vec3(CornerFit::row(i)[1], CornerFit::row(i)[2], CornerFit::row(i)[3]);
    const Vec3 p(pack_from * DVec4(DVec3(box.center() + 0.5f * q * (box.upper - box.lower)), 1));
    corners[i] = light_at(field, p);
    weights[i] = std::max(corners[i].trust, kLeastWeight);
    if (!all_in_harmonics) continue;
    for (const LocalLight::Share& s : corners[i].bright)
      add_as_harmonics(field.lights[s.light], s.share, p, field.bands, corners[i].sh);
    corners[i].bright.clear();
  }
  const CornerFit corner_fit(weights);

  // The fitted coefficients in the object's axes: by colour, coefficient.
  const ShRotation rotation(glm::transpose(DMat3(pack_from)), field.bands);
  const auto count = static_cast<std::size_t>(sh_count(field.bands));
  std::vector<Vec4> light(3 * count);
  std::vector<float> world(count), object(count);
  for (std::size_t c = 0; c < 3; ++c)
    for (int part = 0; part < 4; ++part) {
      for (std::size_t k = 0; k < count; ++k)
        world[k] = corner_fit.fit([&](std::size_t i) { return corners[i].sh[c * count + k]; })[part];
      rotation.apply(world, object);
      for (std::size_t k = 0; k < count; ++k) light[c * count + k][part] = object[k];
    }

  fill_table(transfer, light, count, out.table);
  for (std::uint32_t l = 0; l < field.lights.size(); ++l) {
    bool shines = false;
    const auto share = [&](std::size_t i) {
      for (const LocalLight::Share& s : corners[i].bright)
        if (s.light == l) {
          shines = true;
          return s.share;
        }
      return 0.0f;
    };
    const Vec4 fit = corner_fit.fit(share);
    if (shines) out.bright.push_back({l, fit});
  }
  return out;
}

}  // namespace oriel
