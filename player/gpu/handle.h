// Owners of OpenGL names: move-only, deleted with the scope. A current context is needed to create and to destroy.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace oriel::gpu {

enum class ObjectKind { kBuffer, kVertexArray, kTexture, kFramebuffer, kQuery, kShader, kProgram };

void delete_object(ObjectKind kind, GLuint name);

template <ObjectKind kind>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Handle() {
    if (name_ != 0) delete_object(kind, name_);
  }
  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

using VertexArray = Handle<ObjectKind::kVertexArray>;
using Query = Handle<ObjectKind::kQuery>;

VertexArray make_vertex_array();
Query make_query();

}  // namespace oriel::gpu
