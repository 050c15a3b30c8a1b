#include "formats/query/lobe_light.h"

#include <algorithm>

namespace oriel {
namespace {

// (m11, m13, m22, m31) over m33 after the frame has turned by an angle of that cosine and sine: about y, z towards -x.
Vec4 turned(const Vec4& m, float cosine, float sine) {
  const float m33 = cosine - m.w * sine;
  return Vec4(m.x * cosine + m.y * sine, m.y * cosine - m.x * sine, m.z, m.w * cosine + sine) / m33;
}

float sine_of(float cosine) {
  return std::sqrt(std::max(0.0f, 1 - cosine * cosine));
}

}  // namespace

double lobe_density(const LobeFit& fit, const DVec3& w) {
  const DVec3 v(fit.m11 * w.x + fit.m13 * w.z, fit.m22 * w.y, fit.m31 * w.x + w.z);
  const double determinant = double{fit.m22} * (fit.m11 - double{fit.m13} * fit.m31), length2 = glm::dot(v, v);
  return std::max(v.z, 0.0) * determinant / (kPiD * length2 * length2);
}

Vec4 in_mirror_frame(const LobeFit& fit, float cos_theta) {
  return turned({fit.m11, fit.m13, fit.m22, fit.m31}, cos_theta, sine_of(cos_theta));
}

Vec4 mix_lobes(const Vec4& a, const Vec4& b, float share) {
  Vec4 m = glm::mix(a, b, share);
  m.z = a.z * b.z / (b.z + (a.z - b.z) * share);  // the width across, its inverse, follows the cosine
  return m;
}

LobeFit in_surface_frame(const Vec4& matrix, float cos_theta, float amplitude) {
  const Vec4 m = turned(matrix, cos_theta, -sine_of(cos_theta));
  return {m.x, m.y, m.z, m.w, amplitude};
}

}  // namespace oriel
