#include "formats/analysis/why.h"
#include "formats/core/json.h"
#include "formats/export/html.h"
#include "formats/export/place_picture.h"
#include "formats/export/sections.h"

namespace oriel::report {
namespace {

constexpr std::size_t kPictures = 6;

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
