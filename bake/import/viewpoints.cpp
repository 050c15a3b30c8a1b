#include "bake/import/viewpoints.h"

#include "bake/import/node_names.h"

namespace oriel {
namespace {

using gltf::Document;

// Where something stands and looks; ok is false where that cannot be said.
struct Pose {
  Vec3 eye{0}, forward{0, 0, -1}, up{0, 1, 0};
  bool ok = false;
};

Pose camera_pose(const DMat4& world_from_node, const DVec3& origin) {
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

std::string camera_name(const Document& document, std::uint32_t node) {
  const gltf::NodeDesc& desc = document.nodes[node];
  return desc.name.empty() ? document.cameras[static_cast<std::size_t>(desc.camera)].name : desc.name;
}

// The walk of one camera; empty where it does not move or a pose cannot be told.
Result<std::vector<CameraKey>> camera_keys(const Document& document, std::uint32_t node, const Animation& animation,
                                           const DVec3& origin, bool& lost) {
  std::vector<CameraKey> keys;
  ORIEL_TRY(const std::vector<MotionKey> motion, motion_of(document, node, animation));
  for (const MotionKey& m : motion) {
    const Pose pose = camera_pose(m.world_from_node, origin);
    lost |= !pose.ok;
    const CameraKey key{static_cast<float>(m.time_s), pose.eye, pose.forward};
    if (!keys.empty() && keys.back().time_s == key.time_s && keys.back().eye == key.eye &&
        keys.back().forward == key.forward)
      continue;
    keys.push_back(key);
  }
  return keys;
}

Status place_paths(const Document& document, const std::vector<std::uint32_t>& camera_nodes,
                   std::span<const Animation> animations, Scene& scene, Context& context) {
  for (const Animation& animation : animations) {
    for (const std::uint32_t node : camera_nodes) {
      const gltf::CameraDesc& camera = document.cameras[static_cast<std::size_t>(document.nodes[node].camera)];
      CameraPath path;
      path.name = camera_name(document, node);
      path.vertical_fov_rad = static_cast<float>(camera.perspective ? camera.vertical_fov_rad : 1.0);
      bool lost = false;
      ORIEL_TRY(path.keys, camera_keys(document, node, animation, scene.origin, lost));
      if (lost)
        context.warning(
            "bad-viewpoint",
            fmt::format("the animation of camera \"{}\" has no direction somewhere and is left out", path.name));
      else if (!path.keys.empty())
        scene.paths.push_back(std::move(path));
    }
  }
  return {};
}

}  // namespace

Status place_viewpoints(const PosedNodes& nodes, std::span<const Animation> animations, Scene& scene,
                        Context& context) {
  const Document& document = nodes.document;
  std::vector<std::uint32_t> camera_nodes;
  for (const NodePose& node_pose : nodes.poses) {
    const gltf::NodeDesc& node = document.nodes[node_pose.node];
    if (node.camera < 0 && node.light < 0) continue;
    const Pose pose = camera_pose(node_pose.world_from_node, scene.origin);
    if (!pose.ok) {
      context.warning(
          "bad-viewpoint",
          fmt::format("node \"{}\": its camera or light has no finite place and direction and is left out", node.name));
      continue;
    }
    if (node.light >= 0) {
      Light light = document.lights[static_cast<std::size_t>(node.light)];
      if (!node.name.empty()) light.name = node.name;
      light.node_path = gltf::path_of(document, node_pose.node);
      light.group_mark = document.nodes[node_pose.node].keys.light_group.value_or("");
      light.position = pose.eye;
      light.direction = pose.forward;
      light.right = glm::cross(pose.forward, pose.up);
      light.mirrored = glm::determinant(DMat3(node_pose.world_from_node)) < 0;
      if (light.mirrored) light.right = -light.right;
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
  return place_paths(document, camera_nodes, animations, scene, context);
}

}  // namespace oriel
