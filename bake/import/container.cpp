#include "bake/import/container.h"

#include <algorithm>
#include <array>

#include "formats/core/glb.h"

namespace oriel::gltf {
namespace {

Result<Container> split_glb(std::span<const std::byte> bytes, const std::string& file) {
  ByteReader header(bytes);
  header.get<std::uint32_t>();
  const auto version = header.get<std::uint32_t>();
  const auto length = header.get<std::uint32_t>();
  if (!header.ok()) return invalid(file, "found {} bytes, expected a GLB header of 12", bytes.size());
  if (version != 2) return invalid(file, "found GLB version {}, expected 2", version);
  if (length < 12 || length > bytes.size())
    return invalid(file, "found {} bytes, expected the {} that the GLB header says", bytes.size(), length);
  Container parts;
  if (length < bytes.size())
    parts.warnings.push_back(fmt::format("{}: {} bytes after the GLB's end are ignored: its header says {}", file,
                                         bytes.size() - length, length));
  bytes = bytes.first(length);
  std::size_t at = 12;
  for (int chunk = 0; at < bytes.size(); ++chunk) {
    const std::string where = fmt::format("{}: GLB chunk {} at byte {}", file, chunk, at);
    ByteReader reader(bytes.subspan(at));
    const std::uint64_t size = reader.get<std::uint32_t>();
    const auto type = reader.get<std::uint32_t>();
    if (!reader.ok()) return invalid(where, "found {} bytes, expected a chunk header of 8", bytes.size() - at);
    if (size > reader.remaining())
      return invalid(where, "found a chunk of {} bytes, expected at most the {} that are left", size,
                     reader.remaining());
    const auto data = bytes.subspan(at + 8, size);
    if (chunk == 0 && type != kGlbJson) return invalid(where, "found chunk type {:#010x}, expected JSON first", type);
    if (chunk > 0 && type == kGlbJson) return invalid(where, "found a second JSON chunk, expected one");
    if (type == kGlbJson && size == 0) return invalid(where, "found an empty JSON chunk, expected a JSON object");
    if (type == kGlbJson) parts.json = data;
    if (type == kGlbBinary && parts.binary) return invalid(where, "found a second BIN chunk, expected at most one");
    if (type == kGlbBinary) parts.binary = data;
    at += 8 + size;
  }
  if (parts.json.empty()) return invalid(file, "found no chunk, expected a JSON chunk after the GLB header");
  return parts;
}

bool is_alpha(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_alnum(char c) {
  return is_alpha(c) || (c >= '0' && c <= '9');
}

// RFC 2397's parameters: each attribute=value, after an optional type/subtype.
bool valid_media_type(std::string_view media) {
  const auto token = [](std::string_view s) {
    return !s.empty() && std::all_of(s.begin(), s.end(), [](char c) {
      return is_alnum(c) || std::string_view("!#$&-^_.+%\"'*").find(c) != std::string_view::npos;
    });
  };
  for (bool first = true;; first = false) {
    const std::size_t end = media.find(';');
    const std::string_view part = media.substr(0, end);
    const std::size_t split = part.find(first ? '/' : '=');
    const bool pair = split != std::string_view::npos && token(part.substr(0, split)) && token(part.substr(split + 1));
    if (!pair && !(first && part.empty())) return false;
    if (end == std::string_view::npos) return true;
    media.remove_prefix(end + 1);
  }
}

constexpr auto kBase64 = [] {
  std::array<std::int8_t, 256> table{};
  table.fill(-1);
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < letters.size(); ++i)
    table[static_cast<unsigned char>(letters[i])] = static_cast<std::int8_t>(i);
  return table;
}();

Result<Bytes> decode_base64(std::string_view text, const std::string& where) {
  if (text.size() % 4 != 0) return invalid(where, "found {} base64 characters, expected a multiple of 4", text.size());
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t group = 0;
    const std::size_t digits = i + 4 == text.size() ? 4 - padding : 4;
    for (std::size_t k = 0; k < digits; ++k) {
      const int digit = kBase64[static_cast<unsigned char>(text[i + k])];
      if (digit < 0)
        return invalid(where, "found byte {:#04x} in base64 at {}, expected A-Z, a-z, 0-9, + or /",
                       static_cast<unsigned char>(text[i + k]), i + k);
      group |= static_cast<std::uint32_t>(digit) << (18 - 6 * k);
    }
    for (std::size_t k = 0; k + 1 < digits; ++k) bytes.push_back(static_cast<std::byte>(group >> (16 - 8 * k)));
    if (digits < 4 && (group & (digits == 2 ? 0xFFFFu : 0xFFu)) != 0)
      return invalid(where, "base64 ends with bits beyond its last byte, expected zeros");
  }
  return bytes;
}

}  // namespace

