#include "study/diefenbach1997/volume_cache.h"

#include <algorithm>
#include <chrono>
#include <tuple>

#include "player/scene/surface.h"

namespace oriel::study {
namespace {

constexpr std::uint64_t kKept = 64;  // frames that a volume is kept for without being drawn

// A corner of the cut, by which both triangles of an edge find the same place.
Vec3 crossing(const Vec3& a, const Vec3& b, const Vec4& plane) {
  const auto order = [](const Vec3& v) { return std::tuple(v.x, v.y, v.z); };
  if (order(b) < order(a)) return crossing(b, a, plane);
  const double at = glm::dot(DVec4(plane), DVec4(DVec3(a), 1)), other = glm::dot(DVec4(plane), DVec4(DVec3(b), 1));
  return Vec3(glm::mix(DVec3(a), DVec3(b), at / (at - other)));
}

void cut_by(const Vec4& plane, std::vector<Vec3>& polygon) {
  std::vector<Vec3> kept;
  const auto above = [&](const Vec3& p) { return glm::dot(DVec4(plane), DVec4(DVec3(p), 1)) > 0; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (above(a)) kept.push_back(a);
    if (above(a) != above(b)) kept.push_back(crossing(a, b, plane));
  }
  polygon = std::move(kept);
}

// A plane of pack space in that of an object.
Vec4 plane_in(const Mat4& pack_from_object, const LightMirror& mirror) {
  Vec4 plane = mirror.plane;
  plane.w -= mirror.margin;
  return glm::transpose(pack_from_object) * plane;
}

Vec4 place_in(const Mat4& pack_from_object, const Vec4& place) {
  return Vec4(glm::inverse(DMat4(pack_from_object)) * DVec4(place));
}

// Heights of a box over a plane: the least and the largest.
Vec2 heights(const Bounds& box, const Vec4& plane) {
  const Vec3 middle = box.center(), half = 0.5f * (box.upper - box.lower);
  const float at = glm::dot(Vec3(plane), middle) + plane.w, reach = glm::dot(glm::abs(Vec3(plane)), half);
  return {at - reach, at + reach};
}

// Whether the line between two homogeneous places may meet the box.
bool may_meet(const Bounds& box, const Vec4& place, const Vec4& light) {
  if (place.w == 0 && light.w == 0) return true;
  const bool from_light = place.w == 0;
  const Vec4 &start = from_light ? light : place, &end = from_light ? place : light;
  const DVec3 from = DVec3(start) / double{start.w}, along = DVec3(end) - double{end.w} * from;
  double enters = 0, leaves = end.w == 0 ? std::numeric_limits<double>::infinity() : 1 / double{end.w};
  const double slack = 1e-4 * (box.radius() + 1e-6);
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = box.lower[axis] - slack - from[axis], upper = box.upper[axis] + slack - from[axis];
    if (along[axis] == 0) {
      if (lower > 0 || upper < 0) return false;
      continue;
    }
    const double a = lower / along[axis], b = upper / along[axis];
    enters = std::max(enters, std::min(a, b)), leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves;
}

bool throws_shadow(const GpuScene& scene, std::uint32_t material) {
  return !scene.is_transparent(material) && cutoff_of(scene.pack().materials[material]) < 0;
}

void add_part(const Mesh& mesh, const MeshPart& part, std::vector<UVec3>& triangles) {
  for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3)
    triangles.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
}

}  // namespace

CutTriangles cut_triangles(std::span<const Vec3> positions, std::span<const UVec3> triangles,
                           std::span<const Vec4> planes) {
  CutTriangles out;
  for (const UVec3& t : triangles) {
    std::vector<Vec3> polygon{positions[t.x], positions[t.y], positions[t.z]};
    for (const Vec4& plane : planes) cut_by(plane, polygon);
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    out.positions.insert(out.positions.end(), polygon.begin(), polygon.end());
    for (std::uint32_t k = 2; k < polygon.size(); ++k) out.triangles.emplace_back(first, first + k - 1, first + k);
  }
  return out;
}

