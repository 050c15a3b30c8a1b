# Writes OUTPUT, a C++ file whose function NAMESPACE::shader_sources() gives every file of SHADERS as a raw string.
file(GLOB_RECURSE files RELATIVE "${SHADERS}" "${SHADERS}/*.vert" "${SHADERS}/*.frag" "${SHADERS}/*.glsl")
list(SORT files)
set(table "")
foreach(name IN LISTS files)
  file(READ "${SHADERS}/${name}" text)
  string(APPEND table "    {\"${name}\", R\"oriel_glsl(${text})oriel_glsl\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Made by player/gpu/embed_shaders.cmake.
#include \"player/gpu/program.h\"

namespace ${NAMESPACE} {

std::span<const oriel::gpu::ShaderSource> shader_sources();
std::span<const oriel::gpu::ShaderSource> shader_sources() {
  static const std::initializer_list<oriel::gpu::ShaderSource> kSources = {
${table}};
  return {kSources.begin(), kSources.size()};
}

}  // namespace ${NAMESPACE}
")
