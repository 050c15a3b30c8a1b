// The files of `oriel-inspect extract`.
#pragma once

#include <filesystem>
#include <string>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/image/exr.h"
#include "formats/image/png.h"
#include "formats/pack/pack.h"

namespace oriel::inspect {

// One file after another into the folder; index.json lists those that were written.
class Extraction {
 public:
  Extraction(const Pack& pack, std::filesystem::path folder) : pack_(pack), folder_(std::move(folder)) {
    index_ = Json::array();
  }

  Status lightmaps();
  Status radiance_maps();
  Status surround_maps();
  Status sky_map();
  Status kernels();
  Status fresnel_maps();
  Status textures();
  Status walk_grids();
  Status finish(const std::filesystem::path& source);

 private:
  Status exr(Json& entry, const char* role, const std::string& name, const FloatImage& image, const char* unit) {
    entry["files"][role] = name;
    return write_exr(folder_ / name, image, {{"oriel:role", role}, {"oriel:unit", unit}});
  }
  Status png(Json& entry, const char* role, const std::string& name, const ByteImage& image) {
    entry["files"][role] = name;
    return write_png(folder_ / name, image);
  }
  Status csv(Json& entry, const char* role, const std::string& name, const std::string& text) {
    entry["files"][role] = name;
    return write_file_atomically(folder_ / name, bytes_of_text(text));
  }
  Status images(const char* kind, const char* role, const std::vector<Texture>& textures);
  Status kernel_slices(const BrdfKernel& kernel, const std::string& name, Json& entry);

  const Pack& pack_;
  std::filesystem::path folder_;
  Json index_;
};

}  // namespace oriel::inspect
