#include "formats/query/scattered_lights.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "formats/core/color.h"
#include "formats/core/parallel.h"

namespace oriel {
namespace {

constexpr float kLeastShare = 0.5f;       // of what rays would find if nothing were hidden
constexpr float kSkyDistance = 20;        // over the scene's radius: from there light is as good as parallel
constexpr std::uint32_t kRays = 1 << 16;  // that look around
constexpr std::size_t kNone = ~std::size_t{0};
constexpr std::size_t kMostSources = 1 << 20;  // texels
constexpr std::size_t kBlocks = 2048;          // of sources, that rays tell apart
constexpr float kBefore = 0.95f;               // of the way to what is around
constexpr std::uint32_t kMostDirections = 4096;
constexpr float kFewer = 0.95f;     // a step towards the number that is wanted
constexpr std::size_t kRuns = 64;   // of rays, for threads
constexpr int kPiecesOfScene = 64;  // shining triangles are cut until they are so much smaller than the scene
constexpr int kMostCuts = 32;       // along a side of a triangle

float fraction(double x) {
  return static_cast<float>(x - std::floor(x));
}

// Interleaves the bits of a place in a box, so that what is near in space is near in order (Morton 1966).
std::uint64_t morton(const Vec3& p, const Vec3& lower, float size) {
  std::uint64_t code = 0;
  const Vec3 at = glm::clamp((p - lower) / std::max(size, 1e-30f), Vec3(0), Vec3(1)) * 1048575.0f;
  for (int axis = 0; axis < 3; ++axis) {
    auto x = static_cast<std::uint64_t>(at[axis]);
    x = (x | x << 32) & 0x1f00000000ffffull, x = (x | x << 16) & 0x1f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full, x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    code |= ((x | x << 2) & 0x1249249249249249ull) << axis;
  }
  return code;
}

struct Triangle {
  Vec3 a{0}, ab{0}, ac{0};
  float area() const { return 0.5f * glm::length(glm::cross(ab, ac)); }
};
Triangle triangle_of(const Mesh& mesh, std::size_t first) {
  const Vec3 a = mesh.positions[mesh.indices[first]];
  return {a, mesh.positions[mesh.indices[first + 1]] - a, mesh.positions[mesh.indices[first + 2]] - a};
}

// Of a texel of the page, where that triangle lies on it.
float texel_area(const Mesh& mesh, const LightmapPage& page, std::size_t first) {
  const Vec2 a = mesh.lightmap_uvs[mesh.indices[first]];
  const Vec2 ab = mesh.lightmap_uvs[mesh.indices[first + 1]] - a, ac = mesh.lightmap_uvs[mesh.indices[first + 2]] - a;
  const float on_page = 0.5f * std::abs(ab.x * ac.y - ab.y * ac.x);
  if (!(on_page > 0)) return 0;
  const float area = triangle_of(mesh, first).area() / (on_page * static_cast<float>(page.width * page.height));
  return std::isfinite(area) ? area : 0;
}

std::vector<float> part_areas(const Mesh& mesh) {
  std::vector<float> areas;
  for (const MeshPart& part : mesh.parts) {
    double sum = 0;
    for (std::size_t i = 0; i + 2 < part.index_count; i += 3) sum += triangle_of(mesh, part.first_index + i).area();
    areas.push_back(static_cast<float>(sum));
  }
  return areas;
}

Vec3 even_direction(std::uint32_t i, std::uint32_t count) {
  const float z = 1 - (2 * static_cast<float>(i) + 1) / static_cast<float>(count);
  const float r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * fraction(i * 0.6180339887498949);
  return {r * std::cos(phi), z, r * std::sin(phi)};
}

// Of so many even directions those that are nearest to one of the rays that see the sky.
std::vector<Vec3> open_directions(std::span<const Vec3> rays, std::uint32_t all) {
  std::vector<Vec3> directions;
  for (std::uint32_t i = 0; i < all; ++i) directions.push_back(even_direction(i, all));
  std::vector<std::uint8_t> open(all, 0);
  for_each_parallel(kRuns, core_count(), [&](std::size_t run) {
    for (std::size_t r = run; r < rays.size(); r += kRuns) {
      const auto nearer = [&](const Vec3& a, const Vec3& b) { return glm::dot(a, rays[r]) < glm::dot(b, rays[r]); };
      const auto nearest = std::ranges::max_element(directions, nearer) - directions.begin();
      std::atomic_ref<std::uint8_t>{open[static_cast<std::size_t>(nearest)]}.store(1);
    }
  });
  std::vector<Vec3> out;
  for (std::uint32_t i = 0; i < all; ++i)
    if (open[i] != 0) out.push_back(directions[i]);
  return out;
}

// Texels reach over the borders of their charts: each part's are as large together as it is.
std::vector<float> area_factors(const Mesh& mesh, std::span<const std::uint32_t> part_of,
                                std::span<const float> areas) {
  std::vector<float> factors = part_areas(mesh);
  std::vector<double> sums(factors.size(), 0);
  for (std::size_t i = 0; i < areas.size(); ++i) sums[part_of[i]] += areas[i];
  for (std::size_t p = 0; p < factors.size(); ++p)
    factors[p] = sums[p] > 0 ? static_cast<float>(factors[p] / sums[p]) : 0.0f;
  return factors;
}

}  // namespace

// What rays from some places meet.
struct ScatterSources::Seen {
  std::vector<float> share;  // by block of sources: of the rays, over its area
  std::vector<Vec3> open;    // directions of those that meet nothing
  std::span<const Vec4> places;
  Vec3 middle{0};      // of the places
  float radiance = 0;  // that rays bring from surfaces, in the mean over all of them
};

ScatterSources::ScatterSources(const ScatteredScene& in) {
  lower_ = Vec3(std::numeric_limits<float>::max()), upper_ = Vec3(std::numeric_limits<float>::lowest());
  for (const Vec3& p : in.scene.mesh().positions) lower_ = glm::min(lower_, p), upper_ = glm::max(upper_, p);
  add_texels(in);
  add_emission(in, glm::length(upper_ - lower_) / kPiecesOfScene);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < sources_.size(); ++i)
    order.emplace_back(code_of(sources_[i].kind, sources_[i].position, sources_[i].normal), i);
  std::ranges::sort(order);
  std::vector<Source> ordered;
  for (const auto& [code, i] : order) ordered.push_back(sources_[i]), codes_.push_back(code);
  sources_ = std::move(ordered);
}

