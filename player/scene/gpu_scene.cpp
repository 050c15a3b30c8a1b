#include "player/scene/gpu_scene.h"

#include <algorithm>
#include <atomic>

#include "formats/core/threads/parallel.h"
#include "player/scene/check.h"
#include "player/scene/emitter_ranges.h"

namespace oriel {
namespace {

constexpr int kKernelTaps = 48;

// Over the pixels of a reflector's maps.
struct MapMeans {
  Vec3 radiance{0};
  float distance = 0;
};

MapMeans means_of_maps(const Pack& pack, const Reflector& reflector) {
  DVec3 radiance(0);
  double count = 0, distance = 0, surfaces = 0;
  for (std::uint32_t m = 0; m < reflector.map_count; ++m) {
    const RadianceMap& map = pack.radiance_maps[reflector.first_map + m];
    for (std::size_t i = 0; i < map.radiance.size(); ++i) {
      if (map.valid[i] == 0 || !is_finite(map.radiance[i])) continue;
      radiance += DVec3(map.radiance[i]);
      count += 1;
      if (map.valid[i] == 2 || !(map.disparity[i] > 0)) continue;
      const Vec2 share((static_cast<float>(i % map.width) + 0.5f) / static_cast<float>(map.width),
                       (static_cast<float>(i / map.width) + 0.5f) / static_cast<float>(map.height));
      const Vec3 to_plane = Vec3(glm::mix(map.lower, map.upper, share), 0) - map.eye;
      distance += double{glm::length(to_plane)} * (1 / double{map.disparity[i]} - 1);
      surfaces += 1;
    }
  }
  MapMeans out;
  if (count > 0) out.radiance = Vec3(radiance / count);
  if (surfaces > 0) out.distance = static_cast<float>(distance / surfaces);
  return out;
}

}  // namespace

Result<std::unique_ptr<GpuScene>> GpuScene::create(DeferredPack pack, const gpu::Device& device) {
  ORIEL_TRY_VOID(check_drawable(pack.pack, device, pack.maps ? MapPixels::kDeferred : MapPixels::kHere));
  std::unique_ptr<GpuScene> scene(new GpuScene);
  static std::atomic<std::uint64_t> scenes{0};
  scene->serial_ = ++scenes;
  scene->pack_ = std::move(pack.pack);
  scene->deferred_ = std::move(pack.maps);
  scene->upload_geometry();
  scene->upload_images();
  for (const Mover& mover : scene->pack_.movers) scene->movers_.push_back(upload_mover(mover));
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
    (is_transparent(range.material) ? transparent_ : opaque_).push_back(range);
  }
  make_reflectors(indices);
  make_emitters(indices);
  make_curved_reflectors(indices);

  vertex_array_ = gpu::make_vertex_array();
  glBindVertexArray(vertex_array_.name());
  upload_vertices(mesh, buffers_);
  index_buffer_ = gpu::Buffer(GLenum{GL_ELEMENT_ARRAY_BUFFER}, std::span<const std::uint32_t>(indices));
  glBindVertexArray(0);
  if (known) indices_ = std::move(indices);
}

std::vector<DrawBatch> GpuScene::show(const Frustum& frustum, const SeenMask& seen) {
  shown_buffer_.reset();
  if (!seen) return visible_batches(opaque_, frustum);
  ShownTriangles shown = gather_visible(opaque_, indices_, frustum, seen);
  glBindVertexArray(vertex_array_.name());
  shown_buffer_.emplace(GLenum{GL_ELEMENT_ARRAY_BUFFER}, std::span<const std::uint32_t>(shown.indices));
  return std::move(shown.batches);
}

void GpuScene::make_reflectors(std::vector<std::uint32_t>& indices) {
  for (std::uint32_t i = 0; i < pack_.reflectors.size(); ++i) {
    const Reflector& r = pack_.reflectors[i];
    GpuReflector out;
    out.index = i;
    out.material = r.material;
    out.first_index = static_cast<std::uint32_t>(indices.size());
    out.index_count = static_cast<std::uint32_t>(r.indices.size());
    indices.insert(indices.end(), r.indices.begin(), r.indices.end());
    out.pack_from_reflector = r.pack_from_reflector;
    const Mat3 rotation = glm::transpose(Mat3(r.pack_from_reflector));
    out.reflector_from_pack = Mat4(rotation);
    out.reflector_from_pack[3] = Vec4(-(rotation * Vec3(r.pack_from_reflector[3])), 1);
    const Vec2 corners[] = {r.lower, {r.upper.x, r.lower.y}, r.upper, {r.lower.x, r.upper.y}};
    for (int c = 0; c < 4; ++c) out.corners[c] = Vec3(r.pack_from_reflector * Vec4(corners[c], 0, 1));
    out.size = glm::length(r.upper - r.lower);
    out.elements = group_by_element(r, pack_.radiance_maps);
    out.emitters = upload_emitters(pack_, r, out.reflector_from_pack, out.size);
    reflectors_.push_back(std::move(out));
  }
  loaded_.resize(reflectors_.size());
}

