// The lists of one tile: a square of texels of a flat chart. Private to shadow_lists.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <ranges>
#include <vector>

#include "bake/radiosity/chart_surface.h"
#include "bake/radiosity/sharp_records.h"
#include "bake/radiosity/texels/lightmap_scene.h"
#include "bake/radiosity/texels/sharp_charts.h"
#include "bake/trace/punctual.h"
#include "bake/trace/sampler.h"
#include "formats/core/color.h"

namespace oriel {

inline constexpr std::uint32_t kTile = 16;  // texels a side, that are looked at together first
inline constexpr std::size_t kListed = 4,
                             kListedAtLast = 16;   // triangles for one lamp: with more, quarters have fewer each
inline constexpr std::size_t kMostOfTexel = 2048;  // words: with more it is made again with fewer quarters
inline constexpr int kFilterSplits = 3;            // from eighths of a texel on rays find edges of cut-outs and panes
inline constexpr std::uint32_t kFewRays = 2, kRays = 4;  // a side
inline constexpr std::uint32_t kRaysOfEdge = 8;          // a side, that a screen's edge is fitted to
inline constexpr double kWider = 1.25;    // squares and suns in which casters are sought: what rays just miss shows
inline constexpr float kLitShare = 0.5f;  // of the most that arrives: less is neither lit nor dark
inline constexpr double kParted = 0.4;  // of a square: from the middle of what is lit to that of what is dark, half for
                                        // an edge, a third for a penumbra
inline constexpr double kOver = 8;      // height of a screen over a square, in levels

// A square of texels or of a part of one, in texels of the chart's page.
struct Square {
  DVec2 lower{0};
  double side = 1;
  Square quarter(std::uint32_t k) const { return {lower + 0.5 * side * DVec2(k & 1u, k >> 1u), 0.5 * side}; }
};

// A lamp whose shadows in a square are not settled: what may stand in its way.
struct Unsettled {
  std::uint32_t lamp = 0;
  std::vector<std::uint32_t> casters;
};

// The records of a tile's texels, by y * kTile + x; several may be one.
using TileRecords = std::vector<std::shared_ptr<const SharpRecord>>;

// What all tiles ask.
struct ListedScene {
  const LightmapScene& scene;
  const SharpCharts& sharp;
  const ShadowCasters& casters;
  std::vector<std::vector<std::uint32_t>> charts;  // charts_of_texels()
};

class TileLister {
 public:
  TileLister(const ListedScene& in, std::uint32_t chart)
      : scene_(in.scene),
        sharp_(in.sharp),
        casters_(in.casters),
        chart_number_(chart),
        chart_(in.sharp.charts[chart]),
        surface_{in.scene.atlas, in.scene.map[chart_.page], in.charts[chart_.page], chart},
        level_(kLevel * double{in.scene.transport.accel.scene().radius()} + chart_.off) {}

  std::uint64_t rays() const { return rays_; }

  TileRecords list(const UVec2& lower) {
    TileRecords records(std::size_t{kTile} * kTile);
    const Square tile{DVec2(lower), kTile};
    std::vector<Unsettled> lamps;
    for (std::uint32_t lamp = 0; lamp < sharp_.lights.size(); ++lamp) {
      if (!chart_.sharp[sharp_.lights[lamp]]) continue;
      const ShadowBeam beam = beam_to(lamp, tile);
      if (!beam.faces_lamp() || is_beyond_cone(lamp, tile)) continue;
      lamps.push_back({lamp, casters_.in(beam, lamp)});
      std::erase_if(lamps.back().casters, [&](std::uint32_t t) { return is_own(t); });
    }
    fill(tile, lower, std::move(lamps), {}, records);
    return records;
  }

 private:
  enum class Light { kNone, kSettled, kOpen };
  struct Look {
    Light light = Light::kNone;
    LampShine shine;
    std::vector<std::uint32_t> casters;  // kOpen
  };

  const oriel::Light& light_of(std::uint32_t lamp) const {
    return scene_.transport.accel.scene().lights[sharp_.lights[lamp]];
  }

  static bool has_disk(const oriel::Light& light) {
    return light.type == LightType::kDirectional && light.angular_radius_rad > 0;
  }

