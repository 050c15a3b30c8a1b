// Reprojection of radiance maps on the CPU: the same maths as the player's shaders, and the reference that tests hold
// them against (Bastos et al. 1999, section 8.1.3, "Selection", "Reprojection", "Reconstruction").
#pragma once

#include <span>
#include <vector>

#include "formats/assets/camera.h"
#include "formats/assets/radiance_map.h"

namespace oriel {

// Points between pack space and a reflector's space. Rigid both ways, by differences to the origin: no matrix is
// inverted.
Vec3 reflector_from_pack(const Reflector& reflector, const Vec3& p);
Vec3 pack_from_reflector(const Reflector& reflector, const Vec3& p);
// The mirror image in the reflector's plane, reflector space.
inline Vec3 mirrored(const Vec3& p) {
  return {p.x, p.y, -p.z};
}

// The point of the element's rectangle under a pixel position; centres are at i + ½.
Vec2 map_point(const RadianceMap& map, const Vec2& pixel);
// The pixel position under which the map's eye sees p (reflector space, p.z > eye.z).
Vec2 map_pixel(const RadianceMap& map, const Vec3& p);
// Disparity of a point at height z above the plane, and back: e / (e + z) with e the eye's distance from the plane.
float disparity_of(const RadianceMap& map, float z);
float height_of(const RadianceMap& map, float disparity);
// The scene point of a pixel, reflector space, homogeneous: w is the disparity, so that w = 0 is a direction (sky).
Vec4 unproject(const RadianceMap& map, const Vec2& pixel, float disparity);

// The map's off-axis projection: near plane the reflector's (clip z/w = -1), far at infinity (+1), the element's
// rectangle fills [-1, 1]². disparity = (1 - z/w) / 2.
Mat4 clip_from_reflector(const RadianceMap& map);

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
// maps' order; ties go to the lower index. Residual maps are not among them.
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

}  // namespace oriel
