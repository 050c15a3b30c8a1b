#include "bake/import/movers.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <map>

#include "bake/import/node_names.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

using gltf::Document;

std::string mover_name(const Document& document, std::uint32_t node) {
  const std::string& name = document.nodes[node].name;
  return name.empty() ? fmt::format("node {}", node) : name;
}

// Why a node is a mover.
constexpr char kMoves = 1, kAsked = 2;

// By node: 0 no mover.
std::vector<char> mark(const Document& document) {
  std::vector<char> marks(document.nodes.size());
  for (const gltf::AnimationDesc& animation : document.animations)
    for (const gltf::AnimationDesc::Channel& channel : animation.channels)
      if (is_motion(document, channel) && channel.target != "scale")
        if (const auto node = static_cast<std::size_t>(channel.node); document.nodes[node].camera < 0)
          marks[node] = kMoves;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (document.nodes[i].keys.mover.value_or(false)) marks[i] |= kAsked;
  return marks;
}

MoverPose pose_of(const DMat4& world_from_node, const DVec3& origin) {
  const glm::dquat q = glm::normalize(glm::quat_cast(rotation_of(world_from_node)));
  return {Vec3(DVec3(world_from_node[3]) - origin), Vec4(q.x, q.y, q.z, q.w)};
}

Result<std::vector<MoverKey>> mover_keys(const Document& document, std::uint32_t node,
                                         std::span<const Animation> animations, const DVec3& origin, Context& context) {
  std::vector<MoverKey> keys;
  std::size_t moving = 0;
  for (const Animation& animation : animations) {
    ORIEL_TRY(const std::vector<MotionKey> motion, motion_of(document, node, animation));
    if (motion.empty() || ++moving > 1) continue;
    for (const MotionKey& m : motion)
      keys.push_back({static_cast<float>(m.time_s), pose_of(m.world_from_node, origin)});
  }
  if (moving > 1)
    context.warning("animation-left-out", fmt::format("mover \"{}\": the first of {} animations is taken",
                                                      mover_name(document, node), moving));
  return keys;
}

bool shines(const Scene& scene, const Surface& surface) {
  const SceneMaterial& material = scene.materials[surface.material];
  return !material.unlit && max_component(material.emission) > 0;
}

// What shines of movers becomes part of the scene that stands still: a lamp, which has the mover's motion if the file
// animates it. What else the mover has goes on as one then; without an animation it stands still with its lamp.
// carried: by light the mover that it hangs on, -1: none.
void part_lamps(Scene& scene, std::span<const std::int32_t> carried, Context& context) {
  std::vector<char> has_body(scene.movers.size()), has_lamp(has_body);
  for (const std::int32_t mover : carried)
    if (mover >= 0) has_lamp[static_cast<std::size_t>(mover)] = 1;
  for (const Surface& surface : scene.surfaces)
    if (surface.mover >= 0) (shines(scene, surface) ? has_lamp : has_body)[static_cast<std::size_t>(surface.mover)] = 1;
  std::vector<std::int32_t> renamed(scene.movers.size(), -1), motions(renamed);
  std::vector<SceneMover> kept;
  for (std::size_t i = 0; i < scene.movers.size(); ++i) {
    SceneMover& mover = scene.movers[i];
    if (has_lamp[i] && mover.keys.empty()) {
      context.warning(
          "mover-still",
          fmt::format("mover \"{}\" has an emissive material: its light is baked where it is, so it stands still",
                      mover.name));
      continue;
    }
    if (has_lamp[i]) {
      motions[i] = static_cast<std::int32_t>(scene.lamp_motions.size());
      scene.lamp_motions.push_back(mover);
      if (has_body[i]) scene.lamp_motions.back().name += " light";  // the body has the node's
    }
    if (!has_body[i]) continue;
    renamed[i] = static_cast<std::int32_t>(kept.size());
    kept.push_back(std::move(mover));
  }
  scene.movers = std::move(kept);
  for (Surface& surface : scene.surfaces) {
    if (surface.mover < 0) continue;
    const auto mover = static_cast<std::size_t>(surface.mover);
    if (shines(scene, surface)) surface.motion = motions[mover];
    surface.mover = surface.motion >= 0 ? -1 : renamed[mover];
  }
  for (std::size_t l = 0; l < carried.size(); ++l)
    if (carried[l] >= 0) scene.lights[l].motion = motions[static_cast<std::size_t>(carried[l])];
}

