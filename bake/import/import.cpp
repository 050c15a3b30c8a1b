#include "bake/import/import.h"

#include <algorithm>
#include <set>

#include "bake/import/coplanar.h"
#include "bake/import/images.h"
#include "bake/import/lighting.h"
#include "bake/import/movers.h"
#include "bake/import/node_names.h"
#include "bake/import/opacity.h"
#include "bake/import/repair.h"
#include "bake/import/seams.h"
#include "bake/import/solids.h"
#include "bake/import/viewpoints.h"
#include "bake/jobs/parallel.h"
#include "bake/jobs/warning_group.h"
#include "bake/scene/edges.h"
#include "convert/import_process.h"
#include "formats/core/file.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;

Result<std::vector<std::uint32_t>> find_roots(const gltf::Document& document, int wanted, Context& context) {
  const int count = static_cast<int>(document.scenes.size());
  if (wanted >= count)
    return fail(ErrorCode::kUsage, document.file, "scene {} was asked for, the file has {}", wanted, count);
  if (count > 0) {
    const int taken = wanted >= 0 ? wanted : std::max(0, document.default_scene);
    const gltf::SceneDesc& scene = document.scenes[static_cast<std::size_t>(taken)];
    if (count > 1 && wanted < 0)
      context.warning("scene-chosen",
                      fmt::format("the file has {} scenes: number {}{} is taken, --scene takes another", count, taken,
                                  scene.name.empty() ? "" : fmt::format(", \"{}\",", scene.name)));
    return scene.nodes;
  }
  std::vector<std::uint32_t> roots;
  for (std::uint32_t i = 0; i < document.nodes.size(); ++i)
    if (document.nodes[i].parent < 0) roots.push_back(i);
  if (!roots.empty()) context.warning("scene-chosen", "the file has no scene: all of its nodes are taken");
  return roots;
}

// Puts all that is shown below a node that scales it, and returns that node.
std::uint32_t scale_document(double unit_m, const std::vector<std::uint32_t>& roots, gltf::Document& document) {
  const auto unit = static_cast<std::uint32_t>(document.nodes.size());
  for (const std::uint32_t root : roots) document.nodes[root].parent = static_cast<std::int32_t>(unit);
  gltf::NodeDesc node;
  node.has_matrix = true;
  for (int axis = 0; axis < 3; ++axis) node.matrix[axis][axis] = unit_m;
  node.children = roots;
  document.nodes.push_back(std::move(node));
  for (Light& light : document.lights)
    if (light.type != LightType::kDirectional)
      light.intensity *= static_cast<float>(unit_m * unit_m), light.color *= static_cast<float>(unit_m * unit_m);
  for (SceneMaterial& material : document.materials)
    material.absorption /= static_cast<float>(unit_m), material.thickness_m *= static_cast<float>(unit_m);
  for (gltf::CameraDesc& camera : document.cameras) camera.half_height *= unit_m;
  return unit;
}

// Loads the images that the placed surfaces' materials use, in the order of the document.
class ImageLoader {
 public:
  ImageLoader(const gltf::Document& document, const gltf::BufferStore& buffers, const fs::path& folder,
              gltf::MemoryBudget& budget, ImportedScene& out)
      : document_(document), buffers_(buffers), folder_(folder), budget_(budget), out_(out) {}

  Status load(const ImportedScene* last, Context& context) {
    find_used();
    ORIEL_TRY_VOID(read(context));
    std::vector<Result<Image>> decoded(sources_.size(), tl::unexpected<Error>(Error{}));
    if (!sources_.empty())
      ORIEL_TRY_VOID(parallel_for(context, "images", sources_.size(),
                                  [&](std::size_t i) { decoded[i] = decode(sources_[i], last); }));
    std::vector<std::int32_t> scene_image(document_.images.size(), -1);
    for (std::size_t i = 0; i < decoded.size(); ++i) {
      if (!decoded[i] && decoded[i].error().code != ErrorCode::kInvalid)
        return tl::unexpected<Error>(decoded[i].error());
      if (!decoded[i]) {
        warn(decoded[i].error(), context);
        continue;
      }
      scene_image[sources_[i].image] = static_cast<std::int32_t>(out_.scene.images.size());
      out_.scene.images.push_back(std::move(*decoded[i]));
      out_.image_files.push_back(sources_[i].hash);
    }
    for (SceneMaterial& material : out_.scene.materials)
      for (TextureSlot* slot : texture_slots(material))
        if (slot->image >= 0) slot->image = scene_image[static_cast<std::size_t>(slot->image)];
    return {};
  }

