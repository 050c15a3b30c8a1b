// What pixels see of a scene, as textures that the passes of light read.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "bake/scene/scene.h"
#include "player/gpu/buffer.h"
#include "player/gpu/framebuffer.h"
#include "player/gpu/program.h"
#include "player/navigation/view.h"
#include "preview/frame/neighbours.h"
#include "preview/frame/scene_parts.h"

namespace oriel {

// By pixel, row 0 at the bottom; shaders/passes/preview_surface.frag says what is in each.
struct SeenSurfaces {
  gpu::Texture2d place, normal, face, diffuse, emission, depth;
  gpu::Framebuffer framebuffer;
  IVec2 size() const { return {place.width(), place.height()}; }
};
Result<SeenSurfaces> make_seen_surfaces(int width, int height);
// A texture's texels, and what pixels see, row 0 at the bottom.
std::vector<Vec4> read_texture(const gpu::Texture2d& texture);
SeenPoints read_seen_points(const SeenSurfaces& surfaces);

// A scene's triangles, textures and reflectances on the device.
class PreviewMesh {
 public:
  PreviewMesh() = default;
  // last: of a scene before, whose buffers and textures are taken where the scene's parts are the same. Errors:
  // kRuntime where the device takes no texture or buffer of that size.
  static Result<PreviewMesh> create(const Scene& scene, const SceneParts& parts, const gpu::Device& device,
                                    const PreviewMesh& last);
  // The scene's materials have other numbers than before; their textures stay.
  void take_materials();
  const Scene& scene() const { return *scene_; }
  // Draws all of it; the program of SurfacePass is in use.
  void draw(const gpu::Program& program) const;
  const gpu::Texture2d& sky() const { return *sky_; }  // an image, or none

 private:
  // What is shared among meshes whose parts are the same.
  struct Vertices {
    gpu::VertexArray array;
    std::vector<gpu::Buffer> buffers;
    gpu::Buffer indices;
    gpu::Texture2d faces;
  };
  static Result<std::shared_ptr<const Vertices>> upload_vertices(const Scene& scene, const gpu::Device& device);
  Status upload_textures(const Scene& scene, const gpu::Device& device);
  void upload_reflectances(const Scene& scene);
  static std::shared_ptr<const gpu::Texture2d> upload_sky(const Scene& scene);
  void set_slot(const gpu::Program& program, const TextureSlot& slot, bool srgb, const char* name, int unit) const;
  void set_material(const gpu::Program& program, std::uint32_t material) const;

  using TextureKey = std::tuple<std::int32_t, bool, Wrap, Wrap, bool>;  // image, srgb, wraps, nearest
  const Scene* scene_ = nullptr;
  SceneParts parts_;
  std::shared_ptr<const Vertices> vertices_;
  std::map<TextureKey, std::shared_ptr<const gpu::Texture2d>> textures_;
  std::shared_ptr<const gpu::Texture2d> sky_;
  gpu::Texture2d white_, left_;
  std::vector<Vec2> left_rows_;  // by material
};

class SurfacePass {
 public:
  static Result<SurfacePass> create(gpu::Dialect dialect);
  // glossy: roughness below which surfaces are tagged to be traced, [0,1].
  void draw(const PreviewMesh& mesh, const View& view, float glossy, const SeenSurfaces& to) const;

 private:
  gpu::Program program_;
};

}  // namespace oriel
