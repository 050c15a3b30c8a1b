#include "player/reflections/fill_pass.h"

#include <algorithm>
#include <bit>

#include "player/gpu/raster_state.h"

namespace oriel {
namespace {

// Light nearer than the farthest around a hole by more than this factor is another thing's, and does not flow into it.
constexpr float kReach = 1.25f, kAll = 1e30f;

// Only that level can be read: drawing into another one of the same texture is defined then.
void bind_level(const gpu::Texture2d& texture, int unit, int level) {
  texture.bind(unit);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, level);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level);
}

void bind_all_levels(const gpu::Texture2d& texture, int unit, int levels) {
  texture.bind(unit);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels - 1);
}

}  // namespace

Result<FillPass> FillPass::create(gpu::Dialect dialect) {
  FillPass pass;
  ORIEL_TRY(pass.pull_, gpu::Program::create("screen_pull", dialect));
  ORIEL_TRY(pass.push_, gpu::Program::create("screen_push", dialect));
  pass.no_vertices_ = gpu::make_vertex_array();
  return pass;
}

void FillPass::draw(const Fill& fill, FrameStats& stats) const {
  const auto& [rect, target, blurs] = fill;
  const float reach = blurs ? kAll : kReach;
  // Levels round up, to a last one of a single pixel: the textures' sizes are powers of two and have as many.
  const int levels = std::bit_width(static_cast<unsigned>(std::max(rect.width, rect.height) - 1)) + 1;
  const auto size_at = [&rect = rect](int level) {
    return IVec2(gpu::level_size(rect.width, level), gpu::level_size(rect.height, level));
  };
  const auto draw_level = [&, &target = target](const gpu::Texture2d& texture, int level) {
    target.level_framebuffer.attach_color_level(texture, level);
    glViewport(0, 0, size_at(level).x, size_at(level).y);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ++stats.draws;
  };
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  target.level_framebuffer.bind();
  const auto pull = [&, &target = target](const gpu::Texture2d& texture, float as_far) {
    pull_.use();
    pull_.set("u_source", 0);
    pull_.set("u_reach", as_far);
    for (int level = 1; level < levels; ++level) {
      bind_level(texture, 0, level - 1);
      pull_.set("u_source_size", size_at(level - 1));
      draw_level(texture, level);
    }
    bind_all_levels(texture, 0, levels);
  };
  pull(target.sharp, reach);
  push_.use();
  push_.set("u_reach", reach);
  push_.set("u_fine", 0);
  push_.set("u_coarse", 1);
  for (int level = levels - 1; level >= 0; --level) {
    const bool top = level == levels - 1;
    bind_level(target.sharp, 0, level);
    bind_level(target.filled, 1, top ? level : level + 1);
    if (top) glBindTexture(GL_TEXTURE_2D, 0);
    push_.set("u_coarse_size", top ? IVec2(0) : size_at(level + 1));
    draw_level(target.filled, level);
  }
  bind_all_levels(target.sharp, 0, levels);
  bind_all_levels(target.filled, 1, levels);
  if (blurs) pull(target.filled, kAll);
}

}  // namespace oriel