void ScatterSources::add_texels(const ScatteredScene& in) {
  const Mesh& mesh = in.scene.mesh();
  std::vector<std::uint32_t> part_of;
  std::vector<const PagePoint*> point_of;
  std::vector<float> areas;
  std::size_t points = 0;
  for (const std::vector<PagePoint>& of_page : in.points) points += of_page.size();
  const std::size_t step = points / kMostSources + 1;  // those left stand for the others
  for (std::uint32_t p = 0; p < in.pages.size(); ++p)
    for (std::size_t i = 0; i < in.points[p].size(); i += step) {
      const PagePoint& point = in.points[p][i];
      if (point.index >= in.pages[p].irradiance.size()) continue;
      sources_.push_back({point.position, point.normal, Vec3(0), 0, ScatterSource::kTexel, p, point.index});
      areas.push_back(texel_area(mesh, in.pages[p], point.first_index));
      part_of.push_back(point.part), point_of.push_back(&point);
    }
  const std::vector<float> factors = area_factors(mesh, part_of, areas);
  for_each_run(sources_.size(), core_count(), [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const PagePoint& point = *point_of[i];
      Source& source = sources_[i];
      source.area = areas[i] * factors[part_of[i]];
      source.lux = in.pages[source.index].irradiance[point.index];
      source.flux = source.area * source.lux * in.scene.reflectance(point.part, point.first_index, point.shares);
    }
  });
}

void ScatterSources::add_pieces(const Vec3& a, const Vec3& ab, const Vec3& ac, float longest, const Source& like) {
  const float side = std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
  const int cuts = std::clamp(static_cast<int>(std::ceil(side / std::max(longest, 1e-30f))), 1, kMostCuts);
  const float step = 1.0f / static_cast<float>(cuts), area = 0.5f * glm::length(glm::cross(ab, ac)) * step * step;
  for (int i = 0; i < cuts; ++i)
    for (int j = 0; i + j < cuts; ++j)
      for (int upper = 0; upper < (i + j + 1 < cuts ? 2 : 1); ++upper) {
        const float third = upper == 0 ? 1.0f / 3 : 2.0f / 3;
        Source piece = like;
        piece.position = a + step * ((static_cast<float>(i) + third) * ab + (static_cast<float>(j) + third) * ac);
        piece.area = area, piece.flux = area * like.flux;
        sources_.push_back(piece);
      }
}

