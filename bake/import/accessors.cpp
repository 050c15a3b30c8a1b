#include "bake/import/accessors.h"

#include <cmath>

namespace oriel::gltf {
namespace {

// Zeros need no bytes in the file, so only this bounds what a short file can ask for.
constexpr std::uint64_t kMaxZeroElements = std::uint64_t{1} << 26;

template <class T>
T load(const std::byte* p) {
  T value;
  std::memcpy(&value, p, sizeof(T));
  return value;
}

std::uint32_t load_unsigned(const std::byte* p, ComponentType type) {
  if (type == ComponentType::kUnsignedByte) return load<std::uint8_t>(p);
  if (type == ComponentType::kUnsignedShort) return load<std::uint16_t>(p);
  return load<std::uint32_t>(p);
}

float load_float(const std::byte* p, ComponentType type, bool normalized) {
  switch (type) {
    case ComponentType::kByte:
      return normalized ? std::fmax(static_cast<float>(load<std::int8_t>(p)) / 127.0f, -1.0f)
                        : static_cast<float>(load<std::int8_t>(p));
    case ComponentType::kUnsignedByte:
      return static_cast<float>(load<std::uint8_t>(p)) / (normalized ? 255.0f : 1.0f);
    case ComponentType::kShort:
      return normalized ? std::fmax(static_cast<float>(load<std::int16_t>(p)) / 32767.0f, -1.0f)
                        : static_cast<float>(load<std::int16_t>(p));
    case ComponentType::kUnsignedShort:
      return static_cast<float>(load<std::uint16_t>(p)) / (normalized ? 65535.0f : 1.0f);
    case ComponentType::kUnsignedInt:
      return static_cast<float>(load<std::uint32_t>(p));
    case ComponentType::kFloat:
      break;
  }
  return load<float>(p);
}

}  // namespace

template <class Element>
Status AccessorReader::for_each(int accessor, const Element& element) {
  const AccessorDesc& a = desc(accessor);
  if (a.view >= 0 && a.count > 0) {
    const ViewDesc& v = document_.views[static_cast<std::size_t>(a.view)];
    const std::uint64_t view_stride = v.meshopt ? v.meshopt->stride : v.stride;
    const std::uint64_t stride = view_stride != 0 ? view_stride : a.element_size;
    const std::byte* bytes = buffers_.view(a.view).data() + a.offset;
    for (std::uint64_t i = 0; i < a.count; ++i) element(i, bytes + i * stride);
  } else if (a.view < 0 && a.count > kMaxZeroElements) {
    return invalid(where(accessor), "found {} elements without a bufferView, expected at most {}", a.count,
                   kMaxZeroElements);
  }
  if (!a.sparse || a.sparse->count == 0) return {};
  const std::byte* indices = buffers_.view(a.sparse->indices_view).data() + a.sparse->indices_offset;
  const std::byte* values = buffers_.view(a.sparse->values_view).data() + a.sparse->values_offset;
  const std::uint64_t index_size = component_size(a.sparse->indices_type);
  std::int64_t last = -1;
  for (std::uint64_t i = 0; i < a.sparse->count; ++i) {
    const std::uint32_t at = load_unsigned(indices + i * index_size, a.sparse->indices_type);
    if (at >= a.count || static_cast<std::int64_t>(at) <= last)
      return invalid(where(accessor) + ".sparse.indices", "found index {} after {}, expected increasing ones below {}",
                     at, last, a.count);
    last = at;
    element(at, values + i * a.element_size);
  }
  return {};
}

Result<std::vector<float>> AccessorReader::decode(int accessor, NotFinite& bad) {
  const AccessorDesc& a = desc(accessor);
  if (a.view < 0 && a.count > kMaxZeroElements)
    return invalid(where(accessor), "found {} elements without a bufferView, expected at most {}", a.count,
                   kMaxZeroElements);
  std::vector<float> out(a.count * a.components);
  const std::uint64_t size = component_size(a.type);
  const std::uint32_t columns = a.matrix ? static_cast<std::uint32_t>(std::lround(std::sqrt(a.components))) : 1;
  const std::uint32_t rows = a.components / columns;
  const std::uint64_t column_size = a.element_size / columns;
  const Status status = for_each(accessor, [&](std::uint64_t i, const std::byte* bytes) {
    for (std::uint32_t c = 0; c < a.components; ++c) {
      const float value = load_float(bytes + c / rows * column_size + c % rows * size, a.type, a.normalized);
      const bool finite = std::isfinite(value);
      if (!finite && bad.count++ == 0) bad.first = i;
      out[i * a.components + c] = finite ? value : 0;
    }
  });
  if (!status) return tl::unexpected<Error>(status.error());
  return out;
}

Result<std::span<const float>> AccessorReader::floats(int accessor) {
  ORIEL_TRY(const std::span<const float> values, finite_or_zero(accessor));
  if (const NotFinite& bad = not_finite_[static_cast<std::size_t>(accessor)]; bad.count > 0)
    return invalid(where(accessor), "found NaN or infinity in element {}, expected finite numbers", bad.first);
  return values;
}

Result<std::span<const float>> AccessorReader::finite_or_zero(int accessor) {
  auto& cached = cache_[static_cast<std::size_t>(accessor)];
  if (!cached) {
    ORIEL_TRY_VOID(budget_.take(desc(accessor).count * desc(accessor).components * sizeof(float), where(accessor)));
    ORIEL_TRY(cached, decode(accessor, not_finite_[static_cast<std::size_t>(accessor)]));
  }
  return std::span<const float>(*cached);
}

Result<std::vector<std::uint32_t>> AccessorReader::indices(int accessor) {
  const AccessorDesc& a = desc(accessor);
  const bool unsigned_type = a.type == ComponentType::kUnsignedByte || a.type == ComponentType::kUnsignedShort ||
                             a.type == ComponentType::kUnsignedInt;
  if (a.components != 1 || !unsigned_type || a.normalized)
    return invalid(where(accessor), "found something else than unsigned scalars, expected them as indices");
  if (a.view < 0 && a.count > kMaxZeroElements)
    return invalid(where(accessor), "found {} elements without a bufferView, expected at most {}", a.count,
                   kMaxZeroElements);
  if (a.count * sizeof(std::uint32_t) > budget_.left())
    return invalid(where(accessor), "found {} indices, expected what fits the import's memory limit", a.count);
  std::vector<std::uint32_t> out(a.count);
  ORIEL_TRY_VOID(
      for_each(accessor, [&](std::uint64_t i, const std::byte* bytes) { out[i] = load_unsigned(bytes, a.type); }));
  return out;
}

}  // namespace oriel::gltf
