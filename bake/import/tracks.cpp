#include "bake/import/tracks.h"

#include <algorithm>
#include <set>

namespace oriel {
namespace {

using gltf::AnimationDesc;
using gltf::Document;
using Interpolation = Track::Interpolation;

constexpr double kMaxTurn_rad = 5 * kPiD / 180;  // between two keys: what a straight line still follows
constexpr std::size_t kMaxKeys = 1 << 20;

Result<Track> load_track(const Document& document, const AnimationDesc& animation,
                         const AnimationDesc::Channel& channel, gltf::AccessorReader& accessors) {
  const auto& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
  const std::string where = document.file + ": " + channel.file_path;
  Track track;
  track.node = static_cast<std::uint32_t>(channel.node);
  track.target = channel.target[0];
  track.interpolation = sampler.interpolation;
  track.components = track.target == 'r' ? 4 : 3;
  if (accessors.desc(sampler.input).components != 1)
    return invalid(where, "found {} components in keyframe times, expected 1",
                   accessors.desc(sampler.input).components);
  if (accessors.desc(sampler.output).components != track.components)
    return invalid(where, "found {1} components in {0}, expected {2}", channel.target,
                   accessors.desc(sampler.output).components, track.components);
  ORIEL_TRY(track.times, accessors.floats(sampler.input));
  ORIEL_TRY(track.values, accessors.floats(sampler.output));
  const std::size_t rows = track.times.size() * (track.interpolation == Interpolation::kCubicSpline ? 3 : 1);
  if (track.times.empty() || track.values.size() != rows * track.components)
    return invalid(where, "found {} keyframe times and {} values, expected as many", track.times.size(),
                   track.values.size() / track.components);
  for (std::size_t i = 1; i < track.times.size(); ++i)
    if (!(track.times[i] > track.times[i - 1]))
      return invalid(where, "found {1} as keyframe time {0} after {2}, expected increasing times", i, track.times[i],
                     track.times[i - 1]);
  if (track.target == 'r')
    for (std::size_t i = 0; i < track.times.size(); ++i)
      if (!(glm::dot(track.value(i), track.value(i)) > 0))
        return invalid(where, "found zero as rotation {}, expected a unit quaternion", i);
  return track;
}

// A node under the tracks that move it or a node above it.
class Motion {
 public:
  Motion(const Document& document, std::uint32_t moved, const Animation& animation) : document_(document) {
    for (int node = static_cast<int>(moved); node >= 0; node = document.nodes[static_cast<std::size_t>(node)].parent)
      chain_.push_back(static_cast<std::uint32_t>(node));
    std::set<double> times;
    for (const Track& track : animation) {
      if (!is_above(document, track.node, moved)) continue;
      tracks_.push_back(&track);
      times.insert(track.times.begin(), track.times.end());
      steps_ |= track.interpolation == Interpolation::kStep;
      turns_ |= track.target == 'r';
    }
    times_.assign(times.begin(), times.end());
  }

  Result<std::vector<MotionKey>> keys() const {
    std::vector<MotionKey> keys;
    for (std::size_t i = 0; i < times_.size(); ++i) {
      if (i > 0) {
        const int parts = turns_ ? parts_between(times_[i - 1], times_[i]) : 1;
        for (int k = 1; k < parts; ++k) {
          const double time = times_[i - 1] + (times_[i] - times_[i - 1]) * k / parts;
          keys.push_back({time, world(time, false)});
        }
        if (steps_) keys.push_back({times_[i], world(times_[i], true)});
      }
      keys.push_back({times_[i], world(times_[i], false)});
      if (keys.size() > kMaxKeys)
        return invalid(document_.file, "found more than {} keys of one animation, expected fewer", kMaxKeys);
    }
    return keys;
  }

 private:
  // A rotation may go the long way round: its angle is that of both halves.
  int parts_between(double from, double to) const {
    const DMat3 a = rotation_of(world(from, false)), middle = rotation_of(world(0.5 * (from + to), false)),
                b = rotation_of(world(to, true));
    return std::max(1, static_cast<int>(std::ceil((angle(a, middle) + angle(middle, b)) / kMaxTurn_rad - 1e-6)));
  }

  static double angle(const DMat3& a, const DMat3& b) {
    const double trace = glm::dot(a[0], b[0]) + glm::dot(a[1], b[1]) + glm::dot(a[2], b[2]);
    return std::acos(std::clamp(0.5 * (trace - 1), -1.0, 1.0));
  }

  DMat4 world(double time, bool before) const {
    DMat4 world(1);
    for (auto node = chain_.rbegin(); node != chain_.rend(); ++node) world = world * local(*node, time, before);
    return world;
  }

