#include "player/passes/glass_cubes.h"

#include <algorithm>
#include <limits>

#include "player/gpu/raster_state.h"
#include "player/passes/glass_canvas.h"
#include "player/scene/glass_tree.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

constexpr int kShapeSize = 128;             // texels a side of a face
constexpr std::ptrdiff_t kMostAround = 16;  // bodies that the scene is drawn around; others use the nearest one's
constexpr float kLeastOfPicture = 1e-4f;    // of it, that a body covers for that

// As OpenGL has the faces of a cube around the middle of a body, which near things show in.
View face_view(const Vec3& eye, int face, int size, const Bounds& bounds) {
  Camera camera;
  camera.eye = eye;
  camera.forward = Vec3(0);
  camera.forward[face / 2] = face % 2 == 0 ? 1.0f : -1.0f;
  camera.up = face / 2 == 1 ? Vec3(0, 0, camera.forward.y) : Vec3(0, -1, 0);
  camera.vertical_fov_rad = 0.5f * kPi;
  return make_view(camera, size, size, bounds, std::min(0.02f, 1e-3f * bounds.radius()));
}

gpu::Texture2d texture_of(std::vector<Vec4> texels) {
  const std::size_t rows = (texels.size() + kGlassTreeWidth - 1) / kGlassTreeWidth;
  texels.resize(rows * kGlassTreeWidth);
  return {gpu::kRgba32f, kGlassTreeWidth, static_cast<int>(rows), texels.data()};
}

}  // namespace

Status GlassCubes::compile(gpu::Dialect dialect) {
  ORIEL_TRY(shape_, gpu::Program::create("glass_shape", dialect));
  depth_ = gpu::Texture2d(gpu::kDepthStencil, kAroundSize, kAroundSize, nullptr);
  ORIEL_TRY(face_, gpu::Framebuffer::create("faces around glass", nullptr, &depth_, true));
  return gpu::check_gl("compiling glass");
}

void GlassCubes::start(const GpuScene& scene) {
  if (geometry_of_ == scene.geometry_serial()) return;
  geometry_of_ = scene.geometry_serial();
  bodies_.clear();
  bodies_.resize(scene.glass().size());
}

Status GlassCubes::make(const FrameContext& context, const ScenePass& scene_pass, std::size_t body, float share) {
  const GpuScene& scene = context.scene;
  const GlassBody& glass = scene.glass()[body];
  Cubes& cubes = bodies_[body];
  const bool whole = !scene.images().state().busy;
  if (!glass.tree.empty() && !cubes.tree) cubes.tree = texture_of(glass.tree);
  const bool curved = glass.planes.empty() && glass.tree.empty() && !glass.pane;
  if (curved && !cubes.shape) ORIEL_TRY_VOID(draw_shape(context, body));
  if (share < kLeastOfPicture || (cubes.around_of == scene.serial() && (cubes.whole || !whole))) return {};
  const auto others = std::ranges::count_if(bodies_, [](const Cubes& c) { return static_cast<bool>(c.around); });
  if (!cubes.around && others >= kMostAround) return {};
  ORIEL_TRY_VOID(draw_around(context, body, scene_pass));
  cubes.around_of = scene.serial(), cubes.whole = whole;
  return {};
}

Status GlassCubes::draw_shape(const FrameContext& context, std::size_t body) {
  const GpuScene& scene = context.scene;
  const GlassBody& glass = scene.glass()[body];
  bodies_[body].shape = gpu::CubeTexture(gpu::kRgba32f, kShapeSize, 1);
  ORIEL_TRY_VOID(gpu::check_gl("making the shape of glass"));
  face_.bind();
  glViewport(0, 0, kShapeSize, kShapeSize);
  shape_.use();
  shape_.set("u_centre", glass.centre);
  scene.bind_geometry();
  for (int face = 0; face < 6; ++face) {
    face_.attach_color_face(bodies_[body].shape, face);
    clear_all(Vec4(0, 0, 0, glass.radius));
    gpu::RasterState state;
    state.depth_test = state.depth_write = true;
    gpu::apply(state);
    shape_.set("u_clip_from_pack", face_view(glass.centre, face, kShapeSize, glass.bounds).clip_from_pack);
    for (const DrawRange& range : glass.ranges) draw_indices(range.first_index, range.index_count, context.stats);
  }
  return {};
}

Status GlassCubes::draw_around(const FrameContext& context, std::size_t body, const ScenePass& scene_pass) {
  GpuScene& scene = context.scene;
  gpu::CubeTexture& around = bodies_[body].around;
  if (!around) around = gpu::CubeTexture(gpu::kRgba32f, kAroundSize, gpu::mip_levels(kAroundSize, kAroundSize));
  ORIEL_TRY_VOID(gpu::check_gl("making the surroundings of glass"));
  for (int face = 0; face < 6; ++face) {
    const View view = face_view(scene.glass()[body].centre, face, kAroundSize, scene.bounds());
    face_.bind();
    face_.attach_color_face(around, face);
    glViewport(0, 0, kAroundSize, kAroundSize);
    clear_all(Vec4(scene.pack().sky, kClosest));
    const FrameContext outside{scene, view, context.options, context.stats};
    scene_pass.draw_sky(outside, kClosest);
    const MirroredScene seen{visible_batches(scene.opaque(), make_frustum(view.clip_from_pack)), {}, {}};
    scene_pass.draw_reflected(outside, seen);
    ORIEL_TRY_VOID(scene_pass.draw_transparent(outside, {}, [](std::size_t) { return true; }));
  }
  around.make_mipmaps();
  return {};
}

std::size_t GlassCubes::nearest_around(const GpuScene& scene, std::size_t body) const {
  std::size_t best = body;
  float nearest = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const float away = length2(scene.glass()[i].centre - scene.glass()[body].centre);
    if (!bodies_[i].around || away >= nearest) continue;
    nearest = away;
    best = i;
  }
  return best;
}

std::uint64_t GlassCubes::bytes() const {
  std::uint64_t sum = depth_.bytes();
  for (const Cubes& cubes : bodies_) sum += cubes.shape.bytes() + cubes.tree.bytes() + cubes.around.bytes();
  return sum;
}

}  // namespace oriel
