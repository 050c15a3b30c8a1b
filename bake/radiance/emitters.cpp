#include "bake/radiance/emitters.h"

#include <algorithm>
#include <map>

#include "bake/jobs/parallel.h"
#include "bake/radiance/punctual_emitter.h"
#include "bake/radiance/sun_emitter.h"
#include "bake/trace/polygon_light.h"
#include "bake/trace/sampler.h"
#include "formats/core/color.h"
#include "formats/query/emitter_views.h"

namespace oriel {
namespace {

constexpr std::size_t kMostTriangles = 16;  // of a lamp: finer ones leave no room for others
constexpr double kStraight = 1e-4;          // sine of the angle at a corner that is none
constexpr double kLeastShare = 1e-4;        // of a reflector's light from lamps: less is not worth an emitter
constexpr std::size_t kMostGlints = 16;     // of a mirror
constexpr std::size_t kMostEmitters = 512;  // of a pack, with those that no reflector lists
constexpr std::uint32_t kFirstSamples = 8;  // of a sun, a point or a spot, which nodes hardly see in part

// The corners of a light's outline, counter-clockwise from its front; empty unless it is one closed loop.
std::vector<Vec3> outline(const PolygonLight& light) {
  const auto less = [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::map<Vec3, Vec3, decltype(less)> next(less);
  for (const auto& edge : light.boundary) next[edge[0]] = edge[1];
  if (light.boundary.empty() || next.size() != light.boundary.size()) return {};
  std::vector<Vec3> loop;
  for (Vec3 at = light.boundary[0][0]; loop.size() < next.size(); at = next[at]) {
    if (!next.contains(at) || (!loop.empty() && at == loop[0])) return {};
    loop.push_back(at);
  }
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const DVec3 here(loop[i]), before(loop[(i + loop.size() - 1) % loop.size()]), after(loop[(i + 1) % loop.size()]);
    const DVec3 in = here - before, out = after - here;
    if (glm::length(glm::cross(in, out)) > kStraight * glm::length(in) * glm::length(out)) corners.push_back(loop[i]);
  }
  return corners;
}

bool is_convex(const std::vector<Vec3>& corners, const Vec3& normal) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i)
    if (glm::dot(glm::cross(corners[(i + 1) % n] - corners[i], corners[(i + 2) % n] - corners[(i + 1) % n]), normal) <
        0)
      return false;
  return true;
}

// One polygon where the outline is a convex triangle or quadrangle, else the triangles.
std::vector<Emitter> polygons_of(const PolygonLight& light) {
  std::vector<Vec3> corners = outline(light);
  if ((corners.size() == 3 || corners.size() == 4) && is_convex(corners, light.normal))
    return {{std::move(corners), light.radiance, light.double_sided}};
  std::vector<Emitter> out;
  for (const auto& t : light.corners) out.push_back({{t[0], t[1], t[2]}, light.radiance, light.double_sided});
  return out;
}

struct Nodes {
  ReflectorNodes grid;
  std::vector<bool> covered;  // by the reflector
};

Nodes lay_out(const Accel& accel, const FoundReflector& found, float node_m, std::uint32_t max_nodes) {
  const Reflector& r = found.reflector;
  const Vec2 size = r.upper - r.lower;
  Nodes nodes{lay_out_nodes(r, nodes_along(size.x, node_m, max_nodes), nodes_along(size.y, node_m, max_nodes)), {}};
  const Vec3 normal(r.pack_from_reflector[2]);
  for (const Vec3& point : nodes.grid.points) {
    const Hit below = accel.intersect({point, -normal, 4 * nodes.grid.lift_m});
    nodes.covered.push_back(below &&
                            std::binary_search(found.triangles.begin(), found.triangles.end(), below.triangle));
  }
  return nodes;
}

struct LightOnReflector {
  std::size_t light = 0;
  PolygonLight lamp;
  const Light* punctual = nullptr;  // that the lamp stands for
  std::vector<Emitter> polygons = {};
  double worth = 0;   // luminous irradiance on the covered nodes, visibility counted
  double parted = 0;  // of it, what lobes that see less than the whole lamp may get wrong
};

