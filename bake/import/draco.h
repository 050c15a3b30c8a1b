// KHR_draco_mesh_compression.
#pragma once

#include <map>
#include <span>

#include "formats/core/bytes.h"
#include "formats/core/result.h"
#include "formats/core/vec.h"

namespace oriel::gltf {

struct DracoMesh {
  std::uint32_t vertex_count = 0;
  std::vector<std::uint32_t> indices;                    // three a triangle, below vertex_count
  std::map<std::string, std::vector<float>> attributes;  // vertex_count * components
  std::map<std::string, std::uint32_t> components;
};

struct DracoRequest {
  std::uint32_t id = 0;          // unique id of the attribute
  std::uint32_t components = 3;  // expected
  bool normalized = false;       // of the accessor: integers map to [0,1] or [-1,1]
};

// Error kInvalid where the data is corrupt, is a point cloud, or lacks an attribute that is asked for.
Result<DracoMesh> decode_draco(std::span<const std::byte> bytes, const std::map<std::string, DracoRequest>& requests,
                               const std::string& where);

}  // namespace oriel::gltf
