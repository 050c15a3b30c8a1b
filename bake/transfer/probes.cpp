#include "bake/transfer/probes.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "formats/assets/fields.h"
#include "formats/core/sh.h"

namespace oriel {
namespace {

constexpr float kInset = 0.05f;      // of the spacing, so that probes do not stand in the walls around the box
constexpr float kCapInCells = 1.5f;  // beyond a cell's diagonal no probe asks for depth
constexpr float kDimShare = 0.01f;   // of the mean, by which dark probes are compared as if lit

using Lattice = std::array<std::uint32_t, 3>;  // a place in units of the finest possible cell

class FieldBake {
 public:
  FieldBake(const FieldScene& scene, const ProbeOptions& options, const Stage& stage)
      : bright_(scene.accel, scene.lights),
        options_(options),
        net_(mix64(stage.context.seed), options.samples),
        scene_{scene, bright_, options_, net_, stage.context.seed},
        context_(stage.context),
        stage_(stage) {}

  Result<LightField> run(const FieldBox& box) {
    lay_grid(box);
    std::vector<Vec3> points;
    for (const LightProbe& probe : field_.probes) points.push_back(probe.position);
    ORIEL_TRY_VOID(bright_.choose(
        points, options_.bright_lights, [this, half = 0.5 * left()] { return left() < half || left() <= 0; },
        context_));
    field_.lights = bright_.list();
    ORIEL_TRY(bool in_time, measure(0));
    if (!in_time) tell_unmeasured();
    std::size_t first = 0;
    for (int level = 1; in_time && level <= options_.levels; ++level) {
      const std::size_t cells = field_.cells.size(), probes = field_.probes.size();
      LightField before = field_;
      refine(first, level);
      ORIEL_TRY(in_time, measure(probes));
      if (!in_time) field_ = std::move(before);
      first = cells;
    }
    field_.error = squared_sum_ > 0 ? static_cast<float>(std::sqrt(squared_difference_ / squared_sum_)) : 0;
    ORIEL_TRY_VOID(window());
    dilate();
    return std::move(field_);
  }

 private:
  void lay_grid(const FieldBox& box) {
    const Vec3 extent = glm::max(box.upper - box.lower, Vec3(1e-6f));
    float spacing = options_.spacing_m;
    const auto cells = [&](float s) {
      std::array<std::uint32_t, 3> n{};
      for (int a = 0; a < 3; ++a)
        n[static_cast<std::size_t>(a)] =
            static_cast<std::uint32_t>(std::clamp(std::ceil(extent[a] / s - 1e-4f), 1.0f, 1e6f));
      return n;
    };
    const auto probes = [](const std::array<std::uint32_t, 3>& n) {
      return std::uint64_t{n[0] + 1} * (n[1] + 1) * (n[2] + 1);
    };
    while (probes(cells(spacing)) > std::max<std::size_t>(options_.max_probes, 8)) spacing *= 1.05f;
    if (spacing > options_.spacing_m)
      context_.warning("coarser-probes",
                       fmt::format("light field: {:.3g} m between probes instead of {:.3g} m, for {} of them at most",
                                   spacing, options_.spacing_m, options_.max_probes));
    field_.bands = options_.bands;
    field_.depth_side = options_.depth_side;
    field_.size = cells(spacing);
    const Vec3 inset = kInset * glm::min(extent, Vec3(spacing));
    field_.lower = box.lower + inset;
    for (int a = 0; a < 3; ++a)
      field_.cell_m[a] = (extent[a] - 2 * inset[a]) / static_cast<float>(field_.size[static_cast<std::size_t>(a)]);
    field_.depth_cap_m = scene_.depth_cap_m = kCapInCells * glm::length(field_.cell_m);
    const std::uint32_t step = 1u << options_.levels;
    for (std::uint32_t z = 0; z < field_.size[2]; ++z)
      for (std::uint32_t y = 0; y < field_.size[1]; ++y)
        for (std::uint32_t x = 0; x < field_.size[0]; ++x) add_cell({x * step, y * step, z * step}, step);
  }

