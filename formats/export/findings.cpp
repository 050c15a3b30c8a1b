#include <array>
#include <cmath>

#include "formats/analysis/why.h"
#include "formats/core/json.h"
#include "formats/export/html.h"
#include "formats/export/picture.h"
#include "formats/export/sections.h"
#include "formats/query/mesh_rays.h"

namespace oriel::report {
namespace {

constexpr std::size_t kPictures = 6;
constexpr std::uint32_t kPlaceWidth = 320, kPlaceHeight = 200;  // pixels of each
constexpr float kBefore_m = 3, kLeastBefore_m = 0.3f;           // from the place to the eye
constexpr float kTangent = 0.55f;                               // of half the picture's width
constexpr float kRing = 0.05f;                                  // its radius, in the picture's half width

// Texels are read at their centre: pages' colours, not their filtering.
Vec3 light_of(const Pack& pack, const MeshPart& part, const TriangleHit& hit) {
  const Material& m = pack.materials[part.material];
  if (m.unlit) return unlit_white(m) * m.base_color;
  Vec3 light = m.emission;
  if (part.lightmap_page < 0) return light;
  const LightmapPage& page = pack.lightmaps[static_cast<std::size_t>(part.lightmap_page)];
  const std::uint32_t* c = &pack.mesh.indices[hit.first_index];
  const Vec2 uv = pack.mesh.lightmap_uvs[c[0]] * (1 - hit.u - hit.v) + pack.mesh.lightmap_uvs[c[1]] * hit.u +
                  pack.mesh.lightmap_uvs[c[2]] * hit.v;
  const IVec2 size(page.width, page.height);
  const IVec2 texel = glm::clamp(IVec2(glm::floor(uv * Vec2(size))), IVec2(0), size - 1);
  const std::size_t i = static_cast<std::size_t>(texel.y) * page.width + static_cast<std::size_t>(texel.x);
  return light + page.irradiance[i] * m.base_color / kPi;
}

struct Look {
  Vec3 eye{0}, ahead{0}, right{0}, up{0};
};

// From the side that the surface faces, somewhat aside and above, as far off as there is room for.
Look look_at_place(const MeshRays& rays, const Vec3& at, const Vec3& normal) {
  const Vec3 level = normalize_or(Vec3(normal.x, 0, normal.z), Vec3(0.6f, 0, 0.8f));
  const Vec3 aside = normalize_or(glm::cross(level, Vec3(0, 1, 0)), Vec3(1, 0, 0));
  const std::array<Vec3, 4> ways{normal + 0.4f * aside + Vec3(0, 0.35f, 0), normal - 0.4f * aside + Vec3(0, 0.35f, 0),
                                 normal + 0.8f * level, normal};
  Look look;
  float farthest = 0;
  for (const Vec3& way : ways) {
    const Vec3 direction = normalize_or(way, normal);
    const auto hit = rays.first(at + 1e-3f * normal, direction, kBefore_m / 0.9f);
    const float room = hit ? 0.9f * hit->distance : kBefore_m;
    if (room <= farthest) continue;
    farthest = room;
    look.eye = at + 1e-3f * normal + std::max(room, kLeastBefore_m) * direction;
  }
  look.ahead = normalize_or(at - look.eye, -normal);
  const Vec3 upright = std::fabs(look.ahead.y) < 0.98f ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
  look.right = normalize_or(glm::cross(look.ahead, upright), Vec3(1, 0, 0));
  look.up = glm::cross(look.right, look.ahead);
  return look;
}

// A place of the scene as somebody sees it who stands before it, its baked light ray by ray: irradiance times base
// colour over pi, emission, nothing of reflections; a ring around the place. at: pack space; normal: of the surface
// there, unit.
Raster place_picture(const Pack& pack, const MeshRays& rays, const Vec3& at, const Vec3& normal) {
  const Look look = look_at_place(rays, at, normal);
  Raster out;
  out.light = {kPlaceWidth, kPlaceHeight, 3, {}};
  out.light.pixels.reserve(std::size_t{3} * kPlaceWidth * kPlaceHeight);
  for (std::uint32_t y = 0; y < kPlaceHeight; ++y)
    for (std::uint32_t x = 0; x < kPlaceWidth; ++x) {
      const Vec2 p((2 * (static_cast<float>(x) + 0.5f) - kPlaceWidth) / kPlaceWidth,
                   (kPlaceHeight - 2 * (static_cast<float>(y) + 0.5f)) / kPlaceWidth);
      const Vec3 way = glm::normalize(look.ahead + kTangent * (p.x * look.right + p.y * look.up));
      const auto hit = rays.first(look.eye, way);
      const auto part = hit ? rays.part(hit->first_index) : std::nullopt;
      const Vec3 light = part ? light_of(pack, pack.mesh.parts[*part], *hit) : pack.sky;
      for (int c = 0; c < 3; ++c) out.light.pixels.push_back(light[c]);
      // The ring is what is not known: grey on any light.
      out.known.push_back(std::fabs(glm::length(p) - kRing) > 1.5f / kPlaceWidth ? 1 : 0);
    }
  return out;
}

struct Place {
  Vec3 at{0}, normal{0, 1, 0};
};

// The middle of the largest triangle of the first part of that name.
std::optional<Place> place_of(const Pack& pack, const std::string& name) {
  for (const MeshPart& part : pack.mesh.parts) {
    if (part.name != name || name.empty()) continue;
    float largest = 0;
    std::optional<Place> found;
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
      const auto corner = [&](std::uint32_t k) { return pack.mesh.positions[pack.mesh.indices[i + k]]; };
      const float area = glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
      if (area <= largest) continue;
      largest = area;
      found = Place{(corner(0) + corner(1) + corner(2)) / 3.0f, triangle_normal(pack.mesh, i)};
    }
    return found;
  }
  return std::nullopt;
}

// What stands between the first quotes: messages name their surface so.
std::string quoted(const std::string& text) {
  const std::size_t open = text.find_first_of("'\"");
  if (open == std::string::npos) return {};
  const std::size_t close = text.find(text[open], open + 1);
  return close == std::string::npos ? std::string() : text.substr(open + 1, close - open - 1);
}

class Findings {
 public:
  explicit Findings(const Pack& pack) : pack_(pack) {}

