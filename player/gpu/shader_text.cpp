#include <algorithm>

#include "player/gpu/program.h"

namespace oriel::gpu {
namespace {

constexpr std::string_view kDesktopHead = "#version 330 core\n";
constexpr std::string_view kEsHead =
    "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";
constexpr std::string_view kInclude = "#include \"";

Status append_file(std::string_view name, ShaderText& out) {
  if (std::find(out.files.begin(), out.files.end(), name) != out.files.end()) return {};
  const std::string_view source = shader_source(name);
  if (source.empty()) return fail(ErrorCode::kRuntime, std::string(name), "found no such shader file in the program");
  const std::size_t number = out.files.size();
  out.files.emplace_back(name);
  out.text += fmt::format("#line 1 {}\n", number);
  std::size_t line = 1;
  for (std::size_t begin = 0; begin < source.size(); ++line) {
    const std::size_t end = std::min(source.find('\n', begin), source.size() - 1) + 1;
    const std::string_view text = source.substr(begin, end - begin);
    begin = end;
    if (!text.starts_with(kInclude)) {
      out.text += text;
      continue;
    }
    const std::string_view rest = text.substr(kInclude.size());
    ORIEL_TRY_VOID(append_file(rest.substr(0, rest.find('"')), out));
    out.text += fmt::format("#line {} {}\n", line + 1, number);
  }
  out.text += "\n";
  return {};
}

}  // namespace

Result<ShaderText> assemble_shader(std::string_view name, Dialect dialect) {
  ShaderText out;
  out.text = dialect == Dialect::kEs300 ? kEsHead : kDesktopHead;
  ORIEL_TRY_VOID(append_file(name, out));
  return out;
}

}  // namespace oriel::gpu
