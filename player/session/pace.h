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

// How coarse a frame is while something moves.
struct CoarseLevel {
  float scale = 1;                                                    // of the pixels, along each side
  bool few = false;                                                   // images in large plane reflectors alone
  float work() const { return scale * scale * (few ? 0.5f : 1.0f); }  // about, of a coarse frame of the whole's size
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

  // Of a coarse frame, along each side; and whether it shows large plane reflections alone.
  float scale() const { return now().scale; }
  bool few_reflections() const { return now().few; }
  // Frames are coarser while something moves.
  bool coarsens() const { return level_ > 0; }

 private:
  static constexpr std::array<CoarseLevel, 11> kCoarse{{{1},
                                                        {0.85f},
                                                        {0.7f},
                                                        {0.6f},
                                                        {0.5f},
                                                        {0.42f},
                                                        {0.35f},
                                                        {0.42f, true},
                                                        {0.35f, true},
                                                        {0.3f, true},
                                                        {0.25f, true}}};
  static constexpr int kLevels = static_cast<int>(kCoarse.size());  // 0 is the whole frame
  static const CoarseLevel& coarse(int level) { return kCoarse[static_cast<std::size_t>(level > 0 ? level - 1 : 0)]; }
  const CoarseLevel& now() const { return coarse(level_); }
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
