#include "player/gpu/framebuffer.h"

#include <array>
#include <vector>

namespace oriel::gpu {
namespace {

// Of the framebuffer that is bound.
Status check_complete(const char* what, int width, int height) {
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return {};
  return fail(ErrorCode::kRuntime, what,
              "found framebuffer status 0x{:04x} for {}x{} pixels, expected it to be complete", status, width, height);
}

// To the framebuffer that is bound.
void attach_colors(std::span<const Texture2d* const> colors) {
  std::vector<GLenum> drawn;
  for (const Texture2d* color : colors) {
    drawn.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(drawn.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, drawn.back(), GL_TEXTURE_2D, color->name(), 0);
  }
  glDrawBuffers(static_cast<GLsizei>(drawn.size()), drawn.data());
}

}  // namespace

Result<Framebuffer> Framebuffer::create(const char* what, const Texture2d* color, const Texture2d* depth,
                                        bool stencil) {
  Framebuffer framebuffer;
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  framebuffer.handle_ = Handle<ObjectKind::kFramebuffer>(name);
  framebuffer.bind();
  if (color != nullptr) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color->name(), 0);
  if (depth != nullptr) {
    const GLenum attachment = stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, depth->name(), 0);
  }
  const Texture2d* any = color != nullptr ? color : depth;
  ORIEL_TRY_VOID(check_complete(what, any != nullptr ? any->width() : 0, any != nullptr ? any->height() : 0));
  return framebuffer;
}

Result<Framebuffer> Framebuffer::create(const char* what, const Texture2d& color, const Texture2d& more,
                                        const Texture2d& depth) {
  return create(what, std::array{&color, &more}, depth);
}

Result<Framebuffer> Framebuffer::create(const char* what, std::span<const Texture2d* const> colors,
                                        const Texture2d& depth) {
  ORIEL_TRY(Framebuffer framebuffer, create(what, nullptr, &depth, true));
  attach_colors(colors);
  ORIEL_TRY_VOID(check_complete(what, depth.width(), depth.height()));
  return framebuffer;
}

Result<Framebuffer> Framebuffer::create(const char* what, std::span<const Texture2d* const> colors) {
  ORIEL_TRY(Framebuffer framebuffer, create(what, colors.front(), nullptr));
  attach_colors(colors);
  ORIEL_TRY_VOID(check_complete(what, colors.front()->width(), colors.front()->height()));
  return framebuffer;
}

Result<Framebuffer> Framebuffer::create(const char* what, const MultisampleTexture& color,
                                        const MultisampleTexture& depth) {
  Framebuffer framebuffer;
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  framebuffer.handle_ = Handle<ObjectKind::kFramebuffer>(name);
  framebuffer.bind();
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, color.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D_MULTISAMPLE, depth.name(), 0);
  ORIEL_TRY_VOID(check_complete(what, color.width(), color.height()));
  return framebuffer;
}

Framebuffer Framebuffer::create_for_layers() {
  Framebuffer framebuffer;
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  framebuffer.handle_ = Handle<ObjectKind::kFramebuffer>(name);
  framebuffer.bind();
  const GLenum none = GL_NONE;
  glDrawBuffers(1, &none);
  glReadBuffer(GL_NONE);
  return framebuffer;
}

void Framebuffer::copy_depth_stencil(const Framebuffer& other, const IVec2& from, const IVec2& size,
                                     const IVec2& to) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, other.handle_.name());
  glBlitFramebuffer(from.x, from.y, from.x + size.x, from.y + size.y, to.x, to.y, to.x + size.x, to.y + size.y,
                    GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.name());
}

void Framebuffer::resolve_color(const Framebuffer& samples, const IVec2& size) const {
  bind();
  glBindFramebuffer(GL_READ_FRAMEBUFFER, samples.handle_.name());
  glBlitFramebuffer(0, 0, size.x, size.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.name());
}

void Framebuffer::resolve_depth_stencil(const Framebuffer& samples, const IVec2& size) const {
  bind();
  copy_depth_stencil(samples, IVec2(0), size, IVec2(0));
}

void Framebuffer::attach_depth_layer(const TextureArray& depth, int layer) const {
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth.name(), 0, layer);
}

void Framebuffer::stretch_over_window(const IVec2& size, const IVec2& window) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, size.x, size.y, 0, 0, window.x, window.y, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Framebuffer::attach_color_level(const Texture2d& color, int level) const {
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color.name(), level);
}

void Framebuffer::attach_color_face(const CubeTexture& color, int face) const {
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                         GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), color.name(), 0);
}

}  // namespace oriel::gpu
