#include "bake/import/place.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <set>

#include "bake/import/deform.h"
#include "bake/import/material_variants.h"
#include "bake/import/node_names.h"
#include "bake/import/simplify.h"
#include "bake/jobs/warning_group.h"

namespace oriel {
namespace {

using gltf::Document;
using gltf::LoadedMesh;
using gltf::TriangleMesh;

constexpr double kLargestScene = 1e9, kSmallestScene = 1e-9;  // metres
constexpr double kWarnShare = 0.01;                           // of corners with a normal on the wrong side

struct Instance {
  std::uint32_t node = 0;
  const LoadedMesh* mesh = nullptr;
  DMat4 world_from_mesh{1};
};

bool finite(const DMat4& m) {
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k)
      if (!(std::abs(m[i][k]) < 1e150)) return false;  // so that products of three stay finite
  return true;
}

std::string node_path(const Document& document, std::uint32_t node) {
  return fmt::format("{}: nodes[{}]", document.file, node);
}

// EXT_mesh_gpu_instancing: one matrix an instance.
Result<std::vector<DMat4>> instance_matrices(const Document& document, std::uint32_t index,
                                             gltf::AccessorReader& accessors) {
  const gltf::NodeDesc& node = document.nodes[index];
  const std::string where = node_path(document, index) + ".extensions.EXT_mesh_gpu_instancing";
  std::map<std::string, std::span<const float>> values;
  std::optional<std::uint64_t> count;
  for (const auto& [name, accessor] : node.instance_attributes) {
    const std::uint32_t components = name == "ROTATION" ? 4 : 3;
    if (name != "TRANSLATION" && name != "ROTATION" && name != "SCALE") continue;
    const gltf::AccessorDesc& desc = accessors.desc(accessor);
    if (desc.components != components || desc.matrix)
      return invalid(where, "found {1} components in {0}, expected {2}", name, desc.components, components);
    if (count && *count != desc.count)
      return invalid(where, "found {1} elements in {0}, expected {2} as in the others", name, desc.count, *count);
    count = desc.count;
    ORIEL_TRY(values[name], accessors.floats(accessor));
  }
  if (!count) return std::vector<DMat4>{DMat4(1)};
  ORIEL_TRY_VOID(accessors.budget().take(*count * sizeof(DMat4) * 2, where));
  std::vector<DMat4> matrices;
  for (std::size_t i = 0; i < *count; ++i) {
    DVec3 t(0), s(1);
    DVec4 r(0, 0, 0, 1);
    if (const auto v = values.find("TRANSLATION"); v != values.end())
      t = {v->second[3 * i], v->second[3 * i + 1], v->second[3 * i + 2]};
    if (const auto v = values.find("SCALE"); v != values.end())
      s = {v->second[3 * i], v->second[3 * i + 1], v->second[3 * i + 2]};
    if (const auto v = values.find("ROTATION"); v != values.end()) {
      r = {v->second[4 * i], v->second[4 * i + 1], v->second[4 * i + 2], v->second[4 * i + 3]};
      if (!(glm::dot(r, r) > 0)) return invalid(where, "found zero as rotation {}, expected a unit quaternion", i);
      r /= std::sqrt(glm::dot(r, r));
    }
    matrices.push_back(gltf::matrix_from_trs(t, r, s));
  }
  return matrices;
}

// `shapes` keeps the meshes that stand in a shape of their own.
Result<std::vector<Instance>> find_instances(const PosedNodes& nodes, std::span<const LoadedMesh> meshes,
                                             gltf::AccessorReader& accessors, std::deque<RestShape>& shapes) {
  const Document& document = nodes.document;
  std::vector<Instance> instances;
  for (const NodePose& pose : nodes.poses) {
    const gltf::NodeDesc& node = document.nodes[pose.node];
    if (node.mesh < 0 || meshes[static_cast<std::size_t>(node.mesh)].primitives.empty()) continue;
    Instance plain{pose.node, &meshes[static_cast<std::size_t>(node.mesh)], pose.world_from_node};
    ORIEL_TRY(std::optional<RestShape> shape, rest_shape(nodes, pose, *plain.mesh, accessors));
    if (shape) {
      plain.mesh = &shapes.emplace_back(std::move(*shape)).mesh;
      plain.world_from_mesh = shapes.back().world_from_mesh;
    }
    if (!node.instanced) {
      instances.push_back(plain);
      continue;
    }
    ORIEL_TRY(const std::vector<DMat4> matrices, instance_matrices(document, pose.node, accessors));
    for (const DMat4& node_from_instance : matrices) {
      instances.push_back({pose.node, plain.mesh, plain.world_from_mesh * node_from_instance});
      if (!finite(instances.back().world_from_mesh))
        return invalid(node_path(document, pose.node),
                       "found an instance's transform that overflows, expected a finite one");
    }
  }
  return instances;
}

// Appends the surfaces of instances to a scene whose origin is known.
class Placer {
 public:
  Placer(Scene& scene, Context& context, bool with_colors, bool with_tangents)
      : scene_(scene),
        with_colors_(with_colors),
        with_tangents_(with_tangents),
        normals_wrong_(context, "surfaces with normals on the back of their triangles", "normals-behind"),
        collapsed_(context, "surfaces with triangles too small or thin for where they stand", "too-small"),
        texcoords_missing_(context, "surfaces without TEXCOORDs that their material wants", "missing-texcoords") {}

