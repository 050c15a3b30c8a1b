// Vertex and index data.
#pragma once

#include <span>
#include <vector>

#include "player/gpu/handle.h"

namespace oriel::gpu {

class Buffer {
 public:
  Buffer() = default;
  // Copies the values to the GPU as they lie in memory: scalars, or vectors of them without padding. target:
  // GL_ARRAY_BUFFER or GL_ELEMENT_ARRAY_BUFFER (then a vertex array must be bound).
  template <class T>
  Buffer(GLenum target, std::span<const T> values) {
    GLuint name = 0;
    glGenBuffers(1, &name);
    handle_ = Handle<ObjectKind::kBuffer>(name);
    glBindBuffer(target, name);
    glBufferData(target, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), GL_STATIC_DRAW);
  }

  // As many other values.
  template <class T>
  void replace(GLenum target, std::span<const T> values) const {
    bind(target);
    glBufferSubData(target, 0, static_cast<GLsizeiptr>(values.size_bytes()), values.data());
  }

  // To the target, of the bound vertex array where that is GL_ELEMENT_ARRAY_BUFFER.
  void bind(GLenum target) const { glBindBuffer(target, handle_.name()); }
  GLuint name() const { return handle_.name(); }

 private:
  Handle<ObjectKind::kBuffer> handle_;
};

// Numbers of a vertex attribute.
struct AttributeFormat {
  int components = 0;
  GLenum type = GL_FLOAT;
  bool normalized = false;  // the largest integer is 1
};

// A vertex attribute of the bound vertex array, in a buffer of its own.
template <class T>
void add_attribute(std::vector<Buffer>& buffers, GLuint location, const std::vector<T>& values,
                   const AttributeFormat& format) {
  buffers.emplace_back(GLenum{GL_ARRAY_BUFFER}, std::span<const T>(values));
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, format.components, format.type, format.normalized ? GL_TRUE : GL_FALSE, sizeof(T),
                        nullptr);
}

}  // namespace oriel::gpu