  // Of the chart itself, or its other side.
  bool is_own(std::uint32_t t) const {
    const std::vector<std::uint32_t>& twin = scene_.transport.accel.scene().twin;
    const auto chart_of = [&](std::uint32_t triangle) { return triangle == ~0u ? ~0u : scene_.atlas.chart[triangle]; };
    return chart_of(t) == chart_number_ || (!twin.empty() && chart_of(twin[t]) == chart_number_);
  }

  ShadowBeam beam_to(std::uint32_t lamp, const Square& s) const {
    const double wider = has_disk(light_of(lamp)) ? kWider : 1, more = 0.5 * (wider - 1) * s.side;
    const DVec2 a = s.lower - more, b = s.lower + s.side + more;
    return {light_of(lamp),
            {chart_.at(a), chart_.at({b.x, a.y}), chart_.at(b), chart_.at({a.x, b.y})},
            chart_.normal,
            level_,
            wider};
  }

  bool is_beyond_cone(std::uint32_t lamp, const Square& s) const {
    const oriel::Light& light = light_of(lamp);
    if (light.type != LightType::kSpot || light.profile >= 0) return false;
    const DVec3 to = chart_.at(s.lower + 0.5 * s.side) - DVec3(light.position);
    const double reach = 0.5 * s.side * (glm::length(chart_.along_x) + glm::length(chart_.along_y));
    const double distance = glm::length(to);
    if (distance <= reach) return false;
    const double off = std::acos(std::clamp(glm::dot(to, DVec3(light.direction)) / distance, -1.0, 1.0));
    return off - std::asin(reach / distance) > double{light.outer_cone_rad};
  }

  // Settles what it can in a square of whole texels and goes on in its quarters.
  void fill(const Square& square, const UVec2& first, std::vector<Unsettled> lamps, std::vector<LampShine> settled,
            TileRecords& records) {
    const auto side = static_cast<std::uint32_t>(square.side);
    const UVec2 lower(square.lower);
    const auto is_covered = [&](std::uint32_t k) {
      return surface_.is_of_texel(lower.x + k % side, lower.y + k / side);
    };
    if (std::ranges::none_of(std::views::iota(0u, side * side), is_covered)) return;
    if (side == 1) {
      SharpRecord record;
      for (most_splits_ = kMostSharpSplits; most_splits_ >= 0; --most_splits_) {
        words_ = 0;
        record = part(square, 0, lamps, settled);
        if (words_ <= kMostOfTexel) break;
      }
      if (record.is_split() || !record.shines.empty())
        records[std::size_t{lower.y - first.y} * kTile + lower.x - first.x] =
            std::make_shared<SharpRecord>(std::move(record));
      return;
    }
    lamps = settle(square, std::move(lamps), settled, 0);
    if (lamps.empty()) {
      std::ranges::sort(settled, {}, &LampShine::lamp);
      const auto record =
          settled.empty() ? nullptr : std::make_shared<SharpRecord>(SharpRecord{std::move(settled), {}});
      for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x)
          records[std::size_t{lower.y - first.y + y} * kTile + lower.x - first.x + x] = record;
      return;
    }
    for (std::uint32_t k = 0; k < 4; ++k) fill(square.quarter(k), first, lamps, settled, records);
  }

  // Ends early where a texel has too many words.
  SharpRecord part(const Square& square, int splits, std::vector<Unsettled> lamps, std::vector<LampShine> settled) {
    SharpRecord record;
    if (words_ > kMostOfTexel) return record;
    // Lightmap coordinates are rounded: what is close beside it may be shown.
    if (!surface_.meets(square.lower, square.side, 2.0 / (1 << kMostSharpSplits))) lamps.clear(), settled.clear();
    lamps = settle(square, std::move(lamps), settled, splits + 1);
    if (lamps.empty()) std::ranges::sort(settled, {}, &LampShine::lamp), record.shines = std::move(settled);
    for (std::uint32_t k = 0; k < 4 && !lamps.empty(); ++k)
      record.quarters[k] = std::make_unique<SharpRecord>(part(square.quarter(k), splits + 1, lamps, settled));
    words_ += record.words();
    return record;
  }