  // A cell with its probes, which it shares with its neighbours.
  void add_cell(const Lattice& at, std::uint32_t step) {
    FieldCell cell;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      Lattice place = at;
      for (std::uint32_t a = 0; a < 3; ++a) place[a] += (corner >> a & 1) * step;
      const auto [known, added] = probe_at_.try_emplace(place, static_cast<std::uint32_t>(field_.probes.size()));
      cell.probes[corner] = known->second;
      if (!added) continue;
      LightProbe probe;
      const float finest = 1.0f / static_cast<float>(1u << options_.levels);
      probe.position = field_.lower + field_.cell_m * (Vec3(place[0], place[1], place[2]) * finest);
      field_.probes.push_back(std::move(probe));
    }
    field_.cells.push_back(cell);
    cell_place_.push_back(at);
  }

  double left() const { return options_.left ? options_.left() : std::numeric_limits<double>::infinity(); }
  void tell_unmeasured() {
    std::size_t count = 0;
    for (LightProbe& probe : field_.probes) {
      if (!probe.sh.empty()) continue;
      ++count;
      probe.sh.resize(3 * static_cast<std::size_t>(sh_count(options_.bands)));
      probe.depth.assign(std::size_t{options_.depth_side} * options_.depth_side, Vec2(1));
    }
    context_.warning("time-over", fmt::format("light field: {} of {} probes have the light of the nearest other, as "
                                              "--time was over",
                                              count, field_.probes.size()));
  }

  // The probes from `first` on: whether there was time for all. Of the grid, one is measured at least that is in no
  // wall, and what is measured stays; other levels may be left out.
  Result<bool> measure(std::size_t first) {
    std::vector<MeasuredProbe> measured(field_.probes.size() - first);
    if (measured.empty()) return true;
    std::atomic<bool> any{first > 0};
    const auto enough = [&] { return any && left() <= 0; };
    UnitLoop loop{.stage = "probes", .count = measured.size(), .rays = static_cast<double>(options_.samples)};
    loop.inputs = [&](std::size_t i, Archive& key) {
      key(first + i, field_.probes[first + i].position, bright_.listed());
    };
    loop.compute = [&](std::size_t i) {
      std::uint64_t rays = 0;
      measured[i] = measure_probe(scene_, field_.probes[first + i].position, first + i, rays);
      if (measured[i].probe.valid) any = true;
      return rays;
    };
    loop.results = [&](std::size_t i, Archive& archive) {
      archive(measured[i].probe, measured[i].squared_difference, measured[i].squared_sum);
    };
    ORIEL_TRY(const bool all, done_in_time(context_, enough, [&] { return parallel_units(stage_, loop); }));
    if (!all && first > 0) return false;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      if (measured[i].probe.sh.empty()) continue;
      if (measured[i].probe.valid) {
        squared_difference_ += measured[i].squared_difference;
        squared_sum_ += measured[i].squared_sum;
      }
      field_.probes[first + i] = std::move(measured[i].probe);
    }
    return all;
  }

