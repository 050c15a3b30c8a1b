// A reflector's place in the frame: its region in the stencil, and (M * K) R drawn there.
#pragma once

#include <span>

#include "player/gpu/program.h"
#include "player/reflections/image_target.h"
#include "player/scene/frame_context.h"

namespace oriel {

// A rectangle around what is visible is as tight as a strip.
inline constexpr int kMaskStrips = 8;
inline constexpr std::size_t kMaskQueries = 2 * kMaskStrips;

// In place of a mark: added to what is there; into an image, with the distance of what the reflector shows.
inline constexpr GLint kAdded = 0, kAddedWithDistance = -1;

class ReflectorPass {
 public:
  static Result<ReflectorPass> create(gpu::Dialect dialect);

  // Asks which strips along each axis have pixels of the reflector that the frame's depth leaves visible: kMaskQueries
  // queries. screen: what the reflector covers.
  void ask_visible(const FrameContext& context, const GpuReflector& reflector, const NdcRect& screen,
                   std::span<const gpu::Query> queries) const;
  // Marks these pixels in the stencil: by kSeeThroughBit, or by a number in kReflectorBits.
  void draw_mask(const FrameContext& context, const GpuReflector& reflector, GLuint mark) const;
  // The strips of a mask that have pixels, as a rectangle around what is visible; empty where nothing is. Waits for the
  // queries.
  static NdcRect visible_part(const NdcRect& screen, const View& view, std::span<const gpu::Query> queries);
  // An image, times R unless options show a stage before it. value: as marked, where it replaces what the frame holds;
  // kAdded: adds to it wherever the depth leaves the reflector visible.
  void draw_light(const FrameContext& context, const ReflectedImage& image, GLint value) const;
  // The same of an image that is as fine as the frame (rect.scale 1) and is convolved on the way: target.filled, all
  // levels.
  void draw_convolved(const FrameContext& context, const ReflectedImage& image, GLint value) const;
  // Adds the emitters that the image leaves out.
  void draw_emitters(const FrameContext& context, const GpuReflector& reflector, GLint value) const;

 private:
  void begin_mask(const FrameContext& context, GLuint mark, GLuint bits) const;
  // What every program needs to know about the reflector and its R.
  void set_surface(const gpu::Program& program, const FrameContext& context, const GpuReflector& reflector) const;
  // The program for those that the reflector's maps leave out, in use from then on; null where there is nothing to
  // show.
  const gpu::Program* set_emitters(const FrameContext& context, const GpuReflector& reflector) const;
  gpu::Program mask_, compose_, convolve_, emitters_, emitters_sharp_;
};

}  // namespace oriel
