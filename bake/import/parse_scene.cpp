// Meshes, nodes, scenes, cameras, lights and animations.
#include <algorithm>
#include <array>
#include <cmath>

#include "bake/import/document.h"
#include "bake/scene/daylight.h"

namespace oriel::gltf {
namespace {

PrimitiveDesc parse_primitive(const JsonAt& value, std::size_t materials, const Document& document) {
  PrimitiveDesc p;
  p.path = value.path();
  p.mode = static_cast<int>(value["mode"].integer(4, 6));
  p.indices = value["indices"].index(document.accessors.size());
  p.material = value["material"].index(materials);
  const JsonAt attributes = value.need("attributes");
  for (const std::string& name : attributes.keys())
    p.attributes[name] = attributes[name.c_str()].index(document.accessors.size());
  const JsonAt draco = value.extension("KHR_draco_mesh_compression");
  if (draco.present()) {
    p.draco.emplace();
    p.draco->view = draco.need("bufferView").index(document.views.size());
    const JsonAt ids = draco.need("attributes");
    for (const std::string& name : ids.keys())
      p.draco->attributes[name] = static_cast<std::uint32_t>(ids[name.c_str()].integer(0, ~0u));
    if (p.mode != 4 && p.mode != 5) value["mode"].expected("4 or 5 with KHR_draco_mesh_compression");
  }
  const JsonAt targets = value["targets"];
  for (std::size_t i = 0; i < targets.size(); ++i) {
    TargetDesc& target = p.targets.emplace_back();
    for (const std::string& name : targets.at(i).keys())
      target.attributes[name] = targets.at(i)[name.c_str()].index(document.accessors.size());
  }
  return p;
}

std::vector<double> parse_weights(const JsonAt& value) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < value.size(); ++i) weights.push_back(value.at(i).number(0, -1e6, 1e6));
  return weights;
}

SkinDesc parse_skin(const JsonAt& value, std::size_t nodes, const Document& document) {
  SkinDesc skin;
  const JsonAt joints = value.need("joints");
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (const int joint = joints.at(i).index(nodes); joint >= 0)
      skin.joints.push_back(static_cast<std::uint32_t>(joint));
  if (joints.present() && joints.size() == 0) joints.expected("at least one joint");
  skin.inverse_bind = value["inverseBindMatrices"].index(document.accessors.size());
  if (skin.inverse_bind < 0) return skin;
  const AccessorDesc& matrices = document.accessors[static_cast<std::size_t>(skin.inverse_bind)];
  if (matrices.components != 16 || matrices.type != ComponentType::kFloat || matrices.count < joints.size())
    value["inverseBindMatrices"].error(
        fmt::format("found accessor {}, expected one of {} MAT4 of floats", skin.inverse_bind, joints.size()));
  return skin;
}

// The last row of a matrix that is affine but for rounding becomes 0, 0, 0, 1. False where it is more than rounding.
bool round_to_affine(const JsonAt& value, DMat4& m) {
  constexpr double kRounding = 1e-3;  // of a column's length: a matrix printed with four digits
  const auto length = [&](int i) { return std::hypot(m[i].x, m[i].y, m[i].z); };
  if (std::abs(m[3][3] - 1) > kRounding && m[3][3] > 0) m /= m[3][3];  // homogeneous coordinates
  bool rounded = false;
  for (int i = 0; i < 4; ++i) {
    const double off = i < 3 ? std::abs(m[i][3]) : std::abs(m[3][3] - 1);
    if (!std::isfinite(length(i)) || off > kRounding * (i < 3 ? length(i) : 1.0)) return false;
    rounded = rounded || off > 0;
    m[i][3] = i == 3;
  }
  if (rounded) value.repaired("the last row of the matrix is taken as 0, 0, 0, 1: it differs by rounding");
  return true;
}

// A matrix that is no translation, rotation and scale (glTF-Validator: NODE_MATRIX_NON_TRS).
bool shears(const DMat4& m) {
  for (int i = 0; i < 3; ++i) {
    const DVec3 a(m[i]), b(m[(i + 1) % 3]);
    const double lengths = std::hypot(a.x, a.y, a.z) * std::hypot(b.x, b.y, b.z);
    if (std::abs(glm::dot(a, b)) > 1e-4 * lengths) return true;
  }
  return false;
}

