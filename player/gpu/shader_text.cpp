#include <algorithm>
#include <charconv>
#include <set>

#include "player/gpu/program.h"

namespace oriel::gpu {

std::span<const ShaderSource> shader_sources();  // of shaders/, made by embed_shaders.cmake

namespace {

std::vector<ShaderSource>& added_sources() {
  static std::vector<ShaderSource> sources;
  return sources;
}

constexpr std::string_view kDesktopHead = "#version 330 core\n";
constexpr std::string_view kEsHead =
    "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
    "precision highp sampler2DArray;\nprecision highp isampler2D;\nprecision highp usampler2D;\nprecision highp "
    "sampler2DArrayShadow;\n";
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

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// A file number with a line: "0:12", "0:12(5)" or "0(12)".
struct Place {
  std::size_t line = 0;
  const char* end = nullptr;  // after it; null where there is none
};

Place read_place(const char* at, const char* end) {
  while (at != end && is_digit(*at)) ++at;
  if (at == end || (*at != ':' && *at != '(')) return {};
  const bool parenthesis = *at == '(';
  Place place;
  const auto [after, error] = std::from_chars(at + 1, end, place.line);
  if (error != std::errc()) return {};
  place.end = after;
  if (parenthesis) {
    if (after == end || *after != ')') return {};
    place.end = after + 1;
  } else if (after != end && *after == '(') {  // a column
    const char* close = std::find(after, end, ')');
    if (close != end) place.end = close + 1;
  }
  return place;
}

}  // namespace

void add_shader_sources(std::span<const ShaderSource> sources) {
  added_sources().insert(added_sources().end(), sources.begin(), sources.end());
}

std::string_view shader_source(std::string_view name) {
  for (const std::span<const ShaderSource> sources : {shader_sources(), std::span<const ShaderSource>(added_sources())})
    for (const ShaderSource& source : sources)
      if (source.name == name) return source.text;
  return {};
}

Result<ShaderText> assemble_shader(std::string_view name, Dialect dialect, std::string_view define) {
  ShaderText out;
  out.name = name;
  out.text = dialect == Dialect::kEs300 ? kEsHead : kDesktopHead;
  for (std::size_t at = 0; at < define.size();) {
    const std::size_t end = std::min(define.find(' ', at), define.size());
    if (end > at) out.text += fmt::format("#define {}\n", define.substr(at, end - at));
    at = end + 1;
  }
  out.origin.resize(static_cast<std::size_t>(std::count(out.text.begin(), out.text.end(), '\n')));
  std::set<std::string_view> done;
  ORIEL_TRY_VOID(append_file(name, done, out));
  return out;
}

std::string name_places(const std::string& log, const ShaderText& source) {
  std::string out;
  const char* const end = log.data() + log.size();
  for (const char* at = log.data(); at != end;) {
    const bool starts_number = is_digit(*at) && (at == log.data() || !is_word(at[-1]));
    const Place place = starts_number ? read_place(at, end) : Place{};
    const bool known = place.end != nullptr && place.line >= 1 && place.line <= source.origin.size() &&
                       !source.origin[place.line - 1].empty();
    if (known) {
      out += source.origin[place.line - 1];
      at = place.end;
    } else {
      out += *at++;
    }
  }
  return out;
}

}  // namespace oriel::gpu
