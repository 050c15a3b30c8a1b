#include "bake/import/meshes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "bake/import/draco.h"
#include "bake/jobs/warning_group.h"
#include "formats/core/numbering.h"

namespace oriel::gltf {
namespace {

struct DropCounts {
  std::size_t degenerate = 0, duplicate = 0, incomplete = 0;
};

// An attribute of a primitive, from an accessor or from Draco. Empty where the primitive has none.
struct Attribute {
  std::span<const float> values;
  std::uint32_t components = 0;
};

// What glTF 2.0 §3.7.2.1 allows, widened by KHR_mesh_quantization.
Status check_type(const AccessorDesc& a, const std::string& name, bool quantized, const std::string& where) {
  const bool joints = name.starts_with("JOINTS"), weights = name.starts_with("WEIGHTS");
  const std::uint32_t least = name.starts_with("TEXCOORD") ? 2 : name == "TANGENT" || joints || weights ? 4 : 3;
  const std::uint32_t most = name == "COLOR_0" ? 4 : least;
  if (a.matrix || a.components < least || a.components > most)
    return invalid(where, "found {} components, expected {}", a.components,
                   most == least ? fmt::format("{}", least) : fmt::format("{} or {}", least, most));
  const bool is_float = a.type == ComponentType::kFloat;
  const bool unit = a.normalized && (a.type == ComponentType::kUnsignedByte || a.type == ComponentType::kUnsignedShort);
  const bool index =
      !a.normalized && (a.type == ComponentType::kUnsignedByte || a.type == ComponentType::kUnsignedShort);
  if (joints)
    return index ? Status{}
                 : invalid(where, "found component type {}, expected 5121 or 5123", static_cast<int>(a.type));
  if (is_float || ((least == 2 || weights || name == "COLOR_0") && unit)) return {};
  if (quantized && !weights && name != "COLOR_0" && a.type != ComponentType::kUnsignedInt) return {};
  return invalid(where, "found component type {}{}, expected 5126 (float){}", static_cast<int>(a.type),
                 a.normalized ? " normalized" : "", quantized ? "" : ": other types need KHR_mesh_quantization");
}

// Triples of positions in an order that does not depend on the corner they start with.
struct TriangleKey {
  std::array<std::uint32_t, 9> bits;
  bool operator==(const TriangleKey&) const = default;
};
struct TriangleKeyHash {
  std::size_t operator()(const TriangleKey& key) const {
    std::uint64_t h = 0x9E3779B97F4A7C15ull;
    for (const std::uint32_t b : key.bits) h = (h ^ b) * 0xFF51AFD7ED558CCDull, h ^= h >> 29;
    return h;
  }
};
TriangleKey key_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  std::array<std::array<std::uint32_t, 3>, 3> corners;
  const Vec3 points[3] = {a, b, c};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      corners[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
          std::bit_cast<std::uint32_t>(points[i][k] + 0.0f);  // -0 as 0
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  TriangleKey key;
  for (std::size_t i = 0; i < 9; ++i) key.bits[i] = corners[i / 3][i % 3];
  return key;
}

// Reads one primitive.
class PrimitiveLoader {
 public:
  PrimitiveLoader(const Document& document, const BufferStore& buffers, AccessorReader& accessors,
                  const PrimitiveDesc& desc, WarningGroup& mended)
      : document_(document),
        buffers_(buffers),
        accessors_(accessors),
        budget_(accessors.budget()),
        mended_(mended),
        desc_(desc),
        where_(document.file + ": " + desc.path) {}

