#include "bake/transfer/transfer.h"

#include <bit>
#include <optional>

#include "bake/jobs/units.h"
#include "bake/scene/shade.h"
#include "bake/trace/albedo.h"
#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"
#include "formats/core/sh.h"

namespace oriel {
namespace {

constexpr std::size_t kVerticesATask = 64;  // vertices a task
constexpr int kMaxTransferLayers = 16;      // of surfaces that a ray passes

// Half a vertex's rays each, so that their difference tells the error.
struct Halves {
  std::vector<double> sum[2];
  explicit Halves(std::size_t count) { sum[0] = sum[1] = std::vector<double>(count); }
};

class VertexRays {
 public:
  VertexRays(const Accel& object, std::uint32_t vertex) : object_(object), scene_(object.scene()) {
    position_ = scene_.positions[vertex];
    normal_ = scene_.normals[vertex];
    magnitude_ = std::max(max_component(glm::abs(scene_.lower)), max_component(glm::abs(scene_.upper)));
  }

  struct Blocker {
    Hit hit;
    Vec3 share{1};  // of light from there that reaches the vertex: what surfaces before it let through
  };
  // The opaque surface in a direction; none where it is free, but `passed` may be below 1.
  std::optional<Blocker> trace(const Vec3& direction, Vec3& passed, std::uint64_t& rays) const {
    Ray ray{offset_origin(position_, normal_, magnitude_), direction};
    passed = Vec3(1);
    for (int layer = 0; layer < kMaxTransferLayers; ++layer) {
      const Hit hit = object_.intersect(ray);
      ++rays;
      if (!hit) return {};
      const SceneMaterial& material = scene_.material_of(hit.triangle);
      if (!hit.front && !material.double_sided) return {};
      if (!touches(hit.triangle)) {
        if (!may_transmit(material)) return Blocker{hit, passed};
        const Vec3 through = transmittance_at(scene_, hit.triangle, hit.barycentric);
        if (max_component(through) <= 0) return Blocker{hit, passed};
        passed *= through;
      }
      ray.origin = spawn_origin(scene_, hit.triangle, hit.barycentric, direction);
    }
    return {};
  }
  Mat3 frame() const { return frame_from_normal(normal_); }

 private:
  bool touches(std::uint32_t triangle) const {
    const UVec3& corners = scene_.triangles[triangle];
    for (int c = 0; c < 3; ++c)
      if (scene_.positions[corners[c]] == position_) return true;
    return false;
  }

  const Accel& object_;
  const Scene& scene_;
  Vec3 position_, normal_;
  float magnitude_;
};

// Light that a hit surface sends to the ray's origin, per light that comes in: all its reflection as if it were
// diffuse.
Vec3 exit_albedo(const Scene& scene, const Hit& hit, const Vec3& direction) {
  const ShadePoint point = shade_point(scene, hit.triangle, hit.barycentric);
  const float cos_theta = std::abs(glm::dot(geometric_normal(scene, hit.triangle), direction));
  const Vec3 r = reflectance(point, cos_theta);
  return point.diffuse * (1 - max_component(r)) + r;
}

class TransferBake {
 public:
  TransferBake(const Accel& object, const TransferOptions& options, const Stage& stage)
      : object_(object), scene_(object.scene()), options_(options), stage_(stage) {
    count_ = static_cast<std::size_t>(sh_count(options.bands));
    out_.bands = options.bands;
    out_.channels = coloured() ? 3 : 1;
    out_.coefficients.resize(scene_.positions.size() * out_.stride());
  }

  Result<VertexTransfer> run() {
    unshadowed();
    ORIEL_TRY(bool in_time, pass("transfer", std::max(16u, options_.samples), 0, nullptr));
    VertexTransfer last = out_;  // of the last bounce alone
    for (int bounce = 1; in_time && bounce <= options_.bounces; ++bounce) {
      VertexTransfer next = out_;
      std::fill(next.coefficients.begin(), next.coefficients.end(), 0.0f);
      std::swap(next, out_);
      ORIEL_TRY(in_time, pass("transfer bounces", std::max(16u, options_.samples / 4), bounce, &last));
      last = out_;
      for (std::size_t i = 0; i < out_.coefficients.size(); ++i) out_.coefficients[i] += next.coefficients[i];
    }
    if (!in_time)
      stage_.context.warning("time-over", fmt::format("mover \"{}\": --time was over before all its own shadows",
                                                      scene_.surfaces[0].name));
    return std::move(out_);
  }

