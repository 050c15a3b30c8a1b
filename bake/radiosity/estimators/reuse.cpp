#include "bake/radiosity/estimators/reuse.h"

#include <algorithm>
#include <cmath>

#include "bake/jobs/units.h"

namespace oriel {
namespace {

constexpr std::size_t kTile = 64;  // texels, as FinalGather groups them
constexpr double kDarkest = 0.01;  // of the mean: the change of darker texels is relative to it

void fields(Archive& archive, DirectSums& s) {
  archive(s.value, s.difference, s.variance, s.uneven, s.per_half, s.moments, s.sharp);
}
void fields(Archive& archive, HalfSums& s) {
  archive(s.sum, s.slope, s.samples, s.moments);
}
void fields(Archive& archive, PreviousLight& k) {
  archive(k.page, k.x, k.y, k.chart, k.first_pass, k.unrefined_direct, k.coarse, k.min_distance, k.lamps);
  fields(archive, k.direct);
  fields(archive, k.gathered);
}

// True if every array has an entry for every texel.
bool is_whole(const PreviousLight& k, bool directional) {
  const std::size_t n = k.count(), moments = directional ? n : 0;
  const auto has = [&](const auto&... all) { return ((all.size() == n) && ...); };
  return has(k.x, k.y, k.chart, k.first_pass, k.unrefined_direct, k.coarse, k.direct.value, k.direct.difference,
             k.direct.variance, k.direct.uneven, k.direct.per_half, k.direct.sharp, k.gathered.samples) &&
         has(k.gathered.sum[0], k.gathered.sum[1], k.gathered.slope[0], k.gathered.slope[1]) &&
         k.direct.moments.size() == moments && k.gathered.moments.size() == moments;
}

}  // namespace

Hash128 previous_light_key(const Scene& scene, const Texels& texels, const RadiosityOptions& options,
                           const PathOptions& paths, std::uint64_t seed) {
  Hasher hasher;
  Archive archive(hasher);
  archive(std::string("known light"), scene.triangles.size(), scene.surfaces.size(), options.samples, options.error,
          options.most_rays, options.bounces, options.directional, options.verify, options.filter.scales,
          options.filter.strength, paths.max_bounces, seed);
  for (const Texels::Page& page : texels.pages) archive(page.width, page.height);
  return hasher.result();
}

std::optional<PreviousLight> load_previous_light(Context& context, const Hash128& name, bool directional) {
  if (const auto bytes = context.units ? context.units->recall(name) : std::nullopt) {
    PreviousLight previous;
    Archive archive{std::span<const std::byte>(*bytes)};
    fields(archive, previous);
    if (archive.complete() && is_whole(previous, directional)) return previous;
  }
  context.warning(
      "nothing-to-reuse",
      "--reuse-error: the cache knows no whole bake with these options of a scene of as many triangles on as large "
      "pages: all is baked");
  return std::nullopt;
}

void store_light(Context& context, const Hash128& name, PreviousLight previous) {
  if (!context.units) return;
  Bytes bytes;
  Archive archive(bytes);
  fields(archive, previous);
  context.units->remember(name, std::move(bytes));
}

Reuse::Reuse(const Texels& texels, std::span<const std::uint32_t> chart, PreviousLight before)
    : previous_(std::move(before)),
      previous_number_(texels.count(), kNoTexel),
      reused_(texels.count()),
      change_(texels.count()) {
  for (std::uint32_t k = 0; k < previous_.count(); ++k) {
    if (previous_.page[k] >= texels.pages.size()) continue;
    const std::uint32_t now =
        texels.at(previous_.page[k], static_cast<int>(previous_.x[k]), static_cast<int>(previous_.y[k]));
    if (now != kNoTexel && chart[now] == previous_.chart[k]) previous_number_[now] = k;
  }
}

std::vector<bool> Reuse::same_first_pass(const TexelGraph& graph, std::span<const Vec3> first_pass) const {
  const auto is_same = [&](std::size_t i) {
    return previous_number_[i] != kNoTexel && first_pass[i] == previous_.first_pass[previous_number_[i]];
  };
  std::vector<bool> same(previous_number_.size());
  for (std::size_t i = 0; i < same.size(); ++i) {
    const auto neighbours = graph.of(i);
    same[i] = is_same(i) && std::all_of(neighbours.begin(), neighbours.end(), is_same);
  }
  return same;
}

void Reuse::compare(const Texels& texels, std::span<const std::uint32_t> order, std::span<const Vec3> coarse,
                    bool lamps, double error) {
  DVec3 mean(0);
  std::size_t visible = 0;
  for (std::size_t i = 0; i < texels.count(); ++i)
    if (texels.visible[i] > 0) mean += DVec3(coarse[i]), ++visible;
  if (visible > 0) mean *= kDarkest / static_cast<double>(visible);
  double all = 0, seen = 0;
  for (std::size_t i = 0; i < texels.count(); ++i) seen += texels.visible_fraction(i);
  report_ = {};
  report_.asked = error;
  if (lamps != previous_.lamps) return;
  for (std::size_t first = 0; first < order.size(); first += kTile) {
    const auto tile = order.subspan(first, std::min(kTile, order.size() - first));
    double relative = 0, count = 0;
    bool complete = true;
    for (const std::uint32_t i : tile) {
      if (texels.visible[i] == 0) continue;
      count += texels.visible_fraction(i);
      if (!(complete = complete && previous_number_[i] != kNoTexel)) break;
      const DVec3 now(coarse[i]), d = now - DVec3(previous_.coarse[previous_number_[i]]);
      for (int c = 0; c < 3; ++c)
        if (const double square = now[c] * now[c] + mean[c] * mean[c]; square > 0)
          relative += texels.visible_fraction(i) * d[c] * d[c] / square / 3;
    }
    ++report_.tiles;
    if (!complete || relative > error * error * count) continue;
    ++report_.reused;
    all += relative;
    for (const std::uint32_t i : tile) {
      if (texels.visible[i] == 0) continue;
      reused_[i] = true;
      change_[i] = static_cast<float>(std::sqrt(relative / std::max(count, 1e-30)));
    }
  }
  report_.error = seen > 0 ? std::sqrt(all / seen) : 0;
}

}  // namespace oriel
