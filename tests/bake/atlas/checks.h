// What every atlas must satisfy, whatever the scene.
#pragma once

#include <gtest/gtest.h>

#include <set>

#include "bake/atlas/texel_map.h"

namespace oriel {

struct Built {
  Atlas atlas;
  std::vector<TexelMapPage> map;
  std::vector<std::string> warnings;
};

inline Built build(const Scene& scene, const AtlasOptions& options = {}, int threads = 2) {
  Built built;
  Context context;
  context.threads = threads;
  context.warn = [&](const Warning& said) { built.warnings.push_back(said.text); };
  auto atlas = build_atlas(scene, options, context);
  EXPECT_TRUE(atlas.has_value()) << (atlas ? "" : atlas.error().text());
  if (!atlas) return built;
  built.atlas = std::move(*atlas);
  auto map = build_texel_map(built.atlas, context);
  EXPECT_TRUE(map.has_value());
  if (map) built.map = std::move(*map);
  return built;
}

inline Error build_error(const Scene& scene, const AtlasOptions& options) {
  Context context;
  auto atlas = build_atlas(scene, options, context);
  EXPECT_FALSE(atlas.has_value());
  return atlas ? Error{} : atlas.error();
}

// Texels of automatic pages that hold fragments of two charts.
inline std::size_t shared_texels(const Atlas& atlas, const std::vector<TexelMapPage>& map) {
  std::size_t shared = 0;
  for (std::size_t p = 0; p < map.size(); ++p) {
    if (atlas.pages[p].from_uv1) continue;
    for (std::size_t i = 0; i < map[p].texel.size(); ++i)
      for (std::uint32_t f = map[p].first[i] + 1; f < map[p].first[i + 1]; ++f)
        if (atlas.chart[map[p].fragments[f].triangle] != atlas.chart[map[p].fragments[map[p].first[i]].triangle]) {
          ++shared;
          break;
        }
  }
  return shared;
}

inline double fragment_area(const std::vector<TexelMapPage>& map) {
  double sum = 0;
  for (const TexelMapPage& page : map)
    for (const TexelFragment& f : page.fragments) sum += static_cast<double>(f.area);
  return sum;
}

inline std::size_t texel_count(const std::vector<TexelMapPage>& map) {
  std::size_t sum = 0;
  for (const TexelMapPage& page : map) sum += page.texel.size();
  return sum;
}

// Every lit triangle has a place, finite coordinates and at least one texel; no two charts share one and no chart
// covers one twice; order is kept.
inline void expect_sound(const Scene& scene, const Built& built) {
  const Atlas& atlas = built.atlas;
  ASSERT_EQ(atlas.page.size(), scene.triangles.size());
  ASSERT_EQ(built.map.size(), atlas.pages.size());
  std::vector<bool> seen(scene.triangles.size());
  for (std::size_t p = 0; p < built.map.size(); ++p) {
    const TexelMapPage& page = built.map[p];
    ASSERT_EQ(page.width, atlas.pages[p].width);
    ASSERT_EQ(page.first.size(), page.texel.size() + 1);
    for (std::size_t i = 0; i < page.texel.size(); ++i) {
      ASSERT_LT(page.texel[i], page.width * page.height);
      if (i > 0) {
        ASSERT_LT(page.texel[i - 1], page.texel[i]);
      }
      ASSERT_LT(page.first[i], page.first[i + 1]);
      double covered = 0;
      for (std::uint32_t f = page.first[i]; f < page.first[i + 1]; ++f) {
        const TexelFragment& fragment = page.fragments[f];
        if (f > page.first[i]) {
          ASSERT_LT(page.fragments[f - 1].triangle, fragment.triangle);
        }
        ASSERT_GT(fragment.area, 0.0f);
        ASSERT_LE(fragment.area, 1.0f);
        ASSERT_EQ(atlas.page[fragment.triangle], static_cast<int>(p));
        seen[fragment.triangle] = true;
        covered += static_cast<double>(fragment.area);
      }
      ASSERT_LT(covered, 1.01) << "texel " << page.texel[i] << " of page " << p << " is covered twice";
    }
  }
  std::set<std::uint32_t> charts;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    if (scene.material_of(t).unlit) {
      ASSERT_EQ(atlas.page[t], -1);
      continue;
    }
    ASSERT_TRUE(seen[t]) << "triangle " << t << " lies under no texel";
    ASSERT_LT(atlas.chart[t], atlas.chart_count);
    charts.insert(atlas.chart[t]);
    for (const Vec2& uv : atlas.uv[t]) ASSERT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1);
  }
  EXPECT_EQ(charts.size(), atlas.chart_count);
  EXPECT_EQ(shared_texels(atlas, built.map), 0u);
  // An artist's charts may touch.
  if (!atlas.pages[0].from_uv1) {
    EXPECT_EQ(atlas.report.overlapping_texels, 0u);
  }
}

}  // namespace oriel
