#include "preview/frame/surface_pass.h"

#include <array>

#include "bake/scene/shade.h"
#include "bake/trace/albedo.h"
#include "player/gpu/raster_state.h"

namespace oriel {
namespace {

constexpr int kFaceColumns = 4096;  // as shaders/passes/preview_surface.frag
constexpr int kCosines = 64;
constexpr int kRoughnesses = 9;  // rows of a material whose roughness is a texture
enum Unit { kBase, kRough, kEmission, kNormal, kFaces, kLeft };

GLenum wrap_of(Wrap wrap) {
  return wrap == Wrap::kClamp ? GL_CLAMP_TO_EDGE : wrap == Wrap::kMirror ? GL_MIRRORED_REPEAT : GL_REPEAT;
}

// Share of light that a material's specular layers leave to the diffuse one, at a roughness.
void add_left_row(const SceneMaterial& m, std::optional<float> roughness, std::vector<float>& table) {
  ShadePoint p;
  const float metallic = roughness ? 0 : m.metallic;
  const Vec3 dielectric = glm::min(static_cast<float>(dielectric_f0(m.ior)) * m.specular_color, Vec3(1)) * m.specular;
  p.f0 = glm::mix(dielectric, m.base_color, metallic);
  p.f90 = glm::mix(m.specular, 1.0f, metallic);
  p.curve = {.ior = m.ior, .schlick = metallic};
  const float rough = roughness.value_or(m.roughness);
  p.alpha = rough * rough;
  p.coat = m.coat;
  p.coat_alpha = m.coat_roughness * m.coat_roughness;
  for (int i = 0; i < kCosines; ++i) {
    const float root = static_cast<float>(i) / (kCosines - 1);
    table.push_back(1 - max_component(reflectance(p, root * root)));
  }
}

}  // namespace

Result<SeenSurfaces> make_seen_surfaces(int width, int height) {
  SeenSurfaces s;
  for (gpu::Texture2d* image : {&s.place, &s.normal, &s.face, &s.diffuse, &s.emission})
    *image = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
  s.depth = gpu::Texture2d(gpu::kDepthStencil, width, height, nullptr);
  ORIEL_TRY_VOID(gpu::check_gl("making the preview's textures"));
  ORIEL_TRY(s.framebuffer,
            gpu::Framebuffer::create(
                "seen surfaces",
                std::array<const gpu::Texture2d*, 5>{&s.place, &s.normal, &s.face, &s.diffuse, &s.emission}, s.depth));
  return s;
}

std::vector<Vec4> read_texture(const gpu::Texture2d& texture) {
  std::vector<Vec4> texels(static_cast<std::size_t>(texture.width()) * static_cast<std::size_t>(texture.height()));
  texture.bind(0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, texels.data());
  return texels;
}

SeenPoints read_seen_points(const SeenSurfaces& surfaces) {
  return {surfaces.size().x, surfaces.size().y, read_texture(surfaces.place), read_texture(surfaces.face),
          read_texture(surfaces.normal)};
}

Result<PreviewMesh> PreviewMesh::create(const Scene& scene, const SceneParts& parts, const gpu::Device& device,
                                        const PreviewMesh& last) {
  PreviewMesh mesh;
  mesh.scene_ = &scene;
  mesh.parts_ = parts;
  const std::uint8_t white[4] = {255, 255, 255, 255};
  mesh.white_ = gpu::Texture2d(gpu::kRgba8, 1, 1, white);
  if (last.parts_.vertices == parts.vertices) {
    mesh.vertices_ = last.vertices_;
  } else {
    ORIEL_TRY(mesh.vertices_, upload_vertices(scene, device));
  }
  if (last.parts_.images == parts.images) mesh.textures_ = last.textures_;
  ORIEL_TRY_VOID(mesh.upload_textures(scene, device));
  mesh.sky_ = last.parts_.sky == parts.sky ? last.sky_ : upload_sky(scene);
  mesh.upload_reflectances(scene);
  ORIEL_TRY_VOID(gpu::check_gl("loading the scene"));
  return mesh;
}

auto PreviewMesh::upload_vertices(const Scene& scene, const gpu::Device& device)
    -> Result<std::shared_ptr<const Vertices>> {
  const auto rows = static_cast<int>(scene.triangles.size() / kFaceColumns) + 1;
  if (rows > device.texture_size)
    return fail(ErrorCode::kRuntime, "preview", "found {} triangles, expected at most {} on this device",
                scene.triangles.size(), std::size_t{kFaceColumns} * static_cast<std::size_t>(device.texture_size));
  auto vertices = std::make_shared<Vertices>();
  std::vector<Vec4> faces(static_cast<std::size_t>(rows) * kFaceColumns);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) faces[t] = Vec4(geometric_normal(scene, t), 0);
  vertices->faces = gpu::Texture2d(gpu::kRgba32f, kFaceColumns, rows, faces.data());
  vertices->array = gpu::make_vertex_array();
  glBindVertexArray(vertices->array.name());
  std::vector<gpu::Buffer>& buffers = vertices->buffers;
  gpu::add_attribute(buffers, 0, scene.positions, {3, GL_FLOAT});
  gpu::add_attribute(buffers, 1, scene.normals, {3, GL_FLOAT});
  gpu::add_attribute(buffers, 2, scene.uv0, {2, GL_FLOAT});
  gpu::add_attribute(buffers, 3, scene.uv1, {2, GL_FLOAT});
  if (!scene.colors.empty()) gpu::add_attribute(buffers, 4, scene.colors, {4, GL_UNSIGNED_BYTE, true});
  if (!scene.tangents.empty()) gpu::add_attribute(buffers, 5, scene.tangents, {4, GL_FLOAT});
  vertices->indices = gpu::Buffer(GL_ELEMENT_ARRAY_BUFFER, std::span<const UVec3>(scene.triangles));
  glBindVertexArray(0);
  return std::shared_ptr<const Vertices>(std::move(vertices));
}

