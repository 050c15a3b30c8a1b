// The covered texels of all pages as one list: where light is gathered, and what a ray that hits them finds.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "bake/radiosity/texels/diffuse_share.h"
#include "bake/radiosity/texels/lightmap_scene.h"
#include "bake/radiosity/texels/texel_part.h"
#include "bake/trace/polygon_light.h"

namespace oriel {

inline constexpr std::uint32_t kNoTexel = std::numeric_limits<std::uint32_t>::max();

// A point of a texel: where rays leave it (already moved off the surface), and its normals.
struct TexelSite {
  Vec3 origin{0};
  Vec3 normal{0, 0, 1};            // shading normal
  Vec3 geometric_normal{0, 0, 1};  // of the real surface

  Receiver receiver() const { return {origin, normal, geometric_normal}; }
};

inline void fields(Archive& archive, TexelSite& site) {
  archive(site.origin, site.normal, site.geometric_normal);
}

// Two halves of every texel's estimate share nothing, neither points nor directions: their difference tells the error.
inline constexpr int kHalves = 2;
inline constexpr int kSitesPerHalf = 4;
inline constexpr int kSites = kHalves * kSitesPerHalf;

struct Texels {
  // By texel.
  std::vector<std::uint32_t> page, index;           // into the texel map: page, and TexelMapPage::texel[index]
  std::vector<std::uint32_t> x, y;                  // on the page
  std::vector<std::uint32_t> chart;                 // of Atlas
  std::vector<std::array<TexelSite, kSites>> site;  // [half * kSitesPerHalf + k]; not buried, stratified over the texel
  // Texels that are partly hidden, or that something stands or hangs close to: their light varies more over them, and
  // so they have more sites, by half.
  std::unordered_map<std::uint32_t, std::array<std::vector<TexelSite>, kHalves>> many_sites;
  std::vector<char> has_many;  // whether it is in many_sites
  std::vector<float> visible;  // share of the texel that is not inside other geometry nor in a gap; 0: no site
  std::vector<float> covered;  // share of the texel that has a surface
  std::vector<float> area_m2;
  std::vector<Vec3> albedo;  // diffuse, mean over the texel
  std::vector<DiffuseShare> diffuse_share;

  std::vector<Vec3> eyes;  // that points must be in sight of; none: all are (trace/onlookers.h)

  std::size_t count() const { return page.size(); }
  std::vector<bool> has_light() const {
    std::vector<bool> has;
    for (const float share : visible) has.push_back(share > 0);
    return has;
  }
  // How far a ray leaves a point that lies in no gap, m.
  float gap_reach(std::size_t i) const {
    return std::min(kGapReach_m, kGapTexels * std::sqrt(area_m2[i] / std::max(covered[i], 0.1f)));
  }
  float seen(std::size_t i) const { return covered[i] * visible[i]; }  // seen_share()

  std::uint32_t kept_sites(std::uint32_t i, int half) const {
    return has_many[i] ? static_cast<std::uint32_t>(many_sites.at(i)[half].size()) : kSitesPerHalf;
  }
  // The k-th site of a half, again from the first where there are no more. The texel must be visible.
  const TexelSite& site_for(std::uint32_t i, int half, std::uint32_t k) const {
    if (!has_many[i]) return site[i][half * kSitesPerHalf + k % kSitesPerHalf];
    const std::vector<TexelSite>& many = many_sites.at(i)[half];
    return many[k % many.size()];
  }

  std::unordered_map<std::uint32_t, TexelPart> cut;  // texels on which a wall stands
  std::vector<char> is_cut;                          // whether it is in `cut`

  // The texel under a point of a triangle, or the one beside it where a wall or a lamp parts it from the point;
  // kNoTexel where it takes no lightmap, and where a wall parts that one from it too.
  std::uint32_t find(std::uint32_t triangle, const Vec2& barycentric) const {
    return place(triangle, barycentric).texel;
  }
  // in_lit_gap: the point lies under a lamp, its texel is beside it. From afar nothing but the gap's rim is seen, where
  // its light ends within centimetres: no texel tells of it.
  struct Place {
    std::uint32_t texel = kNoTexel;
    bool in_lit_gap = false;
    std::uint32_t lies_on = kNoTexel;  // whatever parts it

    // Whether only the point itself tells its light: it has a texel, and no texel speaks of it.
    bool is_untold() const { return in_lit_gap || (texel == kNoTexel && lies_on != kNoTexel); }
  };
  Place place(std::uint32_t triangle, const Vec2& barycentric) const;
  // The texel that tells of what lies under a lamp on a texel that has_lamp().
  std::uint32_t under_lamp(std::uint32_t texel) const { return beside(texel, cut.at(texel).towards_lamp()); }
  // How large a square metre of a triangle is on its page, in texels; 0 where it has no area or no page.
  float texels2_per_m2(const Scene& scene, std::uint32_t triangle) const;
  // Whether a wall parts that point from the texel on which it lies.
  bool parts(std::uint32_t triangle, const Vec2& barycentric) const;
  // The texel at a place of a page; kNoTexel where none is.
  std::uint32_t at(std::uint32_t page_number, int px, int py) const;

  struct Page {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint32_t> number;  // by y * width + x; empty where few places of the page have a texel:
    std::vector<std::uint32_t> place;   // then y * width + x of each of them, ascending,
    std::uint32_t first = 0;            // and the number of the first
  };
  std::vector<Page> pages;
  struct Placement {  // of a triangle on its page, in texels
    Vec2 corner{0}, edge1{0}, edge2{0};
    std::int32_t page = -1;
  };
  std::vector<Placement> placement;

 private:
  std::uint32_t beside(std::uint32_t texel, const IVec2& step) const;  // of its chart; itself where none lies there
  std::uint32_t across_wall(std::uint32_t texel, std::uint32_t triangle, const Vec2& barycentric, const Vec2& p) const;
};

struct TexelUse {
  std::span<const Vec3> eyes{};  // from which somebody looks; what none of them can see in a gap counts as hidden.
                                 // None: nothing does
  bool met = true;               // by rays; false: albedo and diffuse_share are not needed
  std::uint32_t fewer = 1;       // times as few points are tried of a texel that is partly hidden: small ones need few
};
Result<Texels> list_texels(const LightmapScene& scene, const Stage& stage, const TexelUse& use = {});

// Area of surface under a texel, m².
double texel_area_m2(const Scene& scene, const Atlas& atlas, const TexelMapPage& map, std::size_t i);

}  // namespace oriel
