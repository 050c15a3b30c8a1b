// A pack as the passes draw it.
#pragma once

#include <future>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "player/gpu/buffer.h"
#include "player/gpu/device.h"
#include "player/images/scene_images.h"
#include "player/navigation/lamps.h"
#include "player/navigation/view.h"
#include "player/scene/fewer_triangles.h"
#include "player/scene/frame_options.h"
#include "player/scene/glass_bodies.h"
#include "player/scene/gpu_emitters.h"
#include "player/scene/gpu_map_meshes.h"
#include "player/scene/gpu_mesh.h"
#include "player/scene/gpu_sharp_light.h"
#include "player/scene/kernel_taps.h"
#include "player/scene/lights.h"
#include "player/scene/textures.h"

namespace oriel {

struct GpuReflector {
  std::uint32_t index = 0;     // into Pack::reflectors
  std::uint32_t material = 0;  // into Pack::materials
  std::uint32_t first_index = 0, index_count = 0;
  Mat4 pack_from_reflector{1}, reflector_from_pack{1};
  std::array<Vec3, 4> corners{};  // of its bounds, pack space, in order around
  float size = 0;                 // diagonal of its bounds, metres
  std::vector<ReflectorElement> elements;
  SeenMask seen;  // groups that any eye may see in it; nothing: all
  // Once bring_maps() has been called:
  Vec3 mean_radiance{0};              // of its maps: shown where none of them has anything
  std::vector<std::uint32_t> listed;  // into Pack::emitters: shown in closed form, left out of its maps and images
  GpuEmitters emitters;
};

struct GpuCurvedReflector {
  std::uint32_t material = 0;  // into Pack::materials
  std::uint32_t map = 0;       // into Pack::surround_maps
  std::uint32_t index = 0;     // into Pack::curved_reflectors
  DrawRange triangles;
};

// K as shaders read it.
struct GpuKernel {
  gpu::Texture2d taps;
  int count = 1, rows = 1;  // as KernelTaps
  float median = 0;
  gpu::Texture2d fits;  // LobeFit by incidence, as upload_lobe_fits; none where the kernel has no fits
  bool blurs() const { return count > 1; }
};

class LiveLamps;
struct LiveReport;

std::uint64_t next_scene_serial();

class GpuScene {
 public:
  // Takes the pack and uploads it. Errors of check_drawable; kRuntime where the driver refuses.
  // Not in the background: errors of the pack's images too.
  static Result<std::unique_ptr<GpuScene>> create(DeferredPack pack, const gpu::Device& device,
                                                  const LoadingOptions& loading = {});
  static Result<std::unique_ptr<GpuScene>> create(Pack pack, const gpu::Device& device,
                                                  const LoadingOptions& loading = {}) {
    return create(DeferredPack{std::move(pack), nullptr}, device, loading);
  }

  // By group of lamps, how many times they shine as they were baked, and where they are; of another number of groups,
  // or none: once, there. Takes time where that changes: light of lightmaps is added up anew, for lamps that moved it
  // is computed (live_lamps.h). Errors of images.
  Status set_lamps(std::span<const Vec3> factors, std::span<const MoverPose> poses, const LiveSettings& live);
  // In the background the light of a lamp that moved comes later, coarse before fine, and maps follow lamps one after
  // the other: whether the next set_lamps() and the frame after it show more of it.
  bool has_live_news() const;
  bool lamps_moved() const { return !std::ranges::all_of(lamps_, is_rest); }
  // What is to be told of lamps that moved, each once.
  std::vector<LiveReport> take_live_reports();

  // Before a frame of this view: what it shows comes first, and within a limit as fine as there is room for. Not in the
  // background all of that is there afterwards, but for maps. Errors of images.
  Status load_images(const View& view);
  SceneImages& images() { return *images_; }
  const SceneImages& images() const { return *images_; }
  // In the background, between frames: brings images to the device for about so long. Errors, each once.
  std::vector<Error> advance(SceneImages::Clock::duration budget);
  // All that is wanted, or what is there by then.
  std::vector<Error> advance_all(SceneImages::Clock::time_point until = SceneImages::Clock::time_point::max());

