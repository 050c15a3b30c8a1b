#include "player/scene/gpu_scene.h"

#include <algorithm>

#include "formats/core/half.h"
#include "player/scene/check.h"
#include "player/scene/emitter_ranges.h"
#include "player/scene/image_uses.h"
#include "player/scene/live_lamps.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

constexpr int kKernelTaps = 48, kFaintTaps = 24, kCoarseTaps = 12;
constexpr std::size_t kFewTriangles = 20000;  // that no device minds
constexpr float kFewerPixels = 1;             // of a coarse frame, that fewer triangles are off by

// What the pack knows of a reflector's image.
SeenMask seen_in(const Pack& pack, std::uint32_t reflector) {
  const VisibleSets& groups = pack.visible_sets;
  const std::vector<std::uint8_t>& sets = pack.reflected_sets.seen;
  std::vector<std::uint8_t> seen(groups.groups);
  for (std::size_t g = 0; g < seen.size(); ++g) seen[g] = sets[reflector * groups.set_bytes() + g / 8] >> (g % 8) & 1;
  return seen;
}

Status first_of(const std::vector<Error>& errors) {
  if (errors.empty()) return {};
  return tl::unexpected<Error>(errors.front());
}

}  // namespace

Result<std::unique_ptr<GpuScene>> GpuScene::create(DeferredPack pack, const gpu::Device& device,
                                                   const LoadingOptions& loading) {
  ORIEL_TRY_VOID(check_drawable(pack.pack, device));
  std::unique_ptr<GpuScene> scene(new GpuScene);
  scene->serial_ = scene->geometry_serial_ = next_scene_serial();
  scene->pack_ = std::move(pack.pack);
  scene->baked_ = BakedLamps(scene->pack_);
  scene->bright_lights_ = scene->pack_.light_field.lights;
  scene->lamps_.resize(scene->pack_.light_groups.size());
  scene->lights_.assign(scene->pack_.light_groups.size(), Vec3(1));
  scene->map_meshes_ = GpuMapMeshes(scene->pack_.map_meshes.size());
  scene->upload_geometry();
  for (const Mover& mover : scene->pack_.movers) {
    scene->movers_.push_back(upload_mover(mover));
    for (const MeshPart& part : mover.mesh.parts) {  // they hide what is behind; their materials are theirs alone
      AlphaMode& mode = scene->pack_.materials[part.material].alpha_mode;
      if (mode == AlphaMode::kBlend) mode = AlphaMode::kOpaque;
    }
  }
  scene->upload_images(std::move(pack.images), loading);
  scene->live_ = std::make_unique<LiveLamps>(scene->pack_, scene->images_->source());
  if (!loading.background && loading.limit == kNoLimit) ORIEL_TRY_VOID(first_of(scene->advance_all()));
  ORIEL_TRY_VOID(gpu::check_gl("uploading the pack"));
  return scene;
}

bool GpuScene::is_transparent(std::uint32_t material) const {
  const Material& m = pack_.materials[material];
  return m.alpha_mode == AlphaMode::kBlend || m.transmission > 0;
}

void GpuScene::upload_geometry() {
  const Mesh& mesh = pack_.mesh;
  std::vector<std::uint32_t> indices;
  // See-through parts are sorted by distance: they stay whole.
  const bool known = made_for(pack_.visible_sets, mesh, pack_.materials, pack_.walk_grids);
  if (known) seen_groups_ = SeenGroups(pack_.visible_sets, pack_.walk_grids);
  const auto divided = [&](std::uint32_t material) { return known && !is_transparent(material); };
  for (const DrawRange& range : sorted_ranges(mesh, indices, pack_.visible_sets.runs, divided)) {
    bounds_.extend(range.bounds);
    const bool transparent = is_transparent(range.material);
    if (transparent) transparent_.push_back(range);
    if (!transparent || is_partly_opaque(pack_.materials[range.material])) opaque_.push_back(range);
  }
  // Of both sides of a shell, which are as far away, the inside is drawn first: from outside it lies behind.
  std::ranges::stable_partition(transparent_, [&](const DrawRange& r) { return faces_inward(mesh, indices, r); });
  glass_ = take_glass_bodies(pack_, indices, transparent_);
  find_lit_sides(pack_, indices, glass_);
  make_reflectors(indices, known && !pack_.reflected_sets.empty() &&
                               pack_.reflected_sets.made_for == reflected_hash(pack_.visible_sets, pack_.reflectors));
  make_emitters(indices);
  make_curved_reflectors(indices);

  vertex_array_ = gpu::make_vertex_array();
  glBindVertexArray(vertex_array_.name());
  upload_vertices(mesh, buffers_);
  index_buffer_ = gpu::Buffer(GLenum{GL_ELEMENT_ARRAY_BUFFER}, std::span<const std::uint32_t>(indices));
  glBindVertexArray(0);
  indices_ = std::move(indices);
}