  // Moves lamps that are settled to `settled`; those that are dark are gone. splits: 0 for whole texels; else one more
  // than a texel's splits so far.
  std::vector<Unsettled> settle(const Square& square, std::vector<Unsettled> lamps, std::vector<LampShine>& settled,
                                int splits) {
    std::vector<Unsettled> open;
    for (const Unsettled& lamp : lamps) {
      Look found = look(square, lamp, splits);
      if (found.light == Light::kSettled) settled.push_back(std::move(found.shine));
      if (found.light == Light::kOpen) open.push_back({lamp.lamp, std::move(found.casters)});
    }
    return open;
  }

  Look look(const Square& square, const Unsettled& lamp, int splits) {
    const ShadowBeam beam = beam_to(lamp.lamp, square);
    if (is_beyond_cone(lamp.lamp, square)) return {};
    LampShine shine{lamp.lamp, Vec3(1), {}, {}, {}};
    for (const std::uint32_t t : lamp.casters)
      if (beam.may_meet(casters_.triangle(t))) shine.casters.push_back(t);
    if (shine.casters.empty()) return {Light::kSettled, std::move(shine), {}};
    if (casters_.stop_all(beam, shine.casters, lamp.lamp)) return {};
    bool edges = false, rims = false, filters = false, patterned = false;
    std::size_t opaque = 0;
    for (const std::uint32_t t : shine.casters) {
      const BeamTriangle& triangle = casters_.triangle(t);
      std::uint8_t bits = 0;
      bool near = casters_.is_patterned(t) || beam.is_cut_by(triangle);
      for (std::size_t k = 0; k < 3; ++k) {
        if (!casters_.ends_shadow(t, k, lamp.lamp)) continue;
        const DVec3 &a = triangle[k], &b = triangle[(k + 1) % 3];
        if (!beam.in_plane(a, b)) bits |= static_cast<std::uint8_t>(1u << k);
        near = near || beam.may_meet(a, b);
      }
      shine.edges.push_back(bits);
      edges = edges || near;
      filters = filters || casters_.is_filter(t);
      patterned = patterned || casters_.is_patterned(t);
      rims = rims || (near && casters_.is_filter(t));
      opaque += casters_.is_filter(t) ? 0 : 1;
    }
    if (!edges) {
      const Rays few = rays_to(square, lamp.lamp, kFewRays);
      if (few.beyond && splits <= most_splits_) return {Light::kOpen, {}, std::move(shine.casters)};
      if (few.even()) return arrived(lamp.lamp, few.mean());
    }
    // Within an eighth of a texel a pane's rim is a share of the tint of what is listed.
    rims = rims && (patterned || splits <= kFilterSplits);
    const bool last = splits > most_splits_ || (rims && splits > kFilterSplits + 1);
    const auto is_list = [&](std::size_t most) { return splits > 0 && !rims && opaque <= most; };
    if (is_list(kListed) && list(square, filters, shine)) return {Light::kSettled, std::move(shine), {}};
    if (splits > 0 && !patterned)
      if (std::optional<Look> fit = fitted(square, beam, shine)) return std::move(*fit);
    if (!last && rims && splits > kFilterSplits)
      if (std::optional<Look> parted = screened(square, lamp.lamp, false)) return std::move(*parted);
    if (!last) return {Light::kOpen, {}, std::move(shine.casters)};
    if (is_list(kListedAtLast) && list(square, filters, shine)) return {Light::kSettled, std::move(shine), {}};
    return *screened(square, lamp.lamp, true);
  }