  Result<TriangleMesh> load(DropCounts& drops) {
    TriangleMesh mesh;
    mesh.path = desc_.path;
    mesh.material = desc_.material;
    if (desc_.draco) ORIEL_TRY_VOID(decompress());
    ORIEL_TRY(const Attribute position, attribute("POSITION"));
    count_ = position.components == 0 ? 0 : position.values.size() / position.components;
    ORIEL_TRY(const std::vector<std::uint32_t> indices, read_indices());
    ORIEL_TRY_VOID(budget_.take(indices.size() * 3 * sizeof(UVec3), where_));
    std::vector<UVec3> triangles = list_of(indices, drops);
    const bool morphed = std::ranges::any_of(desc_.targets, &TargetDesc::used);
    if (!morphed) drop_bad(position.values, triangles, drops);  // else what they are is known later
    const std::vector<std::uint32_t> used = compact(triangles);
    mesh.triangles = std::move(triangles);
    ORIEL_TRY_VOID(budget_.take(used.size() * 48, where_));
    gather(position, used, mesh.positions);
    ORIEL_TRY(const Attribute normal, attribute("NORMAL"));
    gather(normal, used, mesh.normals);
    if (wants_tangents() && normal.components > 0) {  // tangents without normals are to be ignored
      ORIEL_TRY_VOID(budget_.take(used.size() * sizeof(Vec4), where_));
      ORIEL_TRY(const Attribute tangent, attribute("TANGENT"));
      gather(tangent, used, mesh.tangents);
    }
    ORIEL_TRY(const Attribute uv0, attribute("TEXCOORD_0"));
    gather(uv0, used, mesh.uv0);
    ORIEL_TRY(const Attribute uv1, attribute("TEXCOORD_1"));
    gather(uv1, used, mesh.uv1);
    ORIEL_TRY(const Attribute color, attribute("COLOR_0"));
    gather_colors(color, used, mesh.colors);
    ORIEL_TRY_VOID(load_targets(used, mesh));
    if (desc_.skinned) ORIEL_TRY_VOID(load_influences(used, mesh));
    return mesh;
  }

 private:
  bool wants_tangents() const {
    if (desc_.material < 0) return false;
    const SceneMaterial& material = document_.materials[static_cast<std::size_t>(desc_.material)];
    return material.normal_texture.image >= 0 || material.anisotropy > 0;
  }
  Status decompress() {
    std::map<std::string, DracoRequest> requests;
    for (const auto& [name, id] : desc_.draco->attributes) {
      if (!is_read(name)) continue;
      const auto accessor = desc_.attributes.find(name);
      if (accessor == desc_.attributes.end())
        return invalid(where_, "Draco holds {}, expected an accessor for it", name);
      const AccessorDesc& a = accessors_.desc(accessor->second);
      requests[name] = {id, a.components, a.normalized};
    }
    ORIEL_TRY(draco_, decode_draco(buffers_.view(desc_.draco->view), requests, where_));
    return {};
  }

  bool is_read(const std::string& name) const {
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) return desc_.skinned;
    constexpr std::array kNames = {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"};
    return std::ranges::find(kNames, name) != kNames.end();
  }

  // Of each target that a node gives a weight.
  Status load_targets(const std::vector<std::uint32_t>& used, TriangleMesh& mesh) {
    mesh.targets.resize(desc_.targets.size());
    for (std::size_t i = 0; i < desc_.targets.size(); ++i) {
      if (!desc_.targets[i].used) continue;
      ORIEL_TRY_VOID(budget_.take(used.size() * 2 * sizeof(Vec3), where_));
      const std::string where = fmt::format("{}.targets[{}]", where_, i);
      ORIEL_TRY(const Attribute position, plain(desc_.targets[i].attributes, "POSITION", where));
      gather(position, used, mesh.targets[i].positions);
      ORIEL_TRY(const Attribute normal, plain(desc_.targets[i].attributes, "NORMAL", where));
      gather(normal, used, mesh.targets[i].normals);
    }
    return {};
  }