// The light of a node, by path and place, since names may repeat; none: ~0. A sun is no lamp that the player could
// move.
std::size_t light_of_node(const Scene& scene, const std::string& path, const Vec3& position,
                          std::span<const std::int32_t> carried) {
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    if (light.type != LightType::kDirectional && light.node_path == path && light.position == position &&
        carried[l] < 0)
      return l;
  }
  return ~std::size_t{0};
}

template <class T>
void append(const std::vector<T>& from, std::size_t first, std::size_t count, std::vector<T>& to) {
  if (from.empty()) return;
  const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
  to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
}

// Appends a surface with its triangles and vertices.
void copy_surface(const Scene& from, const Surface& surface, Scene& to) {
  Surface added = surface;
  added.mover = -1;
  added.first_triangle = static_cast<std::uint32_t>(to.triangles.size());
  added.first_vertex = static_cast<std::uint32_t>(to.positions.size());
  append(from.positions, surface.first_vertex, surface.vertex_count, to.positions);
  append(from.normals, surface.first_vertex, surface.vertex_count, to.normals);
  append(from.uv0, surface.first_vertex, surface.vertex_count, to.uv0);
  append(from.uv1, surface.first_vertex, surface.vertex_count, to.uv1);
  append(from.colors, surface.first_vertex, surface.vertex_count, to.colors);
  append(from.tangents, surface.first_vertex, surface.vertex_count, to.tangents);
  for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
    to.triangles.push_back(from.triangles[t] - surface.first_vertex + added.first_vertex);
    to.triangle_surface.push_back(static_cast<std::uint32_t>(to.surfaces.size()));
  }
  to.surfaces.push_back(std::move(added));
}

void find_bounds(Scene& scene) {
  scene.lower = scene.upper = scene.positions.front();
  for (const Vec3& p : scene.positions) {
    scene.lower = glm::min(scene.lower, p);
    scene.upper = glm::max(scene.upper, p);
  }
}

// Only with the bytes of the images that its surfaces use.
std::vector<Image> images_of(const Scene& scene, const std::vector<Image>& all) {
  std::vector<Image> images(all.size());
  for (const Surface& surface : scene.surfaces)
    for (const TextureSlot* slot : texture_slots(scene.materials[surface.material]))
      if (slot->image >= 0) images[static_cast<std::size_t>(slot->image)] = all[static_cast<std::size_t>(slot->image)];
  return images;
}

// Gives movers copies of the materials that they share with what stands still: later stages change those.
void part_materials(Scene& scene) {
  std::vector<char> stands(scene.materials.size());
  for (const Surface& surface : scene.surfaces)
    if (surface.mover < 0) stands[surface.material] = 1;
  std::map<std::uint32_t, std::uint32_t> copies;
  for (Surface& surface : scene.surfaces) {
    if (surface.mover < 0 || !stands[surface.material]) continue;
    const auto [copy, added] = copies.try_emplace(surface.material, static_cast<std::uint32_t>(scene.materials.size()));
    if (added) scene.materials.push_back(SceneMaterial(scene.materials[surface.material]));
    surface.material = copy->second;
  }
}

Scene object_scene(const Scene& scene, std::size_t mover) {
  Scene object;
  object.materials = scene.materials;
  for (const Surface& surface : scene.surfaces)
    if (surface.mover == static_cast<std::int32_t>(mover)) copy_surface(scene, surface, object);
  const DMat4 scene_from = pack_from_object(scene.movers[mover].rest);
  const DMat3 object_from(glm::transpose(DMat3(scene_from)));
  const auto turned = [&](const Vec3& v) { return Vec3(object_from * DVec3(v)); };
  for (Vec3& p : object.positions) p = Vec3(object_from * (DVec3(p) - DVec3(scene_from[3])));
  for (Vec3& n : object.normals) n = normalize_or(turned(n), Vec3(0, 0, 1));
  for (Vec4& t : object.tangents) t = Vec4(turned(Vec3(t)), t.w);
  object.images = images_of(object, scene.images);
  find_bounds(object);
  return object;
}