 private:
  bool coloured() const {
    if (options_.bounces <= 0) return false;
    const auto grey = [](const Vec3& c) { return c.r == c.g && c.g == c.b; };
    for (const Surface& surface : scene_.surfaces) {
      const SceneMaterial& m = scene_.materials[surface.material];
      if (!grey(m.base_color) || m.base_color_texture.image >= 0 || !grey(m.specular_color) || m.metal != Metal::kNone)
        return true;
    }
    return !scene_.colors.empty();
  }

  void unshadowed() {
    std::vector<double> zonal, turned(count_);
    for (int l = 0; l < options_.bands; ++l)  // A_l / π of a zonal delta
      zonal.push_back(cosine_factor(l) / kPiD * std::sqrt((2 * l + 1) / (4 * kPiD)));
    for (std::size_t v = 0; v < scene_.positions.size(); ++v) {
      turn_zonal(zonal, DVec3(scene_.normals[v]), turned);
      float* row = out_.coefficients.data() + v * out_.stride();
      for (int c = 0; c < out_.channels; ++c)
        for (const double t : turned) *row++ = static_cast<float>(t);
    }
  }

  // Without `last`: takes what the object hides from the unshadowed transfer. With it: adds what its surfaces, lit by
  // the last bounce, send. Only rays that meet the object count: the rest stays exact. Whether there was time for all.
  Result<bool> pass(const char* stage, std::uint32_t samples, int bounce, const VertexTransfer* last) {
    samples = std::bit_floor(samples);
    const ShiftedNet net(mix64(stage_.context.seed + static_cast<std::uint64_t>(bounce)), samples);
    const std::size_t vertices = scene_.positions.size(), blocks = (vertices + kVerticesATask - 1) / kVerticesATask;
    std::vector<DVec2> errors(blocks);  // Σ squared differences of the halves, Σ squares
    const auto end = [&](std::size_t block) { return std::min(vertices, (block + 1) * kVerticesATask); };
    UnitLoop loop{.stage = stage, .count = blocks, .rays = static_cast<double>(kVerticesATask) * samples};
    loop.inputs = [&](std::size_t block, Archive& key) { key(bounce, block); };
    loop.compute = [&](std::size_t block) {
      std::uint64_t rays = 0;
      for (std::size_t v = block * kVerticesATask; v < end(block); ++v)
        errors[block] += vertex(static_cast<std::uint32_t>(v), net, samples, last, rays);
      return rays;
    };
    loop.results = [&](std::size_t block, Archive& archive) {
      const std::size_t first = block * kVerticesATask * out_.stride(),
                        count = (end(block) - block * kVerticesATask) * out_.stride();
      archive(errors[block], std::span(out_.coefficients).subspan(first, count));
    };
    ORIEL_TRY(const bool in_time,
              done_in_time(stage_.context, options_.enough, [&] { return parallel_units(stage_, loop); }));
    DVec2 sum(0);
    for (const DVec2& e : errors) sum += e;
    if (!last) out_.standard_error = sum.y > 0 ? static_cast<float>(0.5 * std::sqrt(sum.x / sum.y)) : 0;
    return in_time;
  }

