#include "study/herf1997/equal_weights.h"

#include <algorithm>
#include <bit>

#include "formats/core/check.h"

namespace oriel::study {

std::vector<float> form_factor_light(const ShadowReceiver& receiver, std::span<const DVec3> corners, int every) {
  ORIEL_CHECK(every >= 1);
  const auto at = [&](double x, double y) {
    const DVec3 p = receiver.corner + x * receiver.x + y * receiver.y;
    std::vector<DVec3> above;  // the horizon cuts the light
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const DVec3 a = corners[k] - p, b = corners[(k + 1) % corners.size()] - p;
      const double da = glm::dot(a, receiver.normal), db = glm::dot(b, receiver.normal);
      if (da >= 0) above.push_back(a);
      if ((da > 0 && db < 0) || (da < 0 && db > 0)) above.push_back(a + (b - a) * (da / (da - db)));
    }
    double sum = 0;
    for (std::size_t k = 0; k < above.size(); ++k) {
      const DVec3 &a = above[k], &b = above[(k + 1) % above.size()];
      const DVec3 normal = glm::cross(b, a);
      const double sine = glm::length(normal);
      if (sine > 0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(normal, receiver.normal) / sine;
    }
    return static_cast<float>(std::max(0.0, 0.5 * sum));
  };
  const int columns = (receiver.width - 1) / every + 2, lines = (receiver.height - 1) / every + 2;
  std::vector<float> coarse(static_cast<std::size_t>(columns) * lines);
  for (int j = 0; j < lines; ++j)
    for (int i = 0; i < columns; ++i) coarse[j * columns + i] = at(i * every + 0.5, j * every + 0.5);
  std::vector<float> out;
  out.reserve(static_cast<std::size_t>(receiver.width) * receiver.height);
  for (int j = 0; j < receiver.height; ++j)
    for (int i = 0; i < receiver.width; ++i) {
      const float* c = &coarse[(j / every) * columns + i / every];
      const float x = static_cast<float>(i % every) / every, y = static_cast<float>(j % every) / every;
      out.push_back((c[0] * (1 - x) + c[1] * x) * (1 - y) + (c[columns] * (1 - x) + c[columns + 1] * x) * y);
    }
  return out;
}

std::vector<std::uint16_t> count_blocked(const BlockedRows& rows) {
  std::vector<std::uint16_t> count(static_cast<std::size_t>(rows.width()) * static_cast<std::size_t>(rows.height()));
  for (int s = 0; s < rows.samples(); ++s)
    for (int w = 0; w < rows.words(); ++w)
      for (int y = 0; y < rows.height(); ++y)
        for (std::uint32_t bits = rows.word(s, w, y); bits != 0; bits &= bits - 1)
          ++count[static_cast<std::size_t>(y) * static_cast<std::size_t>(rows.width()) +
                  static_cast<std::size_t>(32 * w + std::countr_zero(bits))];
  return count;
}

}  // namespace oriel::study