  // Whether light comes past what is opaque of it; panes that reach beyond the square become its tint.
  bool list(const Square& square, bool filters, LampShine& shine) {
    if (!filters) return true;
    const Rays rays = rays_to(square, shine.lamp, kRays);
    shine.tint = rays.tint();
    if (shine.tint == Vec3(0)) return false;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < shine.casters.size(); ++i)
      if (!casters_.is_filter(shine.casters[i]))
        shine.casters[kept] = shine.casters[i], shine.edges[kept++] = shine.edges[i];
    shine.casters.resize(kept), shine.edges.resize(kept);
    if (kept == 0) shine.tint = rays.mean();
    return true;
  }

  // Of a sun whose penumbrae are wider than the square: few triangles between real edges.
  std::optional<Look> fitted(const Square& square, const ShadowBeam& beam, const LampShine& shine) {
    if (!has_disk(light_of(shine.lamp))) return std::nullopt;
    const DVec3 corner = chart_.at(square.lower), middle = chart_.at(square.lower + 0.5 * square.side),
                other = chart_.at(square.lower + DVec2(square.side, 0));
    ScreenFit fit(light_of(shine.lamp), middle, std::max(glm::distance(corner, middle), glm::distance(other, middle)));
    for (const std::uint32_t t : shine.casters)
      for (std::size_t k = 0; k < 3 && !casters_.is_filter(t); ++k) {
        const auto& triangle = casters_.triangle(t);
        const DVec3 &a = triangle[k], &b = triangle[(k + 1) % 3];
        if (casters_.ends_shadow(t, k, shine.lamp) && beam.may_meet(a, b)) fit.add_edge(a, b, triangle[(k + 2) % 3]);
      }
    if (!fit.is_soft()) return std::nullopt;
    Rays rays = rays_to(square, shine.lamp, kRays, kWider);
    if (rays.even()) rays = rays_to(square, shine.lamp, kRaysOfEdge, kWider);
    if (!rays.even()) rays = rays_to(square, shine.lamp, kFitSide, kWider);
    if (rays.dim) return std::nullopt;
    if (rays.even()) return arrived(shine.lamp, rays.mean());
    std::bitset<kFitRays> lit;
    for (std::size_t i = 0; i < kFitRays; ++i) lit[i] = i >= rays.lit.size() || rays.lit[i] > 0;
    std::optional<std::vector<Screen>> screens = fit.fit(rays.rays, lit);
    if (!screens) return std::nullopt;
    return Look{Light::kSettled, {shine.lamp, rays.tint(), {}, {}, std::move(*screens)}, {}};
  }

  // One triangle just over the square in place of too many: its shadow's edge is the straight line that parts what rays
  // find lit from what they find dark, and leaves as much of the square lit as they find. Where nothing parts them, a
  // share; none where quarters may know more. There half a row of rays may be wrong: a bend needs no finer squares.
  std::optional<Look> screened(const Square& square, std::uint32_t lamp, bool last) {
    const Rays rays = rays_to(square, lamp, kRaysOfEdge);
    if (rays.dim || rays.even()) return arrived(lamp, rays.mean());
    DVec2 of_lit(0), of_dark(0);
    for (std::size_t k = 0; k < rays.lit.size(); ++k)
      of_lit += rays.lit[k] * rays.places[k], of_dark += (1 - rays.lit[k]) * rays.places[k];
    const auto count = static_cast<double>(rays.lit.size());
    const DVec2 across = of_lit / rays.sum - of_dark / (count - rays.sum);
    if (glm::length(across) < kParted) return last ? std::optional(arrived(lamp, rays.mean())) : std::nullopt;
    const DVec2 towards = glm::normalize(across), along(-towards.y, towards.x);
    std::vector<double> at;
    for (const DVec2& place : rays.places) at.push_back(glm::dot(towards, place - 0.5));
    std::ranges::sort(at);
    const auto dark = std::min(static_cast<std::size_t>(count - rays.sum), at.size() - 1);
    const DVec2 edge = 0.5 + towards * (0.5 * (at[dark - (dark > 0)] + at[dark]));
    std::size_t astray = 0;
    for (std::size_t k = 0; k < rays.lit.size(); ++k)
      astray += (glm::dot(towards, rays.places[k] - edge) > 0) != (rays.lit[k] > 0) ? 1 : 0;
    if (!last && 2 * kRaysOfEdge * astray > rays.lit.size()) return std::nullopt;
    const BeamTriangle corners{over(square, edge - kScreen * along, lamp), over(square, edge + kScreen * along, lamp),
                               over(square, edge - 2 * kScreen * towards, lamp)};
    return Look{Light::kSettled, {lamp, rays.tint(), {}, {}, {{corners, 1}}}, {}};
  }

  // A place of a square, its sides being 1, on the way from there to the lamp, just over the chart.
  DVec3 over(const Square& square, const DVec2& place, std::uint32_t lamp) const {
    const oriel::Light& light = light_of(lamp);
    const DVec3 at = chart_.at(square.lower + square.side * place);
    const DVec3 way = light.type == LightType::kDirectional ? -DVec3(light.direction) : DVec3(light.position) - at;
    return at + way * (kOver * level_ / std::max(glm::dot(way, chart_.normal), kOver * level_));
  }

  static Look arrived(std::uint32_t lamp, const Vec3& share) {
    if (!(max_component(share) > 0)) return {};
    return {Light::kSettled, {lamp, share, {}, {}, {}}, {}};
  }

  // The share of a lamp's light that arrives in a square, by so many rays a side.
  struct Rays {
    Vec3 all{0}, most{0};  // what arrives: of all rays, and the most
    std::vector<Ray> rays;
    std::vector<DVec2> places;  // in the square, its sides being 1
    std::vector<double> lit;    // by ray: 1, or 0; what a pane lets through is lit, too
    double sum = 0;             // of `lit`
    bool dim = false;           // of some rays so little arrives that they are neither lit nor dark
    bool beyond = false;        // no place of them is the chart's
    Vec3 mean() const { return all / static_cast<float>(lit.size()); }
    Vec3 tint() const { return all / static_cast<float>(std::max(sum, 1.0)); }  // of what is lit
    bool even() const { return sum == 0 || sum == static_cast<double>(lit.size()); }
  };
  // From the chart where it can: rays from beyond its end tell nothing of it, they may start in a wall that meets it
  // there. wider: how many times the square and a sun's disk are as wide.
  Rays rays_to(const Square& square, std::uint32_t lamp, std::uint32_t side, double wider = 1) {
    const oriel::Light& light = light_of(lamp);
    Rays out;
    std::vector<DVec2> places;
    for (std::uint32_t k = 0; k < side * side; ++k) {
      places.push_back(0.5 + wider * ((DVec2(k % side, k / side) + 0.5) / double(side) - 0.5));
      if (surface_.meets(square.lower + square.side * places[k], 0, 0)) out.places.push_back(places[k]);
    }
    out.beyond = out.places.empty();
    if (out.beyond) out.places = places;
    std::vector<Ray>& rays = out.rays;
    for (std::uint32_t k = 0; k < out.places.size(); ++k) {
      Ray ray;
      const Vec3 at(chart_.at(square.lower + square.side * out.places[k]) + 8 * level_ * chart_.normal);
      ray.origin = offset_origin(at, Vec3(chart_.normal), max_component(glm::abs(at)));
      ray.past_frosted = false;
      if (light.type == LightType::kDirectional) {
        ray.direction = light.angular_radius_rad > 0
                            ? sample_cone(-light.direction, static_cast<float>(wider) * light.angular_radius_rad,
                                          Sampler(0, 0, k).next2())
                            : -light.direction;
      } else {
        const Vec3 to = light.position - ray.origin;
        ray.max_distance = glm::length(to);
        ray.direction = to / ray.max_distance;
      }
      rays.push_back(ray);
    }
    std::vector<Vec3> passed(rays.size());
    scene_.transport.accel.transmittance(rays, passed);
    rays_ += rays.size();
    for (const Vec3& share : passed) {
      out.all += share;
      out.most = glm::max(out.most, share);
      out.sum += out.lit.emplace_back(max_component(share) > 0 ? 1 : 0);
    }
    for (const Vec3& share : passed)
      out.dim = out.dim || (max_component(share) > 0 && luminance(share) < kLitShare * luminance(out.most));
    return out;
  }

  const LightmapScene& scene_;
  const SharpCharts& sharp_;
  const ShadowCasters& casters_;
  std::uint32_t chart_number_;
  const ChartGrid& chart_;
  ChartSurface surface_;
  double level_;
  int most_splits_ = kMostSharpSplits;
  std::size_t words_ = 0;  // of the texel so far
  std::uint64_t rays_ = 0;
};

}  // namespace oriel
