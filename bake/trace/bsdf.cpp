#include "bake/trace/bsdf.h"

#include "bake/trace/albedo.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {

struct LobeChoice {
  float diffuse = 0, specular = 0, transmission = 0;  // probabilities; sum 1, or all 0
  float diffuse_scale = 1;                            // 1 - max R: what the specular lobe leaves
};

LobeChoice choose_lobes(const ShadePoint& point, float cos_o) {
  LobeChoice c;
  const float r = max_component(reflectance(point, cos_o));
  c.diffuse_scale = 1 - r;
  c.diffuse = max_component(point.diffuse) * c.diffuse_scale;
  c.transmission = max_component(point.transmission) * c.diffuse_scale;
  c.specular = r;
  const float sum = c.diffuse + c.specular + c.transmission;
  if (!(sum > 0)) return {};
  c.diffuse /= sum, c.specular /= sum, c.transmission /= sum;
  return c;
}

// Smith's Λ for GGX.
float lambda(float cos_v, float alpha) {
  const float c2 = cos_v * cos_v;
  const float tan2 = (1 - c2) / c2;
  return 0.5f * (std::sqrt(1 + alpha * alpha * tan2) - 1);
}

Vec3 specular_eval(const ShadePoint& point, const Vec3& wo, const Vec3& wi) {
  const Vec3 h = glm::normalize(wo + wi);
  const float d = ggx_d(h.z, point.alpha) * smith_g2(wo.z, wi.z, point.alpha) / (4 * wo.z);  // cos θi cancels
  return fresnel_schlick(point.f0, point.f90, glm::dot(wo, h)) * d;
}

float pdf_of(const ShadePoint& point, const LobeChoice& lobes, const Vec3& wo, const Vec3& wi) {
  float pdf = lobes.diffuse * cosine_hemisphere_pdf(wi.z);
  if (lobes.specular > 0 && point.alpha >= kMirrorAlpha) {
    const Vec3 h = glm::normalize(wo + wi);
    pdf += lobes.specular * smith_g1(wo.z, point.alpha) * ggx_d(h.z, point.alpha) / (4 * wo.z);
  }
  return pdf;
}

Vec3 eval_with(const ShadePoint& point, const LobeChoice& lobes, const Vec3& wo, const Vec3& wi) {
  Vec3 f = point.diffuse * (lobes.diffuse_scale / kPi * wi.z);
  if (lobes.specular > 0 && point.alpha >= kMirrorAlpha) f += specular_eval(point, wo, wi);
  return f;
}

}  // namespace

Vec3 fresnel_schlick(const Vec3& f0, float f90, float cos_theta) {
  const float m = std::clamp(1 - cos_theta, 0.0f, 1.0f);
  const float m2 = m * m;
  return f0 + (Vec3(f90) - f0) * (m2 * m2 * m);
}

float ggx_d(float cos_h, float alpha) {
  // cos²(α² + tan²) written without the difference 1 - cos² (1 - α²), which cancels for narrow lobes.
  const float a2 = alpha * alpha;
  const float sin2 = std::max(0.0f, (1 - cos_h) * (1 + cos_h));
  const float base = a2 * cos_h * cos_h + sin2;
  return a2 / (kPi * base * base);
}

float smith_g1(float cos_v, float alpha) {
  return 1 / (1 + lambda(cos_v, alpha));
}
float smith_g2(float cos_o, float cos_i, float alpha) {
  return 1 / (1 + lambda(cos_o, alpha) + lambda(cos_i, alpha));
}

Vec3 sample_ggx_visible_normal(const Vec3& wo, float alpha, const Vec2& u) {
  const Vec3 v = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
  const float length2_xy = v.x * v.x + v.y * v.y;
  const Vec3 t1 = length2_xy > 0 ? Vec3(-v.y, v.x, 0) / std::sqrt(length2_xy) : Vec3(1, 0, 0);
  const Vec3 t2 = glm::cross(v, t1);
  const Vec2 d = square_to_disk(u);
  const float s = 0.5f * (1 + v.z);
  const float y = (1 - s) * std::sqrt(std::max(0.0f, 1 - d.x * d.x)) + s * d.y;
  const Vec3 n = d.x * t1 + y * t2 + std::sqrt(std::max(0.0f, 1 - d.x * d.x - y * y)) * v;
  return glm::normalize(Vec3(alpha * n.x, alpha * n.y, std::max(1e-7f, n.z)));
}

Vec3 bsdf_eval(const ShadePoint& point, const Vec3& wo, const Vec3& wi) {
  if (wo.z <= 0 || wi.z <= 0) return Vec3(0);
  return eval_with(point, choose_lobes(point, wo.z), wo, wi);
}

float bsdf_pdf(const ShadePoint& point, const Vec3& wo, const Vec3& wi) {
  if (wo.z <= 0 || wi.z <= 0) return 0;
  return pdf_of(point, choose_lobes(point, wo.z), wo, wi);
}

std::optional<BsdfSample> bsdf_sample(const ShadePoint& point, const Vec3& wo, float u, const Vec2& v) {
  if (wo.z <= 0) return std::nullopt;
  const LobeChoice lobes = choose_lobes(point, wo.z);
  BsdfSample s;
  if (u < lobes.diffuse) {
    s.wi = square_to_cosine_hemisphere(v);
    s.lobe = Lobe::kDiffuse;
  } else if (u < lobes.diffuse + lobes.specular) {
    s.lobe = Lobe::kSpecular;
    if (point.alpha < kMirrorAlpha) {
      s.wi = Vec3(-wo.x, -wo.y, wo.z);
      s.weight = fresnel_schlick(point.f0, point.f90, wo.z) / lobes.specular;
      s.delta = true;
      return s;
    }
    const Vec3 h = sample_ggx_visible_normal(wo, point.alpha, v);
    s.wi = 2 * glm::dot(wo, h) * h - wo;
  } else if (lobes.transmission > 0) {
    s.wi = -wo;
    s.weight = point.transmission * (lobes.diffuse_scale / lobes.transmission);
    s.delta = true;
    s.lobe = Lobe::kTransmission;
    return s;
  } else {
    return std::nullopt;
  }
  if (s.wi.z <= 0) return std::nullopt;
  s.pdf = pdf_of(point, lobes, wo, s.wi);
  if (!(s.pdf > 0)) return std::nullopt;
  s.weight = eval_with(point, lobes, wo, s.wi) / s.pdf;
  return s;
}

}  // namespace oriel