gpu::Buffer GpuScene::bind_far_to_near(const DrawRange& range, const View& view) const {
  const Vec4 towards = glm::transpose(view.view_from_pack)[2];
  std::vector<std::pair<float, UVec3>> sorted;
  for (std::uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
    const UVec3 t(indices_[i], indices_[i + 1], indices_[i + 2]);
    const auto& p = pack_.mesh.positions;
    sorted.emplace_back(glm::dot(Vec3(towards), p[t.x] + p[t.y] + p[t.z]), t);
  }
  std::ranges::stable_sort(sorted, {}, [](const auto& triangle) { return triangle.first; });
  std::vector<std::uint32_t> order;
  for (const auto& [depth, t] : sorted) order.insert(order.end(), {t.x, t.y, t.z});
  return gpu::Buffer(GLenum{GL_ELEMENT_ARRAY_BUFFER}, std::span<const std::uint32_t>(order));
}

std::vector<DrawBatch> GpuScene::show(const Frustum& frustum, const SeenMask& seen) {
  shown_buffer_.reset();
  chosen_ = {};
  if (!seen) return visible_batches(opaque_, frustum);
  return upload_shown(gather(visible_batches(opaque_, frustum, seen), indices_));
}

std::vector<DrawBatch> GpuScene::keep_shown(std::vector<DrawBatch> shown, std::span<const std::uint32_t> kept) {
  return upload_shown(gather(std::move(shown), shown_indices(), kept));
}

std::vector<DrawBatch> GpuScene::upload_shown(ShownTriangles shown) {
  shown_indices_ = std::move(shown.indices);
  glBindVertexArray(vertex_array_.name());
  shown_buffer_.emplace(GLenum{GL_ELEMENT_ARRAY_BUFFER}, std::span<const std::uint32_t>(shown_indices_));
  return std::move(shown.batches);
}

void GpuScene::begin_fewer() {
  coming_ = std::async(std::launch::async, [this] {
    std::vector<std::uint32_t> kept;
    for (const Reflector& r : pack_.reflectors) kept.insert(kept.end(), r.indices.begin(), r.indices.end());
    FewerTriangles::DrawnAgain again{kept, {}};
    for (const CurvedReflector& r : pack_.curved_reflectors) again.curved.emplace_back(r.indices);
    return FewerTriangles(pack_.mesh, opaque_, indices_, again);
  });
}

void GpuScene::make_fewer() {
  if (fewer_ || pack_.mesh.indices.size() <= 3 * kFewTriangles) return;
  if (!coming_.valid()) begin_fewer();
  fewer_ = coming_.get();
  glBindVertexArray(vertex_array_.name());
  fewer_buffer_ = gpu::Buffer(GLenum{GL_ELEMENT_ARRAY_BUFFER}, std::span<const std::uint32_t>(fewer_->indices()));
}

std::vector<DrawBatch> GpuScene::show_fewer(const View& view, const SeenMask& seen) {
  const Frustum frustum = make_frustum(view.clip_from_pack);
  if (!fewer_ && !coming_.valid() && pack_.mesh.indices.size() > 3 * kFewTriangles) begin_fewer();
  if (coming_.valid() && coming_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) make_fewer();
  if (!fewer_) return show(frustum, seen);
  chosen_ = fewer_->choose(view, kFewerPixels);
  return upload_shown(gather(visible_batches(chosen_.ranges, frustum, seen), fewer_->indices()));
}