  void place(const TriangleMesh& mesh, const DMat4& world_from_mesh, Surface surface) {
    surface.first_triangle = static_cast<std::uint32_t>(scene_.triangles.size());
    surface.first_vertex = static_cast<std::uint32_t>(scene_.positions.size());
    surface.has_uv1 = !mesh.uv1.empty();
    transform(mesh, world_from_mesh);
    shared_.assign(mesh.positions.size(), kNone);
    std::size_t turned = 0, collapsed = 0;
    for (const UVec3& t : mesh.triangles) {
      const UVec3 corners = flipped_ ? UVec3(t.x, t.z, t.y) : t;
      const Vec3 &a = positions_[corners.x], &b = positions_[corners.y], &c = positions_[corners.z];
      if (gltf::degenerate(a, b, c)) {
        ++collapsed;
        continue;
      }
      const DVec3 cross = glm::cross(DVec3(b) - DVec3(a), DVec3(c) - DVec3(a));
      const Vec3 front(cross / std::sqrt(glm::dot(cross, cross)));
      UVec3 out;
      for (int k = 0; k < 3; ++k) out[k] = vertex(mesh, corners[k], front, turned);
      scene_.triangles.push_back(out);
      scene_.triangle_surface.push_back(static_cast<std::uint32_t>(scene_.surfaces.size()));
    }
    surface.triangle_count = static_cast<std::uint32_t>(scene_.triangles.size()) - surface.first_triangle;
    surface.vertex_count = static_cast<std::uint32_t>(scene_.positions.size()) - surface.first_vertex;
    warn(mesh, surface, turned, collapsed);
    if (surface.triangle_count > 0) scene_.surfaces.push_back(std::move(surface));
  }

