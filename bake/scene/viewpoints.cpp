#include "bake/scene/viewpoints.h"

#include <algorithm>
#include <set>

namespace oriel {
namespace {

using gltf::AnimationDesc;
using gltf::Document;
using Interpolation = AnimationDesc::Sampler::Interpolation;

constexpr double kMaxTurn_rad =
    5 * kPiD / 180;  // between two keys: what a straight line between directions still follows
constexpr std::size_t kMaxKeys = 1 << 20;

// Where something stands and looks; ok is false where that cannot be said.
struct Pose {
  Vec3 eye{0}, forward{0, 0, -1}, up{0, 1, 0};
  bool ok = false;
};

Pose pose_of(const DMat4& world_from_node, const DVec3& origin) {
  Pose pose;
  const DVec3 forward = -DVec3(world_from_node[2]), up(world_from_node[1]);
  const double f2 = glm::dot(forward, forward), u2 = glm::dot(up, up);
  const DVec3 eye = DVec3(world_from_node[3]) - origin;
  if (!(f2 > 1e-300) || !(u2 > 1e-300) || !(glm::dot(eye, eye) < 1e36)) return pose;
  pose.eye = Vec3(eye);
  pose.forward = Vec3(forward / std::sqrt(f2));
  const DVec3 f = forward / std::sqrt(f2), u = up / std::sqrt(u2), side = u - glm::dot(u, f) * f;
  if (!(glm::dot(side, side) > 1e-12)) return pose;
  pose.up = Vec3(glm::normalize(side));
  pose.ok = true;
  return pose;
}

// One channel with its keys.
struct Track {
  std::uint32_t node = 0;
  char target = 't';  // t, r, s
  Interpolation interpolation = Interpolation::kLinear;
  std::span<const float> times, values;
  std::uint32_t components = 3;

  DVec4 value(std::size_t key) const {
    const std::size_t row = interpolation == Interpolation::kCubicSpline ? 3 * key + 1 : key;
    DVec4 v(0);
    for (std::uint32_t c = 0; c < components; ++c) v[static_cast<int>(c)] = values[row * components + c];
    return v;
  }

  // `before` asks for the limit from the left, which differs at the keys of STEP.
  DVec4 at(double time, bool before) const {
    if (time <= times.front()) return value(0);
    if (time >= times.back() && !(before && interpolation == Interpolation::kStep)) return value(times.size() - 1);
    const auto next = before ? std::lower_bound(times.begin(), times.end(), time)
                             : std::upper_bound(times.begin(), times.end(), time);
    const auto i = static_cast<std::size_t>(next - times.begin());
    const DVec4 a = value(i - 1);
    if (interpolation == Interpolation::kStep || i >= times.size()) return a;
    DVec4 b = value(i);
    const double w = (time - times[i - 1]) / (static_cast<double>(times[i]) - times[i - 1]);
    if (target != 'r') return a + w * (b - a);
    // Shortest way round; glTF 2.0 appendix C.4.
    double cosine = glm::dot(a, b);
    if (cosine < 0) b = -b, cosine = -cosine;
    const double angle = std::acos(std::min(1.0, cosine));
    if (angle < 1e-6) return a + w * (b - a);
    return (std::sin((1 - w) * angle) * a + std::sin(w * angle) * b) / std::sin(angle);
  }
};

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

// The walk of one camera under the tracks that move it or a node above it.
class PathBuilder {
 public:
  PathBuilder(const Document& document, std::uint32_t camera_node, std::vector<const Track*> tracks,
              const DVec3& origin)
      : document_(document), tracks_(std::move(tracks)), origin_(origin) {
    for (int node = static_cast<int>(camera_node); node >= 0;
         node = document.nodes[static_cast<std::size_t>(node)].parent)
      chain_.push_back(static_cast<std::uint32_t>(node));
    std::set<double> times;
    for (const Track* track : tracks_) {
      times.insert(track->times.begin(), track->times.end());
      steps_ |= track->interpolation == Interpolation::kStep;
      turns_ |= track->target == 'r';
    }
    times_.assign(times.begin(), times.end());
  }

  // Empty where a pose cannot be told or there would be too many keys.
  std::vector<CameraKey> keys() const {
    std::vector<CameraKey> keys;
    for (std::size_t i = 0; i < times_.size(); ++i) {
      if (i > 0) {
        const Pose a = pose(times_[i - 1], false), b = pose(times_[i], true);
        const double cosine = std::clamp(static_cast<double>(glm::dot(a.forward, b.forward)), -1.0, 1.0);
        // A rotation may go the long way round or leave the direction as it is while an arm swings: look halfway too.
        const Pose middle = pose(0.5 * (times_[i - 1] + times_[i]), false);
        const double half = std::clamp(static_cast<double>(glm::dot(a.forward, middle.forward)), -1.0, 1.0);
        const double turn = std::max(std::acos(cosine), 2 * std::acos(half));
        const int parts = turns_ ? std::max(1, static_cast<int>(std::ceil(turn / kMaxTurn_rad))) : 1;
        for (int k = 1; k < parts; ++k) add(times_[i - 1] + (times_[i] - times_[i - 1]) * k / parts, false, keys);
        if (steps_) add(times_[i], true, keys);
      }
      add(times_[i], false, keys);
      if (keys.size() > kMaxKeys || failed_) return {};
    }
    return keys;
  }