std::span<const DrawRange> GpuScene::bind_curved(const GpuCurvedReflector& reflector) const {
  glBindVertexArray(vertex_array_.name());
  const bool fewer = !chosen_.ranges.empty() && !is_transparent(reflector.material);
  (fewer ? fewer_buffer_ : index_buffer_).bind(GL_ELEMENT_ARRAY_BUFFER);
  if (fewer) return chosen_.curved[reflector.index];
  return {&reflector.triangles, 1};
}

// Where it is, and what it shows in closed form.
GpuReflector GpuScene::placed(const Reflector& r, std::uint32_t index) const {
  GpuReflector out;
  out.index = index;
  out.material = r.material;
  out.pack_from_reflector = r.pack_from_reflector;
  const Mat3 rotation = glm::transpose(Mat3(r.pack_from_reflector));
  out.reflector_from_pack = Mat4(rotation);
  out.reflector_from_pack[3] = Vec4(-(rotation * Vec3(r.pack_from_reflector[3])), 1);
  const Vec2 corners[] = {r.lower, {r.upper.x, r.lower.y}, r.upper, {r.lower.x, r.upper.y}};
  for (int c = 0; c < 4; ++c) out.corners[c] = Vec3(r.pack_from_reflector * Vec4(corners[c], 0, 1));
  out.size = glm::length(r.upper - r.lower);
  out.listed = r.emitters;
  out.emitters = upload_emitters(pack_, listed_by(r), out.reflector_from_pack, out.size);
  return out;
}

void GpuScene::make_reflectors(std::vector<std::uint32_t>& indices, bool sets_known) {
  for (std::uint32_t i = 0; i < pack_.reflectors.size(); ++i) {
    const Reflector& r = pack_.reflectors[i];
    GpuReflector out = placed(r, i);
    out.first_index = static_cast<std::uint32_t>(indices.size());
    out.index_count = static_cast<std::uint32_t>(r.indices.size());
    indices.insert(indices.end(), r.indices.begin(), r.indices.end());
    if (!pack_.map_meshes.empty()) out.elements = group_by_element(r, pack_.radiance_maps);
    if (sets_known) out.seen = seen_in(pack_, i);
    reflectors_.push_back(std::move(out));
  }
  for (std::uint32_t i = 0; i < pack_.frosted_panes.size(); ++i)
    frosted_panes_.push_back(placed(pack_.frosted_panes[i], i));
}

Result<bool> GpuScene::may_show_maps(const GpuReflector& reflector) {
  const ImageName name{ImageKind::kMaps, reflector.index};
  if (images_->has(name)) return true;
  if (images_->in_background()) return false;
  if (images_->state().limit == kNoLimit) return true;
  images_->want(name);
  ORIEL_TRY_VOID(first_of(advance_all()));
  return images_->has(name);
}

Result<bool> GpuScene::bring_maps(const GpuReflector& reflector) {
  const ImageName name{ImageKind::kMaps, reflector.index};
  images_->want(name);
  const bool late = !images_->in_background() && !images_->is_lit(name);
  if (!images_->has(name) || late) ORIEL_TRY_VOID(first_of(advance_all()));
  if (!images_->has(name)) return false;
  reflectors_[reflector.index].mean_radiance = images_->maps(reflector.index).mean_radiance;
  return true;
}

Result<bool> GpuScene::bring_surround_map(std::uint32_t index) {
  const ImageName name{ImageKind::kSurround, index};
  images_->want(name);
  const bool is_ready = images_->has(name) && images_->is_lit(name);
  if (!is_ready && !images_->in_background()) ORIEL_TRY_VOID(first_of(advance_all()));
  return images_->has(name);
}

Status GpuScene::load_images(const View& view) {
  if (!images_->in_background() && images_->state().limit == kNoLimit) return {};  // all is there
  const SeenMask seen = view.orthographic ? std::nullopt : seen_from(Vec3(view.eye));
  images_->begin_wants();
  images_->prioritise(Vec3(view.eye), make_frustum(view.clip_from_pack), seen ? &*seen : nullptr);
  return images_->in_background() ? Status() : first_of(advance_all());
}