  void finish() {
    normals_wrong_.finish();
    collapsed_.finish();
    texcoords_missing_.finish();
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  void transform(const TriangleMesh& mesh, const DMat4& world_from_mesh) {
    const DMat3 linear(world_from_mesh);
    const DVec3 offset = DVec3(world_from_mesh[3]) - scene_.origin;
    // det(M) times the inverse transpose: exists for singular M too, and its sign cancels below.
    const DMat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                          glm::cross(linear[0], linear[1]));
    flipped_ = glm::dot(linear[0], cofactors[0]) < 0;
    positions_.resize(mesh.positions.size());
    for (std::size_t i = 0; i < positions_.size(); ++i)
      positions_[i] = Vec3(linear * DVec3(mesh.positions[i]) + offset);
    normals_.resize(mesh.normals.size());
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const DVec3 n = cofactors * DVec3(mesh.normals[i]);
      const double scale = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
      normals_[i] =
          scale > 0 && std::isfinite(scale) ? Vec3(glm::normalize(n / scale) * (flipped_ ? -1.0 : 1.0)) : Vec3(0);
    }
    tangents_.resize(mesh.tangents.size());
    for (std::size_t i = 0; i < tangents_.size(); ++i) {
      const Vec3 t = normalize_or(Vec3(linear * DVec3(mesh.tangents[i])), Vec3(0));
      // A mirrored cross product points the other way.
      const float side = (mesh.tangents[i].w < 0) == flipped_ ? 1.0f : -1.0f;
      tangents_[i] = Vec4(t, t == Vec3(0) ? 0 : side);
    }
  }

  // The scene's vertex for a corner: shared between triangles where the stored normal serves, else with the triangle's
  // own.
  std::uint32_t vertex(const TriangleMesh& mesh, std::uint32_t corner, const Vec3& front, std::size_t& turned) {
    const bool serves = !normals_.empty() && glm::dot(normals_[corner], front) > 0;
    if (serves && shared_[corner] != kNone) return shared_[corner];
    if (!serves && !normals_.empty()) ++turned;
    const auto added = static_cast<std::uint32_t>(scene_.positions.size());
    scene_.positions.push_back(positions_[corner]);
    scene_.normals.push_back(serves ? normals_[corner] : front);
    scene_.uv0.push_back(mesh.uv0.empty() ? Vec2(0) : mesh.uv0[corner]);
    scene_.uv1.push_back(mesh.uv1.empty() ? Vec2(0) : mesh.uv1[corner]);
    if (with_tangents_) scene_.tangents.push_back(serves && !tangents_.empty() ? tangents_[corner] : Vec4(0));
    if (with_colors_) scene_.colors.push_back(mesh.colors.empty() ? ~0u : mesh.colors[corner]);
    if (serves) shared_[corner] = added;
    return added;
  }

  void warn(const TriangleMesh& mesh, const Surface& surface, std::size_t turned, std::size_t collapsed) {
    const std::size_t corners = std::size_t{surface.triangle_count} * 3;
    if (static_cast<double>(turned) > kWarnShare * static_cast<double>(corners) &&
        warned_.insert("n" + mesh.path).second)
      normals_wrong_.add(
          fmt::format("surface \"{}\": {:.1f} % of the corners have a normal that is zero or on the back of its "
                      "triangle; the triangle's own is used",
                      surface.name, 100.0 * static_cast<double>(turned) / static_cast<double>(corners)));
    if (collapsed > 0 && warned_.insert("c" + mesh.path).second)
      collapsed_.add(
          fmt::format("surface \"{}\": {} triangles are too small or thin for where they stand and were dropped",
                      surface.name, collapsed));
    const SceneMaterial& material = scene_.materials[surface.material];
    for (const TextureSlot* slot : texture_slots(material))
      if (slot->image >= 0 && (slot->texcoord == 0 ? mesh.uv0 : mesh.uv1).empty() &&
          warned_.insert("t" + mesh.path).second)
        texcoords_missing_.add(
            fmt::format("surface \"{}\" has no TEXCOORD_{}, which a texture of \"{}\" wants; 0, 0 is used",
                        surface.name, slot->texcoord, material.name));
  }

  Scene& scene_;
  bool with_colors_, with_tangents_, flipped_ = false;
  std::vector<Vec3> positions_, normals_;  // of the mesh at hand, scene space
  std::vector<Vec4> tangents_;
  std::vector<std::uint32_t> shared_;
  WarningGroup normals_wrong_, collapsed_, texcoords_missing_;
  std::set<std::string> warned_;
};