// What shines: of two-sided materials both sides do.
void ScatterSources::add_emission(const ScatteredScene& in, float longest) {
  const Mesh& mesh = in.scene.mesh();
  shines_.assign(in.emission.size(), 0);
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    const MeshPart& part = mesh.parts[p];
    if (in.left_out[p] != 0 || luminance(in.emission[part.material]) <= 0) continue;
    shines_[part.material] = 1;
    for (std::size_t i = 0; i + 2 < part.index_count; i += 3) {
      const Triangle triangle = triangle_of(mesh, part.first_index + i);
      Source like;
      like.normal = normalize_or(glm::cross(triangle.ab, triangle.ac), Vec3(0));
      like.flux = kPi * in.emission[part.material];
      like.kind = ScatterSource::kEmission, like.index = part.material;
      if (like.normal == Vec3(0)) continue;
      add_pieces(triangle.a, triangle.ab, triangle.ac, longest, like);
      if (!in.scene.is_two_sided(part.material)) continue;
      like.normal = -like.normal;
      add_pieces(triangle.a, triangle.ab, triangle.ac, longest, like);
    }
  }
}

// The side that a surface faces comes first: the two sides of a wall lie together and have nothing in common.
std::uint64_t ScatterSources::code_of(ScatterSource kind, const Vec3& position, const Vec3& normal) const {
  const Vec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto side = static_cast<std::uint64_t>(2 * axis + (normal[axis] < 0 ? 1 : 0));
  const auto shines = static_cast<std::uint64_t>(kind == ScatterSource::kEmission ? 1 : 0);
  return shines << 63 | side << 60 | morton(position, lower_, max_component(upper_ - lower_));
}

std::optional<std::size_t> ScatterSources::nearest(ScatterSource kind, const Vec3& position, const Vec3& normal) const {
  const auto at = std::ranges::lower_bound(codes_, code_of(kind, position, normal)) - codes_.begin();
  std::optional<std::size_t> best;
  float least = std::numeric_limits<float>::infinity();
  for (auto i = std::max<std::ptrdiff_t>(at - 1, 0); i <= at && i < std::ssize(sources_); ++i) {
    const Source& source = sources_[static_cast<std::size_t>(i)];
    const float d2 = length2(source.position - position);
    if (source.kind == kind && d2 < least) best = static_cast<std::size_t>(i), least = d2;
  }
  return best;
}

std::size_t ScatterSources::block() const {
  return std::max<std::size_t>(sources_.size() / kBlocks, 1);
}

ScatterSources::Seen ScatterSources::look_around(const LampScene& around, std::span<const Vec4> places) const {
  std::vector<Vec3> ways(kRays);
  std::vector<std::array<std::size_t, 2>> met(kRays);  // blocks of what reflects there, and of what shines
  std::vector<std::uint8_t> open(kRays, 0);
  for_each_parallel(kRays, core_count(), [&](std::size_t ray) {
    const Vec4& place = places[ray % places.size()];
    const auto i = static_cast<double>(ray / places.size());
    const Vec3 in_cube(fraction(i * 0.8191725133961645), fraction(i * 0.6710436067037893),
                       fraction(i * 0.5497004779019703));
    // On this side of what is around: a sphere about what stands on a floor reaches below it.
    const Vec3 off = place.w * (2.0f * in_cube - 1.0f) / std::sqrt(3.0f);
    const auto before = around.first_surface(Vec3(place), off);
    const Vec3 from = Vec3(place) + (before && before->distance < 1 ? kBefore * before->distance : 1.0f) * off;
    ways[ray] = even_direction(static_cast<std::uint32_t>(i * 7919) % kMostDirections, kMostDirections);
    const auto surface = around.first_surface(from, ways[ray]);
    open[ray] = surface ? 0 : 1;
    met[ray] = {kNone, kNone};
    if (!surface || surface->normal == Vec3(0)) return;
    if (const auto texel = nearest(ScatterSource::kTexel, surface->position, surface->normal))
      met[ray][0] = *texel / block();
    if (shines_[surface->material] == 0) return;
    if (const auto piece = nearest(ScatterSource::kEmission, surface->position, surface->normal))
      met[ray][1] = *piece / block();
  });
  Seen seen;
  seen.places = places;
  seen.share.assign(sources_.size() / block() + 1, 0);
  for (const Vec4& place : places) seen.middle += Vec3(place) / static_cast<float>(places.size());
  for (std::uint32_t ray = 0; ray < kRays; ++ray) {
    if (open[ray] != 0) seen.open.push_back(ways[ray]);
    for (const std::size_t b : met[ray])
      if (b != kNone) seen.share[b] += 1.0f / kRays;
  }
  for (std::size_t b = 0; b < seen.share.size(); ++b) {
    float area = 0, flux = 0;
    for (std::size_t i = b * block(); i < std::min(sources_.size(), (b + 1) * block()); ++i)
      area += sources_[i].area, flux += luminance(sources_[i].flux);
    seen.share[b] = area > 0 ? seen.share[b] / area : 0.0f;
    seen.radiance += seen.share[b] * flux / kPi;
  }
  return seen;
}

