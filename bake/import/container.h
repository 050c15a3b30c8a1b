// How a glTF file and what it refers to is stored: GLB chunks, data URIs, file names.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "formats/core/bytes.h"
#include "formats/core/result.h"

namespace oriel::gltf {

// The two parts of a file. Spans into the bytes given.
struct Container {
  std::span<const std::byte> json;
  std::optional<std::span<const std::byte>> binary;  // the BIN chunk of a GLB, padding included
  std::vector<std::string> warnings = {};
};

// Told by the first bytes: "glTF" is a GLB, anything else is taken for JSON. Error kInvalid for an empty file and for a
// GLB whose header or chunks break the specification.
Result<Container> split_container(std::span<const std::byte> bytes, const std::string& file);

bool is_data_uri(std::string_view uri);
// The bytes of "data:[type][;attribute=value];base64,…". Strict: no white space, right padding.
Result<Bytes> decode_data_uri(std::string_view uri, const std::string& where);
// A relative reference, percent-decoded, as a path relative to the file that holds it. Error kInvalid for absolute
// paths, schemes such as http: and broken escapes.
Result<std::filesystem::path> path_from_uri(std::string_view uri, const std::string& where);

}  // namespace oriel::gltf
