#include "bake/trace/path.h"
#include "bake/trace/rounded.h"

namespace oriel {
namespace {

// The normal n, or, where a map has turned it away from wo, n bent back until wo grazes the surface: lobes are defined
// on the side of wo only, and a switch to another normal there would show as an edge.
Vec3 facing(const Vec3& n, const Vec3& wo) {
  constexpr float kGrazing = 1e-3f;
  const float missing = kGrazing - glm::dot(n, wo);
  return missing > 0 ? glm::normalize(n + missing * wo) : n;
}

// The unit direction in the surface along which an anisotropic lobe is wide; 0 where texture coordinates give none.
Vec3 wide_direction(const Scene& scene, const Hit& hit, const SceneMaterial& material, const Vec3& normal,
                    const Vec2& in_tangent_frame) {
  const Vec4 tangent = tangent_at(scene, hit.triangle, hit.barycentric, normal, material.anisotropy_texture);
  const Vec3 across = Vec3(tangent) - glm::dot(Vec3(tangent), normal) * normal;
  const Vec3 t = normalize_or(across, Vec3(0));
  return in_tangent_frame.x * t + in_tangent_frame.y * tangent.w * glm::cross(normal, t);
}

}  // namespace

SurfacePoint geometry_at(const Scene& scene, const Hit& hit, const Vec3& direction) {
  SurfacePoint s;
  s.triangle = hit.triangle;
  s.barycentric = hit.barycentric;
  s.position = point_on(scene, hit.triangle, hit.barycentric);
  const UVec3& t = scene.triangles[hit.triangle];
  for (int i = 0; i < 3; ++i) s.magnitude = std::max(s.magnitude, max_component(glm::abs(scene.positions[t[i]])));
  const float side = hit.front ? 1.0f : -1.0f;
  s.geometric_normal = side * geometric_normal(scene, hit.triangle);
  const Vec2& b = hit.barycentric;
  s.normal =
      normalize_or(side * ((1 - b.x - b.y) * scene.normals[t.x] + b.x * scene.normals[t.y] + b.y * scene.normals[t.z]),
                   s.geometric_normal);
  // Seen from below its shading normal, a surface is shaded with its geometric one.
  if (glm::dot(s.normal, direction) >= 0) s.normal = s.geometric_normal;
  s.front = hit.front;
  const SceneMaterial& material = scene.material_of(hit.triangle);
  s.reflects = hit.front || material.double_sided || material.solid;
  return s;
}

SurfacePoint surface_at(const Scene& scene, const Hit& hit, const Vec3& direction, float width_m) {
  const Footprint footprint = width_m > 0 ? cone_footprint(scene, hit.triangle, direction, width_m) : Footprint();
  SurfacePoint s = geometry_at(scene, hit, direction);
  const SceneMaterial& material = scene.material_of(hit.triangle);
  if (material.normal_texture.image >= 0) {
    const float side = hit.front ? 1.0f : -1.0f;
    s.normal =
        facing(side * mapped_normal(scene, hit.triangle, hit.barycentric, side * s.normal, footprint), -direction);
  }
  s.shade = shade_point(scene, hit.triangle, hit.barycentric, footprint);
  if (material.solid && !hit.front) {
    turn_inside(s.shade);
    s.reflects = s.shade.inside || material.double_sided;
  }
  if (s.shade.anisotropy > 0)
    s.tangent = wide_direction(scene, hit, material, (hit.front ? 1.0f : -1.0f) * s.normal, s.shade.wide_direction);
  s.emits = s.reflects && max_component(s.shade.emission) > 0;
  return s;
}

SurfacePoint surface_at(const Accel& accel, const Hit& hit, const Vec3& direction, float width_m) {
  SurfacePoint s = surface_at(accel.scene(), hit, direction, width_m);
  if (accel.scene().material_of(hit.triangle).normal_texture.image < 0) s.rounded = height_of_rounded(accel, s);
  return s;
}

SurfacePoint point_on_side(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric, bool front) {
  const Vec3 normal = geometric_normal(scene, triangle);
  return geometry_at(scene, {triangle, 0, barycentric, front}, front ? -normal : normal);
}

SurfacePoint point_on_side(const Accel& accel, std::uint32_t triangle, const Vec2& barycentric, bool front) {
  SurfacePoint s = point_on_side(accel.scene(), triangle, barycentric, front);
  s.rounded = height_of_rounded(accel, s);
  return s;
}

}  // namespace oriel