  DMat4 local(std::uint32_t index, double time, bool before) const {
    const gltf::NodeDesc& node = document_.nodes[index];
    if (node.has_matrix) return node.matrix;
    DVec3 t = node.translation, s = node.scale;
    DVec4 r = node.rotation;
    for (const Track* track : tracks_) {
      if (track->node != index) continue;
      const DVec4 v = track->at(time, before);
      if (track->target == 't') t = DVec3(v);
      if (track->target == 's') s = DVec3(v);
      if (track->target == 'r') r = v / std::sqrt(std::max(glm::dot(v, v), 1e-300));
    }
    return gltf::matrix_from_trs(t, r, s);
  }

  const Document& document_;
  std::vector<const Track*> tracks_;
  std::vector<std::uint32_t> chain_;  // from the node up to its root
  std::vector<double> times_;
  bool steps_ = false, turns_ = false;
};

}  // namespace

DVec4 Track::value(std::size_t key) const {
  const std::size_t row = interpolation == Interpolation::kCubicSpline ? 3 * key + 1 : key;
  DVec4 v(0);
  for (std::uint32_t c = 0; c < components; ++c) v[static_cast<int>(c)] = values[row * components + c];
  return v;
}

DVec4 Track::at(double time_s, bool before) const {
  if (time_s <= times.front()) return value(0);
  if (time_s >= times.back() && !(before && interpolation == Interpolation::kStep)) return value(times.size() - 1);
  const auto next = before ? std::lower_bound(times.begin(), times.end(), time_s)
                           : std::upper_bound(times.begin(), times.end(), time_s);
  const auto i = static_cast<std::size_t>(next - times.begin());
  const DVec4 a = value(i - 1);
  if (interpolation == Interpolation::kStep || i >= times.size()) return a;
  DVec4 b = value(i);
  const double w = (time_s - times[i - 1]) / (static_cast<double>(times[i]) - times[i - 1]);
  if (target != 'r') return a + w * (b - a);
  // Shortest way round; glTF 2.0 appendix C.4.
  double cosine = glm::dot(a, b);
  if (cosine < 0) b = -b, cosine = -cosine;
  const double angle = std::acos(std::min(1.0, cosine));
  if (angle < 1e-6) return a + w * (b - a);
  return (std::sin((1 - w) * angle) * a + std::sin(w * angle) * b) / std::sin(angle);
}

bool is_above(const Document& document, std::uint32_t ancestor, std::uint32_t node) {
  for (int n = static_cast<int>(node); n >= 0; n = document.nodes[static_cast<std::size_t>(n)].parent)
    if (static_cast<std::uint32_t>(n) == ancestor) return true;
  return false;
}

bool is_motion(const Document& document, const AnimationDesc::Channel& channel) {
  const bool known = channel.target == "translation" || channel.target == "rotation" || channel.target == "scale";
  return channel.node >= 0 && known && !document.nodes[static_cast<std::size_t>(channel.node)].has_matrix;
}

Result<std::vector<Animation>> load_animations(const Document& document, std::span<const std::uint32_t> nodes,
                                               gltf::AccessorReader& accessors, Context& context) {
  std::size_t still = 0, cubic = 0;
  std::vector<Animation> animations;
  for (const AnimationDesc& desc : document.animations) {
    Animation& tracks = animations.emplace_back();
    for (const AnimationDesc::Channel& channel : desc.channels) {
      const bool moves = is_motion(document, channel) && std::any_of(nodes.begin(), nodes.end(), [&](std::uint32_t n) {
                           return is_above(document, static_cast<std::uint32_t>(channel.node), n);
                         });
      if (!moves) still += channel.node >= 0;
      if (!moves || channel.sampler < 0) continue;
      ORIEL_TRY(const Track track, load_track(document, desc, channel, accessors));
      cubic += track.interpolation == Interpolation::kCubicSpline;
      tracks.push_back(track);
    }
  }
  if (still > 0)
    context.warning(
        "animation-left-out",
        fmt::format("{} animation channels move other things than cameras and meshes: those stand still", still));
  if (cubic > 0)
    context.warning("animation-simplified",
                    fmt::format("{} cubic spline channels are taken as straight between their keys", cubic));
  return animations;
}

DMat3 rotation_of(const DMat4& world_from_node) {
  const DVec3 x(world_from_node[0]), y(world_from_node[1]);
  const double x2 = glm::dot(x, x), y2 = glm::dot(y, y);
  if (!(x2 > 1e-300 && y2 > 1e-300)) return DMat3(1);
  const DVec3 right = x / std::sqrt(x2), across = y / std::sqrt(y2) - glm::dot(y / std::sqrt(y2), right) * right;
  const double across2 = glm::dot(across, across);
  if (!(across2 > 1e-12)) return DMat3(1);
  const DVec3 up = across / std::sqrt(across2);
  return DMat3(right, up, glm::cross(right, up));
}

Result<std::vector<MotionKey>> motion_of(const Document& document, std::uint32_t node, const Animation& animation) {
  return Motion(document, node, animation).keys();
}

}  // namespace oriel