Status PreviewMesh::upload_textures(const Scene& scene, const gpu::Device& device) {
  const auto upload = [&](const TextureSlot& slot, bool srgb) -> Status {
    if (slot.image < 0) return {};
    const TextureKey key{slot.image, srgb, slot.wrap_s, slot.wrap_t, slot.nearest};
    if (textures_.contains(key)) return {};
    const Image& image = scene.images[static_cast<std::size_t>(slot.image)];
    if (image.width > static_cast<std::uint32_t>(device.texture_size) ||
        image.height > static_cast<std::uint32_t>(device.texture_size))
      return fail(ErrorCode::kRuntime, image.name, "found an image of {}x{}, expected at most {} a side on this device",
                  image.width, image.height, device.texture_size);
    const GLenum filter = slot.nearest ? GL_NEAREST : GL_LINEAR;
    const gpu::TextureOptions options{
        .min_filter = filter, .mag_filter = filter, .wrap_s = wrap_of(slot.wrap_s), .wrap_t = wrap_of(slot.wrap_t)};
    textures_[key] =
        std::make_shared<const gpu::Texture2d>(srgb ? gpu::kSrgbAlpha8 : gpu::kRgba8, static_cast<int>(image.width),
                                               static_cast<int>(image.height), image.texels.data(), options);
    return {};
  };
  for (const SceneMaterial& m : scene.materials) {
    ORIEL_TRY_VOID(upload(m.base_color_texture, true));
    ORIEL_TRY_VOID(upload(m.metallic_roughness_texture, false));
    ORIEL_TRY_VOID(upload(m.emission_texture, true));
    ORIEL_TRY_VOID(upload(m.normal_texture, false));
  }
  return {};
}

void PreviewMesh::upload_reflectances(const Scene& scene) {
  std::vector<float> table;
  std::vector<int> first, count;
  for (const SceneMaterial& m : scene.materials) {
    const bool varies = m.metallic_roughness_texture.image >= 0;
    first.push_back(static_cast<int>(table.size() / kCosines));
    count.push_back(varies ? kRoughnesses : 1);
    for (int i = 0; i < count.back(); ++i)
      add_left_row(m, varies ? std::optional(static_cast<float>(i) / (kRoughnesses - 1)) : std::nullopt, table);
  }
  const auto rows = static_cast<int>(table.size() / kCosines);
  if (rows == 0) return;
  left_ = gpu::Texture2d(gpu::kR32f, kCosines, rows, table.data(), {.min_filter = GL_LINEAR, .mag_filter = GL_LINEAR});
  for (std::size_t m = 0; m < first.size(); ++m)
    left_rows_.emplace_back((static_cast<float>(first[m]) + 0.5f) / static_cast<float>(rows),
                            static_cast<float>(count[m] - 1) / static_cast<float>(rows));
}

void PreviewMesh::take_materials() {
  left_rows_.clear();
  upload_reflectances(*scene_);
}

