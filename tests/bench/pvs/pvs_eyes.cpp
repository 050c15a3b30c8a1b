// pvs_eyes PACK [--eyes N] [--seed S]: from random eyes over a pack's walk grids, which triangles of more than four
// pixels the pack's visible sets miss. Draws all opaque triangles with their numbers and asks of each that covers
// pixels whether its group is in the set. Exit code 5 where one is missing, 3 where the pack has no sets.
//
// Cut-outs and see-through surfaces are not drawn: what lies behind them counts as seen, they themselves are not
// judged.
#include <cstdio>
#include <map>
#include <random>

#include "formats/cli/command.h"
#include "formats/pack/reader.h"
#include "formats/query/camera.h"
#include "player/gpu/buffer.h"
#include "player/gpu/framebuffer.h"
#include "player/gpu/headless.h"
#include "player/gpu/program.h"
#include "player/gpu/raster_state.h"
#include "player/gpu/texture.h"
#include "player/navigation/view.h"

namespace oriel {
namespace {

constexpr int kWidth = 720, kHeight = 486;
constexpr float kFov_rad = 1.15f;
constexpr int kMostPixels = 4;  // of a triangle that may be missing

constexpr const char* kVertex = R"(#version 330 core
layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_pack;
void main() { gl_Position = u_clip_from_pack * vec4(a_position, 1.0); }
)";
constexpr const char* kFragment = R"(#version 330 core
uniform int u_first;
layout(location = 0) out vec4 o_number;
void main() {
  int n = gl_PrimitiveID + u_first;
  o_number = vec4(n & 255, n >> 8 & 255, n >> 16 & 255, n >> 24 & 255) / 255.0;
}
)";

struct Eye {
  Vec3 position{0};
  float yaw_rad = 0, pitch_rad = 0;
};

// Anywhere over the walkable cells, as high and low as the sets say that they hold.
std::vector<Eye> random_eyes(const Pack& pack, int count, unsigned seed) {
  std::vector<std::pair<const WalkGrid*, std::size_t>> cells;
  for (const WalkGrid& grid : pack.walk_grids)
    for (std::size_t c = 0; c < grid.floor_y.size(); ++c)
      if (grid.walkable(c)) cells.emplace_back(&grid, c);
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  std::vector<Eye> eyes;
  while (!cells.empty() && static_cast<int>(eyes.size()) < count) {
    const auto& [grid, cell] = cells[std::uniform_int_distribution<std::size_t>(0, cells.size() - 1)(random)];
    const float half = 0.5f * grid->cell_m;
    const Vec3 offset(uniform(-half, half), uniform(-pack.visible_sets.below_m, pack.visible_sets.above_m),
                      uniform(-half, half));
    eyes.push_back({grid->eye(cell) + offset, uniform(0, 2 * kPi), uniform(-0.6f, 0.6f)});
  }
  return eyes;
}

class Numbers {
 public:
  static Result<Numbers> create(const Pack& pack) {
    Numbers out(pack);
    ORIEL_TRY(out.program_,
              gpu::Program::create_from("numbers", {"numbers.vert", kVertex, {}}, {"numbers.frag", kFragment, {}}));
    out.color_ = gpu::Texture2d(gpu::kRgba8, kWidth, kHeight, nullptr);
    out.depth_ = gpu::Texture2d(gpu::kDepth32f, kWidth, kHeight, nullptr);
    ORIEL_TRY(out.target_, gpu::Framebuffer::create("numbers", &out.color_, &out.depth_));
    out.vertex_array_ = gpu::make_vertex_array();
    glBindVertexArray(out.vertex_array_.name());
    gpu::add_attribute(out.buffers_, 0, pack.mesh.positions, {3, GL_FLOAT});
    out.buffers_.emplace_back(GLenum{GL_ELEMENT_ARRAY_BUFFER}, std::span<const std::uint32_t>(pack.mesh.indices));
    return out;
  }

