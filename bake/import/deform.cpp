#include "bake/import/deform.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

using gltf::Document;
using gltf::TriangleMesh;

void add(std::vector<Vec3>& to, const std::vector<Vec3>& what, double weight) {
  for (std::size_t i = 0; i < std::min(to.size(), what.size()); ++i)
    to[i] = Vec3(DVec3(to[i]) + weight * DVec3(what[i]));
}

void morph(std::span<const double> weights, TriangleMesh& mesh) {
  for (std::size_t i = 0; i < std::min(weights.size(), mesh.targets.size()); ++i) {
    if (weights[i] == 0) continue;
    add(mesh.positions, mesh.targets[i].positions, weights[i]);
    add(mesh.normals, mesh.targets[i].normals, weights[i]);
  }
}

// Of the joints of a node's skin.
Result<std::vector<DMat4>> world_from_joints(const PosedNodes& nodes, const NodePose& pose) {
  const Document& document = nodes.document;
  const int number = document.nodes[pose.node].skin;
  std::vector<DMat4> matrices;
  for (const std::uint32_t joint : document.skins[static_cast<std::size_t>(number)].joints) {
    const std::int32_t at = nodes.pose_of[joint];
    if (at < 0)
      return invalid(fmt::format("{}: skins[{}]", document.file, number),
                     "found the joint nodes[{}] outside of the scene, expected it in that of nodes[{}]", joint,
                     pose.node);
    matrices.push_back(nodes.poses[static_cast<std::size_t>(at)].world_from_node);
  }
  return matrices;
}

// By joint, to a space whose axes are the world's and whose origin is `base`: floats hold what is near it.
Result<std::vector<DMat4>> joint_matrices(std::vector<DMat4> world_from_joint, const gltf::SkinDesc& skin,
                                          const DVec3& base, gltf::AccessorReader& accessors) {
  std::span<const float> inverse;
  if (skin.inverse_bind >= 0) {
    ORIEL_TRY(inverse, accessors.floats(skin.inverse_bind));
  }
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    DMat4 joint_from_mesh(1);
    for (std::size_t k = 0; k < 16 && !inverse.empty(); ++k)
      joint_from_mesh[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = inverse[16 * i + k];
    world_from_joint[i][3] -= DVec4(base, 0);
    world_from_joint[i] = world_from_joint[i] * joint_from_mesh;
  }
  return world_from_joint;
}

Status bend(std::span<const DMat4> joints, TriangleMesh& mesh) {
  const std::size_t count = mesh.influences.size() / std::max<std::size_t>(mesh.positions.size(), 1);
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < mesh.positions.size() && count > 0; ++i) {
    DMat4 blend(0);
    for (const gltf::Influence& part : std::span(mesh.influences).subspan(i * count, count)) {
      if (part.weight == 0) continue;
      if (part.joint >= joints.size())
        return invalid(mesh.path, "found joint {}, expected one of the skin's {}", part.joint, joints.size());
      blend += static_cast<double>(part.weight) * joints[part.joint];
    }
    mesh.positions[i] = Vec3(DVec3(blend * DVec4(DVec3(mesh.positions[i]), 1)));
    const DMat3 linear(blend);
    const DMat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                          glm::cross(linear[0], linear[1]));
    const double side = glm::dot(linear[0], cofactors[0]) < 0 ? -1 : 1;
    mirrored += side < 0 ? 1 : 0;
    // A normal of any length: only its direction is asked for.
    if (!mesh.normals.empty()) {
      const DVec3 n = side * (cofactors * DVec3(mesh.normals[i]));
      const double scale = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
      mesh.normals[i] = scale > 0 && std::isfinite(scale) ? Vec3(n / scale) : Vec3(0);
    }
    if (!mesh.tangents.empty())
      mesh.tangents[i] = Vec4(Vec3(linear * DVec3(mesh.tangents[i])), static_cast<float>(side) * mesh.tangents[i].w);
  }
  if (2 * mirrored > mesh.positions.size())
    for (UVec3& t : mesh.triangles) std::swap(t.y, t.z);
  return {};
}

}  // namespace

Result<std::optional<RestShape>> rest_shape(const PosedNodes& nodes, const NodePose& pose, const gltf::LoadedMesh& mesh,
                                            gltf::AccessorReader& accessors) {
  const Document& document = nodes.document;
  const gltf::NodeDesc& node = document.nodes[pose.node];
  const std::vector<double>& own = node.weights;
  const auto& weights = own.empty() ? document.meshes[static_cast<std::size_t>(node.mesh)].weights : own;
  const bool skinned = node.skin >= 0 && !node.instanced;
  const bool morphed = std::ranges::any_of(weights, [](double w) { return w != 0; });
  if (!skinned && !morphed) return std::optional<RestShape>();
  RestShape out{{mesh.name, {}}, pose.world_from_node};
  std::vector<DMat4> joints;
  if (skinned) {
    const gltf::SkinDesc& skin = document.skins[static_cast<std::size_t>(node.skin)];
    ORIEL_TRY(joints, world_from_joints(nodes, pose));
    const DVec3 base(joints.front()[3]);
    ORIEL_TRY(joints, joint_matrices(std::move(joints), skin, base, accessors));
    out.world_from_mesh = DMat4(1);
    out.world_from_mesh[3] = DVec4(base, 1);
  }
  for (const TriangleMesh& primitive : mesh.primitives) {
    ORIEL_TRY_VOID(accessors.budget().take(primitive.positions.size() * 64 + primitive.triangles.size() * sizeof(UVec3),
                                           primitive.path));
    TriangleMesh shape = primitive;
    morph(weights, shape);
    if (skinned && shape.influences.empty()) {  // it goes with its node
      DMat4 rigid = pose.world_from_node;
      rigid[3] -= DVec4(DVec3(out.world_from_mesh[3]), 0);
      shape.influences.assign(shape.positions.size(), {0, 1});
      ORIEL_TRY_VOID(bend(std::span(&rigid, 1), shape));
    } else if (skinned) {
      ORIEL_TRY_VOID(bend(joints, shape));
    }
    shape.targets = {};
    shape.influences = {};
    out.mesh.primitives.push_back(std::move(shape));
  }
  return std::optional<RestShape>(std::move(out));
}

}  // namespace oriel
