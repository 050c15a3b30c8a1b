// Shader programs, made from the sources in shaders/ that are built into the program.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formats/core/vec.h"
#include "player/gpu/device.h"
#include "player/gpu/handle.h"

namespace oriel::gpu {

struct ShaderSource {
  std::string_view name, text;  // "passes/scene.frag"
};
// Shaders of a program above the player, whose texts stay: found by name from now on. Before the first context.
void add_shader_sources(std::span<const ShaderSource> sources);
// The text of shaders/<name>, or of one that was added; empty where there is none.
std::string_view shader_source(std::string_view name);

// The whole text that the driver compiles: version line of the dialect, default precisions, then the file with each
// `#include "lib/…"` replaced by that file (once). origin[i] says where line i + 1 of the text comes from
// ("lib/color.glsl:7", empty for lines of our own): drivers disagree about #line. Error kRuntime names a missing file.
struct ShaderText {
  std::string name;
  std::string text;
  std::vector<std::string> origin;
};
// define: names that the text finds defined, if any, with spaces between them.
Result<ShaderText> assemble_shader(std::string_view name, Dialect dialect, std::string_view define = {});

// A driver's log with the places in it ("0:12(5)", "0(12)", "ERROR: 0:12") replaced by those of the files.
std::string name_places(const std::string& log, const ShaderText& source);

class Program {
 public:
  Program() = default;
  // passes/<name>.vert with passes/<name>.frag; the passes over a whole image, "screen_…", share
  // passes/screen_fullscreen.vert. define: as assemble_shader. Error kRuntime holds the driver's log with files and
  // lines.
  static Result<Program> create(std::string_view name, Dialect dialect, std::string_view define = {});
  // For tests: a program of two texts as assemble_shader gives them.
  static Result<Program> create_from(std::string_view name, const ShaderText& vertex, const ShaderText& fragment);

  void use() const { glUseProgram(handle_.name()); }
  // Setters act on the program in use; a uniform that the shader does not have is ignored.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, const IVec2& value) const;
  void set(const char* uniform, const Vec2& value) const;
  void set(const char* uniform, const Vec3& value) const;
  void set(const char* uniform, const Vec4& value) const;
  void set(const char* uniform, const Mat4& value) const;
  void set(const char* uniform, std::span<const Vec3> values) const;
  void set(const char* uniform, std::span<const Vec4> values) const;
  void set(const char* uniform, std::span<const Mat4> values) const;

 private:
  GLint location(const char* uniform) const;
  Handle<ObjectKind::kProgram> handle_;
  mutable std::unordered_map<std::string, GLint> locations_;
};

}  // namespace oriel::gpu