Status GpuScene::load_maps(const GpuReflector& reflector) {
  if (loaded_[reflector.index]) return {};
  const Reflector& r = pack_.reflectors[reflector.index];
  if (deferred_) {
    std::vector<Status> loaded(r.map_count);
    for_each_parallel(r.map_count, core_count(), [&](std::size_t m) {
      RadianceMap& place = pack_.radiance_maps[r.first_map + m];
      Result<RadianceMap> map = deferred_->load(r.first_map + m);
      if (!map) {
        loaded[m] = tl::unexpected<Error>(std::move(map).error());
        return;
      }
      map->residual = place.residual;
      place = std::move(*map);
    });
    for (const Status& status : loaded) ORIEL_TRY_VOID(status);
  }
  const MapMeans means = means_of_maps(pack_, r);
  reflectors_[reflector.index].mean_radiance = means.radiance;
  reflectors_[reflector.index].mean_distance = means.distance;
  loaded_[reflector.index] = true;
  return {};
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
  for (const CurvedReflector& r : pack_.curved_reflectors) {
    GpuCurvedReflector out{r.material,
                           r.map,
                           static_cast<std::uint32_t>(indices.size()),
                           static_cast<std::uint32_t>(r.indices.size()),
                           {}};
    for (const std::uint32_t index : r.indices) out.bounds.extend(pack_.mesh.positions[index]);
    indices.insert(indices.end(), r.indices.begin(), r.indices.end());
    curved_reflectors_.push_back(out);
  }
}

void GpuScene::upload_images() {
  const std::array<std::uint8_t, 4> white{255, 255, 255, 255};
  white_ = gpu::Texture(gpu::kSrgbAlpha8, 1, 1, white.data());
  no_lightmap_.texture = gpu::Texture(gpu::kRgba8, 1, 1, white.data());
  const std::array<std::uint8_t, 4> flat{128, 128, 255, 255};
  flat_ = gpu::Texture(gpu::kRgba8, 1, 1, flat.data());
  std::vector<std::vector<Material>> users(pack_.textures.size());
  for (const Material& m : pack_.materials)
    if (m.base_color_texture >= 0) users[static_cast<std::size_t>(m.base_color_texture)].push_back(m);
  for (std::size_t i = 0; i < users.size(); ++i) albedos_.push_back(upload_color_texture(pack_.textures[i], users[i]));
  for (const Texture& texture : pack_.normal_textures) normal_maps_.push_back(upload_normal_texture(texture));
  for (const LightmapPage& page : pack_.lightmaps) lightmaps_.push_back(upload_lightmap(page));
  reflectance_tables_ = upload_reflectance_tables(pack_.fresnel_maps);
  radiance_maps_.resize(pack_.radiance_maps.size());
  surround_maps_.resize(pack_.surround_maps.size());
  sphere_maps_.resize(pack_.fresnel_maps.size());
}

void GpuScene::use_mipmaps(bool on) {
  if (on == mipmaps_) return;
  mipmaps_ = on;
  for (const auto* textures : {&albedos_, &normal_maps_})
    for (const gpu::Texture& texture : *textures) {
      texture.bind(0);
      glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, on ? texture.levels() - 1 : 0);
    }
}

const gpu::Texture& GpuScene::albedo(std::int32_t index) const {
  return index < 0 ? white_ : albedos_[static_cast<std::size_t>(index)];
}

const gpu::Texture& GpuScene::normal_map(std::int32_t index) const {
  return index < 0 ? flat_ : normal_maps_[static_cast<std::size_t>(index)];
}

const LightmapTexture& GpuScene::lightmap(std::int32_t index) const {
  return index < 0 ? no_lightmap_ : lightmaps_[static_cast<std::size_t>(index)];
}

const gpu::Texture& GpuScene::radiance_map(std::uint32_t index) {
  gpu::Texture& texture = radiance_maps_[index];
  if (!texture) {
    texture = upload_radiance_map(pack_.radiance_maps[index]);
    map_bytes_ += texture.bytes();
  }
  return texture;
}

const MapArray& GpuScene::map_array(const ReflectorElement& element) {
  const auto [at, added] = map_arrays_.try_emplace(element.maps.front());
  if (added) {
    at->second = MapArray::upload(pack_.radiance_maps, element.maps);
    map_bytes_ += at->second.bytes();
  }
  return at->second;
}

const SurroundTextures& GpuScene::surround_map(std::uint32_t index) {
  SurroundTextures& textures = surround_maps_[index];
  if (!textures.light) {
    textures = upload_surround_map(pack_.surround_maps[index]);
    map_bytes_ += textures.light.bytes() + textures.inverse_distance.bytes();
  }
  return textures;
}

const gpu::Texture& GpuScene::sphere_map(std::uint32_t fresnel_map) {
  gpu::Texture& texture = sphere_maps_[fresnel_map];
  if (!texture) texture = upload_sphere_map(pack_.fresnel_maps[fresnel_map]);
  return texture;
}

const GpuKernel& GpuScene::kernel(std::uint32_t material, KernelPlace place) {
  const Material& m = pack_.materials[material];
  return kernel(m.kernel, m.fresnel_map, place);
}

const GpuKernel& GpuScene::kernel(std::int32_t index, std::int32_t fresnel_map, KernelPlace place) {
  const auto [at, added] = kernels_.try_emplace({index, fresnel_map, place});
  if (!added) return at->second;
  const BrdfKernel mirror;
  const FresnelMap none;
  const BrdfKernel& kernel = index < 0 ? mirror : pack_.kernels[static_cast<std::size_t>(index)];
  const FresnelMap& fresnel = fresnel_map < 0 ? none : pack_.fresnel_maps[static_cast<std::size_t>(fresnel_map)];
  KernelTaps taps = make_kernel_taps(kernel, kKernelTaps, place);
  const std::vector<float> factors = weigh_by_fresnel(taps, place == KernelPlace::kCentred ? none : fresnel);
  at->second = {upload_kernel_taps(taps), taps.count, taps.rows, taps.median, {}};
  if (!kernel.fits.empty())
    at->second.fits = upload_lobe_fits(kernel, place == KernelPlace::kCentred ? none : fresnel, factors);
  return at->second;
}

}  // namespace oriel