  DVec2 vertex(std::uint32_t v, const ShiftedNet& net, std::uint32_t samples, const VertexTransfer* last,
               std::uint64_t& rays) {
    const VertexRays from(object_, v);
    const Mat3 frame = from.frame();
    const UVec2 shift = net.shift(v);
    Halves halves(out_.stride());
    std::vector<float> y(count_);
    for (std::uint32_t s = 0; s < samples; ++s) {
      const Vec3 direction = frame * square_to_cosine_hemisphere(net.point(s, shift));
      Vec3 passed;
      const auto blocker = from.trace(direction, passed, rays);
      std::vector<double>& sum = halves.sum[s & 1];
      if (!last) {
        const Vec3 hidden = blocker ? Vec3(1) : Vec3(1) - passed;
        if (max_component(hidden) <= 0) continue;
        evaluate_sh(direction, y);
        for (int c = 0; c < out_.channels; ++c)
          for (std::size_t i = 0; i < count_; ++i) sum[static_cast<std::size_t>(c) * count_ + i] -= hidden[c] * y[i];
      } else if (blocker) {
        add_reflected(*blocker, direction, *last, sum);
      }
    }
    return store(v, halves, samples);
  }

  void add_reflected(const VertexRays::Blocker& blocker, const Vec3& direction, const VertexTransfer& last,
                     std::vector<double>& sum) const {
    const Vec3 albedo = blocker.share * exit_albedo(scene_, blocker.hit, direction);
    const UVec3& corners = scene_.triangles[blocker.hit.triangle];
    const Vec2 b = blocker.hit.barycentric;
    const float weights[3] = {1 - b.x - b.y, b.x, b.y};
    for (int corner = 0; corner < 3; ++corner) {
      const float* t = last.coefficients.data() + corners[corner] * last.stride();
      for (int c = 0; c < out_.channels; ++c)
        for (std::size_t i = 0; i < count_; ++i)
          sum[static_cast<std::size_t>(c) * count_ + i] += weights[corner] * albedo[c] * *t++;
    }
  }

  DVec2 store(std::uint32_t v, const Halves& halves, std::uint32_t samples) {
    float* row = out_.coefficients.data() + v * out_.stride();
    DVec2 error(0);
    for (std::size_t i = 0; i < out_.stride(); ++i) {
      const double a = halves.sum[0][i] * 2 / samples, b = halves.sum[1][i] * 2 / samples;
      row[i] += static_cast<float>(0.5 * (a + b));
      error += DVec2((a - b) * (a - b), static_cast<double>(row[i]) * row[i]);
    }
    return error;
  }

  const Accel& object_;
  const Scene& scene_;
  TransferOptions options_;
  const Stage stage_;
  std::size_t count_;
  VertexTransfer out_;
};

}  // namespace

Result<VertexTransfer> bake_transfer(const Accel& object, const TransferOptions& options, const Stage& stage) {
  if (options.bands < 2 || options.bands > 6)
    return fail(ErrorCode::kUsage, "transfer", "found {} bands of spherical harmonics, expected 2 to 6", options.bands);
  if (options.bounces < 0 || options.bounces > 16)
    return fail(ErrorCode::kUsage, "transfer", "found {} bounces, expected 0 to 16", options.bounces);
  return TransferBake(object, options, stage).run();
}

float coarse_share(const Scene& object, const VertexTransfer& transfer, float step) {
  const auto row = [&](std::uint32_t v) { return transfer.coefficients.data() + v * transfer.stride(); };
  const auto distance2 = [&](const float* a, const float* b) {
    double sum = 0;
    for (std::size_t i = 0; i < transfer.stride(); ++i) {
      const double d = static_cast<double>(a[i]) - (b ? b[i] : 0);
      sum += d * d;
    }
    return sum;
  };
  double mean2 = 0;
  for (std::uint32_t v = 0; v < transfer.vertices(); ++v) mean2 += distance2(row(v), nullptr);
  mean2 /= std::max<double>(1, static_cast<double>(transfer.vertices()));
  double area = 0, coarse = 0;
  for (std::uint32_t t = 0; t < object.triangles.size(); ++t) {
    const UVec3& c = object.triangles[t];
    const double a = triangle_area(object, t);
    area += a;
    for (int i = 0; i < 3; ++i)
      if (distance2(row(c[i]), row(c[(i + 1) % 3])) > static_cast<double>(step) * step * mean2) coarse += a / 3;
  }
  return area > 0 ? static_cast<float>(coarse / area) : 0.0f;
}

}  // namespace oriel
