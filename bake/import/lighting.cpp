#include "bake/import/lighting.h"

#include <map>

#include "bake/import/images.h"
#include "bake/scene/ldt.h"
#include "bake/scene/sky.h"
#include "formats/core/file.h"
#include "formats/core/half.h"
#include "formats/core/hash.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;

constexpr float kMostRadiance = 1e30f;

// The file's bytes; its hash goes into `inputs`.
Result<Bytes> read_input(const fs::path& path, gltf::MemoryBudget& budget, ImportedScene& out) {
  ORIEL_TRY(Bytes bytes, read_file(path, budget.left()));
  out.inputs.emplace_back(path.filename().string(), hash128_hex(bytes));
  return bytes;
}

// Makes every texel a radiance in [0, kMostRadiance].
void clean(SkyImage& image, float scale, const std::string& name, Context& context) {
  std::size_t nans = 0, negatives = 0, infinities = 0;
  for (Vec3& texel : image.texels)
    for (int c = 0; c < 3; ++c) {
      float& value = texel[c];
      if (std::isnan(value)) {
        ++nans;
        value = 0;
      } else if (value < 0) {
        ++negatives;
        value = 0;
      } else if (std::isinf(value)) {
        ++infinities;
        value = kHalfMax;  // it did not fit into 16 bits
      }
      value = std::min(value * scale, kMostRadiance);
    }
  if (nans + negatives > 0)
    context.warning("bad-sky", fmt::format("{}: found {} values that are not a number and {} negative ones, taken as 0",
                                           name, nans, negatives));
  if (infinities > 0)
    context.warning("bad-sky", fmt::format("{}: found {} infinite values, taken as {}", name, infinities, kHalfMax));
}

Status load_sky(const ImportOptions& options, gltf::MemoryBudget& budget, ImportedScene& out, Context& context) {
  if (!(options.sky_scale >= 0 && options.sky_scale <= kMostRadiance))
    return fail(ErrorCode::kUsage, "sky scale", "found {}, expected 0 to {}", options.sky_scale, kMostRadiance);
  if (!std::isfinite(options.sky_rotation_deg))
    return fail(ErrorCode::kUsage, "sky rotation", "found {}, expected degrees", options.sky_rotation_deg);
  for (int c = 0; c < 3; ++c)
    if (!(options.sky[c] >= 0 && options.sky[c] <= kMostRadiance))
      return fail(ErrorCode::kUsage, "sky", "found radiance {}, expected 0 to {}", options.sky[c], kMostRadiance);
  Scene& scene = out.scene;
  scene.sky = options.sky;
  if (options.sky_file.empty()) return {};
  const std::string name = options.sky_file.string();
  ORIEL_TRY(const Bytes bytes, read_input(options.sky_file, budget, out));
  ORIEL_TRY(const ImageSize size, sky_image_size(options.sky_file));
  // Texels and the sampler's sums over them.
  ORIEL_TRY_VOID(budget.take(std::uint64_t{2} * sizeof(Vec3) * size.width * size.height, name));
  if (size.width != 2 * size.height)
    context.warning(
        "bad-sky",
        fmt::format("{}: found {} x {} texels, expected twice as wide as high: it is stretched over the sphere", name,
                    size.width, size.height));
  ORIEL_TRY(scene.sky_image, read_sky_image(options.sky_file));
  clean(scene.sky_image, options.sky_scale, name, context);
  scene.sky_image.rotation_rad = std::fmod(options.sky_rotation_deg, 360.0f) * (kPi / 180);
  scene.sky = sky_mean(scene.sky_image);
  return {};
}

// Points and spots.
std::vector<std::string> light_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Light& light : scene.lights)
    if (light.type != LightType::kDirectional) names.push_back(light.name);
  return names;
}

