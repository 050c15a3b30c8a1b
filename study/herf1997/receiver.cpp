#include "study/herf1997/receiver.h"

#include "formats/core/check.h"

namespace oriel::study {

ShadowReceiver make_shadow_receiver(const DVec3& corner, const DVec3& edge_x, const DVec3& edge_y, const IVec2& texels,
                                    const DVec3& facing) {
  const DVec3 normal = glm::cross(edge_x, edge_y);
  ORIEL_CHECK(texels.x > 0 && texels.y > 0);
  ORIEL_CHECK(glm::length(normal) > 0);
  const double sign = glm::dot(normal, facing) < 0 ? -1 : 1;
  return {.corner = corner,
          .x = edge_x / static_cast<double>(texels.x),
          .y = edge_y / static_cast<double>(texels.y),
          .normal = normal * (sign / glm::length(normal)),
          .width = texels.x,
          .height = texels.y};
}

ReceiverSpace::ReceiverSpace(const ShadowReceiver& receiver)
    : corner(receiver.corner), linear(glm::inverse(DMat3(receiver.x, receiver.y, receiver.normal))) {}

}  // namespace oriel::study