  ~GpuScene();
  const Pack& pack() const { return pack_; }
  // Of this scene alone, and of its lamps as they shine now, for what others keep of it.
  std::uint64_t serial() const { return serial_; }
  // The same however its lamps shine.
  std::uint64_t geometry_serial() const { return geometry_serial_; }
  const Bounds& bounds() const { return bounds_; }
  const BakedLamps& baked_lamps() const { return baked_; }
  // Sorted by material and page.
  const std::vector<DrawRange>& opaque() const { return opaque_; }
  // See-through surfaces, without those of glass bodies.
  const std::vector<DrawRange>& transparent() const { return transparent_; }
  const std::vector<GlassBody>& glass() const { return glass_; }
  bool is_inside_glass(const GlassBody& body, const Vec3& point) const {
    return is_inside(body, pack_.mesh, indices_, point);
  }
  const std::vector<GpuReflector>& reflectors() const { return reflectors_; }
  // By Pack::frosted_panes: their lit sides, without triangles (GlassBody::lit).
  const std::vector<GpuReflector>& frosted_panes() const { return frosted_panes_; }
  const std::vector<GpuCurvedReflector>& curved_reflectors() const { return curved_reflectors_; }
  // What an eye there may see of groups of opaque triangles; nothing where the pack does not know.
  SeenMask seen_from(const Vec3& eye) const { return seen_groups_.from(eye); }
  // The opaque triangles of one of Pack::emitters.
  const std::vector<DrawRange>& emitter(std::uint32_t index) const { return emitters_[index]; }
  // Of the pack, as they shine and where they are.
  const std::vector<BrightLight>& bright_lights() const { return bright_lights_; }
  const std::vector<GpuMover>& movers() const { return movers_; }  // by Pack::movers
  bool is_transparent(std::uint32_t material) const;

  // Whether half floats hold the light of surfaces and sky, as lamps shine now; that of a reflector's maps, which are
  // there.
  bool fits_halves() const;
  bool fit_halves(const GpuReflector& reflector) const;

  void bind_geometry() const {
    glBindVertexArray(vertex_array_.name());
    index_buffer_.bind(GL_ELEMENT_ARRAY_BUFFER);
  }
  // The triangles of a see-through range from far to near, as the bound geometry's indices: draws begin at 0.
  gpu::Buffer bind_far_to_near(const DrawRange& range, const View& view) const;
  // The opaque triangles in the frustum, without groups that are not seen. For draws after bind_shown(), until the next
  // call.
  std::vector<DrawBatch> show(const Frustum& frustum, const SeenMask& seen);
  // The same for a coarse frame, with fewer triangles where the scene has many. They are made in the background, from
  // the first such frame on: until they are there, it is all of them.
  std::vector<DrawBatch> show_fewer(const View& view, const SeenMask& seen);
  // Of what these gave, the triangles that are kept (gather()), a range a batch; likewise.
  std::vector<DrawBatch> keep_shown(std::vector<DrawBatch> shown, std::span<const std::uint32_t> kept);
  const std::vector<std::uint32_t>& shown_indices() const { return shown_buffer_ ? shown_indices_ : indices_; }
  // Waits for them.
  void make_fewer();
  // A curved reflector's triangles, those of them that are shown; binds what they are of.
  std::span<const DrawRange> bind_curved(const GpuCurvedReflector& reflector) const;
  void bind_shown() const {
    glBindVertexArray(vertex_array_.name());
    (shown_buffer_ ? *shown_buffer_ : index_buffer_).bind(GL_ELEMENT_ARRAY_BUFFER);
  }
  // cd/m² where its picture is white, or of the whole material; of an unlit one what shows its colour.
  Vec3 brightest_emission(std::uint32_t material) const;
  // What white unlit surfaces show, cd/m²; 1 where none says it.
  float unlit_white() const;
  // The picture that a material shines with; nothing where that is even.
  const EmissionTexture* emission_texture(std::uint32_t material) const;
  // Of opaque materials whose F0 differs from place to place, how; else null.
  const Metalness* metalness(std::uint32_t material) const;
  // White where index is -1.
  const gpu::Texture2d& albedo(std::int32_t index) const;
  // Of Pack::normal_textures; one that tilts nothing where index is -1.
  const gpu::Texture2d& normal_map(std::int32_t index) const;
  // Scale 0 where index is -1.
  const LoadedLightmap& lightmap(std::int32_t index) const;
  const GpuSharpLight& sharp_light() const { return sharp_light_; }
  const gpu::Texture2d& sky_map() const { return sky_map_; }  // Pack::sky_map, or none
  const gpu::Texture2d& reflectance_tables() const { return reflectance_tables_; }
  // Whether a reflector's maps are there, or will be once bring_maps() is called. Errors of images.
  Result<bool> may_show_maps(const GpuReflector& reflector);
  void want_maps(const GpuReflector& reflector) { images_->want({ImageKind::kMaps, reflector.index}); }
  // To be called before a reflector's maps are used, where they may be shown: brings them, the first time; false where
  // within the limit of memory there is no room beside what came since. Errors of images.
  Result<bool> bring_maps(const GpuReflector& reflector);
  // The same of a curved reflector: whether its map is there.
  Result<bool> bring_surround_map(std::uint32_t index);
  // Of an element of the reflector; layers as its maps.
  const MapArray& map_array(const GpuReflector& reflector, std::size_t element) const {
    return images_->maps(reflector.index).elements[element];
  }
  // Of Pack::radiance_maps[index], uploaded on first use and kept.
  const GpuMapMesh& map_mesh(std::uint32_t index) { return map_meshes_.get(index, pack_.map_meshes); }
  const SurroundTextures& surround_map(std::uint32_t index) const { return images_->surround(index); }
  // Of Pack::lightmaps with all that the bake knows; null: not yet.
  Result<const LightmapPage*> page(std::uint32_t index) { return images_->page(index, pack_.lightmaps[index]); }
  // Of radiance and surround maps on the device.
  std::uint64_t map_bytes() const { return images_->map_bytes() + map_meshes_.bytes(); }
  // A material's, made on first use and kept. coarse: of few taps.
  const GpuKernel& kernel(std::uint32_t material, bool coarse);
  // For curved reflectors: half of the taps of wide lobes where R at 60° is below a half.
  const GpuKernel& curved_kernel(std::uint32_t material, bool coarse);
  const GpuKernel& mirror_kernel() { return kernel(-1, -1, 1); }

