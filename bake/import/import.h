// glTF 2.0 files into a Scene.
#pragma once

#include <filesystem>
#include <optional>

#include "bake/import/object_keys.h"
#include "bake/jobs/context.h"
#include "bake/scene/daylight.h"
#include "formats/core/hash.h"
#include "formats/query/mover_pose.h"

namespace oriel {

// Makes lamps, or what shines of itself, brighter.
struct LightScale {
  std::string names;  // which, with * and ? as in fits_pattern(); empty: all
  double factor = 1;  // >= 0
};

struct ImportOptions {
  int scene = -1;                  // which scene of the file; -1: its default, else the first
  Vec3 sky{0};                     // constant sky radiance, cd/m²; not read with a sky_file
  std::filesystem::path sky_file;  // .hdr or .exr, latitude-longitude (see SkyImage); empty: none
  // Without any of these: a clear sky to the file's sun (add_clear_sky). What programs do where nobody says otherwise;
  // off here, for who builds a scene has named all of its light.
  bool clear_sky = false;
  float sky_scale = 1;                 // cd/m² per unit of that file
  float sky_rotation_deg = 0;          // counter-clockwise seen from above
  std::optional<float> sun_angle_deg;  // angular diameter of every directional light, 0 to 180
  DayOptions day;                      // instead of a sky
  std::vector<ObjectRule> objects;     // over what the file says of its nodes
  std::vector<MoverMove> moves;        // where movers and lamps are instead (move_nodes)
  double unit_m = 1;                   // metres that one unit of the file is. Light stays what it is on surfaces:
                                       // point and spot lights shine with the square of it
  bool double_sided = false;           // every material reflects and emits on both sides, whatever the file says
  // Node (or light) name and IES file: the profile of its point or spot light.
  std::vector<std::pair<std::string, std::filesystem::path>> ies;
  std::vector<LightScale> lamp_scales;                // by name of node or light; without names: of points and spots
  std::vector<LightScale> emission_scales;            // by name of material
  std::uint64_t max_bytes = std::uint64_t{16} << 30;  // refuse files and allocations beyond it
  std::uint64_t most_triangles = 0;  // with all instances; of more, repeated meshes get fewer. 0: no limit
};

struct ImportedScene {
  Scene scene;
  std::vector<std::pair<std::string, std::string>> inputs;  // file name (relative to the scene file) and its XXH3-128
  std::vector<Hash128> image_files = {};                    // by Scene::images: of the bytes that hold it
};

// The hashes of all files that an import may read, quickly: of the scene, its buffers and images, sky and profiles.
Result<std::vector<std::pair<std::string, std::string>>> hash_inputs(const std::filesystem::path& path,
                                                                     const ImportOptions& options, Context& context);

// Reads a .gltf (external or embedded buffers and images) or a .glb. The file is told by its first bytes, not its name.
// Everything is validated: JSON depth and types, every index, bounds, finite numbers, node cycles. Degenerate triangles
// are dropped with one warning per mesh, a non-finite vertex is an error; what is not supported gets one warning
// each through context.warning. Errors: kIo where a file cannot be read, kInvalid where the content breaks glTF 2.0
// (found, expected and where) or requires an extension that Oriel does not know; those of apply_lighting.
//
// last: what was read before, of a file that was saved again; null: nothing. Images that it has are not decoded again,
// and advice about meshes that it has is not given again.
Result<ImportedScene> import_gltf(const std::filesystem::path& path, const ImportOptions& options, Context& context,
                                  const ImportedScene* last = nullptr);

}  // namespace oriel
