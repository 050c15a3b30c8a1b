// oriel-import: files of other programs as glTF, which oriel-bake and oriel-preview read.
#include <assimp/postprocess.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdio>
#include <new>

#include "convert/import_process.h"
#include "convert/importer/ifc_text.h"
#include "convert/importer/scene_writer.h"
#include "formats/cli/command.h"
#include "formats/core/file.h"
#include "formats/core/text.h"

namespace {

using namespace oriel;
namespace fs = std::filesystem;

struct Arguments {
  fs::path input;
  std::string output, up = "auto";
  ImportProcess process;
};

void complain(const std::string& text) {
  fmt::print(stderr, "oriel-import: warning: {}\n", text);
}

// What the reader may take. Address space counts what is asked for, so that nothing is ever swapped or killed for it.
void limit(const ImportProcess& process) {
  const auto set = [](auto what, std::uint64_t most) {
    const rlimit value{most, most + 1};  // over the first of CPU time it is told, over the second killed
    ::setrlimit(what, &value);
  };
  set(RLIMIT_AS, process.memory_bytes);
  set(RLIMIT_CPU, static_cast<std::uint64_t>(std::ceil(process.time_s)));
  set(RLIMIT_CORE, 0);
  set(RLIMIT_STACK, process.memory_bytes);  // readers recurse into what is nested
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);       // who waits for it is gone: so is what it is for
}

// Programs whose files say in their head who wrote them, but neither unit nor axis.
struct KnownWriter {
  std::string_view name;
  double unit_m;
  char up;
};
constexpr KnownWriter kWriters[] = {{"FreeCAD", 0.001, 'z'}, {"Sweet Home 3D", 0.01, 'y'}};

std::string_view head_of(std::span<const std::byte> bytes) {
  constexpr std::size_t kComments = 200;  // of bytes, where writers name themselves
  return {reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kComments)};
}

bool by_blender(const aiScene& scene, std::span<const std::byte> bytes) {
  aiString generator;
  if (scene.mMetaData && scene.mMetaData->Get("SourceAsset_Generator", generator))
    return std::string_view(generator.C_Str()).find("Blender") != std::string_view::npos;
  return head_of(bytes).starts_with("# Blender");  // the first line of its OBJs
}