  // All sets of four, with a sum of 1.
  Status load_influences(const std::vector<std::uint32_t>& used, TriangleMesh& mesh) {
    std::vector<Attribute> joints, weights;
    for (int set = 0; desc_.attributes.contains(fmt::format("JOINTS_{}", set)); ++set) {
      ORIEL_TRY(joints.emplace_back(), attribute(fmt::format("JOINTS_{}", set)));
      ORIEL_TRY(weights.emplace_back(), attribute(fmt::format("WEIGHTS_{}", set)));
      if (weights.back().components == 0)
        return invalid(where_, "found JOINTS_{0} without WEIGHTS_{0}, expected both", set);
    }
    ORIEL_TRY_VOID(budget_.take(used.size() * joints.size() * 4 * sizeof(Influence), where_));
    for (const std::uint32_t vertex : used) {
      float sum = 0;
      const std::size_t first = mesh.influences.size();
      for (std::size_t set = 0; set < joints.size(); ++set)
        for (std::size_t k = 4 * std::size_t{vertex}; k < 4 * std::size_t{vertex} + 4; ++k) {
          const float weight = std::fmax(weights[set].values[k], 0.0f);
          const float joint = std::fmin(std::fmax(joints[set].values[k], 0.0f), 65535.0f);  // Draco's are anything
          mesh.influences.push_back({static_cast<std::uint32_t>(joint), weight});
          sum += weight;
        }
      for (std::size_t k = first; k < mesh.influences.size(); ++k)
        mesh.influences[k].weight = sum > 0 ? mesh.influences[k].weight / sum : k == first ? 1.0f : 0.0f;
    }
    return {};
  }

  // What an accessor holds, in the order of the file.
  Result<Attribute> plain(const std::map<std::string, int>& attributes, const std::string& name,
                          const std::string& owner) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return Attribute{};
    const std::string where = owner + "." + name;
    const AccessorDesc& a = accessors_.desc(found->second);
    ORIEL_TRY_VOID(check_type(a, name, document_.quantized, where));
    if (count_ && a.count != *count_)
      return invalid(where, "found {} elements, expected {} as POSITION has", a.count, *count_);
    // Without its normal or tangent a vertex has that of its triangle; one texture coordinate moves one texture.
    const bool mends = name == "NORMAL" || name == "TANGENT" || name.starts_with("TEXCOORD");
    ORIEL_TRY(const std::span<const float> values,
              mends ? accessors_.finite_or_zero(found->second) : accessors_.floats(found->second));
    if (const auto& bad = accessors_.not_finite(found->second); bad.count > 0)
      mended_.add(fmt::format("{}: {} numbers are NaN or infinite, the first in element {}: taken as {}", where,
                              bad.count, bad.first,
                              name.starts_with("TEXCOORD") ? "0" : "none: the triangle's own serves"));
    return Attribute{values, a.components};
  }

  Result<Attribute> attribute(const std::string& name) {
    const auto draco = draco_.attributes.find(name);
    if (draco == draco_.attributes.end()) return plain(desc_.attributes, name, where_ + ".attributes");
    const std::string where = where_ + ".attributes." + name;
    const AccessorDesc& a = accessors_.desc(desc_.attributes.at(name));
    ORIEL_TRY_VOID(check_type(a, name, document_.quantized, where));
    if (a.count != draco_.vertex_count)
      return invalid(where, "found {} elements, expected Draco's {} vertices", a.count, draco_.vertex_count);
    return Attribute{draco->second, a.components};
  }

  Result<std::vector<std::uint32_t>> read_indices() {
    if (desc_.draco) return draco_.indices;
    std::vector<std::uint32_t> indices;
    if (desc_.indices < 0) {
      if (*count_ > ~0u) return invalid(where_, "found {} vertices, expected at most {}", *count_, ~0u);
      indices.resize(*count_);
      for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
      return indices;
    }
    ORIEL_TRY(indices, accessors_.indices(desc_.indices));
    const ComponentType type = accessors_.desc(desc_.indices).type;
    const std::uint32_t restart = type == ComponentType::kUnsignedByte    ? 0xFF
                                  : type == ComponentType::kUnsignedShort ? 0xFFFF
                                                                          : ~0u;
    if (const auto at = std::find(indices.begin(), indices.end(), restart); at != indices.end())
      return invalid(
          where_ + ".indices",
          "found {1} as index {0}, the primitive restart value, expected one below {2} (the count of POSITION)",
          at - indices.begin(), restart, *count_);
    const auto bad = std::find_if(indices.begin(), indices.end(), [this](std::uint32_t i) { return i >= *count_; });
    if (bad != indices.end())
      return invalid(where_ + ".indices", "found {1} as index {0}, expected one below {2} (the count of POSITION)",
                     bad - indices.begin(), *bad, *count_);
    return indices;
  }

