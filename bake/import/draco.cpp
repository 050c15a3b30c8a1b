#include "bake/import/draco.h"

#include <draco/compression/decode.h>

#include <cmath>
#include <new>

namespace oriel::gltf {
namespace {

// The largest value of a signed or unsigned integer type; 1 for others.
float integer_scale(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return 127;
    case draco::DT_UINT8:
      return 255;
    case draco::DT_INT16:
      return 32767;
    case draco::DT_UINT16:
      return 65535;
    default:
      return 1;
  }
}

Result<std::vector<float>> read_attribute(const draco::Mesh& mesh, const std::string& name, const DracoRequest& request,
                                          const std::string& where) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(request.id);
  if (!attribute) return invalid(where, "found no Draco attribute {}, expected one for {}", request.id, name);
  const auto components = static_cast<std::uint32_t>(attribute->num_components());
  if (components != request.components)
    return invalid(where, "found {1} components in Draco attribute {0}, expected the accessor's {2}", name, components,
                   request.components);
  // ConvertValue normalises by the attribute's own flag; glTF's is the accessor's.
  const float scale = request.normalized && !attribute->normalized() ? 1 / integer_scale(attribute->data_type()) : 1.0f;
  const std::size_t values = attribute->size();
  std::vector<float> out(static_cast<std::size_t>(mesh.num_points()) * components);
  for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
    const draco::AttributeValueIndex at = attribute->mapped_index(draco::PointIndex(point));
    float* target = out.data() + static_cast<std::size_t>(point) * components;
    if (at.value() >= values || !attribute->ConvertValue<float>(at, static_cast<std::int8_t>(components), target))
      return invalid(where, "found no value for vertex {1} in Draco attribute {0}, expected one", name, point);
    for (std::uint32_t c = 0; c < components; ++c) {
      target[c] *= scale;
      if (!std::isfinite(target[c]))
        return invalid(where, "found NaN or infinity in Draco attribute {} of vertex {}, expected finite numbers", name,
                       point);
    }
  }
  return out;
}

}  // namespace

Result<DracoMesh> decode_draco(std::span<const std::byte> bytes, const std::map<std::string, DracoRequest>& requests,
                               const std::string& where) try {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok())
    return invalid(where, "found {} bytes that Draco cannot decode ({}), expected intact data", bytes.size(),
                   decoded.status().error_msg_string());
  const draco::Mesh& mesh = *decoded.value();
  DracoMesh out;
  out.vertex_count = mesh.num_points();
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t index = mesh.face(draco::FaceIndex(f))[static_cast<std::size_t>(k)].value();
      if (index >= out.vertex_count)
        return invalid(where, "found index {1} in Draco face {0}, expected one below {2}", f, index, out.vertex_count);
      out.indices.push_back(index);
    }
  for (const auto& [name, request] : requests) {
    ORIEL_TRY(out.attributes[name], read_attribute(mesh, name, request, where));
    out.components[name] = request.components;
  }
  return out;
} catch (const std::bad_alloc&) {
  return invalid(where, "found Draco data of {} bytes that asks for more memory than there is, expected less",
                 bytes.size());
}

}  // namespace oriel::gltf
