#include "bake/radiosity/stitch.h"

#include <algorithm>
#include <Eigen/SparseCholesky>

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kStep = 0.005;  // relative: a step on a seam that weighs as much as a change of one standard error
constexpr double kLeastError = 0.01;  // relative error of any texel: it shows a mean over its square, not its centre
constexpr double kFree = 0.2;         // relative error of a texel without surface
constexpr double kDark = 0.01;        // of the mean light: what is darker counts as that
constexpr int kPoolRadius = 2;        // texels to each side over which errors and their light are pooled
constexpr double kOwn = 1;            // the largest change of a texel: of its standard error,
constexpr double kPooled = 0.3;       // or, if more, of its light, as far as three times the errors around it go,
constexpr double kSlack = 3;          // plus this times kLeastError, plus twice kFree
constexpr int kRounds = 4;
constexpr double kRestraint = 0.6;  // factor of the texels' freedom, in at most kRestraints rounds
constexpr double kStrongest = 0.1;
constexpr int kRestraints = 8;
constexpr double kSolve_s =
    2e-6;                       // a seam point and round of all: measured 0.5e-6 to 2e-6 on rooms and a thousand rings
constexpr double kHeld = 1e-6;  // relative error of a texel that must not move
constexpr std::uint32_t kNone = ~0u;

using Matrix = Eigen::SparseMatrix<double>;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

// Texels and weights of bilinear filtering at a place of a page.
struct Footprint {
  std::array<std::uint32_t, 4> texel{};
  std::array<double, 4> weight{};
};

Footprint footprint(const LightmapPage& page, const DVec2& place) {
  const DVec2 p = place - 0.5, low = glm::floor(p), f = p - low;
  Footprint out;
  for (int i = 0; i < 4; ++i) {
    const int right = i & 1, down = i >> 1;
    const int x = std::clamp(static_cast<int>(low.x) + right, 0, static_cast<int>(page.width) - 1),
              y = std::clamp(static_cast<int>(low.y) + down, 0, static_cast<int>(page.height) - 1);
    out.texel[i] = static_cast<std::uint32_t>(y) * page.width + static_cast<std::uint32_t>(x);
    out.weight[i] = (right ? f.x : 1 - f.x) * (down ? f.y : 1 - f.y);
  }
  return out;
}

DVec3 filtered(const LightmapPage& page, const Footprint& at) {
  DVec3 sum(0);
  for (int i = 0; i < 4; ++i) sum += at.weight[i] * DVec3(page.irradiance[at.texel[i]]);
  return sum;
}

bool reads_empty(const LightmapPage& page, const Footprint& at) {
  for (int i = 0; i < 4; ++i)
    if (at.weight[i] > 0 && page.state[at.texel[i]] == TexelState::kEmpty) return true;
  return false;
}

double brightness(const DVec3& light) {
  return luminance(Vec3(light));
}