// The centre of the world bounds; also refuses what would overflow.
Result<DVec3> find_origin(const Document& document, std::span<const Instance> instances) {
  DVec3 lower(std::numeric_limits<double>::max()), upper(-lower);
  for (const Instance& instance : instances)
    for (const TriangleMesh& mesh : instance.mesh->primitives)
      for (const Vec3& p : mesh.positions) {
        const DVec3 world(instance.world_from_mesh * DVec4(DVec3(p), 1));
        lower = glm::min(lower, world);
        upper = glm::max(upper, world);
      }
  const DVec3 size = upper - lower;
  const double largest = std::max({size.x, size.y, size.z});
  if (!(largest <= kLargestScene))
    return invalid(document.file, "found a scene of {} m, expected at most {} m", largest, kLargestScene);
  if (largest < kSmallestScene)
    return invalid(document.file, "found a scene of {} m, expected at least {} m", largest, kSmallestScene);
  return lower + 0.5 * size;
}

Status reserve(const Document& document, std::span<const Instance> instances, gltf::MemoryBudget& budget,
               Scene& scene) {
  std::uint64_t triangles = 0, vertices = 0, vertex_bytes = 44;
  for (const Instance& instance : instances)
    for (const TriangleMesh& mesh : instance.mesh->primitives) {
      triangles += mesh.triangles.size();
      vertices += mesh.normals.empty() ? 3 * mesh.triangles.size() : mesh.positions.size();
      if (!mesh.tangents.empty()) vertex_bytes = 44 + sizeof(Vec4);
    }
  if (triangles == 0)
    return invalid(document.file, "found no mesh with a triangle in the scene, expected at least one");
  if (triangles > (1u << 30))
    return invalid(document.file, "found {} triangles with all instances, expected at most {}", triangles, 1u << 30);
  ORIEL_TRY_VOID(budget.take(
      triangles * (sizeof(UVec3) + sizeof(Vec3) + sizeof(std::uint32_t)) + vertices * vertex_bytes, document.file));
  scene.triangles.reserve(triangles);
  scene.triangle_surface.reserve(triangles);
  scene.positions.reserve(vertices);
  scene.normals.reserve(vertices);
  scene.uv0.reserve(vertices);
  scene.uv1.reserve(vertices);
  return {};
}

std::uint64_t triangles_of(const LoadedMesh& mesh) {
  std::uint64_t count = 0;
  for (const TriangleMesh& part : mesh.primitives) count += part.triangles.size();
  return count;
}

// Simplifies meshes that stand in several places, into `simple`, so that all of them have at most so many triangles.
Status limit_triangles(const Document& document, std::uint64_t most, Context& context, std::vector<Instance>& instances,
                       std::deque<LoadedMesh>& simple) {
  std::map<const LoadedMesh*, std::pair<std::uint64_t, const LoadedMesh*>> meshes;  // how often, and what instead
  for (const Instance& instance : instances) ++meshes[instance.mesh].first;
  std::uint64_t all = 0, repeated = 0, left = 0;
  for (const auto& [mesh, use] : meshes)
    all += use.first * triangles_of(*mesh), repeated += use.first > 1 ? use.first * triangles_of(*mesh) : 0;
  if (all <= most) return {};
  const double share = (1.0 * most - std::min(1.0 * most, 1.0 * (all - repeated))) / std::max(1.0 * repeated, 1.0);
  for (auto& [mesh, use] : meshes) {
    use.second = use.first > 1 ? &simple.emplace_back(simplified(*mesh, share)) : mesh;
    left += use.first * triangles_of(*use.second);
  }
  if (left > 3 * most)  // not only a little late
    return invalid(
        document.file,
        "found {} triangles with all instances; reading them alone takes longer than --time, which is enough "
        "for {}: give more time, or fewer triangles",
        all, most);
  for (Instance& instance : instances) instance.mesh = meshes[instance.mesh].second;
  if (left < all)
    context.warning("time-over",
                    fmt::format("{} triangles with all instances take too long for --time: meshes that stand in "
                                "several places are shown coarser, {} triangles in all; more time keeps them",
                                all, left));
  return {};
}