class VisibilityBaker {
 public:
  VisibilityBaker(const Accel& accel, const EmitterOptions& options, std::uint64_t seed)
      : accel_(accel), options_(options), seed_(seed) {}

  // Share of the polygon's points over the plane that a point of the plane sees; `few` of them where they agree.
  float share(const Emitter& polygon, std::uint32_t few, const Vec3& node, const Vec3& normal,
              std::uint64_t stream) const {
    if (!polygon.two_sided && glm::dot(node - polygon.corners[0], front_of(polygon)) <= 0) return 0;
    double seen = 0;
    std::uint32_t over = 0;
    for (std::uint32_t i = 0; i < options_.samples; ++i) {
      Sampler sampler(seed_, stream, i);
      const Vec3 way = point_of(polygon, sampler.next2()) - node;
      const float distance = glm::length(way);
      if (!(glm::dot(way, normal) > 0)) continue;
      ++over;
      seen += luminance(glm::min(accel_.transmittance({node, way / distance, distance * (1 - 1e-4f)}), Vec3(1)));
      if (over == few && (seen == 0 || seen == over)) break;
    }
    return over > 0 ? static_cast<float>(seen / over) : 0;
  }

  // Of one of a lamp's polygons, by node; of a punctual light what it sends there beside what the lamp does.
  std::vector<float> shares(const LightOnReflector& on, std::size_t polygon, const Nodes& nodes,
                            const Vec3& normal) const {
    std::vector<float> shares;
    const std::uint32_t few = on.lamp.triangles.empty() ? kFirstSamples : options_.samples;
    std::uint64_t stream = (on.light * kMaxReflectorEmitters + polygon) * nodes.grid.points.size();
    for (const Vec3& node : nodes.grid.points) {
      shares.push_back(share(on.polygons[polygon], few, node, normal, stream++));
      if (on.punctual)
        shares.back() *= fade_of_square(accel_.scene(), *on.punctual, on.lamp, node, options_.squares_turn);
    }
    return shares;
  }

  // lobe_width: α of the reflector's lobe; 0: a mirror, which shows of a lamp what each point sees.
  void weigh(const Nodes& nodes, const Vec3& normal, double lobe_width, LightOnReflector& on) const {
    const PolygonLight& light = on.lamp;
    std::vector<double> mean(nodes.grid.points.size(), 0.0);
    for (std::size_t p = 0; p < on.polygons.size(); ++p) {
      const std::vector<float> seen = shares(on, p, nodes, normal);
      for (std::size_t i = 0; i < seen.size(); ++i) mean[i] += seen[i] / static_cast<double>(on.polygons.size());
    }
    for (std::size_t i = 0; i < nodes.grid.points.size(); ++i) {
      if (!nodes.covered[i]) continue;
      const Vec3& node = nodes.grid.points[i];
      const double light_here = luminance(light.radiance) * polygon_irradiance(light, {node, normal, normal});
      on.worth += mean[i] * light_here;
      const Vec3 towards = glm::normalize(light.center - node);
      const double lamp = polygon_irradiance(light, {node, towards, towards});
      if (lobe_width > 0) on.parted += parted(mean[i], lamp, lobe_width) * light_here;
    }
  }

 private:
  const Accel& accel_;
  const EmitterOptions& options_;
  std::uint64_t seed_;
};

// Lamps that stay in a reflector's maps, by what keeps them there.
struct LeftIn {
  std::size_t too_fine = 0;   // of more triangles than kMostTriangles
  std::size_t too_faint = 0;  // beyond those that light it most, whose visibility is computed
  std::size_t parted = 0;     // of which narrow lobes see other shares than the points do
  std::size_t too_many = 0;   // beyond the polygons that it may list