std::shared_ptr<const gpu::Texture2d> PreviewMesh::upload_sky(const Scene& scene) {
  const SkyImage& sky = scene.sky_image;
  if (sky.texels.empty()) return std::make_shared<const gpu::Texture2d>();
  std::vector<Vec4> texels;
  for (const Vec3& t : sky.texels) texels.emplace_back(t, 1);
  return std::make_shared<const gpu::Texture2d>(
      gpu::kRgba32f, static_cast<int>(sky.width), static_cast<int>(sky.height), texels.data(),
      gpu::TextureOptions{.min_filter = GL_LINEAR, .mag_filter = GL_LINEAR, .wrap_s = GL_REPEAT});
}

void PreviewMesh::set_slot(const gpu::Program& program, const TextureSlot& slot, bool srgb, const char* name,
                           int unit) const {
  const auto found = textures_.find({slot.image, srgb, slot.wrap_s, slot.wrap_t, slot.nearest});
  (found != textures_.end() ? *found->second : white_).bind(unit);
  program.set(fmt::format("u_{}_texture", name).c_str(), unit);
  const Mat3& m = slot.image_from_uv;  // rows, as programs take no 3x3 matrices
  program.set(fmt::format("u_{}_u", name).c_str(), Vec3(m[0][0], m[1][0], m[2][0]));
  program.set(fmt::format("u_{}_v", name).c_str(), Vec3(m[0][1], m[1][1], m[2][1]));
  program.set(fmt::format("u_{}_set", name).c_str(), static_cast<int>(slot.texcoord));
}

void PreviewMesh::set_material(const gpu::Program& program, std::uint32_t material) const {
  const SceneMaterial& m = scene_->materials[material];
  set_slot(program, m.base_color_texture, true, "base", kBase);
  set_slot(program, m.metallic_roughness_texture, false, "rough", kRough);
  set_slot(program, m.emission_texture, true, "emission", kEmission);
  set_slot(program, m.normal_texture, false, "normal", kNormal);
  program.set("u_base_color", Vec4(m.base_color, m.alpha));
  program.set("u_metal_rough", Vec2(m.metallic, m.roughness));
  program.set("u_emission", m.emission);
  program.set("u_alpha_cutoff", m.alpha_mode == AlphaMode::kMask ? std::max(m.alpha_cutoff, 0.0f) : -1.0f);
  program.set("u_covers", m.alpha_mode == AlphaMode::kBlend ? 1 : 0);
  program.set("u_transmission", m.transmission);
  program.set("u_double_sided", m.double_sided ? 1 : 0);
  program.set("u_normal_mapped", m.normal_texture.image >= 0 ? 1 : 0);
  program.set("u_normal_scale", m.normal_scale);
  program.set("u_dark", m.metal != Metal::kNone ? 1 : 0);
  program.set("u_left_rows", left_rows_[material]);
}

void PreviewMesh::draw(const gpu::Program& program) const {
  glBindVertexArray(vertices_->array.name());
  if (scene_->colors.empty()) glVertexAttrib4f(4, 1, 1, 1, 1);
  if (scene_->tangents.empty()) glVertexAttrib4f(5, 0, 0, 0, 0);
  vertices_->faces.bind(kFaces);
  left_.bind(kLeft);
  program.set("u_faces", kFaces);
  program.set("u_left", kLeft);
  std::uint32_t bound = ~0u;
  for (const Surface& surface : scene_->surfaces) {
    if (surface.triangle_count == 0 || scene_->materials[surface.material].unlit) continue;  // paths pass these by
    if (surface.material != bound) set_material(program, bound = surface.material);
    program.set("u_first_triangle", static_cast<int>(surface.first_triangle));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * surface.triangle_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(std::uintptr_t{surface.first_triangle} * sizeof(UVec3)));
  }
  glBindVertexArray(0);
}

Result<SurfacePass> SurfacePass::create(gpu::Dialect dialect) {
  SurfacePass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("preview_surface", dialect));
  return pass;
}

void SurfacePass::draw(const PreviewMesh& mesh, const View& view, float glossy, const SeenSurfaces& to) const {
  to.framebuffer.bind();
  glViewport(0, 0, view.width, view.height);
  gpu::apply({.depth_test = true, .depth_write = true});
  glClearColor(0, 0, 0, 0);
  glClearDepth(1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  program_.use();
  program_.set("u_clip_from_pack", view.clip_from_pack);
  program_.set("u_eye", view.eye);
  program_.set("u_glossy", glossy);
  mesh.draw(program_);
}

}  // namespace oriel