  // Strips and fans as glTF 2.0 §3.7.2.1 winds them.
  std::vector<UVec3> list_of(const std::vector<std::uint32_t>& v, DropCounts& drops) const {
    std::vector<UVec3> triangles;
    const int mode = desc_.draco ? 4 : desc_.mode;  // Draco stores lists
    if (mode == 4) {
      for (std::size_t i = 0; i + 2 < v.size(); i += 3) triangles.emplace_back(v[i], v[i + 1], v[i + 2]);
      if (v.size() % 3 != 0) ++drops.incomplete;
    } else {
      for (std::size_t i = 0; i + 2 < v.size(); ++i)
        triangles.push_back(mode == 5 ? UVec3(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2])
                                      : UVec3(v[i + 1], v[i + 2], v[0]));
      if (!v.empty() && v.size() < 3) ++drops.incomplete;
    }
    return triangles;
  }

  static void drop_bad(std::span<const float> positions, std::vector<UVec3>& triangles, DropCounts& drops) {
    const auto point = [&](std::uint32_t i) {
      return Vec3(positions[3 * std::size_t{i}], positions[3 * std::size_t{i} + 1], positions[3 * std::size_t{i} + 2]);
    };
    Numbering<TriangleKey, TriangleKeyHash> numbers(triangles.size());
    std::erase_if(triangles, [&](const UVec3& t) {
      const Vec3 a = point(t.x), b = point(t.y), c = point(t.z);
      if (degenerate(a, b, c)) return ++drops.degenerate, true;
      const std::size_t known = numbers.size();
      if (numbers(key_of(a, b, c)) < known) return ++drops.duplicate, true;
      return false;
    });
  }

  // Renumbers the triangles' vertices from 0 in increasing order; returns their old numbers.
  static std::vector<std::uint32_t> compact(std::vector<UVec3>& triangles) {
    constexpr std::uint32_t kUnused = ~0u;
    std::uint32_t low = ~0u, high = 0;
    for (const UVec3& t : triangles) low = std::min({low, t.x, t.y, t.z}), high = std::max({high, t.x, t.y, t.z});
    std::vector<std::uint32_t> used, number(triangles.empty() ? 0 : std::size_t{high} - low + 1, kUnused);
    for (const UVec3& t : triangles)
      for (int k = 0; k < 3; ++k) number[t[k] - low] = 0;
    for (std::uint32_t i = 0; i < number.size(); ++i)
      if (number[i] != kUnused) number[i] = static_cast<std::uint32_t>(used.size()), used.push_back(low + i);
    for (UVec3& t : triangles) t = UVec3(number[t.x - low], number[t.y - low], number[t.z - low]);
    return used;
  }

  template <class V>
  static void gather(const Attribute& attribute, const std::vector<std::uint32_t>& used, std::vector<V>& out) {
    if (attribute.components == 0) return;
    out.resize(used.size());
    for (std::size_t i = 0; i < used.size(); ++i)
      for (int c = 0; c < V::length(); ++c)
        out[i][c] = attribute.values[std::size_t{used[i]} * attribute.components + static_cast<std::size_t>(c)];
    // Beyond this no texel could be told from its neighbour, and a texture transform could overflow.
    if constexpr (V::length() == 2)
      for (V& uv : out) uv = glm::clamp(uv, V(-1e9f), V(1e9f));
  }

