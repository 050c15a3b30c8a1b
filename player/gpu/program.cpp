#include "player/gpu/program.h"

#include <algorithm>

namespace oriel::gpu {
namespace {

Result<Handle<ObjectKind::kShader>> compile(GLenum stage, const ShaderText& source) {
  Handle<ObjectKind::kShader> shader(glCreateShader(stage));
  const char* text = source.text.c_str();
  const auto length = static_cast<GLint>(source.text.size());
  glShaderSource(shader.name(), 1, &text, &length);
  glCompileShader(shader.name());
  GLint done = 0, log_length = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &done);
  if (done) return shader;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &log_length);
  std::string log(static_cast<std::size_t>(std::max(log_length, 1)), '\0');
  glGetShaderInfoLog(shader.name(), log_length, &log_length, log.data());
  log.resize(static_cast<std::size_t>(std::max(log_length, 0)));
  while (!log.empty() && log.back() == '\n') log.pop_back();
  return fail(ErrorCode::kRuntime, source.name, "does not compile: {}", name_places(log, source));
}

}  // namespace

Result<Program> Program::create(std::string_view name, Dialect dialect, std::string_view define) {
  const std::string_view vertex_name = name.starts_with("screen_") ? "screen_fullscreen" : name;
  ORIEL_TRY(const ShaderText vertex, assemble_shader(fmt::format("passes/{}.vert", vertex_name), dialect, define));
  ORIEL_TRY(const ShaderText fragment, assemble_shader(fmt::format("passes/{}.frag", name), dialect, define));
  return create_from(name, vertex, fragment);
}

Result<Program> Program::create_from(std::string_view name, const ShaderText& vertex, const ShaderText& fragment) {
  ORIEL_TRY(const auto vertex_shader, compile(GL_VERTEX_SHADER, vertex));
  ORIEL_TRY(const auto fragment_shader, compile(GL_FRAGMENT_SHADER, fragment));
  Program program;
  program.handle_ = Handle<ObjectKind::kProgram>(glCreateProgram());
  const GLuint id = program.handle_.name();
  glAttachShader(id, vertex_shader.name());
  glAttachShader(id, fragment_shader.name());
  glLinkProgram(id);
  GLint done = 0;
  glGetProgramiv(id, GL_LINK_STATUS, &done);
  if (!done) {
    char log[2048] = "";
    glGetProgramInfoLog(id, sizeof(log), nullptr, log);
    return fail(ErrorCode::kRuntime, fmt::format("shader program {}", name), "does not link: {}", log);
  }
  return program;
}

GLint Program::location(const char* uniform) const {
  const auto found = locations_.find(uniform);
  if (found != locations_.end()) return found->second;
  const GLint at = glGetUniformLocation(handle_.name(), uniform);
  locations_.emplace(uniform, at);
  return at;
}

void Program::set(const char* uniform, int value) const {
  glUniform1i(location(uniform), value);
}
void Program::set(const char* uniform, float value) const {
  glUniform1f(location(uniform), value);
}
void Program::set(const char* uniform, const IVec2& value) const {
  glUniform2iv(location(uniform), 1, &value[0]);
}
void Program::set(const char* uniform, const Vec2& value) const {
  glUniform2fv(location(uniform), 1, &value[0]);
}
void Program::set(const char* uniform, const Vec3& value) const {
  glUniform3fv(location(uniform), 1, &value[0]);
}
void Program::set(const char* uniform, const Vec4& value) const {
  glUniform4fv(location(uniform), 1, &value[0]);
}
void Program::set(const char* uniform, const Mat4& value) const {
  glUniformMatrix4fv(location(uniform), 1, GL_FALSE, &value[0][0]);
}
void Program::set(const char* uniform, std::span<const Vec3> values) const {
  glUniform3fv(location(uniform), static_cast<GLsizei>(values.size()), &values[0][0]);
}
void Program::set(const char* uniform, std::span<const Vec4> values) const {
  glUniform4fv(location(uniform), static_cast<GLsizei>(values.size()), &values[0][0]);
}
void Program::set(const char* uniform, std::span<const Mat4> values) const {
  glUniformMatrix4fv(location(uniform), static_cast<GLsizei>(values.size()), GL_FALSE, &values[0][0][0]);
}

}  // namespace oriel::gpu
