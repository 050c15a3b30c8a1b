#include "preview/frame/guided_sources.h"

#include <algorithm>

#include "bake/jobs/parallel.h"
#include "bake/scene/sky.h"
#include "bake/trace/punctual.h"
#include "bake/trace/warp.h"
#include "preview/frame/particle_walk.h"
#include "preview/frame/streams.h"

namespace oriel {
namespace {

constexpr float kUnguided = 0.25f;  // share of particles
constexpr std::size_t kMostGuides = 256;
constexpr int kBounces = 4;        // that the eye's paths take
constexpr float kCone_rad = 0.3f;  // of directions to the sky about a guide's
constexpr std::size_t kPointsATask = 32, kNearest = 4;

float distance_from_line(const Vec3& p, const Ray& line) {
  return glm::length(glm::cross(p - line.origin, line.direction));
}

bool is_afar(SourceKind kind) {
  return kind != SourceKind::kNear;
}

// Each stands for a disk that reaches to its few nearest neighbours of about the same direction.
void find_radii(std::vector<LightGuide>& guides, float scene_radius) {
  const float cosine = std::cos(kCone_rad);
  std::vector<float> distances;
  for (LightGuide& g : guides) {
    distances.clear();
    for (const LightGuide& other : guides)
      if (&other != &g && glm::dot(other.to_source, g.to_source) > cosine)
        distances.push_back(distance_from_line(other.place, {g.place, g.to_source}));
    const std::size_t nth = std::min(kNearest, distances.size());
    g.radius = 0.05f * scene_radius;
    if (nth == 0) continue;
    std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(nth - 1), distances.end());
    g.radius = std::clamp(distances[nth - 1], 1e-3f * scene_radius, g.radius);
  }
}

// The guides of tasks, evenly thinned out.
std::vector<LightGuide> some_of(const std::vector<std::vector<LightGuide>>& found, float scene_radius) {
  std::vector<LightGuide> all, some;
  for (const std::vector<LightGuide>& guides : found) all.insert(all.end(), guides.begin(), guides.end());
  const std::size_t count = std::min(all.size(), kMostGuides);
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  find_radii(some, scene_radius);
  return some;
}

}  // namespace

Result<GuidedSources> GuidedSources::create(const Transport& transport, const Sources& sources,
                                            std::span<const EyePoint> eye, std::uint32_t pass, Context& context) {
  GuidedSources out;
  out.sources_ = &sources;
  out.transport_ = &transport;
  const auto has = [&](SourceKind kind) { return std::ranges::count(sources.kinds(), kind) > 0; };
  const bool has_sun = has(SourceKind::kDirectional), has_sky = has(SourceKind::kSky);
  if (!has_sun && !has_sky) return out;
  const std::size_t tasks = (eye.size() + kPointsATask - 1) / kPointsATask;
  std::vector<std::vector<LightGuide>> sun(tasks), sky(tasks);
  const auto look = [&](std::size_t task, const Vec3& origin, const Vec3& face, Sampler& sampler) {
    if (!has_sun) return;
    const Vec3 to_sun = -sources.emit(SourceKind::kDirectional, sampler).ray.direction;
    if (glm::dot(to_sun, face) > 0 && max_component(transport.accel.transmittance({origin, to_sun})) > 0)
      sun[task].push_back({origin, to_sun});
  };
  ORIEL_TRY_VOID(parallel_for(context, "", tasks, [&](std::size_t task) {
    for (std::size_t i = task * kPointsATask; i < std::min(eye.size(), (task + 1) * kPointsATask); ++i) {
      const EyePoint& p = eye[i];
      Sampler sampler(context.seed, kGuideStream,
                      pass * static_cast<std::uint32_t>(eye.size()) + static_cast<std::uint32_t>(i));
      const Vec3& face = p.at.geometric_normal;
      look(task, p.origin, face, sampler);
      const Vec3 way = glm::normalize(frame_from_normal(face) * square_to_cosine_hemisphere(sampler.next2()));
      ParticleWalk(transport, {p.origin, way}, Vec3(1), sampler)
          .run(
              kBounces,
              [&](const SurfacePoint& s, const Ray&, const Vec3&) {
                look(task, spawn_origin(s, s.geometric_normal), s.geometric_normal, sampler);
              },
              [&](const Ray& ray) {
                if (has_sky) sky[task].push_back({ray.origin, ray.direction});
              });
    }
  }));
  out.sun_ = some_of(sun, transport.accel.scene().radius());
  out.sky_ = some_of(sky, transport.accel.scene().radius());
  return out;
}

// Of lines that guides draw, per m² across the ray, and with cones per steradian.
float GuidedSources::density(std::span<const LightGuide> guides, const Ray& ray, bool cones) const {
  const float cosine = std::cos(kCone_rad), solid_angle = 2 * kPi * (1 - cosine);
  float sum = 0;
  for (const LightGuide& g : guides) {
    if (cones && -glm::dot(g.to_source, ray.direction) < cosine) continue;
    if (distance_from_line(g.place, ray) < g.radius) sum += 1 / (kPi * g.radius * g.radius);
  }
  return sum / static_cast<float>(guides.size()) / (cones ? solid_angle : 1.0f);
}

Particle GuidedSources::emit(SourceKind kind, Sampler& sampler) const {
  const std::span<const LightGuide> along = guides(kind);
  if (!is_afar(kind) || along.empty()) return sources_->emit(kind, sampler);
  const Scene& scene = transport_->accel.scene();
  const bool sky = kind == SourceKind::kSky;
  const float chosen = sampler.next1();
  Particle p = sources_->emit(kind, sampler);
  const float radius = sources_->afar_radius(), area = kPi * radius * radius;
  if (chosen >= kUnguided) {
    const float share = (chosen - kUnguided) / (1 - kUnguided);
    const LightGuide& g =
        along[std::min(along.size() - 1, static_cast<std::size_t>(share * static_cast<float>(along.size())))];
    const Vec3 to_source = sky ? sample_cone(g.to_source, kCone_rad, sampler.next2()) : -p.ray.direction;
    const Vec3 across(g.radius * square_to_disk(sampler.next2()), 0);
    p.ray = {g.place + frame_from_normal(to_source) * across + 2 * radius * to_source, -to_source};
  }
  const Vec3 centre = 0.5f * (scene.lower + scene.upper), to_source = -p.ray.direction;
  float anywhere = distance_from_line(centre, p.ray) <= radius ? 1 / area : 0;
  Vec3 light = p.power / area;
  if (sky) {
    light = sky_radiance(scene, to_source);
    anywhere *= transport_->lights.samples_sky() ? transport_->lights.sky_pdf(to_source) : 1 / (4 * kPi);
  }
  p.power = light / (kUnguided * anywhere + (1 - kUnguided) * density(along, p.ray, sky));
  return p;
}

}  // namespace oriel
