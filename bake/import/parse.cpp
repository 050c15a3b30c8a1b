// The document's frame: asset, extensions, buffers, views, accessors, images.
#include <array>
#include <set>

#include "bake/import/document.h"
#include "bake/import/extensions.h"

namespace oriel::gltf {
namespace {

// "2.0" as {2, 0}; an error where it is something else.
std::array<int, 2> version(const JsonAt& value, std::array<int, 2> fallback) {
  if (!value.present()) return fallback;
  const std::string text = value.text();
  int major = 0, minor = 0, used = 0;
  if (std::sscanf(text.c_str(), "%4d.%4d%n", &major, &minor, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() || major < 0 || minor < 0) {
    value.expected("a version such as \"2.0\"");
    return fallback;
  }
  return {major, minor};
}

void parse_asset(const JsonAt& root) {
  const JsonAt asset = root.need("asset");
  const auto found = version(asset.need("version"), {2, 0});
  if (found[0] != 2) asset["version"].expected("version 2.x");
  const auto lowest = version(asset["minVersion"], {2, 0});
  if (lowest > found)
    asset["minVersion"].error(fmt::format("found minVersion {}.{}, expected at most the version {}.{}", lowest[0],
                                          lowest[1], found[0], found[1]));
  if (lowest > std::array<int, 2>{2, 0}) asset["minVersion"].expected("at most \"2.0\"");
}

void parse_extensions(const JsonAt& root, Document& document) {
  const JsonAt required = root["extensionsRequired"], used = root["extensionsUsed"];
  std::set<std::string> told;
  const auto tell = [&](const std::string& name, const Extension& extension) {
    if ((extension.support != Support::kWithout && extension.support != Support::kNone) || !told.insert(name).second)
      return;
    document.warnings.push_back({fmt::format("extension {} is not supported and is left out{}{}", name,
                                             *extension.advice ? ": " : "", extension.advice),
                                 "unsupported"});
  };
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::string name = used.at(i).text();
    if (name == "KHR_mesh_quantization") document.quantized = true;
    tell(name, extension_named(name));
  }
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string name = required.at(i).text();
    if (name == "KHR_mesh_quantization") document.quantized = true;
    const Extension extension = extension_named(name);
    if (extension.support == Support::kNone || extension.support == Support::kOtherImages)
      required.at(i).error(fmt::format("found the required extension \"{}\", expected one that is supported: {}", name,
                                       *extension.advice ? extension.advice : "export the scene without it"));
    tell(name, extension);
  }
}

BufferDesc parse_buffer(const JsonAt& value) {
  BufferDesc buffer;
  buffer.byte_length = value.need("byteLength").integer(0);
  if (value["uri"].present()) buffer.uri = value["uri"].text();
  buffer.fallback = value.extension("EXT_meshopt_compression")["fallback"].boolean(false);
  return buffer;
}

// Records an error where [offset, offset + length) is not inside of a buffer.
void check_range(const JsonAt& value, int buffer, std::uint64_t offset, std::uint64_t length,
                 const Document& document) {
  if (buffer < 0) return;
  const std::uint64_t size = document.buffers[static_cast<std::size_t>(buffer)].byte_length;
  if (offset > size || length > size - offset)
    value.error(fmt::format("found bytes {} to {}, expected them inside of buffer {}, which holds {}", offset,
                            offset + length, buffer, size));
}

MeshoptDesc parse_meshopt(const JsonAt& value, const Document& document) {
  MeshoptDesc out;
  out.buffer = value.need("buffer").index(document.buffers.size());
  out.offset = value["byteOffset"].integer(0);
  out.length = value.need("byteLength").integer(0);
  out.stride = value.need("byteStride").integer(0, 256);
  out.count = value.need("count").integer(0, ~0u);
  check_range(value, out.buffer, out.offset, out.length, document);
  const std::string mode = value.need("mode").text();
  if (mode == "TRIANGLES")
    out.mode = MeshoptDesc::Mode::kTriangles;
  else if (mode == "INDICES")
    out.mode = MeshoptDesc::Mode::kIndices;
  else if (mode != "ATTRIBUTES")
    value["mode"].expected("ATTRIBUTES, TRIANGLES or INDICES");
  const std::string filter = value["filter"].text("NONE");
  if (filter == "OCTAHEDRAL")
    out.filter = MeshoptDesc::Filter::kOctahedral;
  else if (filter == "QUATERNION")
    out.filter = MeshoptDesc::Filter::kQuaternion;
  else if (filter == "EXPONENTIAL")
    out.filter = MeshoptDesc::Filter::kExponential;
  else if (filter != "NONE")
    value["filter"].expected("NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
  const bool indices = out.mode != MeshoptDesc::Mode::kAttributes;
  if (indices ? out.stride != 2 && out.stride != 4 : out.stride == 0 || out.stride % 4 != 0)
    value["byteStride"].expected(indices ? "2 or 4" : "a multiple of 4 up to 256");
  if (out.mode == MeshoptDesc::Mode::kTriangles && out.count % 3 != 0) value["count"].expected("a multiple of 3");
  const bool filter_fits = out.filter == MeshoptDesc::Filter::kNone ||
                           (!indices && (out.filter == MeshoptDesc::Filter::kOctahedral
                                             ? out.stride == 4 || out.stride == 8
                                             : out.filter != MeshoptDesc::Filter::kQuaternion || out.stride == 8));
  if (!filter_fits)
    value["filter"].error(fmt::format("found filter {} with stride {} and mode {}, expected one that goes with them",
                                      filter, out.stride, mode));
  // The codec's best case is far below this ratio; what claims more would only make us allocate.
  if (out.count * out.stride > 4096 + out.length * 1024)
    value["count"].error(fmt::format("found {1} elements of {2} bytes, expected what {0} compressed bytes can hold",
                                     out.length, out.count, out.stride));
  return out;
}

ViewDesc parse_view(const JsonAt& value, const Document& document) {
  ViewDesc view;
  view.buffer = value.need("buffer").index(document.buffers.size());
  view.offset = value["byteOffset"].integer(0);
  view.length = value.need("byteLength").integer(0);
  view.stride = value["byteStride"].integer(0);
  check_range(value, view.buffer, view.offset, view.length, document);
  if (view.stride != 0 && (view.stride < 4 || view.stride > 252 || view.stride % 4 != 0))
    value["byteStride"].expected("a multiple of 4 from 4 to 252");
  if (const JsonAt meshopt = value.extension("EXT_meshopt_compression"); meshopt.present()) {
    view.meshopt = parse_meshopt(meshopt, document);
    if (view.meshopt->count * view.meshopt->stride != view.length)
      value["byteLength"].expected(
          fmt::format("count * byteStride = {}, of the compressed view", view.meshopt->count * view.meshopt->stride));
  }
  return view;
}

ComponentType component_type(const JsonAt& value, bool indices) {
  const std::uint64_t code = value.integer(5126);
  for (const auto type : {5120, 5121, 5122, 5123, 5125, 5126})
    if (code == static_cast<std::uint64_t>(type) && (!indices || type == 5121 || type == 5123 || type == 5125))
      return static_cast<ComponentType>(type);
  value.expected(indices ? "5121, 5123 or 5125" : "5120, 5121, 5122, 5123, 5125 or 5126");
  return indices ? ComponentType::kUnsignedInt : ComponentType::kFloat;
}

struct ElementRun {
  int view = -1;
  std::uint64_t offset = 0, count = 0, element = 0;  // element: bytes of one
  bool strided = false;
};
// Records an error where elements do not fit their view.
void check_elements(const JsonAt& value, const ElementRun& run, const Document& document) {
  const auto& [view, offset, count, element, strided] = run;
  if (view < 0 || count == 0) return;
  const ViewDesc& v = document.views[static_cast<std::size_t>(view)];
  const std::uint64_t view_stride = v.meshopt ? v.meshopt->stride : v.stride;
  const std::uint64_t stride = strided && view_stride != 0 ? view_stride : element;
  if (stride < element)
    return value.error(fmt::format("found byteStride {} in bufferView {}, expected at least the element's {} bytes",
                                   stride, view, element));
  if (offset > v.length || element > v.length - offset || (count - 1) > (v.length - offset - element) / stride)
    value.error(fmt::format(
        "found {} elements of {} bytes from offset {} on, expected them inside of bufferView {}, which holds {} bytes",
        count, element, offset, view, v.length));
}

SparseDesc parse_sparse(const JsonAt& value, const AccessorDesc& accessor, const Document& document) {
  SparseDesc sparse;
  sparse.count = value.need("count").integer(0);
  if (sparse.count > accessor.count) value["count"].expected(fmt::format("at most the accessor's {}", accessor.count));
  const JsonAt indices = value.need("indices"), values = value.need("values");
  sparse.indices_view = indices.need("bufferView").index(document.views.size());
  sparse.indices_offset = indices["byteOffset"].integer(0);
  sparse.indices_type = component_type(indices.need("componentType"), true);
  sparse.values_view = values.need("bufferView").index(document.views.size());
  sparse.values_offset = values["byteOffset"].integer(0);
  check_elements(indices,
                 {sparse.indices_view, sparse.indices_offset, sparse.count, component_size(sparse.indices_type)},
                 document);
  check_elements(values, {sparse.values_view, sparse.values_offset, sparse.count, accessor.element_size}, document);
  return sparse;
}

AccessorDesc parse_accessor(const JsonAt& value, const Document& document) {
  struct Type {
    const char* name;
    std::uint32_t columns, rows;
  };
  static constexpr std::array<Type, 7> kTypes{{{"SCALAR", 1, 1},
                                               {"VEC2", 1, 2},
                                               {"VEC3", 1, 3},
                                               {"VEC4", 1, 4},
                                               {"MAT2", 2, 2},
                                               {"MAT3", 3, 3},
                                               {"MAT4", 4, 4}}};
  AccessorDesc accessor;
  accessor.view = value["bufferView"].index(document.views.size());
  accessor.offset = value["byteOffset"].integer(0);
  accessor.count = value.need("count").integer(0);
  accessor.type = component_type(value.need("componentType"), false);
  accessor.normalized = value["normalized"].boolean(false);
  const std::string name = value.need("type").text();
  bool known = false;
  for (const Type& type : kTypes) {
    if (name != type.name) continue;
    known = true;
    accessor.matrix = type.columns > 1;
    accessor.components = type.columns * type.rows;
    const std::uint64_t column = component_size(accessor.type) * type.rows;
    accessor.element_size = accessor.matrix ? type.columns * ((column + 3) / 4 * 4) : column;
  }
  if (!known) value["type"].expected("SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
  if (accessor.normalized && (accessor.type == ComponentType::kFloat || accessor.type == ComponentType::kUnsignedInt))
    value["normalized"].expected("false for components of type float and unsigned int");
  check_elements(value, {accessor.view, accessor.offset, accessor.count, accessor.element_size, true}, document);
  if (value["sparse"].present()) accessor.sparse = parse_sparse(value["sparse"], accessor, document);
  return accessor;
}

ImageDesc parse_image(const JsonAt& value, const Document& document) {
  ImageDesc image;
  image.name = value["name"].name();
  if (value["uri"].present()) image.uri = value["uri"].text();
  image.view = value["bufferView"].index(document.views.size());
  if (image.uri && value["bufferView"].present()) value.error("found both uri and bufferView, expected one of them");
  if (image.uri && image.name.empty() && !image.uri->starts_with("data:")) image.name = *image.uri;
  return image;
}

template <class T, class Parse>
void parse_array(const JsonAt& array, std::vector<T>& out, const Parse& parse) {
  out.reserve(array.size());
  for (std::size_t i = 0; i < array.size(); ++i) out.push_back(parse(array.at(i)));
}

}  // namespace

std::uint64_t component_size(ComponentType type) {
  switch (type) {
    case ComponentType::kByte:
    case ComponentType::kUnsignedByte:
      return 1;
    case ComponentType::kShort:
    case ComponentType::kUnsignedShort:
      return 2;
    case ComponentType::kUnsignedInt:
    case ComponentType::kFloat:
      break;
  }
  return 4;
}

DMat4 matrix_from_trs(const DVec3& t, const DVec4& q, const DVec3& s) {
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  return DMat4(DVec4(s.x * DVec3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)), 0),
               DVec4(s.y * DVec3(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)), 0),
               DVec4(s.z * DVec3(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)), 0), DVec4(t, 1));
}

Result<Document> parse_document(JsonDocument& json) {
  const JsonAt root = json.root();
  Document document;
  document.file = json.file();
  parse_asset(root);
  ORIEL_TRY_VOID(json.status());
  parse_extensions(root, document);
  ORIEL_TRY_VOID(json.status());
  parse_array(root["buffers"], document.buffers, [](const JsonAt& v) { return parse_buffer(v); });
  parse_array(root["bufferViews"], document.views, [&](const JsonAt& v) { return parse_view(v, document); });
  ORIEL_TRY_VOID(json.status());
  parse_array(root["accessors"], document.accessors, [&](const JsonAt& v) { return parse_accessor(v, document); });
  parse_array(root["images"], document.images, [&](const JsonAt& v) { return parse_image(v, document); });
  ORIEL_TRY_VOID(json.status());
  parse_materials(root, document);
  ORIEL_TRY_VOID(json.status());
  parse_meshes(root, document.materials.size(), document);
  ORIEL_TRY_VOID(json.status());
  parse_nodes(root, document);
  ORIEL_TRY_VOID(json.status());
  for (Warning& repair : json.repairs()) document.warnings.push_back(std::move(repair));
  return document;
}

}  // namespace oriel::gltf