Result<VolumeCache> VolumeCache::create(gpu::Dialect dialect) {
  VolumeCache cache;
  ORIEL_TRY(cache.program_, gpu::Program::create("shadow_volume", dialect));
  return cache;
}

std::shared_ptr<const VolumeCache::Caster> VolumeCache::make_caster(std::span<const Vec3> positions,
                                                                    std::span<const UVec3> triangles) {
  auto caster = std::make_shared<Caster>();
  caster->mesh = ShadowMesh(positions, triangles);
  std::vector<Vec4> places;
  for (const Vec3& p : caster->mesh.positions()) {
    caster->bounds.extend(p);
    places.emplace_back(p, 0), places.emplace_back(p, 1);
  }
  if (places.empty()) return caster;
  caster->vertices = gpu::make_vertex_array();
  glBindVertexArray(caster->vertices.name());
  gpu::add_attribute(caster->buffers, 0, places, {4, GL_FLOAT});
  glBindVertexArray(0);
  return caster;
}

// Parts of one node, and of one name, are one object.
void VolumeCache::take_scene(const GpuScene& scene) {
  const Mesh& mesh = scene.pack().mesh;
  objects_.clear(), volumes_.clear(), stats_.bytes = 0;
  mirrors_.clear(), apertures_.clear(), aperture_volumes_.clear();
  std::map<std::string, std::vector<UVec3>> by_name;
  for (const MeshPart& part : mesh.parts)
    if (throws_shadow(scene, part.material)) add_part(mesh, part, by_name[part.name]);
  for (auto& [name, triangles] : by_name) {
    Object object;
    std::map<std::uint32_t, std::uint32_t> known;
    for (UVec3& t : triangles)
      for (int k = 0; k < 3; ++k) {
        const auto [at, is_new] = known.try_emplace(t[k], static_cast<std::uint32_t>(object.positions.size()));
        if (is_new) object.positions.push_back(mesh.positions[t[k]]);
        t[k] = at->second;
      }
    object.triangles = std::move(triangles);
    object.whole = make_caster(object.positions, object.triangles);
    objects_.push_back(std::move(object));
  }
  of_scene_ = objects_.size();
  for (const Mover& mover : scene.pack().movers) {
    Object object;
    object.positions = mover.mesh.positions;
    for (const MeshPart& part : mover.mesh.parts)
      if (throws_shadow(scene, part.material)) add_part(mover.mesh, part, object.triangles);
    object.whole = make_caster(object.positions, object.triangles);
    objects_.push_back(std::move(object));
  }
  scene_ = scene.geometry_serial();
}

void VolumeCache::place_movers(const GpuScene& scene, std::span<const PlacedMover> movers) {
  for (std::size_t i = of_scene_; i < objects_.size(); ++i) objects_[i].there = false;
  for (const PlacedMover& placed : movers) {
    const auto mover = static_cast<std::size_t>(placed.mover - scene.movers().data());
    Object& object = objects_[of_scene_ + mover];
    object.there = true;
    if (object.pack_from_object == placed.pack_from_object) continue;
    object.pack_from_object = placed.pack_from_object;
    object.moved = frame_;
    object.parts.clear();
  }
}

