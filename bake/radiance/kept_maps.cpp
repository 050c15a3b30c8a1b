#include "bake/radiance/kept_maps.h"

#include <algorithm>
#include <limits>

#include "bake/jobs/parallel.h"
#include "bake/radiance/reproject.h"
#include "bake/trace/sampler.h"
#include "formats/assets/fields.h"

namespace oriel {
namespace {

constexpr std::uint32_t kBlock = 4;           // pixels along each side, of which one is captured anew
constexpr double kRaysALook = 1 << 13;        // that these take, about
constexpr double kDarkest = 0.01;             // of the map's mean: what darker light is compared with
constexpr float kUnchangedDisparity = 0.03f;  // relative, as where a map is read
constexpr float kBehind = 1 + 1e-4f;          // of the distance to what a pixel shows: still that

// What the edit did to a band, as far as the sample tells.
struct BandCheck {
  bool met = false;   // an edited box is in sight
  double square = 0;  // of relative differences, summed over the sample
  double samples = 0;
};
void fields(Archive& archive, BandCheck& c) {
  archive(c.met, c.square, c.samples);
}

class Checker {
 public:
  Checker(const LitSurroundings& lit, std::span<const Box> edited, std::uint64_t seed)
      : lit_(lit), edited_(edited), seed_(seed) {}

  // Of a band whose pixels are those of the bake before.
  BandCheck check(const RadianceMap& map, const MapBand& band, const Vec3& darkest, std::uint64_t& rays) const {
    BandCheck found;
    found.met = meets_edited(map, band);
    if (found.met) return found;
    for (std::uint32_t y = band.first_row; y < band.first_row + band.rows; y += kBlock)
      for (std::uint32_t x = 0; x < map.width; x += kBlock) {
        Sampler sampler(seed_, band.map, y * map.width + x);
        const Vec2 at = sampler.next2() * static_cast<float>(kBlock);
        const std::uint32_t px = std::min(x + static_cast<std::uint32_t>(at.x), map.width - 1);
        const std::uint32_t py = std::min(y + static_cast<std::uint32_t>(at.y), band.first_row + band.rows - 1);
        const MapPixel now = capture_pixel(lit_, map, px, py, rays);
        found.square += difference(map, std::size_t{py} * map.width + px, now, darkest);
        ++found.samples;
      }
    return found;
  }

 private:
  bool meets_edited(const RadianceMap& map, const MapBand& band) const {
    const Reflector& reflector = lit_.around.reflectors()[map.reflector].reflector;
    for (std::uint32_t y = band.first_row; y < band.first_row + band.rows && !edited_.empty(); ++y)
      for (std::uint32_t x = 0; x < map.width; ++x) {
        const CaptureRay ray = capture_ray(reflector, map, Vec2(x, y) + 0.5f);
        const Vec4 end = unproject(map, Vec2(x, y) + 0.5f, map.disparity[std::size_t{y} * map.width + x]);
        const float distance =
            end.w > 0 ? kBehind * glm::length(Vec3(end) / end.w - Vec3(map_point(map, Vec2(x, y) + 0.5f), 0))
                      : std::numeric_limits<float>::max();
        if (meets(edited_, ray.from, ray.direction, distance)) return true;
      }
    return false;
  }

  // Squared, relative.
  static double difference(const RadianceMap& map, std::size_t at, const MapPixel& now, const Vec3& darkest) {
    const float disparity = map.disparity[at];
    if (map.valid[at] != now.valid || std::abs(disparity - now.disparity) > kUnchangedDisparity * disparity) return 1;
    double square = 0;
    for (int c = 0; c < 3; ++c) {
      const double d = now.radiance[c] - map.radiance[at][c];
      const double scale = double{now.radiance[c]} * now.radiance[c] + double{darkest[c]} * darkest[c];
      if (scale > 0) square += d * d / scale / 3;
    }
    return square;
  }