// The least-squares problem. Unknowns are relative changes: texel = baked + scale * unknown, per channel.
class Stitcher {
 public:
  Stitcher(std::span<const TexelMapPage> texel_map, std::vector<LightmapPage>& pages) : pages_(pages) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t p = 0; p < pages.size(); ++p) {
      unknown_.emplace_back(pages[p].state.size(), kNone);
      covered_.emplace_back(pages[p].state.size(), 0.0f);
      const TexelMapPage& map = texel_map[p];
      for (std::size_t i = 0; i < map.texel.size(); ++i) {
        if (pages[p].state[map.texel[i]] != TexelState::kValid) continue;
        sum += luminance(pages[p].irradiance[map.texel[i]]), ++count;
        area_ += covered_[p][map.texel[i]] = covered_share(map, i);
      }
    }
    dark_ = count > 0 ? kDark * sum / static_cast<double>(count) : 0;
  }

  bool black() const { return !(dark_ > 0); }

  void add(const SeamPoint& point) {
    Row row;
    for (int side = 0; side < 2; ++side) {
      const LightmapPage& page = pages_[point.page[side]];
      row.side[side] = {point.page[side], footprint(page, point.place[side])};
      if (reads_empty(page, row.side[side].at)) return;
    }
    row.mean = 0.5 * (brightness(value(row, 0)) + brightness(value(row, 1))) + dark_;
    row.weight = std::sqrt(double{point.length});
    for (const auto& side : row.side)
      for (int i = 0; i < 4; ++i)
        if (side.at.weight[i] > 0) add_to_unknown(side.page, side.at.texel[i], row);
    rows_.push_back(row);
  }

  // Mean and largest step, relative to the light on both sides.
  void measure(double& mean, double& max) const {
    mean = max = 0;
    for (const Row& row : rows_) {
      const double step = std::abs(brightness(value(row, 0)) - brightness(value(row, 1))) / row.mean;
      mean += step / static_cast<double>(rows_.size());
      max = std::max(max, step);
    }
  }

  // Texels move by no more than at_most, relative, root mean square over all surfaces. False where there is nothing to
  // solve, rounding left no solution, or it was late() before: then all is as it was.
  bool solve(double at_most, const std::function<bool()>& late) {
    if (rows_.empty()) return false;
    for (Texel& t : texels_) {
      t.baked = light(t);
      for (int c = 0; c < 3; ++c) t.most[c] = largest_change(t, c);
    }
    if (late() || !solve_within_limits()) return false;
    // Solves again with less freedom for all texels, until they move by little enough.
    for (int round = 0; round < kRestraints; ++round) {
      const double by = moved();
      if (by <= at_most) break;
      freedom_ *= std::clamp(kRestraint * at_most / by, kStrongest, kRestraint);
      if (late()) {
        for (const Texel& t : texels_) light(t) = t.baked;
        return false;
      }
      if (!solve_within_limits()) return false;
    }
    return true;
  }

  // The relative change of texels, root mean square over all surfaces.
  double moved() {
    double sum = 0;
    for (const Texel& t : texels_) sum += covered_[t.page][t.texel] * square(t);
    return area_ > 0 ? std::sqrt(sum / area_) : 0;
  }

 private:
  struct Texel {
    std::uint32_t page, texel;
    double light;  // sum over the rows that read it: of both sides of the seam, which favours neither
    int rows;
    bool held = false;
    Vec3 baked{0};                                 // lux
    Vec3 most{0};                                  // lux: largest change
    double scale() const { return light / rows; }  // lux
  };
  struct Row {
    struct Side {
      std::uint32_t page;
      Footprint at;
    };
    std::array<Side, 2> side;
    double mean = 0;  // light of the place, lux
    double weight = 1;
  };

  Vec3& light(const Texel& t) { return pages_[t.page].irradiance[t.texel]; }
  Vec3 changed(std::size_t i, const Columns& change) {
    const auto row = static_cast<Eigen::Index>(i);
    const Texel& t = texels_[i];
    return light(t) + Vec3(t.scale() * DVec3(change(row, 0), change(row, 1), change(row, 2)));
  }

  // Clamps a texel to within largest_change(), and to 0. A chart of a texel or two cannot match all the light along its
  // outline; without limits, its texels and their neighbours would be pulled far off.
  Vec3 within_limits(const Texel& t, const Vec3& to) {
    return glm::max(Vec3(0), glm::clamp(to, t.baked - t.most, t.baked + t.most));
  }

  // Texels that would go beyond their limits stay there, and the others are to be solved for again (an active set that
  // only grows). True where there were any.
  bool hold_at_limits(const Columns& change) {
    bool any = false;
    for (std::size_t i = 0; i < texels_.size(); ++i) {
      Texel& t = texels_[i];
      const Vec3 to = changed(i, change), bounded = within_limits(t, to);
      if (t.held || to == bounded) continue;
      light(t) = bounded;
      any = t.held = true;
    }
    return any;
  }

  bool solve_within_limits() {
    for (Texel& t : texels_) light(t) = t.baked, t.held = false;
    Columns change;
    for (int round = 0; round < kRounds; ++round) {
      change = least_squares();
      if (change.rows() == 0 || !change.allFinite()) {
        for (const Texel& t : texels_) light(t) = t.baked;
        return false;
      }
      if (!hold_at_limits(change)) break;
    }
    for (std::size_t i = 0; i < texels_.size(); ++i) light(texels_[i]) = within_limits(texels_[i], changed(i, change));
    return true;
  }

  // Squared change of a texel relative to its light; mean over channels.
  double square(const Texel& t) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double off = double{light(t)[c]} - t.baked[c], floor = dark_, brighter = std::max(light(t)[c], t.baked[c]);
      sum += off * off / (brighter * brighter + floor * floor) / 3;
    }
    return sum;
  }

  // Relative changes of the texels; no rows where there is no solution.
  Columns least_squares() const {
    const auto n = static_cast<Eigen::Index>(texels_.size()), m = static_cast<Eigen::Index>(rows_.size());
    Rows jacobian(m, n);
    jacobian.reserve(Eigen::VectorXi::Constant(m, 8));
    Columns steps(m, 3);
    for (Eigen::Index r = 0; r < m; ++r) fill_row(rows_[static_cast<std::size_t>(r)], r, jacobian, steps);
    Matrix normal = Matrix(jacobian.transpose() * jacobian);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Texel& t = texels_[static_cast<std::size_t>(i)];
      const double error = t.held ? kHeld : freedom_ * error_of(t);
      normal.coeffRef(i, i) += 1 / (error * error);
    }
    const Eigen::SimplicialLDLT<Matrix> solver(normal);
    if (solver.info() != Eigen::Success) return {};
    return solver.solve(-(jacobian.transpose() * steps));
  }

  DVec3 value(const Row& row, int side) const { return filtered(pages_[row.side[side].page], row.side[side].at); }

  void add_to_unknown(std::uint32_t page, std::uint32_t texel, const Row& row) {
    std::uint32_t& index = unknown_[page][texel];
    if (index == kNone) {
      index = static_cast<std::uint32_t>(texels_.size());
      texels_.push_back({page, texel, 0, 0});
    }
    texels_[index].light += row.mean;
    ++texels_[index].rows;
  }

  // Standard errors over the light around a texel, root mean squares. The texel's own is no measure: it is small where
  // chance made the texel dark, and would draw the seam to the dark side.
  double pooled_noise(const Texel& t) const {
    const LightmapPage& page = pages_[t.page];
    const auto width = static_cast<int>(page.width), height = static_cast<int>(page.height);
    const int x0 = static_cast<int>(t.texel) % width, y0 = static_cast<int>(t.texel) / width;
    double squares = 0, light = 0;
    for (int y = std::max(0, y0 - kPoolRadius); y <= std::min(height - 1, y0 + kPoolRadius); ++y)
      for (int x = std::max(0, x0 - kPoolRadius); x <= std::min(width - 1, x0 + kPoolRadius); ++x) {
        const auto texel = static_cast<std::size_t>(y) * page.width + static_cast<std::size_t>(x);
        if (page.state[texel] != TexelState::kValid) continue;
        squares += std::pow(luminance(page.standard_error[texel]), 2);
        light += std::pow(brightness(DVec3(page.irradiance[texel])) + dark_, 2);
      }
    return light > 0 ? std::sqrt(squares / light) : 0;
  }

  // Relative to the texel's scale. Noise goes with a texel's own light: dark ones beside bright ones stay dark.
  double error_of(const Texel& t) const {
    const LightmapPage& page = pages_[t.page];
    const double own = luminance(page.standard_error[t.texel]);
    const double noise = std::max(own, pooled_noise(t) * (brightness(DVec3(t.baked)) + dark_)) / t.scale();
    const double free = kFree * (1 - double{covered_[t.page][t.texel]});
    return std::sqrt(noise * noise +
                     std::pow((kLeastError + free) * (brightness(DVec3(t.baked)) + dark_) / t.scale(), 2));
  }

  // The largest change of a texel that is not noticeable, lux.
  float largest_change(const Texel& t, int channel) const {
    const LightmapPage& page = pages_[t.page];
    const double own = page.irradiance[t.texel][channel], error = page.standard_error[t.texel][channel];
    const double free = kFree * (1 - double{covered_[t.page][t.texel]});
    const double pooled = std::min(kSlack * pooled_noise(t) * own, kPooled * own);
    return static_cast<float>(std::max(kOwn * error, pooled) + (kSlack * kLeastError + 2 * free) * own);
  }

  void fill_row(const Row& row, Eigen::Index r, Rows& jacobian, Columns& steps) const {
    const double factor = row.weight / (kStep * row.mean);
    const DVec3 step = (value(row, 0) - value(row, 1)) * factor;
    for (int c = 0; c < 3; ++c) steps(r, c) = step[c];
    for (int s = 0; s < 2; ++s)
      for (int i = 0; i < 4; ++i) {
        const auto& [page, at] = row.side[s];
        if (!(at.weight[i] > 0)) continue;
        const std::uint32_t index = unknown_[page][at.texel[i]];
        jacobian.coeffRef(r, index) += (s == 0 ? factor : -factor) * at.weight[i] * texels_[index].scale();
      }
  }

  std::vector<LightmapPage>& pages_;
  double dark_ = 0;
  double freedom_ = 1;                               // of error_of()
  double area_ = 0;                                  // sum of covered_
  std::vector<std::vector<std::uint32_t>> unknown_;  // by page and texel
  std::vector<std::vector<float>> covered_;          // share of the texel that has a baked surface
  std::vector<Texel> texels_;
  std::vector<Row> rows_;
};

}  // namespace

SeamReport stitch(const Seams& seams, std::span<const TexelMapPage> texel_map, double at_most,
                  std::vector<LightmapPage>& pages, const std::function<double()>& left_s) {
  SeamReport report;
  Stitcher stitcher(texel_map, pages);
  if (stitcher.black()) return report;
  for (const SeamPoint& point : seams.points) stitcher.add(point);
  stitcher.measure(report.mean_step_before, report.max_step_before);
  report.mean_step = report.mean_step_before, report.max_step = report.max_step_before;
  const auto late = [&] {
    return report.late = left_s && left_s() < kSolve_s * static_cast<double>(seams.points.size());
  };
  if (!stitcher.solve(at_most, late)) return report;
  report.pairs = seams.pairs;
  report.moved = stitcher.moved();
  stitcher.measure(report.mean_step, report.max_step);
  return report;
}

}  // namespace oriel