void VolumeCache::begin(const FrameContext& context, std::span<const PlacedMover> movers,
                        std::span<const LightMirror> mirrors) {
  const GpuScene& scene = context.scene;
  ++frame_;
  stats_ = {.bytes = stats_.bytes};
  std::erase_if(volumes_, [&](const auto& entry) {
    const bool old = entry.second.used + kKept < frame_;
    if (old) stats_.bytes -= entry.second.bytes;
    return old;
  });
  if (scene_ != scene.geometry_serial()) take_scene(scene);
  place_movers(scene, movers);
  const auto same = [](const LightMirror& a, const LightMirror& b) {
    return a.reflector == b.reflector && a.plane == b.plane;
  };
  if (std::ranges::equal(mirrors, mirrors_, same)) return;
  mirrors_.assign(mirrors.begin(), mirrors.end());
  for (Object& object : objects_) object.parts.clear();
  apertures_.clear(), aperture_volumes_.clear();
  const Pack& pack = scene.pack();
  for (const LightMirror& mirror : mirrors_) {
    Object& aperture = apertures_.emplace_back();
    const std::vector<std::uint32_t>& indices = pack.reflectors[mirror.reflector].indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
      aperture.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    aperture.whole = make_caster(pack.mesh.positions, aperture.triangles);
  }
}