 private:
  struct Source {
    std::size_t image;  // of the document
    std::string where, name;
    std::span<const std::byte> bytes;
    Hash128 hash = {};
  };

  static Result<Image> decode(Source& source, const ImportedScene* last) {
    Hasher hasher;
    hasher.add(source.bytes);
    source.hash = hasher.result();
    for (std::size_t i = 0; last != nullptr && i < last->image_files.size(); ++i) {
      if (last->image_files[i] != source.hash) continue;
      Image known = last->scene.images[i];
      known.name = source.name;
      return known;
    }
    Result<Image> image = decode_image(source.bytes, source.where);
    if (image) image->name = source.name;
    return image;
  }

  void find_used() {
    used_.assign(document_.images.size(), false);
    for (const Surface& surface : out_.scene.surfaces)
      for (const TextureSlot* slot : texture_slots(out_.scene.materials[surface.material]))
        if (slot->image >= 0) used_[static_cast<std::size_t>(slot->image)] = true;
  }

  void warn(const Error& error, Context& context) const {
    context.warning("missing-texture", error.text() + ": the texture is left out");
  }

  // The bytes of each image, and the memory that it will need.
  Status read(Context& context) {
    storage_.reserve(document_.images.size());  // sources point into it
    for (std::size_t i = 0; i < document_.images.size(); ++i) {
      if (!used_[i]) continue;
      const gltf::ImageDesc& desc = document_.images[i];
      const std::string where = fmt::format("{}: images[{}]", document_.file, i);
      Result<std::span<const std::byte>> bytes = bytes_of(desc, where);
      if (bytes) {
        const auto size = image_size(*bytes, where);
        if (size) ORIEL_TRY_VOID(budget_.take(std::uint64_t{4} * size->width * size->height, where));
        if (!size) bytes = tl::unexpected<Error>(size.error());
      }
      if (!bytes)
        warn(bytes.error(), context);
      else
        sources_.push_back({i, where, desc.name.empty() ? fmt::format("image {}", i) : desc.name, *bytes});
    }
    return {};
  }

  Result<std::span<const std::byte>> bytes_of(const gltf::ImageDesc& desc, const std::string& where) {
    if (desc.view >= 0) return buffers_.view(desc.view);
    if (!desc.uri) return invalid(where, "found neither uri nor bufferView, expected one of them");
    auto loaded = gltf::is_data_uri(*desc.uri) ? gltf::decode_data_uri(*desc.uri, where)
                                               : gltf::read_external(*desc.uri, folder_, where, budget_, out_.inputs);
    if (!loaded) return tl::unexpected<Error>(std::move(loaded).error());
    return std::span<const std::byte>(storage_.emplace_back(std::move(*loaded)));
  }

  const gltf::Document& document_;
  const gltf::BufferStore& buffers_;
  const fs::path& folder_;
  gltf::MemoryBudget& budget_;
  ImportedScene& out_;
  std::vector<bool> used_;  // by image of the document
  std::vector<Bytes> storage_;
  std::vector<Source> sources_;
};

// Whether a surface is one of the last scene's: its triangles, and whether it has a back.
bool is_known(const Scene& scene, std::size_t surface, const Scene& last) {
  if (surface >= last.surfaces.size()) return false;
  const Surface &a = scene.surfaces[surface], &b = last.surfaces[surface];
  const auto triangles = [](const Scene& of, const Surface& s) {
    return std::span(of.triangles).subspan(s.first_triangle, s.triangle_count);
  };
  const auto places = [](const Scene& of, const Surface& s) {
    return std::span(of.positions).subspan(s.first_vertex, s.vertex_count);
  };
  const auto same = [&](const UVec3& x, const UVec3& y) { return x - a.first_vertex == y - b.first_vertex; };
  return a.name == b.name && scene.materials[a.material].double_sided == last.materials[b.material].double_sided &&
         std::ranges::equal(triangles(scene, a), triangles(last, b), same) &&
         std::ranges::equal(places(scene, a), places(last, b));
}

