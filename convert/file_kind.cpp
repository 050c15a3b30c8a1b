#include "convert/file_kind.h"

#include <algorithm>
#include <string_view>

#include "formats/core/bytes.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

using namespace std::string_view_literals;

enum class Reader { kGltf, kImport, kNone };

// What a file of a kind begins with, what its name ends with, and what its user should do. Of kinds that begin alike
// the one whose extension fits is taken, else the first.
struct FileKind {
  std::string_view name;
  std::string_view extensions;  // with spaces; what stands first is the usual one
  std::string_view start;       // of the file; empty: only its name tells
  Reader reader;
  std::string_view advice;
};

constexpr std::string_view kOle = "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv, kZip = "PK\x03\x04"sv;  // containers of many
constexpr std::string_view kBlender =
    "export glTF from Blender (File > Export > glTF 2.0), with Cameras and Punctual Lights switched on";
constexpr std::string_view kMax = "export FBX from 3ds Max (File > Export)";
constexpr std::string_view kCad =
    "open it in the CAD program or in FreeCAD and export glTF, IFC or OBJ (File > Export); it holds no triangles";
constexpr std::string_view kUnzip = "unpack it and give the scene in it";
constexpr std::string_view kPicture = "a picture is no scene; --sky takes an .hdr or .exr";

constexpr FileKind kKinds[] = {
    {"a glTF", "glb vrm", "glTF"sv, Reader::kGltf, ""},
    {"an FBX", "fbx", "Kaydara FBX Binary"sv, Reader::kImport, "export glTF from the program that wrote it"},
    {"an FBX", "fbx", "; FBX"sv, Reader::kImport, "export glTF from the program that wrote it"},
    {"a Collada file", "dae", "", Reader::kImport, "export it once more, or as glTF or FBX"},
    {"an OBJ", "obj", "", Reader::kImport, "export glTF or FBX from the program that wrote it"},
    {"a 3DS", "3ds", "", Reader::kImport, "export glTF or FBX from the program that wrote it"},
    {"a PLY", "ply", "ply\n"sv, Reader::kImport, "open it in Blender and export glTF"},
    {"a PLY", "ply", "ply\r"sv, Reader::kImport, "open it in Blender and export glTF"},
    {"an STL", "stl", "", Reader::kImport, "open it in Blender and export glTF"},
    {"a STEP file", "step stp p21", "ISO-10303-21"sv, Reader::kNone, kCad},
    {"an IFC", "ifc", "ISO-10303-21"sv, Reader::kImport,
     "export it once more as IFC 2x3 or IFC 4 Reference View, or open it in Blender with Bonsai (BlenderBIM) and "
     "export glTF"},
    {"a .blend", "blend blend1", "BLENDER"sv, Reader::kNone, kBlender},
    {"a compressed .blend", "blend blend1", "\x28\xB5\x2F\xFD"sv, Reader::kNone,
     kBlender},                                                                      // zstd, from Blender 3.0 on
    {"a compressed .blend", "blend blend1", "\x1F\x8B"sv, Reader::kNone, kBlender},  // gzip, before it
    {"a .blend", "blend blend1", "", Reader::kNone, kBlender},
    {"a SketchUp model", "skp skb", "\xFF\xFE\xFF\x0E"sv, Reader::kNone,
     "export glTF from SketchUp (File > Export > 3D Model, type glTF; before 2024 Collada .dae)"},
    {"a Revit model", "rvt rfa rte", kOle, Reader::kNone,
     "export IFC or FBX from Revit (File > Export), or glTF with a plug-in"},
    {"a 3ds Max scene", "max", kOle, Reader::kNone, kMax},
    {"an Archicad project", "pln pla", "", Reader::kNone, "export IFC from Archicad (File > Save as)"},
    {"a Maya scene", "ma mb", "//Maya"sv, Reader::kNone, "export FBX from Maya (File > Export All)"},
    {"a Maya scene", "mb", "FOR8"sv, Reader::kNone, "export FBX from Maya (File > Export All)"},
    {"a Maya scene", "mb", "FOR4"sv, Reader::kNone, "export FBX from Maya (File > Export All)"},
    {"a Cinema 4D scene", "c4d", "QC4DC4D6"sv, Reader::kNone, "export glTF or FBX from Cinema 4D (File > Export)"},
    {"a Cinema 4D scene", "c4d", "", Reader::kNone, "export glTF or FBX from Cinema 4D (File > Export)"},
    {"a Rhino model", "3dm", "3D Geometry File Format"sv, Reader::kNone,
     "export glTF from Rhino (File > Export Selected; Rhino 8), or OBJ or FBX"},
    {"a USD scene", "usd usda usdc", "PXR-USDC"sv, Reader::kNone, "open it in Blender (File > Import) and export glTF"},
    {"a USD scene", "usd usda usdc", "#usda"sv, Reader::kNone, "open it in Blender (File > Import) and export glTF"},
    {"a ZIP archive", "zip zae", kZip, Reader::kNone, kUnzip},
    {"a USD scene", "usdz usd", kZip, Reader::kNone, "open it in Blender (File > Import) and export glTF"},
    {"an AutoCAD drawing", "dwg", "AC10"sv, Reader::kNone, kCad},
    {"a DXF drawing", "dxf", "AutoCAD Binary DXF"sv, Reader::kNone, kCad},
    {"a DXF drawing", "dxf", "", Reader::kNone, kCad},
    {"an IGES file", "igs iges", "", Reader::kNone, kCad},
    {"a FreeCAD document", "fcstd", kZip, Reader::kNone, "export glTF from FreeCAD (File > Export)"},
    {"a Sweet Home 3D home", "sh3d sh3x", kZip, Reader::kNone,
     "export OBJ from Sweet Home 3D (3D view > Export to OBJ)"},
    {"a Google Earth model", "kmz", kZip, Reader::kNone, "unpack it (it is a ZIP) and give the .dae in it"},
    {"a zipped IFC", "ifczip", kZip, Reader::kNone, "unpack it (it is a ZIP) and give the .ifc in it"},
    {"a 3MF", "3mf", kZip, Reader::kNone, "open it in Blender or a slicer and export STL or glTF"},
    {"a gzip archive", "gz tgz", "\x1F\x8B"sv, Reader::kNone, kUnzip},
    {"a Zstandard archive", "zst", "\x28\xB5\x2F\xFD"sv, Reader::kNone, kUnzip},
    {"a 7z archive", "7z", "7z\xBC\xAF\x27\x1C"sv, Reader::kNone, kUnzip},
    {"a RAR archive", "rar", "Rar!"sv, Reader::kNone, kUnzip},
    {"an Alembic cache", "abc", "Ogawa"sv, Reader::kNone, "open it in Blender (File > Import) and export glTF"},
    {"a VRML or X3D scene", "wrl x3d x3dv", "#VRML"sv, Reader::kNone,
     "open it in Blender (X3D add-on) and export glTF"},
    {"a LightWave file", "lwo lws lxo", "FORM"sv, Reader::kNone, "export glTF or FBX from the program that wrote it"},
    {"an OBJ's material file", "mtl", "", Reader::kNone, "give the .obj beside it"},
    {"a glTF's buffer", "bin", "", Reader::kNone, "give the .gltf beside it"},
    {"a pack", "oriel", "ORIEL"sv, Reader::kNone, "it is baked: oriel-play shows it, oriel-inspect tells of it"},
    {"a picture", "png", "\x89PNG"sv, Reader::kNone, kPicture},
    {"a picture", "jpg jpeg", "\xFF\xD8\xFF"sv, Reader::kNone, kPicture},
    {"a picture", "exr", "\x76\x2F\x31\x01"sv, Reader::kNone, kPicture},
    {"a picture", "hdr", "#?"sv, Reader::kNone, kPicture},
    {"a PDF", "pdf", "%PDF"sv, Reader::kNone, "export the model itself as glTF, FBX or IFC"},
};