// Which of the mirrors the object does not stand wholly before.
std::vector<std::uint32_t> VolumeCache::cutting(const Object& object, std::span<const std::uint32_t> walls) const {
  std::vector<std::uint32_t> cuts;
  for (const std::uint32_t m : walls)
    if (heights(object.whole->bounds, plane_in(object.pack_from_object, mirrors_[m])).x <= 0) cuts.push_back(m);
  std::ranges::sort(cuts);
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

std::shared_ptr<const VolumeCache::Caster> VolumeCache::caster_of(Object& object,
                                                                  const std::vector<std::uint32_t>& cuts) {
  if (cuts.empty()) return object.whole;
  std::shared_ptr<const Caster>& part = object.parts[cuts];
  if (part != nullptr) return part;
  std::vector<Vec4> planes;
  for (const std::uint32_t m : cuts) planes.push_back(plane_in(object.pack_from_object, mirrors_[m]));
  const CutTriangles cut = cut_triangles(object.positions, object.triangles, planes);
  return part = make_caster(cut.positions, cut.triangles);
}

const VolumeCache::Volume& VolumeCache::volume(const Key& key, const std::shared_ptr<const Caster>& caster,
                                               const Vec4& light, std::uint64_t moved) {
  Volume& volume = volumes_[key];
  volume.used = frame_;
  if (volume.caster == caster && volume.light == light) {
    ++stats_.reused;
    return volume;
  }
  const auto start = std::chrono::steady_clock::now();
  ++(volume.caster == nullptr ? stats_.built_new
     : moved > volume.built   ? stats_.built_for_object
                              : stats_.built_for_light);
  const ShadowMesh::WholeVolumes built = caster->mesh.whole_volumes(light);
  stats_.bytes -= volume.bytes;
  volume.caster = caster, volume.light = light, volume.built = frame_;
  volume.count = static_cast<GLsizei>(built.indices.size()), volume.sides = static_cast<GLsizei>(built.sides);
  volume.bytes = built.indices.size() * sizeof(std::uint32_t);
  stats_.bytes += volume.bytes;
  glBindVertexArray(caster->vertices.name());
  volume.indices = gpu::Buffer(GL_ELEMENT_ARRAY_BUFFER, std::span<const std::uint32_t>(built.indices));
  glBindVertexArray(0);
  stats_.build_ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return volume;
}

std::uint32_t VolumeCache::around(const Request& request, const Vec4& place) {
  std::uint32_t count = 0;
  for (Object& object : objects_) {
    if (!object.there || object.whole->empty()) continue;
    const auto caster = caster_of(object, cutting(object, request.leg.walls));
    if (caster->empty()) continue;
    const Vec4 at = place_in(request.leg.last_from_leg * object.pack_from_object, place);
    const Vec4 light = place_in(object.pack_from_object, request.leg.light);
    if (!may_meet(caster->bounds, at, light)) continue;
    count += caster->mesh.triangles_between(at, light);
  }
  return count;
}

void VolumeCache::begin_draw(const View& view, GLuint bits) const {
  gpu::apply({.depth_test = true, .color_write = false, .mirrored = view.mirrored, .stencil_write = bits});
  glDepthFunc(GL_LESS);
  glEnable(GL_DEPTH_CLAMP);  // no near plane cuts what lies between it and the eye, no far plane the endless sides
  program_.use();
}

void VolumeCache::end_draw() {
  glBindVertexArray(0);
  glDisable(GL_DEPTH_CLAMP);
}

// Sides, then the triangles themselves, a little behind where they are: one that is seen is not crossed.
void VolumeCache::draw_volume(const Volume& volume, const Mat4& clip_from_object, bool flipped,
                              FrameStats& stats) const {
  if (volume.count == 0) return;
  glStencilOpSeparate(flipped ? GL_BACK : GL_FRONT, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
  glStencilOpSeparate(flipped ? GL_FRONT : GL_BACK, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
  program_.set("u_clip_from_pack", clip_from_object);
  program_.set("u_light", volume.light);
  glBindVertexArray(volume.caster->vertices.name());
  volume.indices.bind(GL_ELEMENT_ARRAY_BUFFER);
  if (volume.sides > 0) draw_indices(0, static_cast<std::uint32_t>(volume.sides), stats);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1, 2);
  draw_indices(static_cast<std::uint32_t>(volume.sides), static_cast<std::uint32_t>(volume.count - volume.sides),
               stats);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void VolumeCache::draw(const Request& request, const View& view, GLuint bits, FrameStats& stats) {
  const auto first = request.path.mirrors.begin();
  const std::vector<std::uint32_t> before(first, first + static_cast<std::ptrdiff_t>(request.stretch));
  const bool flipped = (request.path.mirrors.size() - request.stretch) % 2 != 0;
  begin_draw(view, bits);
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    Object& object = objects_[i];
    if (!object.there || object.whole->empty()) continue;
    const std::vector<std::uint32_t> cuts = cutting(object, request.leg.walls);
    const auto caster = caster_of(object, cuts);
    if (caster->empty()) continue;
    const Vec4 light = place_in(object.pack_from_object, request.leg.light);
    const Volume& shadows = volume({i, request.path.source, before, cuts}, caster, light, object.moved);
    draw_volume(shadows, view.clip_from_pack * request.leg.last_from_leg * object.pack_from_object, flipped, stats);
  }
  end_draw();
}

std::uint32_t VolumeCache::around_aperture(const Request& request, const Vec4& place) {
  const ShadowMesh& mesh = apertures_[request.path.mirrors[request.stretch - 1]].whole->mesh;
  return mesh.triangles_between(place_in(request.leg.last_from_leg, place), request.leg.light);
}

void VolumeCache::draw_aperture(const Request& request, const View& view, GLuint bits, FrameStats& stats) {
  const std::uint32_t mirror = request.path.mirrors[request.stretch - 1];
  const auto& caster = apertures_[mirror].whole;
  if (caster->empty()) return;
  const auto first = request.path.mirrors.begin();
  const std::vector<std::uint32_t> before(first, first + static_cast<std::ptrdiff_t>(request.stretch));
  Volume& volume = aperture_volumes_[{mirror, request.path.source, before, {}}];
  if (volume.caster != caster || volume.light != request.leg.light) {
    const ShadowMesh::WholeVolumes built = caster->mesh.whole_volumes(request.leg.light);
    volume.caster = caster, volume.light = request.leg.light;
    volume.count = static_cast<GLsizei>(built.indices.size()), volume.sides = static_cast<GLsizei>(built.sides);
    glBindVertexArray(caster->vertices.name());
    volume.indices = gpu::Buffer(GL_ELEMENT_ARRAY_BUFFER, std::span<const std::uint32_t>(built.indices));
  }
  begin_draw(view, bits);
  const bool flipped = (request.path.mirrors.size() - request.stretch) % 2 != 0;
  draw_volume(volume, view.clip_from_pack * request.leg.last_from_leg, flipped, stats);
  end_draw();
}

}  // namespace oriel::study