// Advice about meshes in the scene; each mesh once, however often it is placed, and none that the last scene has.
void warn_of_topology(const Scene& scene, const Scene* last, Context& context) {
  std::set<std::string> seen;
  WarningGroup odd(context,
                   "surfaces with edges of more than two triangles or triangles that face against their neighbours",
                   "facing-apart");
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    if (last != nullptr && is_known(scene, i, *last)) continue;
    if (!seen.insert(fmt::format("{}\n{}\n{}", surface.mesh_name, surface.material, surface.triangle_count)).second)
      continue;
    if (context.stopped()) return;
    if (surface.triangle_count > kMaxSoupTriangles) {
      context.warning("not-oriented", fmt::format("surface \"{}\" has {} triangles: its orientation was not checked",
                                                  surface.name, surface.triangle_count));
      continue;
    }
    const SoupReport report = inspect_soup(welded_corners(scene, surface));
    const bool back_matters = !scene.materials[surface.material].double_sided && report.misoriented_triangles > 0;
    if (!back_matters && report.non_manifold_edges == 0) continue;
    std::string text;
    if (back_matters)
      text = fmt::format("{} of {} triangles face against their neighbours and show their back",
                         report.misoriented_triangles, surface.triangle_count);
    if (report.non_manifold_edges > 0)
      text += fmt::format("{}{} edges are shared by more than two triangles", text.empty() ? "" : ", ",
                          report.non_manifold_edges);
    odd.add(fmt::format("surface \"{}\": {}", surface.name, text),
            back_matters ? WarningCode("facing-apart") : WarningCode("shared-edges"));
  }
  odd.finish();
}

// The bytes of a glTF: the file's own, or made of it. Its hash goes into `inputs`.
Result<Bytes> read_scene_file(const fs::path& path, std::uint64_t max_bytes, gltf::InputHashes& inputs,
                              Context& context, bool quiet = false) {
  std::error_code ec;
  const auto status = fs::status(path, ec);
  // Pipes and devices could block for ever.
  if (fs::exists(status) && !fs::is_regular_file(status))
    return fail(ErrorCode::kIo, path.string(), "is no regular file, expected a .gltf or .glb");
  ORIEL_TRY(Bytes bytes, read_file(path, max_bytes));
  inputs.emplace_back(path.filename().string(), hash128_hex(bytes));
  ORIEL_TRY(const auto foreign, source_format(path, bytes));
  if (!foreign) return bytes;
  ImportProcess process;
  process.warn = [&](const std::string& text) {
    if (!quiet) context.warning(text.starts_with("texture ") ? WarningCode("missing-texture") : "converted", text);
  };
  process.stopped = [&] { return context.stopped(); };
  process.read = [&](const fs::path& file) {
    if (const auto other = read_file(file, max_bytes))
      inputs.emplace_back(file.lexically_proximate(fs::absolute(path).parent_path()).string(), hash128_hex(*other));
  };
  return import_by_process(path, *foreign, process);
}