  std::size_t total() const { return too_fine + too_faint + parted + too_many; }
  std::string reasons(std::size_t brightest) const {
    std::string text;
    const auto add = [&](std::size_t lamps, const std::string& why) {
      if (lamps > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", lamps, why);
    };
    add(too_fine, fmt::format("have more than {} triangles", kMostTriangles));
    add(too_faint, fmt::format("are fainter than the {} brightest", brightest));
    add(parted, "are hidden in part and large");
    add(too_many, fmt::format("came after its {} polygons", kMaxReflectorEmitters));
    return text;
  }
};

// Chooses a reflector's emitters.
class EmitterChooser {
 public:
  EmitterChooser(const Accel& accel, const EmitterOptions& options, Context& context)
      : accel_(accel),
        options_(options),
        context_(context),
        baker_(accel, options, context.seed),
        lights_(find_polygon_lights(accel.scene())) {
    for (const Light& light : accel.scene().lights)
      if (auto sun = sun_polygon(accel.scene(), light)) lights_.push_back(std::move(*sun));
  }

  // The lights that would light the reflector most if nothing were in the way, by what they are worth.
  Result<std::vector<LightOnReflector>> lights_on(const FoundReflector& found, double lobe_width,
                                                  LeftIn& left_in) const {
    const Nodes nodes = lay_out(accel_, found, options_.choice_node_m, options_.max_choice_nodes);
    const Vec3 normal(found.reflector.pack_from_reflector[2]);
    std::vector<LightOnReflector> out =
        lamps_before({normal, nodes.grid.points, options_.squares_turn}, lobe_width > 0, left_in);
    std::ranges::stable_sort(out, std::greater(), &LightOnReflector::worth);
    left_in.too_faint = out.size() - std::min<std::size_t>(out.size(), options_.max_lights);
    out.resize(out.size() - left_in.too_faint);
    ORIEL_TRY_VOID(parallel_for(context_, "", out.size(), [&](std::size_t i) {
      out[i].worth = 0;
      out[i].polygons = polygons_of(out[i].lamp);
      baker_.weigh(nodes, normal, lobe_width, out[i]);
    }));
    std::stable_sort(out.begin(), out.end(),
                     [](const LightOnReflector& a, const LightOnReflector& b) { return a.worth > b.worth; });
    return out;
  }

  // The sides of lamps that no reflector sees where they are: a lamp that is moved may show them.
  void append_rest(const std::map<std::size_t, std::uint32_t>& listed, std::vector<Emitter>& emitters) const {
    for (std::size_t l = 0; l < lights_.size() && emitters.size() < kMostEmitters; ++l) {
      const std::size_t triangles = lights_[l].triangles.size();
      if (triangles == 0 || triangles > kMostTriangles || listed.contains(l)) continue;
      const std::vector<Emitter> polygons = polygons_of(lights_[l]);
      emitters.insert(emitters.end(), polygons.begin(), polygons.end());
    }
  }

  // What the reflector's emitters are seen of, on the fine grid: of lamps the polygons, each by its number.
  Status bake_visibility(std::span<const std::pair<const LightOnReflector*, std::size_t>> polygons,
                         FoundReflector& found) const {
    Reflector& r = found.reflector;
    const Nodes nodes = lay_out(accel_, found, options_.node_m, options_.max_nodes);
    std::vector<std::vector<float>> seen(polygons.size());
    ORIEL_TRY_VOID(parallel_for(context_, "", polygons.size(), [&](std::size_t p) {
      seen[p] = baker_.shares(*polygons[p].first, polygons[p].second, nodes, Vec3(r.pack_from_reflector[2]));
      fill_uncovered(nodes.grid, nodes.covered, seen[p]);
    }));
    for (const std::vector<float>& shares : seen)
      for (const float share : shares)
        r.visibility.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f))));
    r.visibility_x = nodes.grid.x, r.visibility_y = nodes.grid.y;
    return {};
  }

 private:
  // Those of the scene that shine on that plane where nothing is in the way, points and spots as what they are to it.
  // flat_ones: not in mirrors, whose images have them.
  std::vector<LightOnReflector> lamps_before(const LitPlane& plane, bool flat_ones, LeftIn& left_in) const {
    std::vector<LightOnReflector> lamps;
    const auto add = [&](std::size_t number, const PolygonLight& lamp, const Light* punctual) {
      double worth = 0;
      for (const Vec3& node : plane.nodes) worth += polygon_irradiance(lamp, {node, plane.normal, plane.normal});
      if (!(worth > 0)) return;
      if (lamp.triangles.size() > kMostTriangles)
        ++left_in.too_fine;
      else
        lamps.push_back(
            {.light = number, .lamp = lamp, .punctual = punctual, .worth = worth * luminance(lamp.radiance)});
    };
    for (std::size_t l = 0; l < lights_.size(); ++l)
      if (flat_ones || lights_[l].triangles.empty()) add(l, lights_[l], nullptr);
    const Scene& scene = accel_.scene();
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
      if (const auto square = punctual_square(scene, scene.lights[l], plane))
        add(lights_.size() + l, *square, &scene.lights[l]);
    return lamps;
  }

  const Accel& accel_;
  const EmitterOptions& options_;
  Context& context_;
  VisibilityBaker baker_;
  std::vector<PolygonLight> lights_;
};

}  // namespace