std::vector<Error> GpuScene::advance(SceneImages::Clock::duration budget) {
  std::vector<Error> errors = images_->advance(budget);
  keep_texels();
  return errors;
}

std::vector<Error> GpuScene::advance_all(SceneImages::Clock::time_point until) {
  std::vector<Error> errors = images_->finish(until);
  keep_texels();
  return errors;
}

// For those who look at texels, not at textures.
void GpuScene::keep_texels() {
  auto texels = images_->take_texels();
  for (auto& [index, texture] : texels) pack_.textures[index].texels = std::move(texture.texels);
  if (live_ && !texels.empty()) live_->look_again();
}

void GpuScene::make_emitters(std::vector<std::uint32_t>& indices) {
  for (const Emitter& emitter : pack_.emitters) {
    std::vector<DrawRange> ranges;
    for (const EmitterTriangles& found : triangles_of(emitter, pack_)) {
      const MeshPart& part = pack_.mesh.parts[found.part];
      if (is_transparent(part.material)) continue;
      DrawRange range{static_cast<std::uint32_t>(indices.size()),
                      static_cast<std::uint32_t>(found.indices.size()),
                      part.material,
                      part.lightmap_page,
                      {},
                      DrawRange::kNoGroup};
      for (const std::uint32_t index : found.indices) range.bounds.extend(pack_.mesh.positions[index]);
      indices.insert(indices.end(), found.indices.begin(), found.indices.end());
      ranges.push_back(range);
    }
    emitters_.push_back(std::move(ranges));
  }
}

void GpuScene::make_curved_reflectors(std::vector<std::uint32_t>& indices) {
  for (std::uint32_t i = 0; i < pack_.curved_reflectors.size(); ++i) {
    const CurvedReflector& r = pack_.curved_reflectors[i];
    GpuCurvedReflector out{r.material, r.map, i, {}};
    out.triangles.first_index = static_cast<std::uint32_t>(indices.size());
    out.triangles.index_count = static_cast<std::uint32_t>(r.indices.size());
    for (const std::uint32_t index : r.indices) out.triangles.bounds.extend(pack_.mesh.positions[index]);
    indices.insert(indices.end(), r.indices.begin(), r.indices.end());
    curved_reflectors_.push_back(out);
  }
}

void GpuScene::upload_images(std::shared_ptr<const DeferredImages> deferred, const LoadingOptions& loading) {
  const std::array<std::uint8_t, 4> white{255, 255, 255, 255};
  white_ = gpu::Texture2d(gpu::kSrgbAlpha8, 1, 1, white.data());
  no_lightmap_.texture = gpu::Texture2d(gpu::kRgba8, 1, 1, white.data());
  const std::array<std::uint8_t, 4> flat{128, 128, 255, 255};
  flat_ = gpu::Texture2d(gpu::kRgba8, 1, 1, flat.data());
  reflectance_tables_ = upload_reflectance_tables(pack_.fresnel_maps);
  sharp_light_ = GpuSharpLight::upload(pack_.sharp_light);
  if (const SkyMap& sky = pack_.sky_map; sky.width > 0) {
    std::vector<std::uint32_t> texels;
    for (const Vec3& texel : sky.texels) texels.push_back(rgb9e5_from_rgb(texel));
    sky_map_ =
        gpu::Texture2d(gpu::kRgb9e5, static_cast<int>(sky.width), static_cast<int>(sky.height), texels.data(),
                       gpu::TextureOptions{.min_filter = GL_LINEAR, .mag_filter = GL_LINEAR, .wrap_s = GL_REPEAT});
  }

  std::vector<ImageUse> uses;
  const auto as_it_is = [](const Bounds& bounds) { return bounds; };
  add_uses(pack_, opaque_, as_it_is, uses);
  add_uses(pack_, transparent_, as_it_is, uses);
  for (const GlassBody& body : glass_) add_uses(pack_, body.ranges, as_it_is, uses);
  // Movers may be anywhere.
  for (const GpuMover& mover : movers_)
    add_uses(
        pack_, mover.ranges, [&](const Bounds&) { return bounds_; }, uses);
  std::vector<std::vector<ReflectorElement>> elements;
  for (const GpuReflector& reflector : reflectors_) {
    Bounds bounds;
    for (const Vec3& corner : reflector.corners) bounds.extend(corner);
    uses.push_back({{ImageKind::kMaps, reflector.index}, bounds, DrawRange::kNoGroup});
    elements.push_back(reflector.elements);
  }
  for (const GpuCurvedReflector& reflector : curved_reflectors_)
    uses.push_back({{ImageKind::kSurround, reflector.map}, reflector.triangles.bounds, DrawRange::kNoGroup});
  images_ = std::make_unique<SceneImages>(ImageSource(pack_, std::move(deferred), std::move(elements)), uses, loading);
}

