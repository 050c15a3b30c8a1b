// Pixels of the frames that people see: which points of the lightmap they show, and how much of its light.
#pragma once

#include "bake/atlas/atlas.h"
#include "bake/jobs/context.h"
#include "bake/trace/path.h"
#include "formats/core/archive.h"

namespace oriel {

struct FramePixel {
  std::uint32_t eye = 0;       // number of the eye that sees it
  std::uint32_t triangle = 0;  // the point that it shows, on the front side
  Vec2 barycentric{0};
  // Radiance at the eye for each lux at the point, sr⁻¹: the diffuse reflectance there over π, times what panes and a
  // mirror on the way leave of it.
  Vec3 transfer{0};
  Vec3 emitted{0};  // cd/m², by the point itself
  // What bilinear filtering reads: texels y * width + x of the page, and their shares, whose sum is 1.
  std::uint32_t page = 0;
  std::array<std::uint32_t, 4> texel{};
  std::array<float, 4> share{};
};

inline void fields(Archive& archive, FramePixel& p) {
  archive(p.eye, p.triangle, p.barycentric, p.transfer, p.emitted, p.page, p.texel, p.share);
}

struct FrameEyes {
  std::span<const Vec3> eyes;
  std::uint32_t per_eye = 0;  // directions
};
// `per_eye` directions from every eye, uniform over the sphere: frames in all headings show each direction as often as
// any other. A pixel is the first surface with a diffuse part and a lightmap on its way, through cut-outs and panes
// (one of their layers, by chance) and by one mirror or glossy surface at most. Directions that meet none (the sky,
// backs, what only emits) make no pixel. In an order whose beginnings are spread evenly over the eyes. Error kStopped.
Result<std::vector<FramePixel>> find_frame_pixels(const Transport& transport, const Atlas& atlas, const FrameEyes& eyes,
                                                  std::uint64_t seed, Context& context);

// Eyes for a scene of which nobody said where people are: uniform over the air in front of its surfaces, on chords that
// leave these by the cosine, so that gaps count by their volume. Empty where there is no surface. Scene space, m.
std::vector<Vec3> eyes_in_the_open(const Transport& transport, std::uint32_t count, std::uint64_t seed);

}  // namespace oriel
