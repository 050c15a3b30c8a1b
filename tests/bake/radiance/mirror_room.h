// A closed room with a mirror, whose every ray has a closed form.
#pragma once

#include "bake/radiance/capture.h"
#include "tests/bake/radiance/uniform_views.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel::test {

inline constexpr float kMirrorInset = 1.0f / 64;  // of the mirror before its wall, in room units

// The room is [0, 4] x [0, 3] x [0, 5] times `scale`, its walls facing inwards with one material each: -x, +x, -y, +y,
// -z, +z are materials 1 … 6; the mirror (material 0, 2 x 1.5) hangs before the -z wall and faces +z.
struct MirrorRoom {
  float scale;
  Scene scene;

  explicit MirrorRoom(float s = 1, float mirror_roughness = 0) : scale(s) {
    SceneParts parts;
    SceneMaterial mirror;
    mirror.name = "mirror";
    mirror.base_color = Vec3(0.9f);
    mirror.metallic = 1;
    mirror.roughness = mirror_roughness;
    parts.add(mirror);
    for (int i = 0; i < 6; ++i) parts.diffuse(Vec3(0.5f));
    const Vec3 size = s * Vec3(4, 3, 5);
    const char* names[] = {"-x", "+x", "-y", "+y", "-z", "+z"};
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 u(0), v(0), o(0);
      u[(axis + 1) % 3] = size[(axis + 1) % 3];
      v[(axis + 2) % 3] = size[(axis + 2) % 3];
      parts.quad(names[2 * axis], 1 + 2 * axis, o, u, v);  // u × v is +axis: inwards
      o[axis] = size[axis];
      parts.quad(names[2 * axis + 1], 2 + 2 * axis, o, v, u);
    }
    parts.quad("mirror", 0, s * Vec3(1, 0.75f, kMirrorInset), {2 * s, 0, 0}, {0, 1.5f * s, 0});
    scene = parts.finish();
  }

  std::vector<ReflectorMaterial> materials() const {
    std::vector<ReflectorMaterial> out;
    for (const SceneMaterial& m : scene.materials)
      out.push_back({m.roughness, glm::mix(Vec3(0.04f * m.specular), m.base_color, m.metallic),
                     glm::mix(m.specular, 1.0f, m.metallic)});
    return out;
  }
  ReflectorOptions reflector_options() const {
    ReflectorOptions options;
    options.min_area_m2 = 0.25f * scale * scale;
    return options;
  }

  // Where a ray from inside leaves the room, and the material there.
  DVec3 exit_point(const DVec3& origin, const DVec3& direction, std::uint32_t& material) const {
    double nearest = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) continue;
      const double wall = direction[axis] > 0 ? scene.upper[axis] : scene.lower[axis];
      const double t = (wall - origin[axis]) / direction[axis];
      if (t < nearest) {
        nearest = t;
        material = 1 + 2 * axis + (direction[axis] > 0 ? 1 : 0);
      }
    }
    return origin + nearest * direction;
  }
  static Vec3 colour(std::uint32_t material) {
    return {static_cast<float>(material), 1, 0.5f * static_cast<float>(material)};
  }

  // The radiance of a surface is the colour of its material.
  OutgoingRadiance outgoing() const {
    return [this](const SeenSurface& surface) {
      return colour(scene.surfaces[scene.triangle_surface[surface.hit.triangle]].material);
    };
  }
};

struct Captured {
  std::vector<FoundReflector> reflectors;
  ViewPlan plan;
};

inline Captured capture(const Accel& accel, const MirrorRoom& room, const ViewOptions& options, int threads = 2) {
  Captured out;
  out.reflectors = find_reflectors(accel, room.materials(), room.reflector_options()).reflectors;
  out.plan = plan_views(room.scene, out.reflectors, options);
  Context context;
  context.threads = threads;
  if (!capture_maps({ReflectedSurroundings(accel, out.reflectors, {}), room.outgoing()}, context, out.plan.maps))
    out.plan.maps.clear();
  return out;
}

}  // namespace oriel::test