const EmissionTexture* GpuScene::emission_texture(std::uint32_t material) const {
  return of_material(pack_.emission_textures, material);
}

const Metalness* GpuScene::metalness(std::uint32_t material) const {
  const Material& m = pack_.materials[material];
  const bool shown = m.fresnel_map >= 0 && m.alpha_mode != AlphaMode::kBlend && m.transmission <= 0;
  return shown ? of_material(pack_.metalness, material) : nullptr;
}

Vec3 GpuScene::brightest_emission(std::uint32_t material) const {
  const Material& m = pack_.materials[material];
  if (m.unlit) return oriel::unlit_white(m);
  Vec3 brightest = m.emission;
  if (const EmissionTexture* picture = emission_texture(material))
    for (int c = 0; c < 3; ++c) brightest[c] = picture->mean[c] > 0 ? brightest[c] / picture->mean[c] : 0.0f;
  return brightest;
}

float GpuScene::unlit_white() const {
  float white = 0;
  for (std::uint32_t m = 0; m < pack_.materials.size(); ++m)
    if (pack_.materials[m].unlit) white = std::max(white, max_component(brightest_emission(m)));
  return white > 0 ? white : 1;
}

const gpu::Texture2d& GpuScene::albedo(std::int32_t index) const {
  return index < 0 ? white_ : images_->color(static_cast<std::uint32_t>(index));
}

const gpu::Texture2d& GpuScene::normal_map(std::int32_t index) const {
  return index < 0 ? flat_ : images_->normal(static_cast<std::uint32_t>(index));
}

const LoadedLightmap& GpuScene::lightmap(std::int32_t index) const {
  return index < 0 ? no_lightmap_ : images_->light(static_cast<std::uint32_t>(index));
}

const GpuKernel& GpuScene::kernel(std::uint32_t material, bool coarse) {
  const Material& m = pack_.materials[material];
  return kernel(m.kernel, m.fresnel_map, coarse ? kCoarseTaps : kKernelTaps);
}

const GpuKernel& GpuScene::curved_kernel(std::uint32_t material, bool coarse) {
  const Material& m = pack_.materials[material];
  const Vec3 r = m.fresnel_map < 0 ? Vec3(0) : lookup_by_cosine(pack_.fresnel_maps[m.fresnel_map].table, 0.5f);
  const bool few = m.kernel >= 0 && pack_.kernels[m.kernel].alpha >= 0.03f && max_component(r) < 0.5f;
  return kernel(m.kernel, m.fresnel_map, coarse ? kCoarseTaps : few ? kFaintTaps : kKernelTaps);
}

const GpuKernel& GpuScene::kernel(std::int32_t index, std::int32_t fresnel_map, int taps_a_row) {
  const auto [at, added] = kernels_.try_emplace({index, fresnel_map, taps_a_row});
  if (!added) return at->second;
  const BrdfKernel mirror;
  const FresnelMap none;
  const BrdfKernel& kernel = index < 0 ? mirror : pack_.kernels[static_cast<std::size_t>(index)];
  const FresnelMap& fresnel = fresnel_map < 0 ? none : pack_.fresnel_maps[static_cast<std::size_t>(fresnel_map)];
  KernelTaps taps = make_kernel_taps(kernel, taps_a_row);
  const std::vector<float> factors = weigh_by_fresnel(taps, fresnel);
  at->second = {upload_kernel_taps(taps), taps.count, taps.rows, taps.median, {}};
  if (!kernel.fits.empty()) at->second.fits = upload_lobe_fits(kernel, fresnel, factors);
  return at->second;
}

}  // namespace oriel
