#include "bake/trace/accel.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>

#include "bake/scene/shade.h"
#include "bake/trace/glass.h"
#include "bake/trace/planar_mirrors.h"
#include "formats/core/check.h"

namespace oriel {
namespace {

constexpr unsigned kOpaqueMask = 1;
constexpr unsigned kTransmittingMask = 2;
constexpr unsigned kSolidMask = 4;    // solid glass
constexpr unsigned kFrostedMask = 8;  // flat frosted panes, where there are lights that they spread
constexpr unsigned kAnyMask = kOpaqueMask | kTransmittingMask | kSolidMask | kFrostedMask;
constexpr int kPacket = 16;              // rays that Embree traces together
constexpr float kMoved = 32 * 0x1p-24f;  // of a point's largest coordinate: how far rays start off it
constexpr int kMaxLayers = 256;  // of transmitting surfaces along one shadow ray: beyond it, it is taken as blocked

// Triangles of one kind (opaque, letting some light through, solid glass, frosted) as one Embree geometry.
struct Group {
  std::vector<UVec3> indices;
  std::vector<std::uint32_t> triangle;  // primitive → Scene triangle; empty: the same number
};

// What Embree reads as long as its scene lives.
struct SharedShape {
  std::vector<Vec3> positions;
  Group groups[4];
};

bool traceable(const Ray& ray, float scale) {
  // Embree asserts on coordinates beyond about 1.8e18.
  return is_finite(ray.origin) && is_finite(ray.direction) && max_component(glm::abs(ray.origin)) * scale < 1e18f &&
         ray.max_distance > 0;
}

}  // namespace

struct Accel::Impl {
  DroppedSamples dropped;
  const Scene* scene = nullptr;
  float scale = 1;  // Embree's units per metre: a power of two, so that scaling is exact
  std::shared_ptr<SharedShape> shape = std::make_shared<SharedShape>();
  bool any_transmitting = false;  // solid glass too
  RTCDevice device = nullptr;
  RTCScene rtc_scene = nullptr;

  ~Impl() {
    if (rtc_scene) rtcReleaseScene(rtc_scene);
    if (device) rtcReleaseDevice(device);
  }

