// The image that a reflector shows, splatted from its maps on the CPU (Bastos et al. 1999, section 8.1.3, "Selection",
// "Reprojection", "Reconstruction"): tells whether captured maps are right, apart from the player.
#pragma once

#include <span>
#include <vector>

#include "bake/radiance/reproject.h"
#include "formats/assets/camera.h"

namespace oriel::test {

// The height above the plane of that disparity.
float height_of(const RadianceMap& map, float disparity);

// A pinhole camera over width * height pixels, in reflector space: pixel (x, y), y downwards, of the point
// eye + s (right (x - width/2) / focal_px - up (y - height/2) / focal_px + forward), s > 0.
struct Pinhole {
  Vec3 eye{0};
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  float focal_px = 1;
  std::uint32_t width = 1, height = 1;
};
// `camera`: perspective, pack space.
Pinhole pinhole_from_camera(const Reflector& reflector, const Camera& camera, std::uint32_t width,
                            std::uint32_t height);

// Equation (3): the size in pixels, along the map's x and y, of the splat that one of its pixels makes in the image of
// `mirror_view`, the camera mirrored in the plane. p: the pixel's scene point. Window: the map's pixels per unit of
// tangent over the image's; DistanceScale: depth from the map's eye over depth from the view; Angular: sine of the
// angle between the view's forward direction and the map's x (y) axis.
Vec2 point_size(const RadianceMap& map, const Pinhole& mirror_view, const Vec3& p);

enum class SelectBy : std::uint8_t { kAngle, kDistance };
// For each element the n maps whose viewpoint is nearest to the mirrored eye (reflector space, z < 0): by the angle at
// the element's centre, or by distance. Indices into `maps` (all of the pack's), best first, elements in the
// maps' order; ties go to the lower index.
std::vector<std::uint32_t> select_maps(const Reflector& reflector, std::span<const RadianceMap> maps,
                                       const Vec3& mirrored_eye, std::uint32_t n, SelectBy by);

struct ReflectionImage {
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> radiance;         // 0 in holes
  std::vector<float> depth;           // along the view, metres, of the mirrored point; infinite in holes and for sky
  std::vector<std::uint8_t> covered;  // 1 where a splat fell
  std::vector<std::uint8_t> inside;   // 1 where the pixel's centre sees the reflector's bounds from its front
};
// The image M of the reflector: pixels of the given maps, splatted as screen-aligned boxes of point_size, nearest depth
// first. Only inside the reflector's bounds. Invalid pixels (valid 0) make no splat.
ReflectionImage render_reflection(const Reflector& reflector, std::span<const RadianceMap> maps,
                                  std::span<const std::uint32_t> selection, const Pinhole& view);

}  // namespace oriel::test
