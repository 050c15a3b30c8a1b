#include "tests/validation/measure.h"

#include <algorithm>

#include "bake/reference/illuminance.h"
#include "bake/run/baked_light.h"
#include "formats/core/check.h"

namespace oriel::validation {
namespace {

// Nodes and weights of Gauss and Legendre's rule on [0,1].
std::vector<std::pair<double, double>> gauss_legendre(int n) {
  std::vector<std::pair<double, double>> rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(kPiD * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 50; ++iteration) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    rule.emplace_back(0.5 * (1 + x), 1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

bool named(const Reading& r, const Surface& surface) {
  return std::find(r.nodes.begin(), r.nodes.end(), surface.name) != r.nodes.end();
}

// Points all over a reading's surfaces, weights adding up to 1: a product rule on quads, centroids on other meshes.
std::vector<Probe> spread(const Scene& scene, const Reading& r, int points) {
  const auto rule = gauss_legendre(r.over == Over::kMean ? points : std::max(1, points / 8));
  std::vector<Probe> probes;
  double area = 0;
  const auto place = [&](const DVec3& p, std::uint32_t triangle, double share) {
    probes.push_back({scene.origin + p, DVec3(geometric_normal(scene, triangle)), share});
    area += share;
  };
  for (const Surface& s : scene.surfaces) {
    if (!named(r, s)) continue;
    const auto corner = [&](std::uint32_t i) { return DVec3(scene.positions[s.first_vertex + i]); };
    if (s.vertex_count == 4 && s.triangle_count == 2) {
      const DVec3 u = corner(1) - corner(0), v = corner(3) - corner(0);
      for (const auto& [x, wx] : rule)
        for (const auto& [y, wy] : rule)
          place(corner(0) + x * u + y * v, s.first_triangle, wx * wy * glm::length(glm::cross(u, v)));
    } else {
      for (std::uint32_t t = s.first_triangle; t < s.first_triangle + s.triangle_count; ++t)
        place(DVec3(point_on(scene, t, Vec2(1.0f / 3))), t, triangle_area(scene, t));
    }
  }
  ORIEL_CHECK(area > 0);
  for (Probe& p : probes) p.weight /= area;
  return probes;
}

double part_of(const PointIlluminance& e, const Reading& r) {
  DVec3 light(0);
  if (r.part != Part::kIndirect) light += e.direct;
  if (r.part != Part::kDirect) light += e.indirect;
  return light[r.channel];
}

// The value farthest from what a reading expects.
void take_worst(const Reading& r, const Measured& m, Measured& worst, bool& first) {
  if (first || std::abs(m.value - r.expected) > std::abs(worst.value - r.expected)) worst = m;
  first = false;
}

Measured combine(const Reading& r, const std::vector<Probe>& probes, const std::vector<PointIlluminance>& read) {
  Measured sum{r.offset, 0}, worst;
  bool first = true;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const double error = std::abs(r.scale) * read[i].standard_error[r.channel];
    sum.value += r.scale * probes[i].weight * part_of(read[i], r);
    sum.error += std::pow(probes[i].weight * error, 2);
    take_worst(r, {r.offset + r.scale * part_of(read[i], r), error}, worst, first);
  }
  sum.error = std::sqrt(sum.error);
  return r.over == Over::kWorst ? worst : sum;
}

// Triangle under a point of the scene, whose front is on the probe's side: nearest plane within rounding.
std::uint32_t triangle_at(const Accel& accel, const Probe& p) {
  const Scene& scene = accel.scene();
  const Vec3 normal(p.normal), position(p.position - scene.origin);
  const float step = 1e-4f * scene.radius();
  const Hit hit = accel.intersect({position + step * normal, -normal, 2 * step});
  ORIEL_CHECK(static_cast<bool>(hit));
  return hit.triangle;
}

Vec2 barycentric_of(const Scene& scene, std::uint32_t triangle, const DVec3& p) {
  const UVec3& t = scene.triangles[triangle];
  const DVec3 a(scene.positions[t.x]), u = DVec3(scene.positions[t.y]) - a, v = DVec3(scene.positions[t.z]) - a;
  const DVec3 n = glm::cross(u, v), w = p - scene.origin - a;
  return Vec2(glm::dot(glm::cross(w, v), n), glm::dot(glm::cross(u, w), n)) / static_cast<float>(glm::dot(n, n));
}

// A baked scene, and readings from it.
class BakedTexture {
 public:
  BakedTexture(const Case& c, const RadiosityOptions& options, std::uint64_t seed)
      : scene_(c.scene), texel_m_(c.texel_m), accel_(*Accel::build(scene_)), lights_(scene_) {
    Context context;
    context.seed = seed;
    AtlasOptions atlas;
    atlas.texel_m = static_cast<float>(c.texel_m);
    atlas_ = *build_atlas(scene_, atlas, context);
    map_ = *build_texel_map(atlas_, context);
    radiosity_ = *bake_radiosity({{accel_, lights_, {}}, atlas_, map_}, options, context);
    errors_ = radiosity_.pages;
    for (LightmapPage& page : errors_) page.irradiance = page.standard_error;
  }

  Measured read(const Reading& r) const {
    Measured m{0, 0};
    if (r.over == Over::kPoints) {
      if (!resolved(r)) return {std::numeric_limits<double>::quiet_NaN(), 0};
      for (const Probe& p : r.probes) {
        const std::uint32_t triangle = triangle_at(accel_, p);
        const Vec2 at = barycentric_of(scene_, triangle, p.position);
        const Vec3 n(p.normal);
        m.value += p.weight * baked_irradiance(atlas_, radiosity_.pages, {triangle, at}, n, n)[r.channel];
        m.error += p.weight * baked_irradiance(atlas_, errors_, {triangle, at}, n, n)[r.channel];
      }
    } else {
      m = over_texels(r);
    }
    if (r.over == Over::kWorst) return m;
    return {r.offset + r.scale * m.value, std::abs(r.scale) * m.error};
  }

 private:
  // No probe lies nearer than half a texel to an edge of its quad: beyond the last texels' centres there is nothing to
  // interpolate.
  bool resolved(const Reading& r) const {
    return std::all_of(r.probes.begin(), r.probes.end(), [&](const Probe& p) {
      const Surface& s = scene_.surfaces[scene_.triangle_surface[triangle_at(accel_, p)]];
      if (s.vertex_count != 4) return true;
      const auto corner = [&](std::uint32_t i) { return DVec3(scene_.positions[s.first_vertex + i]); };
      return std::ranges::all_of(std::array{1u, 3u}, [&](std::uint32_t i) {
        const DVec3 edge = corner(i) - corner(0);
        const double length = glm::length(edge),
                     along = glm::dot(p.position - scene_.origin - corner(0), edge) / length;
        return along >= 0.49 * texel_m_ && along <= length - 0.49 * texel_m_;
      });
    });
  }

  // The texel's surface that belongs to the reading, m².
  double area_of(const Reading& r, const TexelMapPage& page, std::size_t i) const {
    double area = 0;
    for (std::uint32_t f = page.first[i]; f < page.first[i + 1]; ++f) {
      const auto& [triangle, texels] = page.fragments[f];
      if (!named(r, scene_.surfaces[scene_.triangle_surface[triangle]])) continue;
      const auto corners = texel_triangle(atlas_, triangle);
      const DVec2 u = corners[1] - corners[0], v = corners[2] - corners[0];
      area += texels / (0.5 * std::abs(u.x * v.y - u.y * v.x)) * triangle_area(scene_, triangle);
    }
    return area;
  }

  Measured over_texels(const Reading& r) const {
    double area = 0, sum = 0, squares = 0;
    Measured worst;
    bool first = true;
    for (std::size_t p = 0; p < map_.size(); ++p)
      for (std::size_t i = 0; i < map_[p].texel.size(); ++i) {
        const double a = area_of(r, map_[p], i);
        const LightmapPage& page = radiosity_.pages[p];
        if (a <= 0 || page.state[map_[p].texel[i]] != TexelState::kValid) continue;
        const double e = page.irradiance[map_[p].texel[i]][r.channel];
        const double error = page.standard_error[map_[p].texel[i]][r.channel];
        area += a;
        sum += a * e;
        squares += a * a * error * error;
        take_worst(r, {r.offset + r.scale * e, std::abs(r.scale) * error}, worst, first);
      }
    ORIEL_CHECK(area > 0);
    return r.over == Over::kWorst ? worst : Measured{sum / area, std::sqrt(squares) / area};
  }

  const Scene& scene_;
  double texel_m_;
  Accel accel_;
  LightSet lights_;
  Atlas atlas_;
  std::vector<TexelMapPage> map_;
  Radiosity radiosity_;
  std::vector<LightmapPage> errors_;
};

}  // namespace

Measurements measure_by_lux(const Case& c, std::uint64_t seed) {
  Context context;
  context.seed = seed;
  const Accel accel = *Accel::build(c.scene);
  const LightSet lights(c.scene);
  // Readings of single points at once, so that the floor of their error is that of a table of points.
  std::vector<MeasurePoint> single, all;
  for (const Reading& r : c.readings)
    if (r.over == Over::kPoints && r.probes.size() == 1)
      single.push_back({r.probes[0].position, r.probes[0].normal, 0});
  const auto read_single = *illuminance_at({accel, lights, {}}, single, {.relative_error = c.lux_error}, context);

  Measurements out;
  auto next = read_single.begin();
  for (const Reading& r : c.readings) {
    if (r.over == Over::kPoints && r.probes.size() == 1) {
      out.push_back({r.offset + r.scale * part_of(*next, r), std::abs(r.scale) * next->standard_error[r.channel]});
      ++next;
      continue;
    }
    const std::vector<Probe> probes = r.over == Over::kPoints ? r.probes : spread(c.scene, r, c.rule);
    all.clear();
    for (const Probe& p : probes) all.push_back({p.position, p.normal, 0});
    // The errors of a mean's points average out.
    const double error =
        r.over == Over::kWorst ? c.lux_error : c.lux_error * std::sqrt(0.5 * static_cast<double>(probes.size()));
    const auto read = *illuminance_at({accel, lights, {}}, all, {.relative_error = std::min(0.05, error)}, context);
    out.push_back(combine(r, probes, read));
  }
  return out;
}

Measurements measure_by_texture(const Case& c, const RadiosityOptions& options, std::uint64_t seed) {
  const BakedTexture baked(c, options, seed);
  Measurements out;
  for (const Reading& r : c.readings) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    out.push_back(r.part == Part::kTotal ? baked.read(r) : Measured{kNone, 0});
  }
  return out;
}

}  // namespace oriel::validation
