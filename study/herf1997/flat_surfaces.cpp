#include "study/herf1997/flat_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace oriel::study {
namespace {

constexpr double kTouching = 1e-5;     // of the scene's size: what floats and a modeller's rounding leave
constexpr double kSameWay = 1 - 1e-6;  // cosine: normals of one plane
constexpr double kLeastArea = 0.01;    // m²: of a part's triangles in a plane; less is left to shadow maps
constexpr double kBucket = 16;         // of normals, a unit's part
constexpr std::size_t kMostPlanes = 4096;
constexpr std::size_t kRun = 64;  // triangles of one box of the rest

struct Triangle {
  std::array<DVec3, 3> at;
  DVec3 normal{0};
  double area = 0;
};

bool is_opaque(const Material& m) {
  return m.alpha_mode != AlphaMode::kBlend && m.transmission == 0;
}

class Finder {
 public:
  explicit Finder(const Pack& pack) : pack_(pack) {
    Bounds all;
    for (const Vec3& p : pack.mesh.positions) all.extend(p);
    out_.touching = kTouching * std::max(1.0, static_cast<double>(all.radius()));
  }

  FlatSurfaces run() {
    for (const MeshPart& part : pack_.mesh.parts) {
      const Material& m = pack_.materials[part.material];
      if (is_opaque(m) && !m.unlit) add(part, !m.double_sided);
    }
    std::erase_if(out_.planes, [](const FlatPlane& plane) { return plane.pieces.empty(); });
    return std::move(out_);
  }

 private:
  struct InPlane {
    FlatPiece piece{DVec2(1e300), DVec2(-1e300)};
    double area = 0;
    std::vector<std::uint32_t> triangles;  // by first index
  };

  Triangle triangle(std::uint32_t first) const {
    Triangle t;
    for (std::uint32_t k = 0; k < 3; ++k) t.at[k] = DVec3(pack_.mesh.positions[pack_.mesh.indices[first + k]]);
    const DVec3 n = glm::cross(t.at[1] - t.at[0], t.at[2] - t.at[0]);
    const double length = glm::length(n);
    t.area = 0.5 * length;
    if (length > 0) t.normal = n / length;
    return t;
  }

  bool shades_flat(std::uint32_t first, const DVec3& normal) const {
    for (std::uint32_t k = 0; k < 3; ++k)
      if (!(glm::dot(DVec3(pack_.mesh.normals[pack_.mesh.indices[first + k]]), normal) > kSameWay)) return false;
    return true;
  }

  void add(const MeshPart& part, bool may_be_flat) {
    std::map<std::uint32_t, InPlane> found;
    std::vector<std::uint32_t> rest;
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
      const Triangle t = triangle(i);
      if (!(t.area > 0)) continue;
      const auto plane = may_be_flat && shades_flat(i, t.normal) ? plane_of(t) : kMostPlanes;
      if (plane == kMostPlanes) {
        rest.push_back(i);
        continue;
      }
      InPlane& in = found[static_cast<std::uint32_t>(plane)];
      const FlatPlane& p = out_.planes[plane];
      for (const DVec3& at : t.at) {
        const DVec2 q(glm::dot(at - p.origin, p.x), glm::dot(at - p.origin, p.y));
        in.piece.lower = min(in.piece.lower, q), in.piece.upper = max(in.piece.upper, q);
      }
      in.area += t.area;
      in.triangles.push_back(i);
    }
    for (const auto& [plane, in] : found) {
      if (in.area >= kLeastArea)
        out_.planes[plane].pieces.push_back(in.piece);
      else
        rest.insert(rest.end(), in.triangles.begin(), in.triangles.end());
    }
    std::ranges::sort(rest);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (i % kRun == 0) out_.rest.emplace_back();
      for (const DVec3& at : triangle(rest[i]).at) out_.rest.back().extend(Vec3(at));
    }
  }

  bool holds(const FlatPlane& plane, const Triangle& t) const {
    if (!(glm::dot(plane.normal, t.normal) > kSameWay)) return false;
    return std::ranges::all_of(
        t.at, [&](const DVec3& p) { return std::abs(glm::dot(p - plane.origin, plane.normal)) <= out_.touching; });
  }

  // The plane that holds it, a new one where none does; kMostPlanes where there are too many.
  std::size_t plane_of(const Triangle& t) {
    if (last_ < out_.planes.size() && holds(out_.planes[last_], t)) return last_;
    using Key = std::array<int, 3>;
    const DVec3 at = t.normal * kBucket;
    const Key lower{static_cast<int>(std::floor(at.x - 0.5)), static_cast<int>(std::floor(at.y - 0.5)),
                    static_cast<int>(std::floor(at.z - 0.5))};
    for (int i = 0; i < 8; ++i) {
      const auto bucket = buckets_.find({lower[0] + (i & 1), lower[1] + (i >> 1 & 1), lower[2] + (i >> 2)});
      if (bucket == buckets_.end()) continue;
      for (const std::size_t plane : bucket->second)
        if (holds(out_.planes[plane], t)) return last_ = plane;
    }
    if (out_.planes.size() == kMostPlanes) return kMostPlanes;
    const Mat3 frame = frame_from_normal(Vec3(t.normal));
    const DVec3 x = glm::normalize(glm::cross(DVec3(frame[1]), t.normal));
    out_.planes.push_back({t.at[0], x, glm::cross(t.normal, x), t.normal, {}});
    const Key own{static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)),
                  static_cast<int>(std::floor(at.z))};
    buckets_[own].push_back(out_.planes.size() - 1);
    return last_ = out_.planes.size() - 1;
  }

  const Pack& pack_;
  FlatSurfaces out_;
  std::map<std::array<int, 3>, std::vector<std::size_t>> buckets_;
  std::size_t last_ = 0;
};

}  // namespace

FlatSurfaces find_flat_surfaces(const Pack& pack) {
  return Finder(pack).run();
}

}  // namespace oriel::study
