// Shadow rays in exact arithmetic, for shadows to be held against: coordinates are halves of integers.
#pragma once

#include <random>

#include "study/herf1997/soft_shadow.h"

namespace oriel::study {

enum class Ray { kFree, kBlocked, kTouched };

using Half = std::array<std::int64_t, 3>;  // coordinates times two

inline Half halves(const DVec3& p) {
  return {std::llround(p.x * 2), std::llround(p.y * 2), std::llround(p.z * 2)};
}

// Sign of the volume of a tetrahedron.
inline int volume(const Half& a, const Half& b, const Half& c, const Half& d) {
  std::array<Half, 3> e{};
  for (int k = 0; k < 3; ++k) e[0][k] = b[k] - a[k], e[1][k] = c[k] - a[k], e[2][k] = d[k] - a[k];
  const std::int64_t v = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
  return (v > 0) - (v < 0);
}

// From p to q, ends left out. Touched: an edge goes through the ray, or p lies on a face that goes through the
// receiver.
inline Ray cast(const Half& p, const Half& q, const std::array<Half, 3>& t) {
  const int sp = volume(t[0], t[1], t[2], p), sq = volume(t[0], t[1], t[2], q);
  const bool in_receiver = t[0][2] == p[2] && t[1][2] == p[2] && t[2][2] == p[2];
  if ((sp == 0 && in_receiver) || sq == 0 || sp == sq) return Ray::kFree;
  const std::array<int, 3> s{volume(p, q, t[0], t[1]), volume(p, q, t[1], t[2]), volume(p, q, t[2], t[0])};
  const bool positive = s[0] >= 0 && s[1] >= 0 && s[2] >= 0, negative = s[0] <= 0 && s[1] <= 0 && s[2] <= 0;
  if (!positive && !negative) return Ray::kFree;
  return sp != 0 && s[0] != 0 && s[1] != 0 && s[2] != 0 ? Ray::kBlocked : Ray::kTouched;
}

// A scene of a receiver in the plane z = 0, one texel a unit.
struct ShadowScene {
  IVec2 texels{64, 48};
  ShadowLight light{};
  std::vector<DVec3> points{};
  std::vector<std::array<std::uint32_t, 3>> triangles{};

  ShadowReceiver receiver() const {
    return make_shadow_receiver(DVec3(0), DVec3(texels.x, 0, 0), DVec3(0, texels.y, 0), texels, DVec3(0, 0, 1));
  }
  void add(const DVec3& a, const DVec3& b, const DVec3& c) {
    const auto n = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), {a, b, c});
    triangles.push_back({n, n + 1, n + 2});
  }
  void add_box(const DVec3& lo, const DVec3& hi) {
    const auto at = [&](int i) { return DVec3(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z); };
    for (const auto& q : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                          std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
      add(at(q[0]), at(q[1]), at(q[2]));
      add(at(q[0]), at(q[2]), at(q[3]));
    }
  }
  // Samples at places of whole units, some of them in one place.
  void light_over(const DVec3& corner, const DVec3& size, int samples) {
    light = sample_parallelogram({corner, DVec3(size.x, 0, 0), DVec3(0, size.y, 0), true}, 1, samples);
    for (ShadowLightSample& s : light.samples) s.position = round(s.position);
  }
};

struct Compared {
  std::size_t wrong = 0, touched = 0, blocked = 0, rays = 0;
};

// Every texel and sample by rays, beside the bits.
inline Compared compare_with_rays(const ShadowScene& scene, const BlockedRows& rows, const OccluderView& view) {
  Compared out;
  std::vector<std::array<Half, 3>> triangles{};
  for (const auto& t : scene.triangles)
    triangles.push_back({halves(scene.points[t[0]]), halves(scene.points[t[1]]), halves(scene.points[t[2]])});
  for (std::size_t s = 0; s < view.apexes.size(); ++s) {
    const Half to = halves(scene.light.samples[view.apex_of[s]].position);
    for (int y = 0; y < rows.height(); ++y)
      for (int x = 0; x < rows.width(); ++x) {
        Ray ray = Ray::kFree;
        for (const auto& t : triangles)
          ray = std::max(ray, cast({2 * x + 1, 2 * y + 1, 0}, to, t), [](Ray a, Ray b) {
            const auto rank = [](Ray r) { return r == Ray::kBlocked ? 2 : r == Ray::kTouched ? 1 : 0; };
            return rank(a) < rank(b);
          });
        const bool bit = rows.blocked(static_cast<int>(s), x, y);
        ++out.rays, out.blocked += bit, out.touched += ray == Ray::kTouched;
        out.wrong += ray != Ray::kTouched && bit != (ray == Ray::kBlocked);
      }
  }
  return out;
}

}  // namespace oriel::study
