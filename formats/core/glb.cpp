#include "formats/core/glb.h"

#include <algorithm>

namespace oriel {
std::size_t Glb::add(const char* array, Json element) {
  json[array].push_back(std::move(element));
  return json[array].size() - 1;
}

void Glb::uses(const char* extension) {
  Json& used = json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

std::size_t Glb::add_view(std::span<const std::byte> bytes, int target) {
  while (binary_.bytes().size() % 4 != 0) binary_.put(std::uint8_t{0});
  Json view = {{"buffer", 0}, {"byteOffset", binary_.bytes().size()}, {"byteLength", bytes.size()}};
  if (target != kNoTarget) view["target"] = target;
  binary_.put_array(bytes);
  return add("bufferViews", std::move(view));
}

std::size_t Glb::add_accessor(std::span<const std::byte> bytes, int target, int component, std::size_t count,
                              const char* type) {
  const std::size_t view = add_view(bytes, target);
  return add("accessors", {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
}

std::size_t Glb::add_vectors(std::span<const Vec3> values) {
  return add_accessor(std::as_bytes(values), kVertices, kFloats, values.size(), "VEC3");
}
std::size_t Glb::add_vectors(std::span<const Vec2> values) {
  return add_accessor(std::as_bytes(values), kVertices, kFloats, values.size(), "VEC2");
}

std::size_t Glb::add_positions(std::span<const Vec3> values) {
  Vec3 lower = values[0], upper = values[0];
  for (const Vec3& v : values) lower = glm::min(lower, v), upper = glm::max(upper, v);
  const std::size_t accessor = add_vectors(values);
  json["accessors"][accessor]["min"] = {lower.x, lower.y, lower.z};
  json["accessors"][accessor]["max"] = {upper.x, upper.y, upper.z};
  return accessor;
}

std::size_t Glb::add_colors(std::span<const std::uint32_t> rgba8) {
  const std::size_t accessor = add_accessor(std::as_bytes(rgba8), kVertices, kBytes, rgba8.size(), "VEC4");
  json["accessors"][accessor]["normalized"] = true;
  return accessor;
}

std::size_t Glb::add_indices(std::span<const std::uint32_t> values) {
  return add_accessor(std::as_bytes(values), kIndices, kUint32, values.size(), "SCALAR");
}

std::size_t Glb::add_image(const std::string& name, std::span<const std::byte> bytes, const char* type) {
  const std::size_t view = add_view(bytes, kNoTarget);
  return add("images", {{"name", name}, {"mimeType", type}, {"bufferView", view}});
}

Result<Bytes> Glb::file() const {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  const std::size_t binary = padded(binary_.bytes().size());
  Json whole = json;
  if (binary > 0) whole["buffers"] = {{{"byteLength", binary}}};
  std::string text = whole.dump();
  text.resize(padded(text.size()), ' ');
  const std::size_t total = 12 + 8 + text.size() + (binary > 0 ? 8 + binary : 0);
  if (total > 0xffffffff) return invalid("", "the scene takes {} bytes as .glb, expected less than 2^32", total);
  std::vector<std::uint32_t> words = {kGlbMagic, 2, static_cast<std::uint32_t>(total),
                                      static_cast<std::uint32_t>(text.size()), kGlbJson};
  Bytes out;
  out.reserve(total);
  const auto append = [&](std::span<const std::byte> bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); };
  append(std::as_bytes(std::span(words)));
  append(std::as_bytes(std::span(text)));
  if (binary == 0) return out;
  words = {static_cast<std::uint32_t>(binary), kGlbBinary};
  append(std::as_bytes(std::span(words)));
  append(binary_.bytes());
  out.resize(total);
  return out;
}

}  // namespace oriel
