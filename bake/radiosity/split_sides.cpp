#include "bake/radiosity/split_sides.h"

#include <map>
#include <tuple>

namespace oriel {
namespace {

// Copies surfaces part by part from one scene's geometry into another's.
class Splitter {
 public:
  Splitter(Scene scene, std::span<const LitSides> sides)
      : sides_(sides), out_(std::move(scene)), originals_(out_.materials), material_used_(originals_.size()) {
    in_.positions.swap(out_.positions);
    in_.normals.swap(out_.normals);
    in_.uv0.swap(out_.uv0);
    in_.uv1.swap(out_.uv1);
    in_.colors.swap(out_.colors);
    in_.tangents.swap(out_.tangents);
    in_.triangles.swap(out_.triangles);
    in_.face_normals.swap(out_.face_normals);
    in_.triangle_surface.swap(out_.triangle_surface);
    in_.surfaces.swap(out_.surfaces);
    copy_of_.resize(in_.positions.size());
    front_.resize(in_.triangles.size());
  }

  Scene run() {
    for (const Surface& surface : in_.surfaces) {
      const bool both = originals_[surface.material].double_sided;
      append(surface, LitSides::kFront, both, false);
      append(surface, LitSides::kBack, both, true);
      append(surface, LitSides::kBoth, false, false);
    }
    out_.twin.assign(out_.triangles.size(), ~0u);
    for (const Surface& surface : in_.surfaces) append(surface, LitSides::kBoth, false, true);
    return std::move(out_);
  }

 private:
  // The triangles of a surface that are lit so, as a surface of their own.
  void append(const Surface& from, LitSides lit, bool double_sided, bool turned) {
    const bool is_back = lit == LitSides::kBoth && turned;
    Surface part = from;
    part.first_triangle = static_cast<std::uint32_t>(out_.triangles.size());
    part.first_vertex = static_cast<std::uint32_t>(out_.positions.size());
    for (std::uint32_t t = from.first_triangle; t < from.first_triangle + from.triangle_count; ++t) {
      if (sides_[t] != lit) continue;
      add_triangle(t, part.first_vertex, turned);
      const auto added = static_cast<std::uint32_t>(out_.triangles.size() - 1);
      if (!is_back) {
        front_[t] = added;
        continue;
      }
      out_.twin.push_back(front_[t]);
      out_.twin[front_[t]] = added;
    }
    part.triangle_count = static_cast<std::uint32_t>(out_.triangles.size()) - part.first_triangle;
    part.vertex_count = static_cast<std::uint32_t>(out_.positions.size()) - part.first_vertex;
    if (part.triangle_count == 0) return;
    part.material = material(from.material, double_sided, turned);
    if (is_back) {
      part.name += " (back)";
      part.has_uv1 = false;  // its front lies there
    }
    out_.surfaces.push_back(std::move(part));
  }

  void add_triangle(std::uint32_t t, std::uint32_t first_vertex, bool turned) {
    UVec3 corners;
    for (int k = 0; k < 3; ++k) corners[k] = vertex(in_.triangles[t][k], first_vertex, turned);
    if (turned) std::swap(corners.y, corners.z);
    out_.triangles.push_back(corners);
    out_.triangle_surface.push_back(static_cast<std::uint32_t>(out_.surfaces.size()));
    if (in_.face_normals.empty()) return;
    const Vec3 normal = geometric_normal(in_, t);
    out_.face_normals.push_back(turned ? -normal : normal);
  }

  // The copy of a vertex for the surface whose vertices begin there.
  std::uint32_t vertex(std::uint32_t v, std::uint32_t first_vertex, bool turned) {
    const auto next = static_cast<std::uint32_t>(out_.positions.size());
    std::uint32_t& copy = copy_of_[v];
    if (copy >= first_vertex && copy < next && original_[copy] == v) return copy;
    copy = next;
    original_.push_back(v);
    out_.positions.push_back(in_.positions[v]);
    out_.normals.push_back(turned ? -in_.normals[v] : in_.normals[v]);
    out_.uv0.push_back(in_.uv0[v]);
    out_.uv1.push_back(in_.uv1[v]);
    if (!in_.colors.empty()) out_.colors.push_back(in_.colors[v]);
    if (!in_.tangents.empty()) {
      const Vec4& t = in_.tangents[v];
      out_.tangents.push_back(turned ? Vec4(Vec3(t), -t.w) : t);  // the same bitangent
    }
    return next;
  }

  // The variant of a material that a part needs; the first one takes the original's place. On a turned surface a normal
  // map tilts by -x and -y, so that with the normal all of the tilted normal changes sign.
  std::uint32_t material(std::uint32_t m, bool double_sided, bool turned) {
    const bool mirrored = turned && originals_[m].normal_texture.image >= 0;
    const auto [at, added] = variants_.try_emplace({m, double_sided, mirrored}, m);
    if (!added) return at->second;
    SceneMaterial variant = originals_[m];
    variant.double_sided = double_sided;
    if (mirrored) variant.normal_scale = -variant.normal_scale;
    if (material_used_[m]) {
      at->second = static_cast<std::uint32_t>(out_.materials.size());
      out_.materials.push_back(std::move(variant));
    } else {
      material_used_[m] = 1;
      out_.materials[m] = std::move(variant);
    }
    return at->second;
  }

  std::span<const LitSides> sides_;
  Scene in_;  // geometry only
  Scene out_;
  std::vector<SceneMaterial> originals_;
  std::vector<char> material_used_;
  std::map<std::tuple<std::uint32_t, bool, bool>, std::uint32_t> variants_;
  std::vector<std::uint32_t> copy_of_;   // by vertex of in_: its last copy
  std::vector<std::uint32_t> original_;  // by vertex of out_
  std::vector<std::uint32_t> front_;     // by triangle of in_: into out_
};

}  // namespace

Scene split_sides(Scene scene, std::span<const LitSides> sides) {
  return Splitter(std::move(scene), sides).run();
}

}  // namespace oriel