  void add_group(int id, unsigned mask) {
    const std::vector<UVec3>& indices = shape->groups[id].indices;
    if (indices.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, shape->positions.data(), 0,
                               sizeof(Vec3), scene->positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0, sizeof(UVec3),
                               indices.size());
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetGeometryMask(geometry, mask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(rtc_scene, geometry, static_cast<unsigned>(id));
    rtcReleaseGeometry(geometry);
  }

  // Of a pair of twins only the first is traced.
  bool is_second_twin(std::uint32_t t) const { return !scene->twin.empty() && scene->twin[t] < t; }

  void split_groups() {
    std::vector<std::uint8_t> kind(scene->materials.size());
    for (std::size_t m = 0; m < kind.size(); ++m) {
      const SceneMaterial& material = scene->materials[m];
      any_transmitting |= kind[m] = may_transmit(material);
      if (kind[m] && material.solid) kind[m] = 2;
    }
    if (!any_transmitting && scene->twin.empty()) {
      shape->groups[0].indices = scene->triangles;
      return;
    }
    std::vector<char> frosted;  // by triangle; empty: none is
    if (!scene->lights.empty()) frosted = PlanarMirrors::frosted_panes(*scene).triangles_of(*scene);
    for (std::uint32_t t = 0; t < scene->triangles.size(); ++t) {
      if (is_second_twin(t)) continue;
      const std::uint8_t own = kind[scene->surfaces[scene->triangle_surface[t]].material];
      Group& group = shape->groups[!frosted.empty() && frosted[t] ? 3 : own];
      group.indices.push_back(scene->triangles[t]);
      group.triangle.push_back(t);
    }
  }

  Hit intersect(const Ray& ray, unsigned mask) const {
    if (!traceable(ray, scale)) return {};
    alignas(16) RTCRayHit query;
    const Vec3 origin = ray.origin * scale;
    query.ray = {
        origin.x, origin.y, origin.z, 0, ray.direction.x, ray.direction.y, ray.direction.z, 0, ray.max_distance * scale,
        mask,     0,        0};
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(rtc_scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return hit_of({query.hit.geomID,
                   query.hit.primID,
                   query.ray.tfar,
                   {query.hit.u, query.hit.v},
                   {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}},
                  ray.direction);
  }

  // What Embree says of one ray.
  struct Answer {
    unsigned geometry = 0, primitive = 0;
    float distance = 0;
    Vec2 barycentric{0};
    Vec3 normal{0};
  };
  Hit hit_of(const Answer& answer, const Vec3& direction) const {
    const auto& [geometry, primitive, distance, barycentric, normal] = answer;
    const Group& group = shape->groups[geometry];
    Hit hit;
    hit.triangle = group.triangle.empty() ? primitive : group.triangle[primitive];
    hit.distance = distance / scale;
    hit.barycentric = barycentric;
    // Embree's unnormalised normal underflows for tiny triangles: their side is found in double.
    const float side = glm::dot(normal, direction);
    hit.front = side != 0 ? side < 0 : glm::dot(geometric_normal(*scene, hit.triangle), direction) < 0;
    if (!hit.front && !scene->twin.empty() && scene->twin[hit.triangle] != ~0u) {
      hit.triangle = scene->twin[hit.triangle];
      hit.barycentric = {barycentric.y, barycentric.x};  // its second and third vertex are swapped
      hit.front = true;
    }
    return hit.front || geometry != 0 ? hit : front_in_its_place(hit, direction);
  }

  // Walls and roofs are often drawn as two sheets in one place, each with its front to its own side. Which of them a
  // ray meets first is a matter of rounding: it is the one whose front it meets. Sheets are in one place where rays
  // that leave one start beyond the other.
  Hit front_in_its_place(const Hit& back, const Vec3& direction) const;

  // Lane i of Embree's packet. Rays that are not traceable get an interval that holds nothing.
  void load(RTCRay16& packet, int i, const Ray& ray, unsigned mask) const {
    const bool valid = traceable(ray, scale);
    const Vec3 origin = valid ? ray.origin * scale : Vec3(0), direction = valid ? ray.direction : Vec3(0, 0, 1);
    packet.org_x[i] = origin.x, packet.org_y[i] = origin.y, packet.org_z[i] = origin.z;
    packet.dir_x[i] = direction.x, packet.dir_y[i] = direction.y, packet.dir_z[i] = direction.z;
    packet.tnear[i] = 0, packet.tfar[i] = valid ? ray.max_distance * scale : 0;
    packet.time[i] = 0, packet.mask[i] = mask, packet.id[i] = 0, packet.flags[i] = 0;
  }

  void intersect_packet(const Ray* rays, int count, Hit* hits) const {
    alignas(64) std::array<int, kPacket> active;
    alignas(64) RTCRayHit16 query;
    for (int i = 0; i < kPacket; ++i) {
      active[i] = i < count ? -1 : 0;
      load(query.ray, i, rays[std::min(i, count - 1)], kAnyMask);
      query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(active.data(), rtc_scene, &context, &query);
    const RTCHit16& h = query.hit;
    for (int i = 0; i < count; ++i)
      hits[i] =
          h.geomID[i] == RTC_INVALID_GEOMETRY_ID
              ? Hit()
              : hit_of(
                    {h.geomID[i], h.primID[i], query.ray.tfar[i], {h.u[i], h.v[i]}, {h.Ng_x[i], h.Ng_y[i], h.Ng_z[i]}},
                    rays[i].direction);
  }

  // What stands in a shadow ray's way.
  static unsigned blocking(const Ray& ray) {
    return kOpaqueMask | (ray.past_solids ? 0 : kSolidMask) | (ray.past_frosted ? 0 : kFrostedMask);
  }

  // Sets bit i where an opaque surface is in the way of ray i.
  unsigned occluded_packet(const Ray* rays, int count) const {
    alignas(64) std::array<int, kPacket> active;
    alignas(64) RTCRay16 query;
    for (int i = 0; i < kPacket; ++i) {
      active[i] = i < count ? -1 : 0;
      const Ray& ray = rays[std::min(i, count - 1)];
      load(query, i, ray, blocking(ray));
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(active.data(), rtc_scene, &context, &query);
    unsigned blocked = 0;
    for (int i = 0; i < count; ++i)
      if (query.tfar[i] < 0 || !traceable(rays[i], scale)) blocked |= 1u << i;
    return blocked;
  }

  // What the transmitting surfaces along a ray let through.
  Vec3 through_layers(Ray ray) const;

  bool occluded(const Ray& ray) const {
    alignas(16) RTCRay query;
    const Vec3 origin = ray.origin * scale;
    query = {origin.x,
             origin.y,
             origin.z,
             0,
             ray.direction.x,
             ray.direction.y,
             ray.direction.z,
             0,
             ray.max_distance * scale,
             blocking(ray),
             0,
             0};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(rtc_scene, &context, &query);
    return query.tfar < 0;
  }
};

Accel::Accel(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Accel::Accel(Accel&&) noexcept = default;
Accel& Accel::operator=(Accel&&) noexcept = default;
Accel::~Accel() = default;
const Scene& Accel::scene() const {
  return *impl_->scene;
}

Result<Accel> Accel::build(const Scene& scene, const AccelOptions& options) {
  if (scene.triangles.empty()) return invalid("scene", "found no triangle, expected at least one");
  auto impl = std::make_unique<Impl>();
  impl->scene = &scene;
  const float radius = scene.radius();
  if (radius > 0 && std::isfinite(radius)) impl->scale = std::ldexp(1.0f, -std::ilogb(radius));
  std::vector<Vec3>& positions = impl->shape->positions;
  positions.reserve(scene.positions.size() + 2);
  for (const Vec3& p : scene.positions) positions.push_back(p * impl->scale);
  positions.resize(scene.positions.size() + 2);  // Embree reads 16 bytes at the last vertex

  const std::string config = fmt::format("threads={}{}", options.threads, options.reproducible ? ",isa=sse4.2" : "");
  impl->device = rtcNewDevice(config.c_str());
  if (!impl->device)
    return fail(ErrorCode::kRuntime, "Embree", "no device, error {}", static_cast<int>(rtcGetDeviceError(nullptr)));
  impl->rtc_scene = rtcNewScene(impl->device);
  rtcSetSceneFlags(impl->rtc_scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl->rtc_scene, RTC_BUILD_QUALITY_MEDIUM);
  impl->split_groups();
  impl->add_group(0, kOpaqueMask);
  impl->add_group(1, kTransmittingMask);
  impl->add_group(2, kSolidMask);
  impl->add_group(3, kFrostedMask);
  rtcCommitScene(impl->rtc_scene);
  if (const RTCError error = rtcGetDeviceError(impl->device); error != RTC_ERROR_NONE)
    return fail(ErrorCode::kRuntime, "Embree", "building the ray accelerator of {} triangles failed: {}",
                scene.triangles.size(),
                error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : fmt::format("error {}", static_cast<int>(error)));
  return Accel(std::move(impl));
}

Accel Accel::of(const Scene& scene) const {
  ORIEL_CHECK_EQ(scene.triangles.size(), impl_->scene->triangles.size());
  auto impl = std::make_unique<Impl>();
  impl->scene = &scene;
  impl->scale = impl_->scale;
  impl->shape = impl_->shape;
  impl->any_transmitting = impl_->any_transmitting;
  impl->device = impl_->device;
  impl->rtc_scene = impl_->rtc_scene;
  rtcRetainDevice(impl->device);
  rtcRetainScene(impl->rtc_scene);
  return Accel(std::move(impl));
}

Hit Accel::intersect(const Ray& ray) const {
  return impl_->intersect(ray, kAnyMask);
}

Vec3 Accel::transmittance(const Ray& ray) const {
  if (!traceable(ray, impl_->scale) || impl_->occluded(ray)) return Vec3(0);
  return impl_->any_transmitting ? impl_->through_layers(ray) : Vec3(1);
}

Vec3 Accel::transmittance_of_all(std::span<const Ray> legs, std::uint64_t& rays) const {
  Vec3 passed(1);
  for (std::size_t i = 0; i < legs.size() && max_component(passed) > 0; ++i, ++rays) passed *= transmittance(legs[i]);
  return passed;
}

Hit Accel::Impl::front_in_its_place(const Hit& back, const Vec3& direction) const {
  if (scene->materials[scene->surfaces[scene->triangle_surface[back.triangle]].material].double_sided) return back;
  struct Search {
    const Impl& accel;
    DVec3 point, direction;
    double reach;
    std::uint32_t first;  // of those in the place: whatever the order in which they are found
    Hit found;
  };
  const Vec3 point = point_on(*scene, back.triangle, back.barycentric);
  Search search{*this, DVec3(point), DVec3(direction), 2.0 * kMoved * max_component(glm::abs(point)), ~0u, {}};
  RTCPointQuery query{point.x * scale, point.y * scale, point.z * scale, 0, static_cast<float>(search.reach) * scale};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto look = [](RTCPointQueryFunctionArguments* about) {
    auto& [accel, p, d, reach, first, found] = *static_cast<Search*>(about->userPtr);
    const Group& group = accel.shape->groups[about->geomID];
    const std::uint32_t t = group.triangle.empty() ? about->primID : group.triangle[about->primID];
    if (about->geomID != 0 || t >= first) return false;
    const UVec3& corners = accel.scene->triangles[t];
    const DVec3 a(accel.scene->positions[corners.x]), u = DVec3(accel.scene->positions[corners.y]) - a,
                                                      v = DVec3(accel.scene->positions[corners.z]) - a,
                                                      normal = glm::cross(u, v);
    const double area2 = glm::dot(normal, normal);
    const double side = glm::dot(normal, d);
    const std::uint32_t twin = accel.scene->twin.empty() ? ~0u : accel.scene->twin[t];
    if (!(area2 > 0) || side == 0 || (side > 0 && twin == ~0u)) return false;
    if (std::abs(glm::dot(p - a, normal)) > reach * std::sqrt(area2)) return false;
    const double y = glm::dot(glm::cross(p - a, v), normal) / area2, z = glm::dot(glm::cross(u, p - a), normal) / area2;
    if (y < 0 || z < 0 || y + z > 1) return false;
    first = t;
    found.triangle = side < 0 ? t : twin;
    found.barycentric = Vec2(side < 0 ? DVec2(y, z) : DVec2(z, y));
    return false;  // the reach is what it was
  };
  rtcPointQuery(rtc_scene, &query, &context, look, &search);
  if (!search.found) return back;
  search.found.distance = back.distance;
  return search.found;
}

Vec3 Accel::Impl::through_layers(Ray ray) const {
  const unsigned mask = kTransmittingMask | (ray.past_solids ? kSolidMask : 0) | (ray.past_frosted ? kFrostedMask : 0);
  StraightGlass glass;
  Vec3 passed(1);
  for (int layer = 0; layer < kMaxLayers; ++layer) {
    const Hit hit = intersect(ray, mask);
    if (!hit) return passed * glass.end(ray.max_distance);
    passed *= glass.meet(shade_point(*scene, hit.triangle, hit.barycentric), hit.front,
                         geometric_normal(*scene, hit.triangle), ray.direction, hit.distance);
    if (max_component(passed) <= 0) return Vec3(0);
    ray.origin = spawn_origin(*scene, hit.triangle, hit.barycentric, ray.direction);
    ray.max_distance -= hit.distance;
    if (!(ray.max_distance > 0)) return passed * glass.end(0);
  }
  return Vec3(0);
}

void Accel::intersect(std::span<const Ray> rays, std::span<Hit> hits) const {
  for (std::size_t i = 0; i < rays.size(); i += kPacket)
    impl_->intersect_packet(&rays[i], static_cast<int>(std::min<std::size_t>(kPacket, rays.size() - i)), &hits[i]);
}

void Accel::transmittance(std::span<const Ray> rays, std::span<Vec3> passed) const {
  for (std::size_t i = 0; i < rays.size(); i += kPacket) {
    const int count = static_cast<int>(std::min<std::size_t>(kPacket, rays.size() - i));
    const unsigned blocked = impl_->occluded_packet(&rays[i], count);
    for (int k = 0; k < count; ++k)
      passed[i + k] = blocked >> k & 1u         ? Vec3(0)
                      : impl_->any_transmitting ? impl_->through_layers(rays[i + k])
                                                : Vec3(1);
  }
}

DroppedSamples& Accel::dropped() const {
  return impl_->dropped;
}

Vec3 point_on(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric) {
  const UVec3& t = scene.triangles[triangle];
  const Vec3 &a = scene.positions[t.x], &b = scene.positions[t.y], &c = scene.positions[t.z];
  return a + barycentric.x * (b - a) + barycentric.y * (c - a);
}

Vec3 offset_origin(const Vec3& p, const Vec3& side, float magnitude) {
  // Interpolating three vertices errs by a few units in the last place of their largest coordinate, Embree's robust
  // intersector by a few more; 32 covers both (measured: no self-intersection in tests/bake/trace).
  return p + side * (magnitude * kMoved);
}

Vec3 spawn_origin(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric, const Vec3& direction) {
  const UVec3& t = scene.triangles[triangle];
  float magnitude = 0;
  for (int i = 0; i < 3; ++i) magnitude = std::max(magnitude, max_component(glm::abs(scene.positions[t[i]])));
  const Vec3 normal = geometric_normal(scene, triangle);
  return offset_origin(point_on(scene, triangle, barycentric), glm::dot(normal, direction) < 0 ? -normal : normal,
                       magnitude);
}

}  // namespace oriel