std::uint32_t material_of(const TriangleMesh& mesh, std::optional<std::uint32_t>& default_material, Scene& scene) {
  if (mesh.material >= 0) return static_cast<std::uint32_t>(mesh.material);
  if (!default_material) {
    default_material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.emplace_back().name = "default";
  }
  return *default_material;
}

}  // namespace

Result<PosedNodes> pose_nodes(const Document& document, std::span<const std::uint32_t> roots) {
  PosedNodes nodes{document, {}};
  nodes.pose_of.assign(document.nodes.size(), -1);
  std::vector<NodePose> waiting;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) waiting.push_back({*root, DMat4(1)});
  while (!waiting.empty()) {
    NodePose pose = waiting.back();  // holds the parent's matrix so far
    waiting.pop_back();
    const gltf::NodeDesc& node = document.nodes[pose.node];
    if (node.hidden) continue;
    pose.world_from_node = pose.world_from_node * node.matrix;
    if (!finite(pose.world_from_node))
      return invalid(node_path(document, pose.node), "found a world transform that overflows, expected a finite one");
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      waiting.push_back({*child, pose.world_from_node});
    if (node.keys.exclude.value_or(false)) continue;  // what is below it may say otherwise
    nodes.pose_of[pose.node] = static_cast<std::int32_t>(nodes.poses.size());
    nodes.poses.push_back(pose);
  }
  return nodes;
}

Status place_meshes(const PosedNodes& nodes, std::span<const LoadedMesh> meshes, gltf::AccessorReader& accessors,
                    std::uint64_t most_triangles, PlacedScene placed) {
  auto& [scene, context] = placed;
  const Document& document = nodes.document;
  std::deque<RestShape> shapes;
  ORIEL_TRY(std::vector<Instance> instances, find_instances(nodes, meshes, accessors, shapes));
  std::deque<LoadedMesh> simple;
  if (most_triangles > 0) ORIEL_TRY_VOID(limit_triangles(document, most_triangles, context, instances, simple));
  ORIEL_TRY_VOID(reserve(document, instances, accessors.budget(), scene));
  ORIEL_TRY(scene.origin, find_origin(document, instances));
  bool with_colors = false, with_tangents = false;
  for (const Instance& instance : instances)
    for (const TriangleMesh& mesh : instance.mesh->primitives)
      with_colors |= !mesh.colors.empty(), with_tangents |= !mesh.tangents.empty();
  Placer placer(scene, context, with_colors, with_tangents);
  std::optional<std::uint32_t> default_material;
  MaterialVariants variants(scene);
  for (const Instance& instance : instances) {
    if (context.stopped()) return fail(ErrorCode::kStopped, document.file, "stopped");
    const gltf::NodeDesc& node = document.nodes[instance.node];
    const LoadedMesh& mesh = *instance.mesh;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      Surface surface;
      surface.name = !node.name.empty() ? node.name : fmt::format("{}/{}", mesh.name, i);
      surface.mesh_name = mesh.name;
      surface.node_path = gltf::path_of(document, instance.node);
      surface.group_mark = node.keys.light_group.value_or("");
      surface.texel_m = node.keys.texel_m.value_or(0);
      surface.mover = nodes.movers.of_node[instance.node];
      surface.material = variants.of(material_of(mesh.primitives[i], default_material, scene), node.keys);
      placer.place(mesh.primitives[i], instance.world_from_mesh, std::move(surface));
    }
  }
  placer.finish();
  if (scene.triangles.empty())
    return invalid(document.file,
                   "found only triangles too small or thin for the scene's size, expected at least one that is not");
  scene.lower = scene.upper = scene.positions.front();
  for (const Vec3& p : scene.positions) {
    scene.lower = glm::min(scene.lower, p);
    scene.upper = glm::max(scene.upper, p);
  }
  return {};
}

}  // namespace oriel