 private:
  GpuScene() = default;
  // Of Pack::kernels and Pack::fresnel_maps, -1: a mirror's, none.
  const GpuKernel& kernel(std::int32_t index, std::int32_t fresnel_map, int taps_a_row);
  void upload_geometry();
  void upload_images(std::shared_ptr<const DeferredImages> deferred, const LoadingOptions& loading);
  void keep_texels();
  GpuReflector placed(const Reflector& reflector, std::uint32_t index) const;
  void make_reflectors(std::vector<std::uint32_t>& indices, bool sets_known);
  void make_emitters(std::vector<std::uint32_t>& indices);
  void make_curved_reflectors(std::vector<std::uint32_t>& indices);
  void begin_fewer();
  std::vector<DrawBatch> upload_shown(ShownTriangles shown);
  void move_lamps(std::span<const MoverPose> poses);
  // views: lamps that have moved are seen from it, too.
  void list_emitters(GpuReflector& reflector, const Reflector& baked, bool views) const;
  MapFactors factors_of_maps() const;
  std::vector<Vec3> factors_of_sharp_light() const;
  Pack pack_;
  std::uint64_t serial_ = 0, geometry_serial_ = 0;
  SeenGroups seen_groups_;
  Bounds bounds_;
  std::vector<DrawRange> opaque_, transparent_;
  std::vector<GlassBody> glass_;
  std::vector<std::vector<DrawRange>> emitters_;
  std::vector<GpuReflector> reflectors_, frosted_panes_;
  std::vector<GpuCurvedReflector> curved_reflectors_;
  std::vector<GpuMover> movers_;
  gpu::VertexArray vertex_array_;
  std::vector<gpu::Buffer> buffers_;
  gpu::Buffer index_buffer_;
  std::optional<gpu::Buffer> shown_buffer_;   // of what is shown, where that is not ranges of all
  std::vector<std::uint32_t> shown_indices_;  // of that
  std::vector<std::uint32_t> indices_;        // of index_buffer_
  std::optional<FewerTriangles> fewer_;       // once they are made
  gpu::Buffer fewer_buffer_;                  // of their indices
  std::future<FewerTriangles> coming_;        // reads pack_, opaque_ and indices_
  FewerTriangles::Chosen chosen_;             // of the frame, empty where it shows all
  gpu::Texture2d white_, flat_, reflectance_tables_;
  LoadedLightmap no_lightmap_;
  GpuSharpLight sharp_light_;
  gpu::Texture2d sky_map_;
  std::map<std::tuple<std::int32_t, std::int32_t, int>, GpuKernel> kernels_;
  GpuMapMeshes map_meshes_;
  BakedLamps baked_;
  std::vector<Vec3> lights_;      // by group
  std::vector<MoverPose> lamps_;  // by group: where the drawn ones are
  std::vector<BrightLight> bright_lights_;
  std::unique_ptr<SceneImages> images_;  // reads pack_
  std::unique_ptr<LiveLamps> live_;      // reads both
};

}  // namespace oriel
