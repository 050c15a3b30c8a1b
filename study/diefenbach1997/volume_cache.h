// Shadow volumes by object and source, kept from frame to frame (Diefenbach & Badler 1997, section 4.3): each is built
// anew where its object or its light, a mirror's image of a lamp too, is not where it was.
#pragma once

#include <map>
#include <memory>

#include "player/gpu/program.h"
#include "player/movers/mover_pass.h"
#include "study/diefenbach1997/light_paths.h"
#include "study/support/shadow_mesh.h"

namespace oriel::study {

// `positions` and `triangles` as far as they lie on the positive sides of the planes, where dot(plane, (p, 1)) = 0 is
// the boundary. Triangles that share a cut edge share its new corners to the bit.
struct CutTriangles {
  std::vector<Vec3> positions;
  std::vector<UVec3> triangles;
};
CutTriangles cut_triangles(std::span<const Vec3> positions, std::span<const UVec3> triangles,
                           std::span<const Vec4> planes);

// Of a frame: volumes of an object and a source that were drawn as they were kept, or built for it, as the source was
// new, or it or a mirror had moved, or the object had.
struct VolumeStats {
  std::uint32_t reused = 0, built_new = 0, built_for_light = 0, built_for_object = 0;
  std::uint64_t bytes = 0;  // kept
  double build_ms = 0;      // of the processor
};

class VolumeCache {
 public:
  static Result<VolumeCache> create(gpu::Dialect dialect);

  // Before the images of a frame. Objects are nodes of the scene that stands still, and movers. What lets light through
  // or is cut out throws no shadow.
  void begin(const FrameContext& context, std::span<const PlacedMover> movers, std::span<const LightMirror> mirrors);

  // What is drawn of a stretch of a path.
  struct Request {
    const LightPath& path;
    std::size_t stretch = 0;  // into the path's legs
    const PathLeg& leg;
  };
  // How many volumes of the request hold a place, modulo 2^32.
  std::uint32_t around(const Request& request, const Vec4& place);
  // Counts them into the stencil's `bits`, which hold those that are around the eye; own raster state.
  void draw(const Request& request, const View& view, GLuint bits, FrameStats& stats);
  // The same of the light volume through the mirror at whose end the stretch begins.
  std::uint32_t around_aperture(const Request& request, const Vec4& place);
  void draw_aperture(const Request& request, const View& view, GLuint bits, FrameStats& stats);
  // Since begin().
  const VolumeStats& stats() const { return stats_; }

 private:
  // What throws shadows together, or a part of it that is cut off by mirrors.
  struct Caster {
    ShadowMesh mesh;
    Bounds bounds;
    gpu::VertexArray vertices;
    std::vector<gpu::Buffer> buffers;
    bool empty() const { return mesh.triangles() == 0; }
  };
  struct Object {
    std::vector<Vec3> positions;
    std::vector<UVec3> triangles;
    std::shared_ptr<const Caster> whole;
    std::map<std::vector<std::uint32_t>, std::shared_ptr<const Caster>> parts;  // by mirrors that cut it
    Mat4 pack_from_object{1};
    std::uint64_t moved = 0;  // the frame at which it last did
    bool there = true;
  };
  struct Volume {
    std::shared_ptr<const Caster> caster;
    Vec4 light{0};  // object space
    gpu::Buffer indices;
    GLsizei count = 0, sides = 0;
    std::uint64_t built = 0, used = 0;  // frames
    std::size_t bytes = 0;
  };
  // Object or mirror; source; mirrors before the stretch; those that cut the object.
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::vector<std::uint32_t>, std::vector<std::uint32_t>>;

  void take_scene(const GpuScene& scene);
  void place_movers(const GpuScene& scene, std::span<const PlacedMover> movers);
  static std::shared_ptr<const Caster> make_caster(std::span<const Vec3> positions, std::span<const UVec3> triangles);
  std::vector<std::uint32_t> cutting(const Object& object, std::span<const std::uint32_t> walls) const;
  std::shared_ptr<const Caster> caster_of(Object& object, const std::vector<std::uint32_t>& cuts);
  const Volume& volume(const Key& key, const std::shared_ptr<const Caster>& caster, const Vec4& light,
                       std::uint64_t moved);
  void draw_volume(const Volume& volume, const Mat4& clip_from_object, bool flipped, FrameStats& stats) const;
  void begin_draw(const View& view, GLuint bits) const;
  static void end_draw();

  gpu::Program program_;
  std::uint64_t scene_ = 0, frame_ = 0;
  std::vector<Object> objects_;    // of the scene, then movers
  std::size_t of_scene_ = 0;       // so many
  std::vector<Object> apertures_;  // by mirror
  std::vector<LightMirror> mirrors_;
  std::map<Key, Volume> volumes_, aperture_volumes_;
  VolumeStats stats_;
};

}  // namespace oriel::study
