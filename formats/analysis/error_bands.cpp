#include "formats/analysis/error_bands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "formats/analysis/texel_places.h"
#include "formats/core/color.h"
#include "formats/image/contrast_sensitivity.h"

namespace oriel {
namespace {

constexpr int kAround = 3;         // 8 texels: errors are relative to the light of such blocks
constexpr double kDarkBand = 0.1;  // of the mean light
constexpr std::size_t kMostEyes = 512;
constexpr float kFar_m = 2;      // of an eye, where a pack tells of none before a surface
constexpr float kNear_m = 0.3f;  // nobody looks from closer

// Texels side by side of one part, as they are on a page. Blocks never join two of these: charts lie beside each other
// on a page that are far apart in the world.
struct Block {
  std::uint32_t group = 0;  // connected texels
  std::uint32_t x = 0, y = 0;
  std::uint32_t part = 0;
  double texels = 0;
  double light = 0;         // Σ of the reference, lux
  double off = 0;           // Σ of differences: lux, later relative
  double noise = 0;         // Σ of the reference's squared standard errors, likewise
  double side_degrees = 0;  // Σ of texels' sides, as the nearest eye sees them

  bool same_place(const Block& b) const { return group == b.group && x == b.x && y == b.y; }
  void add(const Block& b) {
    texels += b.texels, light += b.light, off += b.off, noise += b.noise, side_degrees += b.side_degrees;
  }
  double mean() const { return off / texels; }
};

// Blocks of twice the side; parent: by block, its place in them.
std::vector<Block> joined(const std::vector<Block>& blocks, std::vector<std::uint32_t>& parent) {
  std::vector<std::uint32_t> order(blocks.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) { return std::tuple(blocks[i].group, blocks[i].y / 2, blocks[i].x / 2); };
  std::ranges::stable_sort(order, {}, place);
  std::vector<Block> larger;
  parent.resize(blocks.size());
  for (const std::uint32_t i : order) {
    Block block = blocks[i];
    block.x /= 2, block.y /= 2;
    if (larger.empty() || !larger.back().same_place(block))
      larger.push_back(block);
    else
      larger.back().add(block);
    parent[i] = static_cast<std::uint32_t>(larger.size() - 1);
  }
  return larger;
}

std::vector<Vec3> eyes_of(const Pack& reference, const Pack& pack) {
  std::vector<Vec3> all;
  for (const Pack* of : {&reference, &pack}) {
    for (const Camera& camera : of->cameras) all.push_back(camera.eye);
    for (const WalkGrid& grid : of->walk_grids)
      for (std::size_t cell = 0; cell < grid.floor_y.size(); ++cell)
        if (grid.walkable(cell)) all.push_back(grid.eye(cell));
  }
  std::vector<Vec3> some;
  const std::size_t count = std::min(all.size(), kMostEyes);
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return some;
}

double side_degrees(const TexelPlace& place, const std::vector<Vec3>& eyes) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const Vec3& eye : eyes)
    if (const Vec3 to = eye - place.position; glm::dot(to, place.normal) > 0) nearest = std::min(nearest, length2(to));
  const float distance = std::isfinite(nearest) ? std::max(std::sqrt(nearest), kNear_m) : kFar_m;
  return std::atan(double{place.side_m} / distance) * 180 / kPiD;
}

// Texels valid in both packs whose centres lie on a surface.
std::vector<Block> blocks_of(const Pack& reference, const Pack& pack) {
  const auto places = texel_places(reference);
  const std::vector<Vec3> eyes = eyes_of(reference, pack);
  std::vector<Block> blocks;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const LightmapPage &truth = reference.lightmaps[p], &page = pack.lightmaps[p];
    const auto first = static_cast<std::uint32_t>(blocks.size());
    std::vector<std::uint32_t> at(places[p].size(), ~0u), parent;
    const auto root = [&](std::uint32_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    for (std::uint32_t i = 0; i < places[p].size(); ++i) {
      const TexelPlace& place = places[p][i];
      if (place.part == TexelPlace::kNowhere) continue;
      if (truth.state[i] != TexelState::kValid || page.state[i] != TexelState::kValid) continue;
      const std::uint32_t x = i % page.width, y = i / page.width;
      const double light = luminance(truth.irradiance[i]), error = luminance(truth.standard_error[i]);
      const auto number = static_cast<std::uint32_t>(parent.size());
      at[i] = number;
      parent.push_back(number);
      blocks.push_back({0, x, y, place.part, 1, light, luminance(page.irradiance[i]) - light, error * error,
                        side_degrees(place, eyes)});
      const auto join = [&](std::uint32_t other) {
        if (at[other] != ~0u && blocks[first + at[other]].part == place.part) parent[root(number)] = root(at[other]);
      };
      if (x > 0) join(i - 1);
      if (y > 0) join(i - page.width);
    }
    for (std::uint32_t i = 0; i < parent.size(); ++i) blocks[first + i].group = first + root(i);
  }
  return blocks;
}

