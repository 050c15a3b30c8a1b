// The difference of finer cells' points, of one level, from the interpolation of a page's texels.
#pragma once

#include <array>
#include <optional>

#include "bake/radiosity/estimators/point_light.h"

namespace oriel {

class LevelGrid {
 public:
  // The points of one level.
  struct Points {
    std::uint8_t level;
    const PointLight& light;
  };

  // levels: by place of the page; the grid holds the cells with points of that level. Noise is removed from the
  // differences, and so are outliers: points that differ more than all their neighbours.
  LevelGrid(const LightmapPage& page, const std::vector<std::uint8_t>& levels, const Points& points,
            std::uint32_t page_number);

  // The difference at point (i, j) of the cell at (x, y), lux. The cell must be of this level or next to one. Points
  // inside a body or beyond the chart get the mean of their neighbours.
  Vec3 at(std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    const std::size_t k = find(number(x, y, i, j));
    return k < place_.size() ? change_[k] : Vec3(0);
  }
  // The interpolation error in the cell at (x, y): rms luminance difference of its points with light of their own, lux.
  // Nothing without such points.
  std::optional<double> missed(std::uint32_t x, std::uint32_t y) const;
  struct Missed {
    double square = 0, noise = 0;  // squared luminance difference, lux², and the points' variance
  };
  // The same at a position in it, [0,1]²; nothing where a surrounding point is not of this level.
  std::optional<Missed> missed_at(std::uint32_t x, std::uint32_t y, const Vec2& within) const;
  std::uint32_t side() const { return side_; }

 private:
  std::uint32_t number(std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    return DetailPoints::fine(y, j, side_) * width_ + DetailPoints::fine(x, i, side_);
  }
  std::size_t find(std::uint32_t place) const;
  void find_neighbours();
  Vec3 between_texels(const LightmapPage& page, std::uint32_t x, std::uint32_t y) const;
  void remove_noise();
  void remove_outliers();
  bool spread();
  template <class Body>
  void for_each_neighbour(std::size_t k, const Body& body) const;

  std::uint32_t side_, width_;
  std::vector<std::uint32_t> place_;  // ascending
  // By point: itself and its neighbours; the number of points stands for none. Empty once the grid is made.
  std::vector<std::array<std::uint32_t, 9>> around_;
  std::vector<Vec3> change_;
  std::vector<float> noise_;           // variance of it, luminance
  std::vector<char> own_, has_value_;  // by point: 1 with light of its own; 1 with any light
};

}  // namespace oriel