  static void gather_colors(const Attribute& attribute, const std::vector<std::uint32_t>& used,
                            std::vector<std::uint32_t>& out) {
    if (attribute.components == 0) return;
    out.resize(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
      std::uint32_t packed = 0;
      for (std::uint32_t c = 0; c < 4; ++c) {
        const float value =
            c < attribute.components ? attribute.values[std::size_t{used[i]} * attribute.components + c] : 1.0f;
        packed |= static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f)) << (8 * c);
      }
      out[i] = packed;
    }
  }

  const Document& document_;
  const BufferStore& buffers_;
  AccessorReader& accessors_;
  MemoryBudget& budget_;
  WarningGroup& mended_;
  const PrimitiveDesc& desc_;
  std::string where_;
  DracoMesh draco_;
  std::optional<std::uint64_t> count_;  // vertices, known once POSITION was read
};

void warn_of_drops(const std::string& what, const DropCounts& drops, WarningGroup& warnings) {
  if (drops.degenerate + drops.duplicate + drops.incomplete == 0) return;
  std::string text;
  const auto add = [&](std::size_t count, const char* kind) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  };
  add(drops.degenerate, "degenerate triangles dropped");
  add(drops.duplicate, "exact duplicates of triangles dropped");
  add(drops.incomplete, "primitives end with an incomplete triangle");
  warnings.add(what + ": " + text, drops.degenerate > 0  ? WarningCode("degenerate-triangles")
                                   : drops.duplicate > 0 ? WarningCode("duplicate-triangles")
                                                         : WarningCode("file-damaged"));
}

}  // namespace

bool degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
  const DVec3 ab = DVec3(b) - DVec3(a), ac = DVec3(c) - DVec3(a), bc = DVec3(c) - DVec3(b);
  const double longest2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
  const DVec3 cross = glm::cross(ab, ac);
  // Not (… > …): also true for what is not finite. 1e-10: a metre long and less than an ångström high.
  return !(glm::dot(cross, cross) > 1e-20 * longest2 * longest2);
}

Result<std::vector<LoadedMesh>> load_meshes(const Document& document, const BufferStore& buffers,
                                            AccessorReader& accessors, Context& context) {
  std::vector<LoadedMesh> meshes;
  std::size_t thin = 0, bare = 0;
  WarningGroup dropped(context, "meshes with degenerate, doubled or incomplete triangles", "degenerate-triangles");
  WarningGroup mended(context, "attributes with numbers that are NaN or infinite", "bad-number");
  for (std::size_t i = 0; i < document.meshes.size(); ++i) {
    if (context.stopped()) return fail(ErrorCode::kStopped, document.file, "stopped");
    const MeshDesc& desc = document.meshes[i];
    LoadedMesh mesh;
    mesh.name = desc.name.empty() ? fmt::format("mesh {}", i) : desc.name;
    DropCounts drops;
    for (const PrimitiveDesc& primitive : desc.primitives) {
      if (!primitive.attributes.contains("POSITION")) {
        ++bare;
        continue;
      }
      if (primitive.mode < 4) {
        ++thin;
        continue;
      }
      ORIEL_TRY(TriangleMesh triangles, PrimitiveLoader(document, buffers, accessors, primitive, mended).load(drops));
      if (!triangles.triangles.empty()) mesh.primitives.push_back(std::move(triangles));
    }
    warn_of_drops(fmt::format("mesh \"{}\"", mesh.name), drops, dropped);
    meshes.push_back(std::move(mesh));
  }
  dropped.finish();
  mended.finish();
  if (thin > 0) context.warning("unsupported", fmt::format("{} primitives of points or lines are left out", thin));
  if (bare > 0) context.warning("file-damaged", fmt::format("{} primitives without POSITION are left out", bare));
  return meshes;
}

}  // namespace oriel::gltf