  const LitSurroundings lit_;
  std::span<const Box> edited_;
  std::uint64_t seed_;
};

// The loop whose units the bake before named, where its reflectors had other numbers; kNoReflector: it had none.
constexpr std::uint32_t kNoReflector = ~0u;
std::vector<std::uint32_t> numbers_before(const ReflectedSurroundings& surroundings, const KnownReflections& known) {
  std::vector<std::uint32_t> before;
  for (const FoundReflector& found : surroundings.reflectors()) {
    const Hash128 identity = identity_of(surroundings.accel().scene(), found);
    const auto at = std::find(known.captured.begin(), known.captured.end(), identity);
    before.push_back(at == known.captured.end() ? kNoReflector
                                                : static_cast<std::uint32_t>(at - known.captured.begin()));
  }
  return before;
}

Hash128 frame_under(const RadianceMap& map, std::uint32_t reflector) {
  RadianceMap frame;
  frame.reflector = reflector;
  frame.eye = map.eye, frame.lower = map.lower, frame.upper = map.upper;
  frame.width = map.width, frame.height = map.height, frame.has_emission = map.has_emission;
  return frame_of(frame);
}

// By map: 1 % of the mean of its bands that are there.
std::vector<Vec3> darkest_of(std::span<const RadianceMap> maps, std::span<const MapBand> bands) {
  std::vector<DVec3> sum(maps.size(), DVec3(0));
  std::vector<double> count(maps.size());
  for (const MapBand& band : bands) {
    const RadianceMap& map = maps[band.map];
    const std::size_t first = std::size_t{band.first_row} * map.width, pixels = std::size_t{band.rows} * map.width;
    for (std::size_t i = first; i < first + pixels; ++i) sum[band.map] += DVec3(map.radiance[i]);
    count[band.map] += static_cast<double>(pixels);
  }
  std::vector<Vec3> darkest;
  for (std::size_t i = 0; i < maps.size(); ++i)
    darkest.emplace_back(count[i] > 0 ? kDarkest * sum[i] / count[i] : DVec3(0));
  return darkest;
}

}  // namespace

Result<MapReuse> capture_edited_maps(const LitSurroundings& lit, const Edit& edit, const Stage& stage,
                                     std::vector<RadianceMap>& maps) {
  const KnownReflections& known = edit.known;
  Context& context = stage.context;
  const std::vector<MapBand> all = make_bands(lit.around, maps);
  const std::vector<std::uint32_t> before = numbers_before(lit.around, known);
  UnitLoop old = capture_loop(lit, all, maps);
  old.inputs = [&](std::size_t i, Archive& key) {
    const RadianceMap& map = maps[all[i].map];
    key(frame_under(map, before[map.reflector]), all[i].first_row, all[i].rows);
  };
  std::vector<std::uint8_t> is_there(all.size());
  ORIEL_TRY_VOID(parallel_for(context, "", all.size(), [&](std::size_t i) {
    is_there[i] = before[maps[all[i].map].reflector] != kNoReflector && recall_item(context, known.inputs, old, i);
  }));
  std::vector<MapBand> there, left;
  for (std::size_t i = 0; i < all.size(); ++i) (is_there[i] ? there : left).push_back(all[i]);

  const Checker checker(lit, edit.boxes, context.seed);
  const std::vector<Vec3> darkest = darkest_of(maps, there);
  std::vector<BandCheck> checks(there.size());
  UnitLoop check{.stage = "known radiance", .count = there.size(), .rays = kRaysALook};
  check.inputs = [&](std::size_t i, Archive& key) {
    const MapBand& band = there[i];
    key(frame_of(maps[band.map]), band.first_row, band.rows, known.inputs, darkest[band.map]);
    for (const Box& box : edit.boxes) key(box.lower, box.upper);
  };
  check.compute = [&](std::size_t i) {
    std::uint64_t traced = 0;
    checks[i] = checker.check(maps[there[i].map], there[i], darkest[there[i].map], traced);
    return traced;
  };
  check.results = [&](std::size_t i, Archive& archive) { archive(checks[i]); };
  ORIEL_TRY_VOID(parallel_units(stage, check));

  MapReuse reuse{.asked = edit.error, .bands = static_cast<std::uint32_t>(all.size())};
  double kept_square = 0, pixels = 0;
  for (const MapBand& band : all) pixels += double{1.0f * band.rows} * maps[band.map].width;
  for (std::size_t i = 0; i < there.size(); ++i) {
    const BandCheck& found = checks[i];
    if (found.met || found.square > edit.error * edit.error * found.samples) {
      left.push_back(there[i]);
      continue;
    }
    ++reuse.kept;
    const double share = double{1.0f * there[i].rows} * maps[there[i].map].width / pixels;
    kept_square += found.samples > 0 ? share * found.square / found.samples : 0;
  }
  reuse.error = std::sqrt(kept_square);
  ORIEL_TRY_VOID(parallel_units(stage, capture_loop(lit, left, maps)));
  return reuse;
}

}  // namespace oriel
