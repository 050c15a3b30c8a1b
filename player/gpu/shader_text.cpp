#include <algorithm>
#include <regex>
#include <set>

#include "player/gpu/program.h"

namespace oriel::gpu {
namespace {

constexpr std::string_view kDesktopHead = "#version 330 core\n";
constexpr std::string_view kEsHead =
    "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";
constexpr std::string_view kInclude = "#include \"";

Status append_file(std::string_view name, std::set<std::string_view>& done, ShaderText& out) {
  if (!done.insert(name).second) return {};
  const std::string_view source = shader_source(name);
  if (source.empty()) return fail(ErrorCode::kRuntime, std::string(name), "found no such shader file in the program");
  std::size_t line = 1;
  for (std::size_t begin = 0; begin < source.size(); ++line) {
    const std::size_t end = std::min(source.find('\n', begin), source.size() - 1) + 1;
    const std::string_view text = source.substr(begin, end - begin);
    begin = end;
    if (text.starts_with(kInclude)) {
      const std::string_view rest = text.substr(kInclude.size());
      ORIEL_TRY_VOID(append_file(rest.substr(0, rest.find('"')), done, out));
    } else {
      out.text += text;
      out.origin.push_back(fmt::format("{}:{}", name, line));
    }
  }
  return {};
}

}  // namespace

Result<ShaderText> assemble_shader(std::string_view name, Dialect dialect) {
  ShaderText out;
  out.name = name;
  out.text = dialect == Dialect::kEs300 ? kEsHead : kDesktopHead;
  out.origin.resize(static_cast<std::size_t>(std::count(out.text.begin(), out.text.end(), '\n')));
  std::set<std::string_view> done;
  ORIEL_TRY_VOID(append_file(name, done, out));
  return out;
}

std::string name_places(const std::string& log, const ShaderText& source) {
  static const std::regex place(R"(\b\d+(?::(\d+)(?:\(\d+\))?|\((\d+)\)))");
  std::string out;
  std::size_t at = 0;
  for (std::sregex_iterator i(log.begin(), log.end(), place), end; i != end; ++i) {
    const std::string number = (*i)[1].matched ? (*i)[1] : (*i)[2];
    const unsigned long line = number.size() < 9 ? std::stoul(number) : 0;
    out += log.substr(at, static_cast<std::size_t>(i->position()) - at);
    const bool known = line >= 1 && line <= source.origin.size() && !source.origin[line - 1].empty();
    out += known ? source.origin[line - 1] : i->str();
    at = static_cast<std::size_t>(i->position() + i->length());
  }
  return out + log.substr(at);
}

}  // namespace oriel::gpu
