// What a pass draws into.
#pragma once

#include <span>

#include "formats/core/vec.h"
#include "player/gpu/texture.h"

namespace oriel::gpu {

class Framebuffer {
 public:
  Framebuffer() = default;
  // color and depth may be null; depth with a stencil is attached as both. Error kRuntime where the driver refuses the
  // combination. The textures must outlive the framebuffer.
  static Result<Framebuffer> create(const char* what, const Texture2d* color, const Texture2d* depth,
                                    bool stencil = false);

  // Two images that one pass draws into at once, of the same size as the depth with its stencil.
  static Result<Framebuffer> create(const char* what, const Texture2d& color, const Texture2d& more,
                                    const Texture2d& depth);

  // Any number of images that one pass draws into at once, of one size; location i is colors[i].
  static Result<Framebuffer> create(const char* what, std::span<const Texture2d* const> colors, const Texture2d& depth);
  // Without depth; at least one image.
  static Result<Framebuffer> create(const char* what, std::span<const Texture2d* const> colors);

  // Both of the same number of samples; depth with its stencil.
  static Result<Framebuffer> create(const char* what, const MultisampleTexture& color, const MultisampleTexture& depth);

  // For depth alone: attach_depth_layer() comes before drawing.
  static Framebuffer create_for_layers();

  void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, handle_.name()); }
  // Copies depth and stencil from another framebuffer, whose own have the same format, into this one, which is bound:
  // `size` pixels from `from` there to `to` here.
  void copy_depth_stencil(const Framebuffer& other, const IVec2& from, const IVec2& size, const IVec2& to) const;
  // The mean of each pixel's samples of another framebuffer of this size into this one's colour; one of them into its
  // depth and stencil. Leaves this one bound.
  void resolve_color(const Framebuffer& samples, const IVec2& size) const;
  void resolve_depth_stencil(const Framebuffer& samples, const IVec2& size) const;
  // The colour of this one, stretched over the window's, which is bound then.
  void stretch_over_window(const IVec2& size, const IVec2& window) const;
  // Draws into a level of a texture from now on.
  void attach_color_level(const Texture2d& color, int level) const;
  // Draws into a face of a cube, 0 to 5, from now on.
  void attach_color_face(const CubeTexture& color, int face) const;
  // Draws depth, and nothing else, into a layer of an array from now on. To be bound before.
  void attach_depth_layer(const TextureArray& depth, int layer) const;
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  Handle<ObjectKind::kFramebuffer> handle_;
};

}  // namespace oriel::gpu