bool has_word(std::string_view list, std::string_view word) {
  return !word.empty() && (" " + std::string(list) + " ").find(" " + std::string(word) + " ") != std::string::npos;
}

// What a longer look tells, where formats begin alike or with nothing of their own.
std::string_view extension_by_content(std::string_view text) {
  const std::string_view head = text.substr(0, 4096);  // headers of all of them end before
  if (head.starts_with("ISO-10303-21")) return text.find("IFC") != std::string_view::npos ? "ifc" : "step";
  if (head.find("<COLLADA") != std::string_view::npos) return "dae";
  if (head.starts_with("solid ") && text.find("facet") != std::string_view::npos) return "stl";
  if (head.starts_with("MM") && head.size() >= 6) {  // the chunk of a 3DS, as long as its file
    std::uint32_t size = 0;
    std::memcpy(&size, head.data() + 2, sizeof(size));
    if (size == text.size()) return "3ds";
  }
  return "";
}

const FileKind* find_kind(std::string_view extension, std::string_view text) {
  const std::string_view content = extension_by_content(text);
  const FileKind* first = nullptr;
  for (const FileKind& kind : kKinds) {
    if (content.empty() ? kind.start.empty() || !text.starts_with(kind.start) : !has_word(kind.extensions, content))
      continue;
    if (!content.empty() || has_word(kind.extensions, extension)) return &kind;
    if (!first) first = &kind;
  }
  if (first) return first;
  // glTF is JSON; a byte order mark before it goes on to its reader, which tells of it.
  const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (begin == std::string_view::npos || text[begin] == '{') return nullptr;
  const auto named =
      std::ranges::find_if(kKinds, [&](const FileKind& kind) { return has_word(kind.extensions, extension); });
  return named == std::end(kKinds) || named->reader == Reader::kGltf ? nullptr : named;
}

}  // namespace

Result<std::optional<SourceFormat>> source_format(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::string extension = lower_case(path.extension().string());
  if (!extension.empty()) extension.erase(0, 1);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const FileKind* kind = find_kind(extension, text);
  if (!kind || kind->reader == Reader::kGltf) return std::nullopt;
  if (kind->reader == Reader::kNone)
    return invalid(path.filename().string(), "this is {}: {}", kind->name, kind->advice);
  const std::string_view name = kind->name.substr(kind->name.find(' ') + 1);
  const std::string_view usual = kind->extensions.substr(0, kind->extensions.find(' '));
  return SourceFormat{std::string(name), std::string(usual), std::string(kind->advice)};
}

}  // namespace oriel
