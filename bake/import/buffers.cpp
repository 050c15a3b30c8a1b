#include "bake/import/buffers.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "formats/core/file.h"
#include "formats/core/hash.h"
#include "formats/core/text.h"

namespace oriel::gltf {
namespace {

Result<Bytes> decode_meshopt(const MeshoptDesc& desc, std::span<const std::byte> source, const std::string& where) {
  Bytes out(desc.count * desc.stride);
  const auto* data = reinterpret_cast<const unsigned char*>(source.data());
  int error = 0;
  switch (desc.mode) {
    case MeshoptDesc::Mode::kAttributes:
      error = meshopt_decodeVertexBuffer(out.data(), desc.count, desc.stride, data, source.size());
      break;
    case MeshoptDesc::Mode::kTriangles:
      error = meshopt_decodeIndexBuffer(out.data(), desc.count, desc.stride, data, source.size());
      break;
    case MeshoptDesc::Mode::kIndices:
      error = meshopt_decodeIndexSequence(out.data(), desc.count, desc.stride, data, source.size());
      break;
  }
  if (error != 0)
    return invalid(where, "found {} bytes that EXT_meshopt_compression cannot decode (error {}), expected intact data",
                   source.size(), error);
  // The filters work four elements at a time: rounded up, cut again.
  const std::size_t padded = (desc.count + 3) / 4 * 4;
  const std::size_t size = out.size();
  if (desc.filter != MeshoptDesc::Filter::kNone) out.resize(padded * desc.stride);
  using Filter = MeshoptDesc::Filter;
  if (desc.filter == Filter::kOctahedral) meshopt_decodeFilterOct(out.data(), padded, desc.stride);
  if (desc.filter == Filter::kQuaternion) meshopt_decodeFilterQuat(out.data(), padded, desc.stride);
  if (desc.filter == Filter::kExponential) meshopt_decodeFilterExp(out.data(), padded, desc.stride);
  out.resize(size);
  return out;
}

// The file of a name, as written or else as Windows and the web find it: \ parts folders, cases are alike, a?b is a,
// and a/../b is b without an a. The name as written where no file has it, or two differ by their case alone.
std::filesystem::path find_file(const std::filesystem::path& folder, const std::filesystem::path& name) {
  std::error_code ec;
  const std::filesystem::path written = folder / name;
  if (std::filesystem::exists(written, ec)) return written;
  std::string slashed = name.string().substr(0, name.string().find('?'));
  std::ranges::replace(slashed, '\\', '/');
  std::filesystem::path at = folder.empty() ? "." : folder;
  for (const std::filesystem::path& part : std::filesystem::path(slashed).lexically_normal()) {
    if (std::filesystem::exists(at / part, ec)) {
      at /= part;
      continue;
    }
    std::vector<std::filesystem::path> alike;
    for (const auto& entry : std::filesystem::directory_iterator(at, ec))
      if (lower_case(entry.path().filename().string()) == lower_case(part.string())) alike.push_back(entry.path());
    if (alike.size() != 1) return written;
    at = alike.front();
  }
  return at;
}

}  // namespace

Status MemoryBudget::take(std::uint64_t bytes, const std::string& where) {
  if (bytes > left_)
    return invalid(where,
                   "found a need for {} bytes, expected at most the {} that are left of the import's memory limit",
                   bytes, left_);
  left_ -= bytes;
  return {};
}

Result<Bytes> read_external(const std::string& uri, const std::filesystem::path& folder, const std::string& where,
                            MemoryBudget& budget, InputHashes& inputs) {
  ORIEL_TRY(const std::filesystem::path name, path_from_uri(uri, where));
  const std::filesystem::path path = find_file(folder, name);
  std::error_code ec;
  const auto status = std::filesystem::status(path, ec);
  if (!std::filesystem::exists(status)) return invalid(where, "found no file \"{}\", expected one", path.string());
  // Pipes and devices could block for ever.
  if (!std::filesystem::is_regular_file(status))
    return invalid(where, "found \"{}\", which is no regular file, expected one", path.string());
  auto bytes = read_file(path, budget.left());
  if (!bytes) return invalid(where, "{}", bytes.error().text());
  ORIEL_TRY_VOID(budget.take(bytes->size(), where));
  inputs.emplace_back(path.lexically_proximate(folder).string(), hash128_hex(*bytes));
  return std::move(*bytes);
}

Result<BufferStore> BufferStore::load(const Document& document, const Container& container,
                                      const std::filesystem::path& folder, MemoryBudget& budget, InputHashes& inputs) {
  BufferStore store;
  std::vector<std::span<const std::byte>> buffers;
  store.storage_.reserve(document.buffers.size() + document.views.size());  // spans point into it
  for (std::size_t i = 0; i < document.buffers.size(); ++i) {
    const BufferDesc& desc = document.buffers[i];
    const std::string where = fmt::format("{}: buffers[{}]", document.file, i);
    std::span<const std::byte> bytes;
    if (desc.uri) {
      if (is_data_uri(*desc.uri)) ORIEL_TRY_VOID(budget.take(desc.uri->size() / 4 * 3, where));
      auto loaded = is_data_uri(*desc.uri) ? decode_data_uri(*desc.uri, where)
                                           : read_external(*desc.uri, folder, where, budget, inputs);
      if (!loaded) return tl::unexpected<Error>(std::move(loaded).error());
      bytes = store.storage_.emplace_back(std::move(*loaded));
    } else if (i == 0 && container.binary) {
      bytes = *container.binary;
    } else if (desc.fallback) {
      buffers.emplace_back();
      continue;
    } else {
      return invalid(where, "found neither a uri nor a BIN chunk, expected one of them");
    }
    if (bytes.size() < desc.byte_length)
      return invalid(where, "found {} bytes, expected the buffer's byteLength of {}", bytes.size(), desc.byte_length);
    buffers.push_back(bytes.first(desc.byte_length));
  }
  for (std::size_t i = 0; i < document.views.size(); ++i) {
    const ViewDesc& view = document.views[i];
    const std::string where = fmt::format("{}: bufferViews[{}]", document.file, i);
    const auto buffer = buffers[static_cast<std::size_t>(view.meshopt ? view.meshopt->buffer : view.buffer)];
    if (!view.meshopt && buffer.size() < view.offset + view.length)
      return invalid(where, "found a plain view of a fallback buffer, expected a compressed one");
    if (!view.meshopt) {
      store.views_.push_back(buffer.subspan(view.offset, view.length));
      continue;
    }
    if (buffer.size() < view.meshopt->offset + view.meshopt->length)
      return invalid(where, "found compressed data in a fallback buffer, expected it in another");
    ORIEL_TRY_VOID(budget.take(view.length, where));
    ORIEL_TRY(Bytes decoded,
              decode_meshopt(*view.meshopt, buffer.subspan(view.meshopt->offset, view.meshopt->length), where));
    store.views_.emplace_back(store.storage_.emplace_back(std::move(decoded)));
  }
  return store;
}

}  // namespace oriel::gltf