  // Pixels by triangle of the mesh.
  std::map<std::uint32_t, int> draw(const Eye& eye) const {
    Camera camera;
    camera.eye = eye.position;
    camera.forward = forward_from(eye.yaw_rad, eye.pitch_rad);
    camera.up = {0, 1, 0};
    camera.vertical_fov_rad = kFov_rad;
    const View view = make_view(camera, kWidth, kHeight, bounds_);
    target_.bind();
    glViewport(0, 0, kWidth, kHeight);
    gpu::RasterState state;
    state.depth_test = state.depth_write = true;
    gpu::apply(state);
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    program_.use();
    program_.set("u_clip_from_pack", view.clip_from_pack);
    glBindVertexArray(vertex_array_.name());
    for (const MeshPart& part : pack_->mesh.parts) {
      const Material& m = pack_->materials[part.material];
      if (m.alpha_mode != AlphaMode::kOpaque || m.transmission > 0) continue;
      state.cull = m.double_sided ? gpu::Cull::kNone : gpu::Cull::kBack;
      gpu::apply(state);
      program_.set("u_first", static_cast<int>(part.first_index / 3));
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(part.index_count), GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(std::uintptr_t{part.first_index} * sizeof(std::uint32_t)));
    }
    std::vector<std::uint32_t> pixels(std::size_t{kWidth} * kHeight);
    glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    std::map<std::uint32_t, int> count;
    for (const std::uint32_t n : pixels)
      if (n != ~0u) ++count[n];
    return count;
  }

 private:
  explicit Numbers(const Pack& pack) : pack_(&pack) {
    for (const Vec3& p : pack.mesh.positions) bounds_.extend(p);
  }
  const Pack* pack_;
  Bounds bounds_;
  gpu::Program program_;
  gpu::Texture2d color_, depth_;
  gpu::Framebuffer target_;
  gpu::VertexArray vertex_array_;
  std::vector<gpu::Buffer> buffers_;
};

struct Tally {
  std::uint64_t seen = 0, missing = 0, small = 0;  // triangles by eye; missing ones of up to kMostPixels
  int most_pixels = 0;                             // of a missing one
  int eyes_missing = 0;
  double share = 0;  // of the triangles that sets hold, added up
};

void judge(const Pack& pack, const std::vector<std::uint32_t>& group, const SeenGroups& sets, const Eye& eye,
           const std::map<std::uint32_t, int>& pixels, Tally& tally) {
  const auto seen = sets.from(eye.position);
  std::size_t held = 0;
  for (const std::uint32_t g : group) held += !seen || (*seen)[g] != 0;
  tally.share += static_cast<double>(held) / static_cast<double>(group.size());
  bool misses = false;
  for (const auto& [triangle, count] : pixels) {
    ++tally.seen;
    if (!seen || (*seen)[group[triangle]] != 0) continue;
    tally.most_pixels = std::max(tally.most_pixels, count);
    ++(count > kMostPixels ? tally.missing : tally.small);
    if (count <= kMostPixels) continue;
    misses = true;
    std::printf("missing: triangle %u of group %u, %d pixels, from eye %.4f %.4f %.4f yaw %.3f pitch %.3f\n", triangle,
                group[triangle], count, double{eye.position.x} + pack.mesh.origin.x,
                double{eye.position.y} + pack.mesh.origin.y, double{eye.position.z} + pack.mesh.origin.z,
                double{eye.yaw_rad}, double{eye.pitch_rad});
  }
  tally.eyes_missing += misses;
}

Result<int> run(const std::string& file, int count, unsigned seed) {
  ORIEL_TRY(const Pack pack, read_pack(file));
  if (!made_for(pack.visible_sets, pack.mesh, pack.materials, pack.walk_grids))
    return fail(ErrorCode::kInvalid, file, "found no visible sets for its mesh");
  ORIEL_TRY(const auto context, gpu::HeadlessContext::create());
  ORIEL_TRY_VOID(gpu::open_device());
  ORIEL_TRY(const Numbers numbers, Numbers::create(pack));
  std::vector<std::uint32_t> group;
  for (const TriangleRun& run : pack.visible_sets.runs) group.insert(group.end(), run.index_count / 3, run.group);
  const SeenGroups sets(pack.visible_sets, pack.walk_grids);
  Tally tally;
  for (const Eye& eye : random_eyes(pack, count, seed)) judge(pack, group, sets, eye, numbers.draw(eye), tally);
  ORIEL_TRY_VOID(gpu::check_gl("drawing numbers"));
  std::printf(
      "%d eyes of %d x %d pixels: %.1f triangles seen by each, sets hold %.1f %% of all; missing: %llu of more than %d "
      "pixels (by %d eyes), %llu smaller, the largest %d pixels\n",
      count, kWidth, kHeight, static_cast<double>(tally.seen) / count, 100 * tally.share / count,
      static_cast<unsigned long long>(tally.missing), kMostPixels, tally.eyes_missing,
      static_cast<unsigned long long>(tally.small), tally.most_pixels);
  return tally.missing > 0 ? 5 : 0;
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  using namespace oriel;
  std::string file;
  int eyes = 10'000;
  unsigned seed = 1;
  if (const auto code = parse_options(argc, argv, "What a pack's visible sets miss",
                                      {{"PACK", "Arguments", "With visible sets", text(file, "PACK"), Use::kRequired},
                                       {"--eyes", "Options", "That look around", number(eyes, 1, 1e9)},
                                       {"--seed", "Options", "Of where they are", number(seed, 0, 4294967295.0)}}))
    return *code;
  const auto code = run(file, eyes, seed);
  if (code) return *code;
  std::fprintf(stderr, "pvs_eyes: %s\n", code.error().text().c_str());
  return static_cast<int>(code.error().code);
}