  void add(const std::string& what, const std::string& text, const std::optional<Place>& place,
           const std::string& more = "") {
    html_ += "<div class=\"finding\"><p><b>" + escaped_word(what) + "</b> " + shown_line(text) + "</p>\n" + more;
    if (place && pictures_ < kPictures) {
      ++pictures_;
      if (!rays_) rays_.emplace(pack_.mesh);
      const Raster raster = place_picture(pack_, *rays_, place->at, place->normal);
      html_ += toned_img(raster, white_of(std::span(&raster, 1)), "the place, ringed");
    }
    html_ += "</div>\n";
  }
  const MeshRays& rays() {
    if (!rays_) rays_.emplace(pack_.mesh);
    return *rays_;
  }
  bool empty() const { return html_.empty(); }
  std::string html() const { return html_; }

 private:
  static std::string escaped_word(const std::string& word) { return shown_text(word + ":"); }
  const Pack& pack_;
  std::optional<MeshRays> rays_;
  std::size_t pictures_ = 0;
  std::string html_;
};

void add_texts(const Pack& pack, const Json& plan, const std::string& what, const Limits& limits, Findings& out) {
  const std::string list = what + "s";
  if (!plan.contains(list) || !plan[list].is_array()) return;
  std::size_t shown = 0;
  for (const Json& text : plan[list]) {
    if (!text.is_string() || shown++ == limits.lines) continue;
    const std::string line = text.get<std::string>();
    out.add(what, line, place_of(pack, quoted(line)));
  }
}

// Where held-out pixels were off most, with why it may be so.
void add_worst(const Pack& pack, const Json& plan, Findings& out) {
  const Json& worst = plan["radiosity"]["certificate"]["worst"];
  if (!worst.is_array()) return;
  for (const Json& w : worst) {
    if (!w.is_object() || !w.contains("at") || !w["at"].is_array() || w["at"].size() != 3) continue;
    DVec3 at(0);
    bool whole = true;
    for (int k = 0; k < 3; ++k) {
      const Json& value = w["at"][static_cast<std::size_t>(k)];
      whole = whole && value.is_number();
      if (value.is_number()) at[k] = value.get<double>();
    }
    const auto number = [&](const char* name) {
      return w.contains(name) && w[name].is_number() ? w[name].get<double>() : 0.0;
    };
    if (!whole) continue;
    const auto why = why_at(pack, out.rays(), Vec3(at - pack.mesh.origin), {},
                            [&](std::uint32_t page) { return &pack.lightmaps[page]; });
    std::string more;
    for (std::size_t i = 0; why && i < why->reasons.size(); ++i)
      more += "<p class=\"quiet\">" +
              shown_line(std::string(name_of(why->reasons[i].cause)) + ": " + why->reasons[i].text +
                         "; to do: " + why->reasons[i].fix) +
              "</p>\n";
    const std::string surface =
        w.contains("surface") && w["surface"].is_string() ? w["surface"].get<std::string>() : "a surface";
    out.add(
        "worst as seen",
        fmt::format("'{}' at {:.2f}, {:.2f}, {:.2f} m: baked {:.4g} cd/m², unbiased paths find {:.4g}; {:.0f} % of all "
                    "squared error",
                    surface, at.x, at.y, at.z, number("baked_cd_m2"), number("measured_cd_m2"), 100 * number("share")),
        why ? std::optional(Place{Vec3(why->at - pack.mesh.origin), why->normal}) : std::nullopt, more);
  }
}

}  // namespace

std::string findings_html(const Pack& pack, const Limits& limits) {
  const Json plan = Json::parse(pack.plan).value_or(Json());
  if (!plan.is_object()) return {};
  Findings out(pack);
  add_texts(pack, plan, "finding", limits, out);
  add_texts(pack, plan, "warning", limits, out);
  add_worst(pack, plan, out);
  if (out.empty()) return {};
  return "<h2>Findings</h2>\n<p class=\"quiet\">What the bake warned of and found, and where it was off most, with the "
         "place ringed in its baked light.</p>\n" +
         out.html();
}

}  // namespace oriel::report
