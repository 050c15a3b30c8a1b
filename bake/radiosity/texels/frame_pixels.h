// Frame pixels: points of the lightmap that viewers see, with their contribution to the image.
#pragma once

#include "bake/atlas/atlas.h"
#include "bake/jobs/context.h"
#include "bake/trace/path.h"
#include "formats/core/archive.h"

namespace oriel {

struct FramePixel {
  std::uint32_t view = 0;      // the number of the view that sees it
  std::uint32_t triangle = 0;  // the visible point, on the front side
  Vec2 barycentric{0};
  // Radiance in the view per lux at the point, sr⁻¹: the diffuse reflectance over π, times the throughput of panes and
  // a mirror on the way.
  Vec3 transfer{0};
  Vec3 emitted{0};  // emission of the point, cd/m²
  // The four texels that bilinear filtering reads, y * width + x on the page, and their weights, which sum to 1.
  std::uint32_t page = 0;
  std::array<std::uint32_t, 4> texel{};
  std::array<float, 4> share{};
};

inline void fields(Archive& archive, FramePixel& p) {
  archive(p.view, p.triangle, p.barycentric, p.transfer, p.emitted, p.page, p.texel, p.share);
}

// View samples for find_frame_pixels().
struct FrameViews {
  std::span<const Vec3> positions;  // scene space, m
  std::uint32_t directions_per_view = 0;
};
// Traces directions uniform over the sphere from every view, so that all headings count alike. A pixel is the first
// diffuse surface with a lightmap on the way. The ray passes cut-outs and panes (one of their layers, by chance), and
// one mirror or glossy surface at most. A direction that meets no such surface (the sky, a back side, an emitter) gives
// no pixel. The pixels are ordered so that each prefix is spread evenly over the views. Error kStopped.
Result<std::vector<FramePixel>> find_frame_pixels(const Transport& transport, const Atlas& atlas,
                                                  const FrameViews& views, std::uint64_t seed, Context& context);

// View positions for a scene without given ones: uniform over the air in front of its surfaces. They lie on chords that
// leave the surfaces with a cosine distribution, so gaps count by their volume. Empty where there is no surface. Scene
// space, m.
std::vector<Vec3> sample_view_positions(const Transport& transport, std::uint32_t count, std::uint64_t seed);

}  // namespace oriel
