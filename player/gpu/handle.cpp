#include "player/gpu/handle.h"

namespace oriel::gpu {

void delete_object(ObjectKind kind, GLuint name) {
  switch (kind) {
    case ObjectKind::kBuffer:
      glDeleteBuffers(1, &name);
      break;
    case ObjectKind::kVertexArray:
      glDeleteVertexArrays(1, &name);
      break;
    case ObjectKind::kTexture:
      glDeleteTextures(1, &name);
      break;
    case ObjectKind::kFramebuffer:
      glDeleteFramebuffers(1, &name);
      break;
    case ObjectKind::kQuery:
      glDeleteQueries(1, &name);
      break;
    case ObjectKind::kShader:
      glDeleteShader(name);
      break;
    case ObjectKind::kProgram:
      glDeleteProgram(name);
      break;
  }
}

VertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArray(name);
}

Query make_query() {
  GLuint name = 0;
  glGenQueries(1, &name);
  return Query(name);
}

}  // namespace oriel::gpu