Status load_profiles(const ImportOptions& options, gltf::MemoryBudget& budget, ImportedScene& out, Context& context) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 20;
  Scene& scene = out.scene;
  std::map<fs::path, std::int32_t> known;
  for (const auto& [node, path] : options.ies) {
    bool found = false;
    for (Light& light : scene.lights) found |= light.name == node && light.type != LightType::kDirectional;
    if (!found)
      return fail(ErrorCode::kUsage, "IES profile", "found the node \"{}\", expected a point or spot light: {}", node,
                  names_like(node, light_names(scene)));
    const auto [at, added] = known.try_emplace(path, static_cast<std::int32_t>(scene.profiles.size()));
    if (added) {
      ORIEL_TRY(const Bytes bytes, read_input(path, budget, out));
      if (bytes.size() > kMostBytes)
        return invalid(path.string(), "found {} bytes, expected at most {}", bytes.size(), kMostBytes);
      const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      const std::string extension = path.extension().string();
      const bool eulumdat = extension == ".ldt" || extension == ".LDT" || extension == ".Ldt";
      ORIEL_TRY(IesFile file, eulumdat ? parse_ldt(text, path.string()) : parse_ies(text, path.string()));
      for (const std::string& warning : file.warnings) context.warning("bad-profile", warning);
      scene.profiles.push_back(std::move(file.profile));
    }
    for (Light& light : scene.lights)
      if (light.name == node && light.type != LightType::kDirectional) light.profile = at->second;
  }
  return {};
}

// A name without a light or material is a typing error.
Status none_scaled(const char* option, const LightScale& scale, const std::vector<std::string>& there,
                   Context& context) {
  if (scale.names.empty()) {
    context.warning("idle-option", fmt::format("{} has no effect: nothing of its kind shines", option));
    return {};
  }
  return fail(ErrorCode::kUsage, option, "found the name \"{}\", expected one that shines: {}", scale.names,
              names_like(scale.names, there));
}

Status scale_lights(const ImportOptions& options, Scene& scene, Context& context) {
  for (const LightScale& scale : options.lamp_scales) {
    bool any = false;
    for (Light& light : scene.lights) {
      if (scale.names.empty() ? light.type == LightType::kDirectional
                              : !fits_pattern(scale.names, light.name) && !fits_pattern(scale.names, light.node_path))
        continue;
      any = true;
      light.intensity *= static_cast<float>(scale.factor), light.color *= static_cast<float>(scale.factor);
    }
    if (!any) ORIEL_TRY_VOID(none_scaled("--lamp-scale", scale, light_names(scene), context));
  }
  for (const LightScale& scale : options.emission_scales) {
    bool any = false;
    std::vector<std::string> there;
    for (SceneMaterial& material : scene.materials) {
      if (max_component(material.emission) <= 0) continue;
      there.push_back(material.name);
      if (!scale.names.empty() && !fits_pattern(scale.names, material.name)) continue;
      any = true;
      material.emission *= static_cast<float>(scale.factor);
    }
    if (!any) ORIEL_TRY_VOID(none_scaled("--emission-scale", scale, there, context));
  }
  return {};
}

}  // namespace

Status apply_lighting(const ImportOptions& options, gltf::MemoryBudget& budget, ImportedScene& out, Context& context) {
  ORIEL_TRY_VOID(load_sky(options, budget, out, context));
  ORIEL_TRY_VOID(load_profiles(options, budget, out, context));
  ORIEL_TRY_VOID(scale_lights(options, out.scene, context));
  if (options.clear_sky && !options.day.wanted && options.sky_file.empty() && options.sky == Vec3(0))
    add_clear_sky(out.scene, context);
  if (options.day.wanted) ORIEL_TRY_VOID(add_daylight(options.day, out.scene, context));
  if (!options.sun_angle_deg) return {};
  if (!(*options.sun_angle_deg >= 0 && *options.sun_angle_deg <= 180))
    return fail(ErrorCode::kUsage, "sun angle", "found {}, expected 0 to 180 degrees", *options.sun_angle_deg);
  for (Light& light : out.scene.lights)
    if (light.type == LightType::kDirectional) light.angular_radius_rad = *options.sun_angle_deg * (kPi / 360);
  return {};
}

}  // namespace oriel