// Moves vertices of a surface as a rigid object.
void change_surface(Scene& scene, const Surface& surface, const DMat4& change) {
  const DMat3 turn(change);
  const auto turned = [&](const Vec3& v) { return normalize_or(Vec3(turn * DVec3(v)), Vec3(0, 0, 1)); };
  for (std::uint32_t v = surface.first_vertex; v < surface.first_vertex + surface.vertex_count; ++v) {
    scene.positions[v] = Vec3(change * DVec4(DVec3(scene.positions[v]), 1));
    scene.normals[v] = turned(scene.normals[v]);
    if (!scene.tangents.empty()) scene.tangents[v] = Vec4(turned(Vec3(scene.tangents[v])), scene.tangents[v].w);
  }
  scene.face_normals.clear();
}

void move_mover(Scene& scene, std::size_t mover, const MoverPose& pose) {
  const DMat4 change = pack_from_object(pose) * glm::inverse(pack_from_object(scene.movers[mover].rest));
  for (const Surface& surface : scene.surfaces)
    if (surface.mover == static_cast<std::int32_t>(mover)) change_surface(scene, surface, change);
  scene.movers[mover].rest = pose;
}

// What shines of the nodes of that name.
struct ShiningNodes {
  std::vector<const Surface*> surfaces;
  std::vector<Light*> lights;
  Vec3 lower{std::numeric_limits<float>::max()}, upper{std::numeric_limits<float>::lowest()};
  bool animated = false;
};

ShiningNodes shining_nodes(Scene& scene, const std::string& name) {
  ShiningNodes lamp;
  const auto extend = [&](const Vec3& p) {
    lamp.lower = glm::min(lamp.lower, p), lamp.upper = glm::max(lamp.upper, p);
  };
  for (const Surface& surface : scene.surfaces) {
    if (surface.name != name || surface.mover >= 0 || !shines(scene, surface)) continue;
    lamp.surfaces.push_back(&surface), lamp.animated |= surface.motion >= 0;
    for (std::uint32_t v = 0; v < surface.vertex_count; ++v) extend(scene.positions[surface.first_vertex + v]);
  }
  for (Light& light : scene.lights) {
    if (light.name != name || light.type == LightType::kDirectional) continue;
    lamp.lights.push_back(&light), lamp.animated |= light.motion >= 0;
    extend(light.position);
  }
  return lamp;
}

void move_lamp(Scene& scene, const ShiningNodes& lamp, const MoverMove& move) {
  MoverPose pose = moved({}, move, scene.origin);
  const DMat3 turn(pack_from_object(pose));
  pose.position -= Vec3(turn * DVec3(0.5f * (lamp.lower + lamp.upper)));
  const DMat4 change = pack_from_object(pose);
  for (const Surface* surface : lamp.surfaces) change_surface(scene, *surface, change);
  for (Light* light : lamp.lights) {
    light->position = Vec3(change * DVec4(DVec3(light->position), 1));
    light->direction = Vec3(turn * DVec3(light->direction)), light->right = Vec3(turn * DVec3(light->right));
  }
}

std::vector<std::string> movable_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneMover& mover : scene.movers) names.push_back(mover.name);
  for (const Surface& surface : scene.surfaces)
    if (surface.mover < 0 && shines(scene, surface)) names.push_back(surface.name);
  for (const Light& light : scene.lights)
    if (light.type != LightType::kDirectional) names.push_back(light.name);
  return names;
}

}  // namespace

MoverNodes find_movers(const PosedNodes& posed, Context& context) {
  const auto& [document, poses, none, numbers] = posed;
  const std::vector<char> marks = mark(document);
  MoverNodes movers;
  movers.of_node.assign(document.nodes.size(), -1);
  std::vector<std::int32_t> nearest(document.nodes.size(), -1);  // by node: the marked node that it goes with
  std::vector<char> shown(document.nodes.size());
  for (const NodePose& pose : poses) {  // parents come first
    const gltf::NodeDesc& node = document.nodes[pose.node];
    nearest[pose.node] = marks[pose.node] != 0 ? static_cast<std::int32_t>(pose.node)
                         : node.parent >= 0    ? nearest[static_cast<std::size_t>(node.parent)]
                                               : -1;
    const std::int32_t top = nearest[pose.node];
    if (top >= 0 && (node.mesh >= 0 || (node.light >= 0 && (marks[static_cast<std::size_t>(top)] & kMoves) != 0)))
      shown[static_cast<std::size_t>(top)] = 1;
  }
  for (const NodePose& pose : poses) {
    if (shown[pose.node]) {
      movers.of_node[pose.node] = static_cast<std::int32_t>(movers.nodes.size());
      movers.nodes.push_back(pose.node);
    } else if ((marks[pose.node] & kAsked) != 0) {
      context.warning("mover-still",
                      fmt::format("mover \"{}\" shows no mesh: it is none", mover_name(document, pose.node)));
    }
  }
  for (const NodePose& pose : poses)
    if (const std::int32_t top = nearest[pose.node]; top >= 0)
      movers.of_node[pose.node] = movers.of_node[static_cast<std::size_t>(top)];
  return movers;
}