void parse_transform(const JsonAt& value, NodeDesc& node) {
  const JsonAt matrix = value["matrix"];
  std::array<double, 3> t{0, 0, 0}, s{1, 1, 1};
  std::array<double, 4> r{0, 0, 0, 1};
  value["translation"].numbers(t);
  value["rotation"].numbers(r);
  value["scale"].numbers(s);
  node.translation = {t[0], t[1], t[2]};
  node.scale = {s[0], s[1], s[2]};
  const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
  if (!(length > 0) || !std::isfinite(length)) return value["rotation"].expected("a unit quaternion");
  node.rotation = DVec4(r[0], r[1], r[2], r[3]) / length;
  node.matrix = matrix_from_trs(node.translation, node.rotation, node.scale);
  if (!matrix.present()) return;
  if (value["translation"].present() || value["rotation"].present() || value["scale"].present())
    matrix.repaired(
        "the matrix is taken; the node has a translation, rotation or scale, too, which glTF does not allow");
  node.has_matrix = true;
  std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  matrix.numbers(m);
  for (std::size_t i = 0; i < 16; ++i) node.matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = m[i];
  if (!round_to_affine(matrix, node.matrix))
    return matrix.error("found a matrix that is not affine, expected a translation, rotation and scale");
  if (shears(node.matrix)) matrix.repaired("the matrix shears, which glTF does not allow; it is taken as it stands");
}

// Half of extras.oriel.angular_diameter_deg: how large a directional light appears.
float angular_radius(const JsonAt& value, double fallback) {
  constexpr const char* kKey = "angular_diameter_deg";
  const JsonAt extras = value.object("extras"), nested = extras.object("oriel")[kKey];
  const JsonAt given = nested.present() ? nested : extras[std::string("oriel_") + kKey];
  return static_cast<float>(given.number(fallback * 360 / kPiD, 0, 180) * kPiD / 360);
}

NodeDesc parse_node(const JsonAt& value, std::size_t count, const Document& document) {
  NodeDesc node;
  node.name = value["name"].name();
  node.mesh = value["mesh"].index(document.meshes.size());
  node.camera = value["camera"].index(document.cameras.size());
  if (node.camera >= 0 && !document.cameras[static_cast<std::size_t>(node.camera)].usable) node.camera = -1;
  node.skin = value["skin"].index(document.skins.size());
  node.weights = parse_weights(value["weights"]);
  node.light = value.extension("KHR_lights_punctual")["light"].index(document.lights.size());
  node.angular_radius_rad = angular_radius(value, -1);
  node.keys = parse_object_keys(value);
  parse_transform(value, node);
  node.hidden = !value.extension("KHR_node_visibility")["visible"].boolean(true);
  const JsonAt children = value["children"];
  for (std::size_t i = 0; i < children.size(); ++i)
    if (const int child = children.at(i).index(count); child >= 0)
      node.children.push_back(static_cast<std::uint32_t>(child));
  const JsonAt instancing = value.extension("EXT_mesh_gpu_instancing");
  if (instancing.present() && node.mesh >= 0) {
    const JsonAt attributes = instancing.need("attributes");
    for (const std::string& name : attributes.keys())
      if (const int accessor = attributes[name.c_str()].index(document.accessors.size()); accessor >= 0)
        node.instance_attributes[name] = accessor;
    node.instanced = !node.instance_attributes.empty();
  }
  return node;
}

CameraDesc parse_camera(const JsonAt& value, std::size_t i) {
  CameraDesc camera;
  camera.name = value["name"].name();
  if (camera.name.empty()) camera.name = fmt::format("camera {}", i);
  const std::string type = value.need("type").text();
  if (type == "perspective") {
    camera.vertical_fov_rad = value["perspective"]["yfov"].number(0);
    camera.usable = camera.vertical_fov_rad > 1e-6 && camera.vertical_fov_rad < kPiD - 1e-6;
    if (!camera.usable)
      value["perspective"]["yfov"].repaired("no angle between 0 and π rad: the camera is left out (degrees?)");
  } else if (type == "orthographic") {
    camera.perspective = false;
    camera.half_height = std::abs(value["orthographic"]["ymag"].number(0));
    camera.usable = camera.half_height > 0 && camera.half_height < 1e30;
    if (!camera.usable) value["orthographic"]["ymag"].repaired("no height other than 0: the camera is left out");
  } else {
    value["type"].expected("perspective or orthographic");
  }
  return camera;
}

