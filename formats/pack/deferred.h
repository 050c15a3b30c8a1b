// Packs of which most bytes stay in the file until somebody wants them: textures, lightmap pages, radiance and surround
// maps. What a first frame needs of them is how large they are.
#pragma once

#include <atomic>
#include <memory>

#include "formats/core/file.h"
#include "formats/pack/half_page.h"
#include "formats/pack/index.h"
#include "formats/pack/pack.h"

namespace oriel {

// The images of a pack's file, which is read when they are wanted. All functions may be called from any thread. Errors:
// kInvalid names the file, the section, what was found and what was expected; kIo where the file became shorter
// meanwhile; kRuntime. A file that was overwritten meanwhile gives one of them too: each section has its checksum, and
// must be of the size that it had.
class DeferredImages {
 public:
  // pack: decoded from the file, with images that have their sizes only. flags: of each lightmap page.
  DeferredImages(OpenFile file, std::vector<SectionInfo> sections, const Pack& pack, std::vector<LightmapFlags> flags);

  // Pack::textures[i] and so on, decoded and checked as read_pack does.
  Result<Texture> texture(std::size_t i) const;
  Result<Texture> normal_texture(std::size_t i) const;
  Result<LightmapPage> lightmap(std::size_t i) const;
  Result<RadianceMap> radiance_map(std::size_t i) const;
  Result<SurroundMap> surround_map(std::size_t i) const;
  // Of a lightmap page what lights surfaces: half of its bytes, and nothing is computed.
  Result<HalfPage> light(std::size_t i) const;
  bool directional(std::size_t page) const { return flags_[page].directional; }

  // All sections of the file, those too that are no images: compares the checksum.
  std::size_t sections() const { return sections_.size(); }
  Status check(std::size_t section) const;
  // Whether that was done already: when the pack was opened, for an image, or by check(). Whatever was found.
  bool was_checked(std::size_t section) const { return checked_[section]; }
  const SectionInfo& section(std::size_t i) const { return sections_[i]; }
  std::uint64_t file_bytes() const { return file_.size(); }

 private:
  std::size_t of(std::uint32_t kind, std::size_t nth) const;  // into sections_
  template <class Image>
  Result<Image> load(std::uint32_t kind, std::size_t nth) const;

  OpenFile file_;
  std::vector<SectionInfo> sections_;
  std::vector<IVec2> sizes_;                       // of images, by section
  std::vector<IVec2> details_;                     // of pages' details, by page
  std::vector<std::vector<std::size_t>> by_kind_;  // into sections_, in the order of kSectionKinds
  std::vector<LightmapFlags> flags_;               // by page
  std::vector<std::uint8_t> sharp_records_;        // by word (issues.h)
  std::unique_ptr<std::atomic<bool>[]> checked_;   // by section
};

struct DeferredPack {
  Pack pack;                                     // the arrays of its images are empty where `images` is not null
  std::shared_ptr<const DeferredImages> images;  // null: all is in the pack
};

// Opens a pack: reads the table, all that is no image, and how large images are. Errors as read_pack's (reader.h), for
// what was read; a damaged image is found when it is wanted, or by DeferredImages::check.
Result<DeferredPack> open_pack(const std::filesystem::path& path);

}  // namespace oriel