Result<Bytes> convert(const fs::path& path, const SourceFormat& format, std::span<const std::byte> bytes, char up) {
  Assimp::Importer importer;
  auto* files = new SourceFiles(path, format.extension);
  importer.SetIOHandler(files);  // owns it
  double unit_m = 1;
  if (format.extension == "ifc") {
    ReadableIfc ifc = readable_ifc({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    files->replace_scene(std::move(ifc.text));
    unit_m = ifc.metres;
  }
  if (format.extension == "obj" || format.extension == "ply" || format.extension == "stl")
    for (const KnownWriter& writer : kWriters)
      if (head_of(bytes).find(writer.name) != std::string_view::npos) unit_m = writer.unit_m, up = up ? up : writer.up;
  importer.SetPropertyBool("IMPORT_FBX_PRESERVE_PIVOTS", false);
  importer.SetPropertyInteger("PP_SBP_REMOVE", aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyFloat("PP_GSN_MAX_SMOOTHING_ANGLE", 30);  // degrees: what CAD programs smooth by
  const aiScene* scene =
      importer.ReadFile(files->scene_name(), aiProcess_Triangulate | aiProcess_SortByPType |
                                                 aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices |
                                                 aiProcess_FindInvalidData | aiProcess_TransformUVCoords);
  const std::string said = importer.GetErrorString();
  if (!scene && said.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
  if (!scene || !scene->mRootNode)
    return invalid(path.filename().string(),
                   "the {} cannot be read ({}): it is damaged, or of a version that is not read: {}", format.name,
                   said.empty() ? "no scene in it" : said, format.advice);
  const SourceScene source{*scene, *files, format.extension, by_blender(*scene, bytes), unit_m, complain};
  auto glb = write_scene(source, up);
  for (const fs::path& file : files->read()) fmt::print(stderr, "oriel-import: read: {}\n", file.string());
  return glb;
}

Result<Bytes> import(const Arguments& arguments, char up) {
  ORIEL_TRY(const Bytes bytes, read_file(arguments.input));
  ORIEL_TRY(const auto format, source_format(arguments.input, bytes));
  if (!format)
    return invalid(
        arguments.input.filename().string(),
        "is a glTF already, or no format that is known, expected .fbx, .obj, .dae, .3ds, .ply, .stl or .ifc");
  if (arguments.output == "-") {
    limit(arguments.process);
    return convert(arguments.input, *format, bytes, up);
  }
  ImportProcess process = arguments.process;
  process.program = "/proc/self/exe";
  process.up = up;
  process.warn = complain;
  return import_by_process(arguments.input, *format, process);
}

Status run(const Arguments& arguments) {
  const char up = arguments.up == "auto" ? '\0' : arguments.up.front();
  ORIEL_TRY(const Bytes glb, import(arguments, up));
  if (arguments.output != "-") return write_file_atomically(arguments.output, glb);
  return print({reinterpret_cast<const char*>(glb.data()), glb.size()});
}

Result<double> parse_duration(const std::string& text) {
  static constexpr Unit kUnits[] = {{"s", 1}, {"min", 60}, {"h", 3600}};
  return parse_quantity(text, kUnits, "time", "60s, 10min or 2h");
}

constexpr const char* kFooter =
    R"(oriel-bake and oriel-preview start it themselves: oriel-bake model.fbx -o model.oriel.
What each format carries, how materials and lamps become glTF's, and the way from SketchUp and Revit: docs/scenes.md.
  oriel-import house.fbx -o house.glb                a glTF to look at, to edit, or to bake
  oriel-import scan.ply -o scan.glb --up y           a file that does not say where up is
  oriel-import tower.ifc -o tower.glb --time 1h --memory 32GiB
Units: of FBX, Collada and IFC as the file says; OBJ, 3DS, PLY and STL have none: oriel-bake guesses, or --unit there.
Exit codes: 0 done, 1 usage, 2 a file cannot be read or written, 3 the file is at fault, 4 out of time or memory.)";

}  // namespace

int main(int argc, char** argv) {
  constexpr const char *kFiles = "Files", *kReading = "Reading", *kLimits = "Limits";
  Arguments arguments;
  ImportProcess& process = arguments.process;
  CommandLine program{
      ORIEL_VERSION,
      {.name = "oriel-import",
       .help = "Turns a scene of another program (.fbx .obj .dae .3ds .ply .stl .ifc) into a binary glTF file.",
       .footer = kFooter,
       .options = {
           {"FILE", kFiles, "The scene; its textures are looked for beside it and in folders there",
            path(arguments.input, "FILE"), Use::kRequired},
           {"-o,--output", kFiles, "The .glb to write; -: to standard output, within this process",
            text(arguments.output, "FILE"), Use::kRequired},
           {"--up", kReading, "The file's axis that points up; auto: as it says; PLY and STL say nothing and have z",
            one_of(arguments.up, {"auto", "y", "z"}), Use::kEveryday},
           {"--time", kLimits, "Give up after so long",
            quantity(
                process.time_s, "TIME", parse_duration, +[](double s) { return fmt::format("{:g}s", s); }),
            Use::kEveryday},
           {"--memory", kLimits, "Give up where reading takes more",
            quantity(
                process.memory_bytes, "SIZE", parse_bytes, +[](std::uint64_t b) { return fmt::format("{}B", b); }),
            Use::kEveryday}}}};
  program.command.run = [&]() -> Status {
    try {
      return run(arguments);
    } catch (const std::bad_alloc&) {
      return fail(
          ErrorCode::kRuntime, arguments.input.filename().string(),
          "reading takes more than {:.3g} GiB: expected a smaller file, or oriel-import {} -o scene.glb --memory 32GiB "
          "and its scene.glb",
          static_cast<double>(process.memory_bytes) / 0x1p30, arguments.input.filename().string());
    }
  };
  return run_program(program, argc, argv);
}