Light parse_light(const JsonAt& value, std::size_t i, Document& document) {
  Light light;
  light.name = value["name"].name();
  if (light.name.empty()) light.name = fmt::format("light {}", i);
  const std::string type = value.need("type").text();
  if (type == "spot")
    light.type = LightType::kSpot;
  else if (type == "directional")
    light.type = LightType::kDirectional;
  else if (type != "point")
    value["type"].expected("point, spot or directional");
  if (light.type == LightType::kDirectional) light.angular_radius_rad = angular_radius(value, double{kSunRadius_rad});
  std::array<double, 3> color{1, 1, 1};
  value["color"].numbers(color);
  double intensity = value["intensity"].number(1);
  if (intensity < 0) {
    value["intensity"].repaired("the intensity is negative: the light is dark");
    intensity = 0;
  }
  for (int c = 0; c < 3; ++c) {
    const double product = color[static_cast<std::size_t>(c)] * intensity;
    light.color[c] = static_cast<float>(color[static_cast<std::size_t>(c)]);
    light.intensity[c] = static_cast<float>(product);
    if (!(product >= 0 && product <= 1e30))
      value.error(fmt::format("found color * intensity {}, expected 0 to 1e30", product));
    if (!(light.color[c] >= 0 && light.color[c] <= 1e30f))
      value.error(fmt::format("found color {}, expected 0 to 1e30", light.color[c]));
  }
  if (value["range"].present())
    document.warnings.push_back({fmt::format("{}: range {} is ignored: light falls off with the square of the distance",
                                             value.path(), value["range"].number(0)),
                                 "unsupported"});
  if (light.type == LightType::kSpot) {
    const JsonAt spot = value["spot"];
    const double inner = spot["innerConeAngle"].number(0), outer = spot["outerConeAngle"].number(kPiD / 4);
    light.outer_cone_rad = static_cast<float>(std::clamp(outer, 0.0, kPiD / 2));
    light.inner_cone_rad = std::clamp(static_cast<float>(inner), 0.0f, light.outer_cone_rad);
    if (inner < 0 || inner > outer || outer < 0 || outer > kPiD / 2 + 1e-6)
      spot.repaired("cone angles are taken as 0 <= innerConeAngle <= outerConeAngle <= π/2 rad");
  }
  return light;
}

AnimationDesc parse_animation(const JsonAt& value, const Document& document) {
  AnimationDesc animation;
  animation.name = value["name"].name();
  const JsonAt samplers = value["samplers"], channels = value["channels"];
  for (std::size_t i = 0; i < samplers.size(); ++i) {
    const JsonAt s = samplers.at(i);
    AnimationDesc::Sampler sampler;
    sampler.input = s.need("input").index(document.accessors.size());
    sampler.output = s.need("output").index(document.accessors.size());
    const std::string kind = s["interpolation"].text("LINEAR");
    using Interpolation = AnimationDesc::Sampler::Interpolation;
    if (kind == "STEP")
      sampler.interpolation = Interpolation::kStep;
    else if (kind == "CUBICSPLINE")
      sampler.interpolation = Interpolation::kCubicSpline;
    else if (kind != "LINEAR")
      s["interpolation"].expected("LINEAR, STEP or CUBICSPLINE");
    animation.samplers.push_back(sampler);
  }
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const JsonAt c = channels.at(i);
    AnimationDesc::Channel channel;
    channel.file_path = c.path();
    channel.sampler = c.need("sampler").index(animation.samplers.size());
    channel.node = c.need("target")["node"].index(document.nodes.size());
    channel.target = c["target"].need("path").text();
    animation.channels.push_back(channel);
  }
  return animation;
}

// Parents, double parents and cycles.
void check_tree(const JsonAt& nodes, Document& document) {
  std::vector<std::uint32_t> reached;
  for (std::size_t i = 0; i < document.nodes.size(); ++i)
    for (const std::uint32_t child : document.nodes[i].children) {
      int& parent = document.nodes[child].parent;
      if (parent >= 0)
        return nodes.at(i)["children"].error(
            fmt::format("found node {} to be a child of node {} too, expected one parent", child, parent));
      parent = static_cast<int>(i);
    }
  std::vector<char> seen(document.nodes.size());
  for (std::uint32_t i = 0; i < document.nodes.size(); ++i)
    if (document.nodes[i].parent < 0) reached.push_back(i);
  while (!reached.empty()) {
    const std::uint32_t node = reached.back();
    reached.pop_back();
    seen[node] = 1;
    reached.insert(reached.end(), document.nodes[node].children.begin(), document.nodes[node].children.end());
  }
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (!seen[i]) return nodes.at(i).error("found a node that is its own ancestor, expected a tree");
}

