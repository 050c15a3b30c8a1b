# Writes OUTPUT, a C++ file that holds every file of VIEWER as a raw string.
file(GLOB files RELATIVE "${VIEWER}" "${VIEWER}/*")
list(SORT files)
set(table "")
foreach(name IN LISTS files)
  file(READ "${VIEWER}/${name}" text)
  string(APPEND table "    {\"${name}\", R\"oriel_web(${text})oriel_web\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Made from web/dist by formats/export/embed_viewer.cmake.
#include \"formats/export/viewer_files.h\"

#include <utility>

namespace oriel {
namespace {
constexpr std::pair<std::string_view, std::string_view> kFiles[] = {
${table}};
}  // namespace

std::string_view viewer_file(std::string_view name) {
  for (const auto& [file, text] : kFiles) {
    if (file == name) return text;
  }
  return {};
}

}  // namespace oriel
")
