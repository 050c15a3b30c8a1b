// Packs of which most bytes stay in the file until somebody wants them: the pixels of radiance maps, which are nine
// tenths of a pack with reflections, and of which a picture shows few.
#pragma once

#include <memory>

#include "formats/core/file.h"
#include "formats/pack/index.h"
#include "formats/pack/pack.h"

namespace oriel {

// The maps of a pack file that was mapped. All functions may be called from any thread.
class DeferredMaps {
 public:
  // sections: those of the radiance maps, in order.
  DeferredMaps(MappedFile file, std::string path, std::vector<SectionInfo> sections)
      : file_(std::move(file)), path_(std::move(path)), sections_(std::move(sections)) {}

  // Pack::radiance_maps[map] with its pixels, decoded and checked as read_pack does; without `residual`. Errors:
  // kInvalid names the file, the section, what was found and what was expected; kRuntime.
  Result<RadianceMap> load(std::size_t map) const;

 private:
  MappedFile file_;
  std::string path_;
  std::vector<SectionInfo> sections_;
};

struct DeferredPack {
  Pack pack;                                 // the arrays of its radiance maps are empty where maps is not null
  std::shared_ptr<const DeferredMaps> maps;  // null: all is in the pack
};

// As read_pack (reader.h): all checksums are compared and all numbers are checked, but for the meaning of deferred
// pixels, which load() checks.
Result<DeferredPack> read_pack_deferred(const std::filesystem::path& path);

}  // namespace oriel