 private:
  Pose pose(double time, bool before) const {
    DMat4 world(1);
    for (auto node = chain_.rbegin(); node != chain_.rend(); ++node) world = world * local(*node, time, before);
    const Pose pose = pose_of(world, origin_);
    failed_ |= !pose.ok;
    return pose;
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

  void add(double time, bool before, std::vector<CameraKey>& keys) const {
    const Pose p = pose(time, before);
    const CameraKey key{static_cast<float>(time), p.eye, p.forward};
    if (!keys.empty() && keys.back().time_s == key.time_s && keys.back().eye == key.eye &&
        keys.back().forward == key.forward)
      return;
    keys.push_back(key);
  }

  const Document& document_;
  std::vector<const Track*> tracks_;
  DVec3 origin_;
  std::vector<std::uint32_t> chain_;  // from the camera up to its root
  std::vector<double> times_;
  bool steps_ = false, turns_ = false;
  mutable bool failed_ = false;
};

bool above(const Document& document, std::uint32_t ancestor, std::uint32_t node) {
  for (int n = static_cast<int>(node); n >= 0; n = document.nodes[static_cast<std::size_t>(n)].parent)
    if (static_cast<std::uint32_t>(n) == ancestor) return true;
  return false;
}

std::string camera_name(const Document& document, std::uint32_t node) {
  const gltf::NodeDesc& desc = document.nodes[node];
  return desc.name.empty() ? document.cameras[static_cast<std::size_t>(desc.camera)].name : desc.name;
}

Status place_paths(const Document& document, const std::vector<std::uint32_t>& camera_nodes,
                   gltf::AccessorReader& accessors, Scene& scene, Context& context) {
  std::size_t still = 0, cubic = 0;
  for (const AnimationDesc& animation : document.animations) {
    std::vector<Track> tracks;
    for (const AnimationDesc::Channel& channel : animation.channels) {
      const bool known = channel.target == "translation" || channel.target == "rotation" || channel.target == "scale";
      const bool moves_camera =
          channel.node >= 0 && known && !document.nodes[static_cast<std::size_t>(channel.node)].has_matrix &&
          std::any_of(camera_nodes.begin(), camera_nodes.end(),
                      [&](std::uint32_t c) { return above(document, static_cast<std::uint32_t>(channel.node), c); });
      if (channel.node >= 0 && (!moves_camera || document.nodes[static_cast<std::size_t>(channel.node)].camera < 0))
        ++still;
      if (!moves_camera || channel.sampler < 0) continue;
      ORIEL_TRY(Track track, load_track(document, animation, channel, accessors));
      cubic += track.interpolation == Interpolation::kCubicSpline;
      tracks.push_back(track);
    }
    for (const std::uint32_t node : camera_nodes) {
      std::vector<const Track*> mine;
      for (const Track& track : tracks)
        if (above(document, track.node, node)) mine.push_back(&track);
      if (mine.empty()) continue;
      const gltf::CameraDesc& camera = document.cameras[static_cast<std::size_t>(document.nodes[node].camera)];
      CameraPath path;
      path.name = camera_name(document, node);
      path.vertical_fov_rad = static_cast<float>(camera.perspective ? camera.vertical_fov_rad : 1.0);
      path.keys = PathBuilder(document, node, std::move(mine), scene.origin).keys();
      if (path.keys.empty())
        context.warning(fmt::format(
            "the animation of camera \"{}\" has no direction somewhere or too many keys and is left out", path.name));
      else
        scene.paths.push_back(std::move(path));
    }
  }
  if (still > 0)
    context.warning(fmt::format("{} animation channels move other things than cameras: those stand still", still));
  if (cubic > 0)
    context.warning(fmt::format("{} cubic spline channels are taken as straight between their keys", cubic));
  return {};
}

}  // namespace

Status place_viewpoints(const Document& document, std::span<const NodePose> poses, gltf::AccessorReader& accessors,
                        Scene& scene, Context& context) {
  std::vector<std::uint32_t> camera_nodes;
  for (const NodePose& node_pose : poses) {
    const gltf::NodeDesc& node = document.nodes[node_pose.node];
    if (node.camera < 0 && node.light < 0) continue;
    const Pose pose = pose_of(node_pose.world_from_node, scene.origin);
    if (!pose.ok) {
      context.warning(
          fmt::format("node \"{}\": its camera or light has no finite place and direction and is left out", node.name));
      continue;
    }
    if (node.light >= 0) {
      Light light = document.lights[static_cast<std::size_t>(node.light)];
      if (!node.name.empty()) light.name = node.name;
      light.position = pose.eye;
      light.direction = pose.forward;
      light.right = glm::cross(pose.forward, pose.up);
      if (node.angular_radius_rad >= 0) light.angular_radius_rad = node.angular_radius_rad;
      scene.lights.push_back(std::move(light));
    }
    if (node.camera < 0) continue;
    camera_nodes.push_back(node_pose.node);
    const gltf::CameraDesc& desc = document.cameras[static_cast<std::size_t>(node.camera)];
    Camera camera{camera_name(document, node_pose.node), pose.eye, pose.forward, pose.up, 0, 0};
    if (desc.perspective)
      camera.vertical_fov_rad = static_cast<float>(desc.vertical_fov_rad);
    else
      camera.half_height = static_cast<float>(desc.half_height);
    scene.cameras.push_back(std::move(camera));
  }
  return place_paths(document, camera_nodes, accessors, scene, context);
}

}  // namespace oriel