  // Luminance of the first two bands.
  DVec4 gist(const LightProbe& probe) const {
    DVec4 sum(0);
    const std::size_t count = probe.sh.size() / 3;
    constexpr double kLuminance[] = {0.2126, 0.7152, 0.0722};
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < 4; ++i)
        sum[static_cast<int>(i)] += kLuminance[c] * static_cast<double>(probe.sh[c * count + i]);
    return sum;
  }

  double difference(const FieldCell& cell, double mean) const {
    double most = 0;
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const LightProbe &a = field_.probes[cell.probes[i]], &b = field_.probes[cell.probes[k]];
        if (!a.valid || !b.valid) continue;
        const DVec4 ga = gist(a), gb = gist(b);
        const double size = std::max(glm::length(ga), glm::length(gb)) + kDimShare * mean;
        if (size > 0) most = std::max(most, glm::length(ga - gb) / size);
      }
    return most;
  }

  // Cuts the cells from `first` on that need it, as long as probes are allowed.
  void refine(std::size_t first, int level) {
    double mean = 0;
    for (const LightProbe& probe : field_.probes) mean += glm::length(gist(probe));
    mean /= static_cast<double>(field_.probes.size());
    std::vector<std::pair<double, std::size_t>> wanted;
    for (std::size_t c = first; c < field_.cells.size(); ++c)
      if (const double d = difference(field_.cells[c], mean); d > static_cast<double>(options_.max_difference))
        wanted.emplace_back(-d, c);
    std::sort(wanted.begin(), wanted.end());
    const std::uint32_t step = 1u << (options_.levels - level);
    for (const auto& [d, c] : wanted) {
      if (field_.probes.size() + 19 > 2 * options_.max_probes) return;  // what a cell may add
      field_.cells[c].children = static_cast<std::uint32_t>(field_.cells.size());
      const Lattice at = cell_place_[c];
      for (std::uint32_t part = 0; part < 8; ++part)
        add_cell({at[0] + (part & 1) * step, at[1] + (part >> 1 & 1) * step, at[2] + (part >> 2) * step}, step);
    }
  }

  // As little as keeps irradiance, which is what transfer asks for, from ringing below zero. Radiance itself may: a
  // window that mends it too takes a tenth of the light of a doorway from what faces it.
  Status window() {
    const std::size_t count = static_cast<std::size_t>(sh_count(options_.bands));
    return parallel_for(context_, "", field_.probes.size(), [&](std::size_t p) {
      std::vector<float>& sh = field_.probes[p].sh;
      std::vector<double> values(sh.begin(), sh.end());
      const auto channel = [&](std::size_t c) { return std::span(values).subspan(c * count, count); };
      double lambda = 0;  // one for all colours, so that none tints what is left
      for (std::size_t c = 0; c < 3; ++c) {
        if (!(values[c * count] > 0)) std::fill(channel(c).begin(), channel(c).end(), 0.0);
        std::vector<double> irradiance(channel(c).begin(), channel(c).end());
        for (int l = 0; l < options_.bands; ++l)
          for (int i = sh_index(l, -l); i <= sh_index(l, l); ++i)
            irradiance[static_cast<std::size_t>(i)] *= cosine_factor(l);
        lambda = std::max(lambda, window_without_ringing(irradiance));
      }
      for (std::size_t c = 0; c < 3; ++c) window_sh(lambda, channel(c));
      for (std::size_t i = 0; i < sh.size(); ++i) sh[i] = static_cast<float>(values[i]);
    });
  }

  // Gives probes in walls the light of the nearest that is in none, for points that are in walls themselves.
  void dilate() {
    for (LightProbe& probe : field_.probes) {
      if (probe.valid) continue;
      const LightProbe* nearest = nullptr;
      float least = 3e38f;
      for (const LightProbe& other : field_.probes)
        if (other.valid && length2(other.position - probe.position) < least) {
          least = length2(other.position - probe.position);
          nearest = &other;
        }
      if (!nearest) continue;
      probe.sh = nearest->sh;
      probe.bright = nearest->bright;
      probe.kept = nearest->kept;
    }
  }

  BrightLights bright_;
  ProbeOptions options_;
  ShiftedNet net_;
  ProbeScene scene_;
  Context& context_;
  const Stage stage_;
  LightField field_;
  std::map<Lattice, std::uint32_t> probe_at_;
  std::vector<Lattice> cell_place_;  // by cell
  double squared_difference_ = 0, squared_sum_ = 0;
};

}  // namespace

Result<LightField> bake_probes(const FieldScene& scene, const FieldBox& box, const ProbeOptions& options,
                               const Stage& stage) {
  if (options.bands < 2 || options.bands > 6)
    return fail(ErrorCode::kUsage, "light field", "found {} bands of spherical harmonics, expected 2 to 6",
                options.bands);
  if (!(options.spacing_m > 0))
    return fail(ErrorCode::kUsage, "light field", "found {} m between probes, expected more than 0", options.spacing_m);
  if (!std::has_single_bit(options.samples) || options.depth_side < 2 || options.depth_side > kMaxDepthSide ||
      options.samples < options.depth_side * options.depth_side)
    return fail(ErrorCode::kUsage, "light field",
                "found {} rays and depth maps of {} texels a side, expected a power of two, and a ray a texel or more",
                options.samples, options.depth_side);
  if (options.levels < 0 || options.levels > kMaxFieldLevels)
    return fail(ErrorCode::kUsage, "light field", "found {} levels of refinement, expected 0 to {}", options.levels,
                kMaxFieldLevels);
  return FieldBake(scene, options, stage).run(box);
}

}  // namespace oriel
