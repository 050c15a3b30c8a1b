// How finely the next frame is drawn: so that frames come fast enough while something moves, and whole once it stands.
#pragma once

#include <array>
#include <cstddef>

namespace oriel {

enum class Quality {
  kAutomatic,  // coarser while something moves, where the device is too slow for more
  kFull,       // each frame as the options ask for
  kFast,       // as while something moves, always
};

struct PaceOptions {
  float slowest_ms = 1000 / 15.0f;  // a frame while something moves
  double still_s = 0.1;             // without motion, until the whole frame is drawn
};

class Pace {
 public:
  enum class Draw {
    kKeep,    // what is shown is what would be drawn
    kCoarse,  // at scale(), with less work by pixel
    kWhole,
  };

  // slow_device: known to be too slow, a rasteriser on the CPU say; it begins coarsely.
  explicit Pace(bool slow_device = false, const PaceOptions& options = {});

  // moved: the eye, what moves, or what has been loaded. altered: anything else that a frame shows.
  Draw next(bool moved, bool altered, Quality quality, double now_s);
  // What the frame took that next() asked for.
  void took(Draw drawn, float ms);

  // Of a coarse frame's pixels, along each side.
  float scale() const { return coarse(level_); }
  // Frames are coarser while something moves.
  bool coarsens() const { return level_ > 0; }

 private:
  static constexpr std::array<float, 9> kCoarse{1, 0.85f, 0.7f, 0.6f, 0.5f, 0.42f, 0.35f, 0.3f, 0.25f};
  static constexpr int kLevels = static_cast<int>(kCoarse.size());  // 0 is the whole frame
  static float coarse(int level) { return kCoarse[static_cast<std::size_t>(level > 0 ? level - 1 : 0)]; }
  // About, of a coarse frame of the whole's size.
  static float work(int level) { return coarse(level) * coarse(level); }
  void fit(float ms);
  void go_finer();

  PaceOptions options_;
  int level_ = 0;
  float mean_ms_ = 0;   // of the last coarse frames
  int frames_ = 0;      // since the level changed
  int steady_ = 0;      // frames until a finer level is tried; more after one that was too slow
  bool tries_ = false;  // this level is such a try
  int failed_ = 0;      // the last level that was too slow a try
  float whole_ms_ = 0;  // the last whole frame took; 0: none was drawn
  double moved_s_ = -1e9;
  bool shows_whole_ = false, drawn_ = false;
};

}  // namespace oriel
