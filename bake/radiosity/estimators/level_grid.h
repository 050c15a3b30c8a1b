// By how much the points of a page's cells of one level differ from the interpolation of its texels.
#pragma once

#include <functional>
#include <optional>

#include "bake/radiosity/estimators/point_light.h"

namespace oriel {

class LevelGrid {
 public:
  // The points of one level. whole: the grid of kWholeLevel, where the level is more: between its points lies what
  // `points` do not hold.
  struct Points {
    std::uint8_t level;
    const PointLight& light;
    const LevelGrid* whole = nullptr;
  };

  // levels: by place of the page; the grid is that of cells that have points of that level. Of what they change the
  // share that is no noise is kept, and a point alone that differs more than all around it is none.
  LevelGrid(const LightmapPage& page, const std::vector<std::uint8_t>& levels, const Points& points,
            std::uint32_t page_number);

  // Of point (i, j) of the cell at (x, y), which must be of this level or beside one. Those inside something or beyond
  // the chart differ as their neighbours do.
  Vec3 at(std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    const std::size_t k = find(number(x, y, i, j));
    return k < place_.size() ? change_[k] : Vec3(0);
  }
  // What interpolation misses in the cell at (x, y): rms over its points that have light of their own, of luminance;
  // nothing where none has.
  std::optional<double> missed(std::uint32_t x, std::uint32_t y) const;
  struct Missed {
    double square = 0, noise = 0;  // of luminance; squared error of points that takes its place
  };
  // The same at a place in it, of [0,1]; nothing where a point around that is not of this level.
  std::optional<Missed> missed_at(std::uint32_t x, std::uint32_t y, const Vec2& within) const;
  // By how much light differs around a place in a cell, of [0,1], at the corners of the square of points that it lies
  // in: relative to the most there and `floor`, luminance, lux.
  double differs_at(const LightmapPage& page, std::uint32_t x, std::uint32_t y, const Vec2& within, double floor) const;
  std::uint32_t side() const { return side_; }

 private:
  std::uint32_t number(std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    return DetailPoints::fine(y, j, side_) * width_ + DetailPoints::fine(x, i, side_);
  }
  std::size_t find(std::uint32_t place) const;
  Vec3 between_texels(const LightmapPage& page, std::uint32_t x, std::uint32_t y) const;
  Vec3 between(std::uint32_t x, std::uint32_t y, const Vec2& within) const;
  void fill_from(const LevelGrid& whole, const LightmapPage& page, const std::vector<std::uint8_t>& levels,
                 const std::function<bool(std::uint32_t x, std::uint32_t y)>& is_lit);
  void leave_noise();
  void leave_dots();
  bool spread();
  template <class Body>
  void for_each_around(std::size_t k, const Body& body) const;

  std::uint32_t side_, width_;
  std::vector<std::uint32_t> place_;  // ascending
  std::vector<Vec3> change_;
  std::vector<float> noise_;       // variance of it, luminance
  std::vector<char> own_, known_;  // by point: whether it has light of its own; or of its neighbours
};

}  // namespace oriel