// As Seen::share, if nothing were between.
float ScatterSources::open_share(const Source& source, std::span<const Vec4> places) {
  float sum = 0;
  for (const Vec4& place : places) {
    const Vec3 to = Vec3(place) - source.position;
    const float d2 = std::max({length2(to), place.w * place.w, 1e-12f});
    sum += std::max(glm::dot(source.normal, to), 0.0f) / (4 * kPi * d2 * std::sqrt(d2));
  }
  return sum / static_cast<float>(places.size());
}

// Systematic sampling along the order of places, each as often as it brings light. Of a block that is hidden but for a
// corner that corner is drawn too rarely, and would stand for too much: what it would be if nothing were hidden bounds
// that.
void ScatterSources::draw_surfaces(const Seen& seen, std::uint32_t count, std::vector<ScatteredLight>& out) const {
  const double each = double{seen.radiance} * kPi / count;
  if (!(each > 0) || !std::isfinite(each)) return;
  double sum = 0;
  std::uint32_t drawn = 0;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& s = sources_[i];
    const double own = double{luminance(s.flux)} * seen.share[i / block()];
    sum += own;
    std::uint32_t times = 0;
    while (drawn < count && sum >= (drawn + 0.5) * each) ++drawn, ++times;
    if (times == 0) continue;
    const double least = kLeastShare * open_share(s, seen.places) * luminance(s.flux);
    const auto stands_for = static_cast<float>(times * each / std::max(own, least));  // times itself
    ScatteredLight light;
    light.light.position = s.position, light.light.normal = s.normal;
    light.light.intensity = stands_for * s.flux / kPi, light.light.disk = stands_for * s.area / kPi;
    light.source = s.kind, light.index = s.index, light.texel = s.texel, light.before = s.lux;
    out.push_back(light);
  }
}

// The edges of what is open touch more directions than its share is: then there are fewer in all.
void ScatterSources::draw_sky(const Seen& seen, const Vec3& sky, std::uint32_t count,
                              std::vector<ScatteredLight>& out) const {
  const float share = static_cast<float>(seen.open.size()) / kRays;
  auto all = std::clamp(static_cast<std::uint32_t>(static_cast<float>(count) / share), 1u, kMostDirections);
  std::vector<Vec3> open = open_directions(seen.open, all);
  while (open.size() > count && all > 1) {
    all = std::max(static_cast<std::uint32_t>(kFewer * all * static_cast<float>(count) / open.size()), 1u);
    open = open_directions(seen.open, all);
  }
  const float distance = kSkyDistance * 0.5f * glm::length(upper_ - lower_);
  const float solid_angle = 4 * kPi / static_cast<float>(all);
  for (const Vec3& direction : open) {
    ScatteredLight light;
    light.light.position = seen.middle + distance * direction;
    light.light.disk = solid_angle / kPi * distance * distance;
    light.light.intensity = sky * (solid_angle * (distance * distance + light.light.disk));
    light.source = ScatterSource::kSky;
    out.push_back(light);
  }
}

std::vector<ScatteredLight> ScatterSources::draw(const LampScene& around, const Vec3& sky, std::span<const Vec4> places,
                                                 std::uint32_t count) const {
  std::vector<ScatteredLight> out;
  if (count == 0 || places.empty()) return out;
  const Seen seen = look_around(around, places);
  const float from_sky = luminance(sky) * static_cast<float>(seen.open.size()) / kRays;
  if (!(from_sky + seen.radiance > 0)) return out;
  const auto of_sky =
      static_cast<std::uint32_t>(std::lround(static_cast<float>(count) * from_sky / (from_sky + seen.radiance)));
  if (of_sky < count) draw_surfaces(seen, count - of_sky, out);
  if (of_sky > 0) draw_sky(seen, sky, of_sky, out);
  return out;
}

Vec3 ScatterSources::flux() const {
  Vec3 sum(0);
  for (const Source& s : sources_) sum += s.flux;
  return sum;
}

}  // namespace oriel