void parse_scenes(const JsonAt& root, Document& document) {
  const JsonAt scenes = root["scenes"];
  std::vector<std::size_t> taken(document.nodes.size(), scenes.size());  // by node: the last scene that lists it
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    SceneDesc scene;
    scene.name = scenes.at(i)["name"].name();
    const JsonAt nodes = scenes.at(i)["nodes"];
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const int node = nodes.at(k).index(document.nodes.size());
      if (node < 0) continue;
      const auto n = static_cast<std::size_t>(node);
      if (document.nodes[n].parent >= 0)
        nodes.at(k).error(
            fmt::format("found node {}, a child of node {}, expected a root node", node, document.nodes[n].parent));
      if (taken[n] == i) nodes.at(k).error(fmt::format("found node {} twice, expected it once", node));
      taken[n] = i;
      scene.nodes.push_back(static_cast<std::uint32_t>(node));
    }
    document.scenes.push_back(std::move(scene));
  }
  document.default_scene = root["scene"].index(document.scenes.size());
}

// Which morph targets and joints the meshes need, and whether something moves them.
void note_deformations(Document& document) {
  std::vector<char> is_joint(document.nodes.size());
  for (const NodeDesc& node : document.nodes) {
    if (node.mesh < 0) continue;
    MeshDesc& mesh = document.meshes[static_cast<std::size_t>(node.mesh)];
    const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
    for (PrimitiveDesc& p : mesh.primitives) {
      p.skinned |= node.skin >= 0;
      for (std::size_t i = 0; i < std::min(p.targets.size(), weights.size()); ++i) p.targets[i].used |= weights[i] != 0;
    }
    if (node.skin < 0) continue;
    for (const std::uint32_t joint : document.skins[static_cast<std::size_t>(node.skin)].joints) is_joint[joint] = 1;
  }
  const bool moves = std::ranges::any_of(document.animations, [&](const AnimationDesc& animation) {
    return std::ranges::any_of(animation.channels, [&](const AnimationDesc::Channel& channel) {
      return channel.target == "weights" || (channel.node >= 0 && is_joint[static_cast<std::size_t>(channel.node)]);
    });
  });
  if (moves)
    document.warnings.push_back(
        {"animations of skins and of morph targets are left out: meshes stand as their joints and weights do at rest",
         "animation-left-out"});
}

void set_key(const std::string& key, const JsonAt& value, ObjectKeys& keys) {
  if (key == "angular_diameter_deg") return;
  const auto text = value.scalar_text();
  if (!text) return value.repaired("found no number, text, true or false; it is ignored", "object-key");
  if (const auto set = set_object_key(key, *text, keys); !set)
    value.repaired(set.error().message + "; it is ignored", "object-key");
}

}  // namespace

ObjectKeys parse_object_keys(const JsonAt& value) {
  ObjectKeys keys;
  const JsonAt extras = value.object("extras"), own = extras.object("oriel");
  for (const std::string& key : own.keys()) set_key(key, own[key], keys);
  for (const std::string& key : extras.keys())
    if (key.starts_with("oriel_") || key.starts_with("oriel.")) set_key(key.substr(6), extras[key], keys);
  return keys;
}

void parse_meshes(const JsonAt& root, std::size_t materials, Document& document) {
  const JsonAt meshes = root["meshes"];
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    MeshDesc mesh;
    mesh.name = meshes.at(i)["name"].name();
    const JsonAt primitives = meshes.at(i).need("primitives");
    for (std::size_t k = 0; k < primitives.size(); ++k)
      mesh.primitives.push_back(parse_primitive(primitives.at(k), materials, document));
    mesh.weights = parse_weights(meshes.at(i)["weights"]);
    document.meshes.push_back(std::move(mesh));
  }
}

void parse_nodes(const JsonAt& root, Document& document) {
  const JsonAt cameras = root["cameras"], lights = root.extension("KHR_lights_punctual")["lights"],
               nodes = root["nodes"];
  for (std::size_t i = 0; i < cameras.size(); ++i) document.cameras.push_back(parse_camera(cameras.at(i), i));
  for (std::size_t i = 0; i < lights.size(); ++i) document.lights.push_back(parse_light(lights.at(i), i, document));
  const JsonAt skins = root["skins"];
  for (std::size_t i = 0; i < skins.size(); ++i)
    document.skins.push_back(parse_skin(skins.at(i), nodes.size(), document));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    document.nodes.push_back(parse_node(nodes.at(i), nodes.size(), document));
  check_tree(nodes, document);
  if (!root.document().status()) return;
  parse_scenes(root, document);
  const JsonAt animations = root["animations"];
  for (std::size_t i = 0; i < animations.size(); ++i)
    document.animations.push_back(parse_animation(animations.at(i), document));
  note_deformations(document);
}

}  // namespace oriel::gltf
