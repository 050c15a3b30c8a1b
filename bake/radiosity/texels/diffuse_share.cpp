#include "bake/radiosity/texels/diffuse_share.h"

#include "bake/trace/albedo.h"

namespace oriel {

DiffuseShare::DiffuseShare(std::span<const ShadePoint> points) : DiffuseShare() {
  if (points.empty()) return;
  for (int i = 0; i < kNodes; ++i) {
    const float cosine = 1 - std::sqrt(static_cast<float>(i) / (kNodes - 1));
    float specular = 0;
    for (const ShadePoint& point : points) specular += max_component(reflectance(point, cosine));
    specular = std::clamp(specular / static_cast<float>(points.size()), 0.0f, 1.0f);
    share_[i] = static_cast<std::uint16_t>(kOne - std::ceil(specular * kOne));
  }
}

}  // namespace oriel
