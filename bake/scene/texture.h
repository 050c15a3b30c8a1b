// Textures: their values at a point, or the mean over what a pixel shows of them.
#pragma once

#include "bake/jobs/context.h"
#include "bake/scene/scene.h"

namespace oriel {

// What a pixel shows of a triangle: an ellipse around a point, 0: the point alone. Its radii are steps of the
// barycentric weights, by which those of any texture coordinates follow.
struct Footprint {
  Vec2 shorter{0}, longer{0};
  bool is_point() const { return shorter == Vec2(0) && longer == Vec2(0); }
};

// Of a cone of that width (metres) where it meets the triangle's plane along `direction` (unit).
Footprint cone_footprint(const Scene& scene, std::uint32_t triangle, const Vec3& direction, float width_m);

// A texture value, RGBA in [0,1], bilinear (or nearest), `srgb` decodes colour channels to linear. With a footprint
// (radii in texture coordinates) its mean over that: of a few places along the longer radius, each read from the levels
// whose texels are as wide as the shorter one (Image::mips). Without levels, or with `nearest`, the value at uv.
Vec4 sample_texture(const Scene& scene, const TextureSlot& slot, const Vec2& uv, bool srgb, const Footprint& over = {});

// Fills Image::mips of all images: means of light, where a material reads an image as colour, and of what its alpha
// leaves, where one is cut out by it. A third more memory.
// Error kStopped.
Status make_mips(Scene& scene, Context& context);

}  // namespace oriel