Status leave_out_emitters(const Accel& accel, const EmitterOptions& options, Context& context,
                          const LeftOutEmitters& out) {
  auto& [reflectors, emitters, omitted] = out;
  const EmitterChooser chooser(accel, options, context);
  std::map<std::size_t, std::uint32_t> first_emitter;  // of a light that is listed
  for (FoundReflector& found : reflectors) {
    Reflector& r = found.reflector;
    const double lobe_width = options.lobe_widths[r.material];
    LeftIn left_in;
    ORIEL_TRY(const std::vector<LightOnReflector> on, chooser.lights_on(found, lobe_width, left_in));
    const double most_parted = found.way == ReflectorWay::kGeometry ? kMostPartedOfGeometry : kMostParted;
    double total = 0;
    for (const LightOnReflector& l : on) total += l.worth;
    std::vector<std::pair<const LightOnReflector*, std::size_t>> chosen;
    for (const LightOnReflector& l : on) {
      if (!(l.worth > kLeastShare * total)) continue;
      if (l.parted > most_parted * l.worth) {
        ++left_in.parted;
        continue;
      }
      if (r.emitters.size() + l.polygons.size() > (lobe_width > 0 ? kMaxReflectorEmitters : kMostGlints)) {
        ++left_in.too_many;
        continue;
      }
      auto first = static_cast<std::uint32_t>(emitters.size());
      // Squares of punctual lights face the reflector that they are made for.
      if (l.punctual == nullptr) first = first_emitter.try_emplace(l.light, first).first->second;
      if (first == emitters.size()) emitters.insert(emitters.end(), l.polygons.begin(), l.polygons.end());
      for (std::uint32_t p = 0; p < l.polygons.size(); ++p) {
        r.emitters.push_back(first + p);
        chosen.emplace_back(&l, p);
      }
      found.emitters.insert(found.emitters.end(), l.lamp.triangles.begin(), l.lamp.triangles.end());
    }
    std::sort(found.emitters.begin(), found.emitters.end());
    if (!chosen.empty()) ORIEL_TRY_VOID(chooser.bake_visibility(chosen, found));
    const char* const how = lobe_width > 0 ? "lamps are blurred with its image instead of shown exactly (their edges "
                                             "are softer, their light is the same)"
                                           : "points, spots and suns do not show in it";
    if (left_in.total() > 0)
      omitted.push_back(
          fmt::format("'{}': {} of its {}: {}", r.name, left_in.total(), how, left_in.reasons(options.max_lights)));
  }
  const bool any_glossy = std::any_of(reflectors.begin(), reflectors.end(), [&](const FoundReflector& f) {
    return options.lobe_widths[f.reflector.material] > 0;
  });
  if (any_glossy && !accel.scene().light_groups.empty()) chooser.append_rest(first_emitter, emitters);
  if (any_glossy && !all_emission_is_plain(accel.scene()))
    omitted.emplace_back(
        "lamps whose emission is textured stay in the images of glossy reflectors and are blurred with them");
  return {};
}

}  // namespace oriel