Result<Container> split_container(std::span<const std::byte> bytes, const std::string& file) {
  if (bytes.empty()) return invalid(file, "found an empty file, expected glTF 2.0");
  std::uint32_t magic = 0;
  if (bytes.size() >= 4) std::memcpy(&magic, bytes.data(), 4);
  if (magic == kGlbMagic) return split_glb(bytes, file);
  const auto first = std::find_if(bytes.begin(), bytes.end(), [](std::byte b) {
    return b != std::byte{' '} && b != std::byte{'\t'} && b != std::byte{'\n'} && b != std::byte{'\r'};
  });
  // A byte order mark goes on to the JSON reader, which names it.
  if (first != bytes.end() && *first != std::byte{'{'} && *first != std::byte{0xEF})
    return invalid(file,
                   "found no scene of a known format, expected .glb or .gltf (or .fbx, .dae, .ifc, .obj, .3ds, .ply, "
                   ".stl): export glTF from the program that made it");
  return Container{.json = bytes, .binary = std::nullopt};
}

bool is_data_uri(std::string_view uri) {
  return uri.starts_with("data:");
}

Result<Bytes> decode_data_uri(std::string_view uri, const std::string& where) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos)
    return invalid(where, "found a data URI without a comma, expected data:…;base64,…");
  std::string_view media = uri.substr(5, comma - 5);
  if (!media.ends_with(";base64"))
    return invalid(where, "found a data URI that is not base64, expected data:…;base64,…");
  media.remove_suffix(7);
  if (!valid_media_type(media))
    return invalid(where, "found \"{}\" in a data URI, expected type/subtype;attribute=value", media.substr(0, 60));
  return decode_base64(uri.substr(comma + 1), where);
}

Result<std::filesystem::path> path_from_uri(std::string_view uri, const std::string& where) {
  if (uri.empty()) return invalid(where, "found an empty URI, expected a relative one");
  const std::size_t colon = uri.find(':');
  if (colon != std::string_view::npos && is_alpha(uri[0]) &&
      std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                  [](char c) { return is_alnum(c) || c == '+' || c == '-' || c == '.'; }))
    return invalid(where, "found a URI with scheme \"{}\", expected a relative one",
                   uri.substr(0, std::min<std::size_t>(colon + 1, 40)));
  std::string name;
  const auto hex = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      name += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hex(uri[i + 1]) : -1, low = i + 2 < uri.size() ? hex(uri[i + 2]) : -1;
    if (high < 0 || low < 0)
      return invalid(where, "found a bare % in the URI \"{}\", expected it written as %25", uri.substr(0, 80));
    name += static_cast<char>(high * 16 + low);
    i += 2;
  }
  if (name.find('\0') != std::string::npos) return invalid(where, "found a zero byte in a URI, expected a file name");
  if (name.front() == '/' || name.front() == '\\')
    return invalid(where, "found the absolute path \"{}\", expected a relative one", name.substr(0, 80));
  return std::filesystem::path(name);
}

}  // namespace oriel::gltf