Result<ImportedScene> import_checked(const fs::path& path, const ImportOptions& options, Context& context,
                                     const ImportedScene* last) {
  ImportedScene out;
  ORIEL_TRY(const Bytes bytes, read_scene_file(path, options.max_bytes, out.inputs, context));
  gltf::MemoryBudget budget(options.max_bytes);
  const std::string file = path.filename().string();
  ORIEL_TRY_VOID(budget.take(bytes.size(), file));
  ORIEL_TRY(const gltf::Container container, gltf::split_container(bytes, file));
  ORIEL_TRY(gltf::JsonDocument json, gltf::JsonDocument::parse(container.json, file));
  ORIEL_TRY(gltf::Document document, gltf::parse_document(json));
  for (const std::string& warning : container.warnings) context.warning("file-damaged", warning);
  for (const Warning& warning : document.warnings) context.warning(warning);
  const fs::path folder = path.parent_path();
  ORIEL_TRY(const gltf::BufferStore buffers, gltf::BufferStore::load(document, container, folder, budget, out.inputs));
  gltf::AccessorReader accessors(document, buffers, budget);
  ORIEL_TRY(const std::vector<gltf::LoadedMesh> meshes, gltf::load_meshes(document, buffers, accessors, context));
  ORIEL_TRY(std::vector<std::uint32_t> roots, find_roots(document, options.scene, context));
  ORIEL_TRY_VOID(gltf::hand_down_keys(options.objects, roots, document));
  if (options.unit_m != 1) roots = {scale_document(options.unit_m, roots, document)};
  ORIEL_TRY(PosedNodes nodes, pose_nodes(document, roots));
  out.scene.materials = document.materials;
  nodes.movers = find_movers(nodes, context);
  ORIEL_TRY_VOID(place_meshes(nodes, meshes, accessors, options.most_triangles, {out.scene, context}));
  join_seams(out.scene);
  if (options.double_sided)
    for (SceneMaterial& material : out.scene.materials) material.double_sided = true;
  ORIEL_TRY_VOID(ImageLoader(document, buffers, folder, budget, out).load(last, context));
  find_opaque(out.scene);
  separate_layers(out.scene, context);
  find_solids(out.scene, context);
  std::vector<std::uint32_t> moving = nodes.movers.nodes;
  for (const NodePose& pose : nodes.poses)
    if (document.nodes[pose.node].camera >= 0) moving.push_back(pose.node);
  ORIEL_TRY(const std::vector<Animation> animations, load_animations(document, moving, accessors, context));
  ORIEL_TRY_VOID(place_viewpoints(nodes, animations, out.scene, context));
  ORIEL_TRY_VOID(place_movers(nodes, animations, out.scene, context));
  ORIEL_TRY_VOID(move_nodes(options.moves, out.scene));
  ORIEL_TRY_VOID(apply_lighting(options, budget, out, context));
  warn_of_topology(out.scene, last != nullptr ? &last->scene : nullptr, context);
  if (context.stopped()) return fail(ErrorCode::kStopped, file, "stopped");
  return out;
}

}  // namespace

Result<ImportedScene> import_gltf(const fs::path& path, const ImportOptions& options, Context& context,
                                  const ImportedScene* last) {
  try {
    return import_checked(path, options, context, last);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kRuntime, path.string(), "not enough memory to import the scene");
  } catch (const std::exception& e) {
    return fail(ErrorCode::kRuntime, path.string(), "the import failed: {}", e.what());
  }
}

Result<gltf::InputHashes> hash_inputs(const fs::path& path, const ImportOptions& options, Context& context) {
  gltf::InputHashes inputs;
  ORIEL_TRY(const Bytes bytes, read_scene_file(path, options.max_bytes, inputs, context, true));
  const std::string file = path.filename().string();
  ORIEL_TRY(const gltf::Container container, gltf::split_container(bytes, file));
  ORIEL_TRY(gltf::JsonDocument json, gltf::JsonDocument::parse(container.json, file));
  gltf::MemoryBudget budget(std::numeric_limits<std::uint64_t>::max());
  for (const char* list : {"buffers", "images"})
    for (std::size_t i = 0; i < json.root()[list].size(); ++i)
      if (const std::string uri = json.root()[list].at(i)["uri"].text(); !uri.empty() && !gltf::is_data_uri(uri))
        (void)gltf::read_external(uri, path.parent_path(), file, budget, inputs);  // the import tells what is missing
  std::vector<fs::path> others{options.sky_file};
  for (const auto& [node, profile] : options.ies) others.push_back(profile);
  for (const fs::path& other : others)
    if (const auto found = read_file(other)) inputs.emplace_back(other.filename().string(), hash128_hex(*found));
  return inputs;
}

}  // namespace oriel