// From lux to shares of the light around, by blocks of so many joins.
void make_relative(std::vector<Block>& texels) {
  double light = 0;
  for (const Block& t : texels) light += t.light;
  const double dark = kDarkBand * light / static_cast<double>(texels.size());
  std::vector<Block> around = texels;
  std::vector<std::uint32_t> of(texels.size()), parent;
  std::iota(of.begin(), of.end(), 0u);
  for (int k = 0; k < kAround; ++k) {
    around = joined(around, parent);
    for (std::uint32_t& i : of) i = parent[i];
  }
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const double mean = around[of[i]].light / around[of[i]].texels;
    const double scale = std::sqrt(mean * mean + dark * dark);
    texels[i].off = scale > 0 ? texels[i].off / scale : 0;
    texels[i].noise = scale > 0 ? texels[i].noise / (scale * scale) : 0;
  }
}

// Sums of squares, by part.
struct Squares {
  double texels = 0, wider = 0, visible = 0;
  std::array<double, kErrorBands> band{};

  void add(const Squares& s) {
    texels += s.texels, wider += s.wider, visible += s.visible;
    for (std::size_t k = 0; k < kErrorBands; ++k) band[k] += s.band[k];
  }
  BandErrors errors() const {
    const auto root = [&](double square) { return texels > 0 ? std::sqrt(std::max(square / texels, 0.0)) : 0; };
    BandErrors e{static_cast<std::uint64_t>(texels), {}, root(wider), root(visible)};
    for (std::size_t k = 0; k < kErrorBands; ++k) e.band[k] = root(band[k]);
    return e;
  }
};

// What blocks differ by from those that hold them, without what noise makes of it: var(m - M) of a mean m of n out of
// N is var(m) (1 - 2 n / N) + var(M).
void add_band(const std::vector<Block>& blocks, const std::vector<Block>& larger,
              const std::vector<std::uint32_t>& parent, std::size_t band, std::vector<Squares>& parts) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block &b = blocks[i], &of = larger[parent[i]];
    const double off = b.mean() - of.mean(), variance = b.noise / (b.texels * b.texels);
    const double noise = variance * (1 - 2 * b.texels / of.texels) + of.noise / (of.texels * of.texels);
    const double square = b.texels * (off * off - noise);
    const double stripe = std::exp2(static_cast<double>(band)) * b.side_degrees / b.texels;
    const double sensitivity = contrast_sensitivity(1 / (2 * stripe));
    parts[b.part].band[band] += square;
    parts[b.part].visible += 2 * sensitivity * sensitivity * square;  // a grating's amplitude is √2 of its mean square
  }
}

}  // namespace

bool same_texels(const Pack& a, const Pack& b) {
  return a.mesh.lightmap_uvs == b.mesh.lightmap_uvs &&
         std::ranges::equal(a.lightmaps, b.lightmaps, [](const LightmapPage& p, const LightmapPage& q) {
           return p.width == q.width && p.height == q.height;
         });
}

std::optional<ErrorBands> error_bands(const Pack& reference, const Pack& pack) {
  if (!same_texels(reference, pack)) return std::nullopt;
  std::vector<Block> blocks = blocks_of(reference, pack);
  if (blocks.empty()) return std::nullopt;
  make_relative(blocks);
  std::vector<Squares> parts(reference.mesh.parts.size());
  for (const Block& texel : blocks) ++parts[texel.part].texels;
  std::vector<std::uint32_t> parent;
  for (std::size_t band = 0; band < kErrorBands; ++band) {
    std::vector<Block> larger = joined(blocks, parent);
    add_band(blocks, larger, parent, band, parts);
    blocks = std::move(larger);
  }
  for (const Block& b : blocks) parts[b.part].wider += b.texels * b.mean() * b.mean() - b.noise / b.texels;
  ErrorBands out;
  Squares all;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].texels == 0) continue;
    all.add(parts[p]);
    out.parts.push_back({p, parts[p].errors()});
  }
  out.all = all.errors();
  std::ranges::stable_sort(out.parts, std::greater(), [](const PartBands& p) { return p.errors.texels; });
  return out;
}

}  // namespace oriel