Status place_movers(const PosedNodes& nodes, std::span<const Animation> animations, Scene& scene, Context& context) {
  const auto& [document, poses, movers, numbers] = nodes;
  scene.movers.resize(movers.nodes.size());
  std::vector<std::int32_t> carried(scene.lights.size(), -1);
  for (const NodePose& pose : poses) {
    const std::int32_t mover = movers.of_node[pose.node];
    if (mover < 0) continue;
    SceneMover& out = scene.movers[static_cast<std::size_t>(mover)];
    if (movers.nodes[static_cast<std::size_t>(mover)] == pose.node) {
      out.name = mover_name(document, pose.node);
      out.rest = pose_of(pose.world_from_node, scene.origin);
      ORIEL_TRY(out.keys, mover_keys(document, pose.node, animations, scene.origin, context));
    }
    if (document.nodes[pose.node].light < 0) continue;
    const Vec3 position(DVec3(pose.world_from_node[3]) - scene.origin);
    const std::size_t light = light_of_node(scene, gltf::path_of(document, pose.node), position, carried);
    if (!out.keys.empty() && light < carried.size())
      carried[light] = mover;
    else
      context.warning("mover-light", fmt::format("mover \"{}\" carries the light \"{}\": that stays where it is",
                                                 out.name, mover_name(document, pose.node)));
  }
  part_lamps(scene, carried, context);
  return {};
}

Status move_nodes(std::span<const MoverMove> moves, Scene& scene) {
  for (const MoverMove& move : moves) {
    const auto animated = [&](const SceneMover& m) { return m.name == move.node || m.name == move.node + " light"; };
    const ShiningNodes lamp = shining_nodes(scene, move.node);
    if (lamp.animated || std::ranges::any_of(scene.lamp_motions, animated))
      return fail(ErrorCode::kUsage, "--move", "found the lamp \"{}\", expected one that the file does not animate",
                  move.node);
    bool found = false;
    for (std::size_t m = 0; m < scene.movers.size(); ++m)
      if (scene.movers[m].name == move.node) {
        move_mover(scene, m, moved(scene.movers[m].rest, move, scene.origin));
        found = true;
      }
    if (found) continue;
    if (lamp.surfaces.empty() && lamp.lights.empty())
      return fail(ErrorCode::kUsage, "--move", "found \"{}\", expected a mover or a lamp of the scene: {}", move.node,
                  names_like(move.node, movable_names(scene)));
    move_lamp(scene, lamp, move);
  }
  if (!moves.empty()) find_bounds(scene);
  return {};
}

Result<std::vector<TakenMover>> take_movers(Scene& scene) {
  std::vector<TakenMover> taken;
  if (scene.movers.empty()) return taken;
  if (std::all_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& s) { return s.mover >= 0; }))
    return invalid("scene",
                   "found movers only, expected something that stands still: light is baked for that; mark fewer nodes "
                   "as movers");
  part_materials(scene);
  for (std::size_t i = 0; i < scene.movers.size(); ++i) taken.push_back({scene.movers[i], object_scene(scene, i)});
  Scene rest;
  for (const Surface& surface : scene.surfaces)
    if (surface.mover < 0) copy_surface(scene, surface, rest);
  scene.positions = std::move(rest.positions);
  scene.normals = std::move(rest.normals);
  scene.uv0 = std::move(rest.uv0);
  scene.uv1 = std::move(rest.uv1);
  scene.colors = std::move(rest.colors);
  scene.tangents = std::move(rest.tangents);
  scene.triangles = std::move(rest.triangles);
  scene.triangle_surface = std::move(rest.triangle_surface);
  scene.surfaces = std::move(rest.surfaces);
  scene.face_normals.clear();
  std::vector<Vec3> normals;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) normals.push_back(geometric_normal(scene, t));
  scene.face_normals = std::move(normals);
  scene.movers.clear();
  find_bounds(scene);
  return taken;
}

}  // namespace oriel
