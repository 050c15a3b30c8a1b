// Images of a pack, made ready for the device in any thread.
#pragma once

#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <span>

#include "formats/pack/deferred.h"
#include "player/images/image_data.h"
#include "player/images/map_array.h"
#include "player/images/map_choice.h"
#include "player/images/map_light.h"
#include "player/images/sharp_texels.h"
#include "player/images/surround_pyramid.h"

namespace oriel {

enum class ImageKind { kColor, kNormal, kLight, kMaps, kSurround };

// index: into Pack::textures, normal_textures, lightmaps, reflectors (all maps of one) and surround_maps.
struct ImageName {
  ImageKind kind = ImageKind::kColor;
  std::uint32_t index = 0;
};

struct PreparedImage {
  std::vector<TextureData> textures;  // light: it, directions, cells and details, sharp_at; maps: light, disparity and
                                      // ranges of each element
  float scale = 0, mean_lux = 0;      // of light
  bool directional = false, detailed = false, sharp = false;  // of light: what of it there is
  std::uint64_t lights = 0;                    // of light and maps: ImageSource::lights() that it was made for
  std::uint64_t geometry = 0;                  // of maps: ImageSource::geometry(), likewise
  std::vector<std::vector<float>> map_scales;  // of maps, by element and layer
  std::vector<std::vector<IVec2>> map_sizes;
  Vec3 mean_radiance{0};      // of maps
  SurroundTextures surround;  // without its textures
  Texture texture;            // of colours that were deferred, as in the pack

  std::size_t bytes() const;  // on the device
};

class ImageSource {
 public:
  // elements: by reflector. What is not deferred lies in `pack`, which then stays as it is, as do its mesh and its
  // reflectors.
  ImageSource(const Pack& pack, std::shared_ptr<const DeferredImages> deferred,
              std::vector<std::vector<ReflectorElement>> elements);

  // Pages of light are made of groups of lamps that shine so many times as they were baked, and of that, from now on;
  // maps show these pages.
  // Not while prepare() runs for anyone who cannot tell by PreparedImage::lights that it came too late.
  void set_lights(std::span<const Vec3> factors, MapFactors of_maps, std::shared_ptr<const PageChanges> changes);
  std::uint64_t lights() const;    // rises with each change
  std::uint64_t geometry() const;  // MapFactors::geometry
  // A group's own light of a page, as it was baked. Errors as prepare().
  Result<PageChange> light_of_group(std::uint32_t page, std::size_t group) const;
  // Its sharp light beside that, of a page as whole_page() has it; by point. Empty: the page has none.
  std::vector<Vec3> sharp_of_group(const LightmapPage& page, std::span<const PagePoint> points,
                                   std::size_t group) const;
  // A page with all that the bake knows of its texels, as it was baked.
  Result<LightmapPage> whole_page(std::uint32_t page) const;
  // The same with the irradiance of lamps as they shine now; standard errors keep their share of it. lights: for which.
  Result<LightmapPage> lit_page(std::uint32_t page, std::uint64_t& lights) const;

  // coarser: halvings of the texels a side, up to coarsest(). Errors of DeferredImages; kRuntime without memory.
  Result<PreparedImage> prepare(const ImageName& name, int coarser) const;
  int coarsest(const ImageName& name) const;
  std::size_t bytes(const ImageName& name, int coarser) const;
  // The same of maps without all but the light, where that alone changes.
  Result<PreparedImage> prepare_light(const ImageName& maps, int coarser) const;
  std::size_t light_bytes(const ImageName& maps, int coarser) const;
  // They are not wanted any more: what is kept for their light to follow lamps is dropped.
  void forget(const ImageName& maps) const;

  // What is being prepared in other threads ends soon, with kStopped.
  void abandon() { *abandoned_ = true; }

  const DeferredImages* deferred() const { return deferred_.get(); }
  std::array<std::size_t, 5> counts() const;  // by ImageKind

 private:
  enum class Parts { kAll, kLight };
  using LightOfMaps = std::shared_ptr<const MapLights>;  // null: as baked
  Result<PreparedImage> guarded(const ImageName& name, int coarser, Parts parts) const;
  Result<PreparedImage> make(const ImageName& name, int coarser, Parts parts) const;
  // What shines otherwise than it was baked, of a page.
  struct Otherwise {
    std::vector<Vec3> factors;
    std::shared_ptr<const PageChanges> added;
    const PageGroups* groups = nullptr;  // null: the factors change nothing
    const PageChange* change = nullptr;  // null: nothing is added
    std::vector<Vec3> sharp;             // MapFactors::sharp
  };
  // As lamps shine, at one time.
  struct Shining {
    std::uint64_t changes = 0;
    std::vector<Vec3> factors, sharp;  // sharp: MapFactors::sharp
    std::shared_ptr<const PageChanges> added;
  };
  Otherwise otherwise(std::uint32_t page, std::uint64_t& lights) const;
  Otherwise otherwise(std::uint32_t page, const Shining& now) const;
  Result<LightmapPage> make_lit_page(std::uint32_t page, std::uint64_t& lights) const;
  Result<HalfPage> light_of_page(std::uint32_t page, const Otherwise& of) const;
  Result<std::shared_ptr<const HalfPage>> baked_page(std::uint32_t page) const;
  Result<PreparedImage> make_maps(std::uint32_t reflector, int coarser, Parts parts) const;
  Result<PreparedImage> make_surround(std::uint32_t index, Parts parts) const;
  Result<RadianceMap> radiance_map(std::uint32_t index) const;
  std::vector<IVec2> map_sizes(const ReflectorElement& element, int coarser) const;
  LightOfMaps light_of_maps(PreparedImage& of) const;
  std::vector<Vec3> sharp_of_page(std::uint32_t page, const HalfPage& light, std::span<const Vec3> factors) const;
  LightOfMaps make_light_of_maps(const Shining& now, const MapFactors& of_maps) const;
  const Pack* baked_ = nullptr;  // what of it is never deferred
  const Pack* pack_ = nullptr;   // null where images are deferred
  std::shared_ptr<const DeferredImages> deferred_;
  std::vector<std::vector<ReflectorElement>> elements_;
  std::span<const PageGroups> page_groups_;
  std::vector<std::vector<Material>> users_;  // by texture
  std::vector<IVec2> textures_, normal_textures_, pages_, details_, maps_;
  std::vector<bool> directional_, sharp_;  // by page; sharp_: it may be
  std::vector<std::uint32_t> surrounds_;
  // What lamps shine now, and pages as they were baked, once any shines otherwise.
  struct Lights {
    std::mutex mutex;
    Shining now;
    std::map<std::uint32_t, std::shared_ptr<const HalfPage>> baked;
    MapFactors of_maps;
  };
  // What maps follow, for the last lights that were asked for.
  struct Followed {
    std::mutex mutex;
    std::uint64_t lights = ~0ull;
    LightOfMaps light;
    std::shared_ptr<const std::vector<LightmapPage>> baked;
  };
  std::unique_ptr<Lights> lights_ = std::make_unique<Lights>();
  std::unique_ptr<Followed> followed_ = std::make_unique<Followed>();
  std::unique_ptr<MapLight> map_light_;
  std::unique_ptr<std::atomic<bool>> abandoned_ = std::make_unique<std::atomic<bool>>(false);
};

}  // namespace oriel
