# Writes OUTPUT, a C++ file that holds every file of SHADERS as a raw string.
file(GLOB_RECURSE files RELATIVE "${SHADERS}" "${SHADERS}/*.vert" "${SHADERS}/*.frag" "${SHADERS}/*.glsl")
list(SORT files)
set(table "")
foreach(name IN LISTS files)
  file(READ "${SHADERS}/${name}" text)
  string(APPEND table "    {\"${name}\", R\"oriel_glsl(${text})oriel_glsl\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Made from shaders/ by player/gpu/embed_shaders.cmake.
#include <array>
#include <string_view>
#include <utility>

namespace oriel::gpu {
namespace {
constexpr std::pair<std::string_view, std::string_view> kSources[] = {
${table}};
}  // namespace

std::string_view shader_source(std::string_view name) {
  for (const auto& [file, text] : kSources) {
    if (file == name) return text;
  }
  return {};
}

}  // namespace oriel::gpu
")
