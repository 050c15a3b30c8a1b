#include "study/diefenbach1997/light_paths.h"

#include <algorithm>

#include "player/movers/light_samples.h"

namespace oriel::study {
namespace {

bool has_before(const LightMirror& mirror, const Vec4& place) {
  return glm::dot(DVec4(mirror.plane), DVec4(place)) > double{mirror.margin} * place.w;
}

// Whether light that a leaves may meet b.
bool face_each_other(const LightMirror& a, const LightMirror& b) {
  const auto any_before = [](const LightMirror& mirror, const LightMirror& other) {
    return std::ranges::any_of(other.corners, [&](const Vec3& c) { return has_before(mirror, Vec4(c, 1)); });
  };
  return any_before(a, b) && any_before(b, a);
}

Vec4 mirrored(const LightMirror& mirror, const Vec4& place) {
  return place - 2 * glm::dot(mirror.plane, place) * Vec4(Vec3(mirror.plane), 0);
}

Vec4 image_of(const LightPath& path, std::span<const LightSource> sources, std::span<const LightMirror> mirrors) {
  Vec4 place = sources[path.source].place;
  for (const std::uint32_t m : path.mirrors) place = mirrored(mirrors[m], place);
  return place;
}

}  // namespace

std::vector<LightSource> sources_of(std::span<const BrightLight> lamps, int points, std::uint32_t look) {
  std::vector<LightSource> sources;
  for (std::uint32_t l = 0; l < lamps.size(); ++l) {
    const LightSamples samples = sample_light(lamps[l], points, look);
    if (!(max_component(samples.intensity) > 0)) continue;
    for (const Vec4& at : samples.at)
      sources.push_back({l, at, samples.intensity / static_cast<float>(samples.at.size()), samples.axis, samples.cones,
                         samples.cosine});
  }
  return sources;
}

Mat4 reflection_of(const LightMirror& mirror) {
  Mat4 out(1);
  for (int column = 0; column < 4; ++column) out[column] -= 2 * mirror.plane[column] * Vec4(Vec3(mirror.plane), 0);
  return out;
}

std::vector<PathLeg> legs_of(const LightPath& path, std::span<const LightSource> sources,
                             std::span<const LightMirror> mirrors) {
  std::vector<PathLeg> legs(path.mirrors.size() + 1);
  legs[0].light = sources[path.source].place;
  for (std::size_t i = 0; i < path.mirrors.size(); ++i) {
    const std::uint32_t m = path.mirrors[i];
    legs[i].walls.push_back(m), legs[i + 1].walls.push_back(m);
    legs[i + 1].light = mirrored(mirrors[m], legs[i].light);
  }
  for (std::size_t i = path.mirrors.size(); i-- > 0;)
    legs[i].last_from_leg = legs[i + 1].last_from_leg * reflection_of(mirrors[path.mirrors[i]]);
  return legs;
}

LightPaths find_light_paths(std::span<const LightSource> sources, std::span<const LightMirror> mirrors, int most) {
  LightPaths out;
  std::vector<LightPath> last;
  for (std::uint32_t s = 0; s < sources.size(); ++s) last.push_back({s, {}});
  for (int order = 0;; ++order) {
    for (const LightPath& path : last) {
      if (out.paths.size() < kMostLightPaths)
        out.paths.push_back(path);
      else
        ++out.left_out;
    }
    if (order >= most || out.left_out > 0) return out;
    std::vector<LightPath> next;
    for (const LightPath& path : last) {
      const Vec4 image = image_of(path, sources, mirrors);
      for (std::uint32_t m = 0; m < mirrors.size(); ++m) {
        if (!has_before(mirrors[m], image)) continue;
        if (!path.mirrors.empty() &&
            (path.mirrors.back() == m || !face_each_other(mirrors[path.mirrors.back()], mirrors[m])))
          continue;
        if (out.paths.size() + next.size() >= kMostLightPaths) {
          ++out.left_out;
          continue;
        }
        next.push_back(path);
        next.back().mirrors.push_back(m);
      }
    }
    if (next.empty()) return out;
    last = std::move(next);
  }
}

}  // namespace oriel::study
