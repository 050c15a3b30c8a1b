#include "formats/shadow/receiver.h"

#include "formats/core/check.h"

namespace oriel {

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

DMat4 pyramid_to_box(const ShadowReceiver& receiver, const DVec3& apex) {
  const DVec3 ex = receiver.x * static_cast<double>(receiver.width), &b = receiver.corner;
  const DVec3 ey = receiver.y * static_cast<double>(receiver.height), ew = b - apex;
  const DVec3 nx = glm::cross(ew, ey), ny = glm::cross(ex, ew), nw = glm::cross(ey, ex);
  const auto row = [](const DVec3& n, double length, const DVec3& zero) {
    return DVec4(n / length, -glm::dot(n, zero) / length);
  };
  return glm::transpose(DMat4(row(nx, glm::dot(nx, ex), b), row(ny, glm::dot(ny, ey), b), DVec4(0, 0, 0, 1),
                              row(nw, glm::dot(nw, ew), apex)));
}

ReceiverSpace::ReceiverSpace(const ShadowReceiver& receiver)
    : corner(receiver.corner), linear(glm::inverse(DMat3(receiver.x, receiver.y, receiver.normal))) {}

}  // namespace oriel
