// The images of a pack on the device: which of them are there, how fine, and how the others get there beside the
// drawing.
#pragma once

#include <chrono>
#include <map>
#include <set>

#include "player/images/background.h"
#include "player/images/image_source.h"
#include "player/images/loading_state.h"
#include "player/images/residency.h"

namespace oriel {

// Half floats of irradiance / scale (image_data.h). Without light: scale 0.
struct LoadedLightmap {
  gpu::Texture2d texture;
  float scale = 0;
  gpu::Texture2d direction;      // of a directional lightmap, else empty
  gpu::Texture2d cells, detail;  // where it has finer cells, else empty
  gpu::Texture2d sharp_at;       // where it has sharp light, else empty; its size is the page's as baked
};

// All maps of a reflector.
struct ReflectorMaps {
  std::vector<MapArray> elements;
  Vec3 mean_radiance{0};
};

struct LoadingOptions {
  // Images come from other threads while frames are drawn; until then something stands for them. Else who asks waits.
  bool background = false;
  std::uint64_t limit = kNoLimit;  // bytes of images on the device
};

// A box in which an image is seen.
struct ImageUse {
  ImageName image;
  Bounds bounds;              // pack space
  std::uint32_t group = ~0u;  // of VisibleSets
};

class SceneImages {
 public:
  using Clock = std::chrono::steady_clock;

  // uses: where each colour texture, normal texture and page of light is seen, and what there is of maps. Images
  // without a use come last.
  SceneImages(ImageSource source, const std::vector<ImageUse>& uses, const LoadingOptions& options);

  ~SceneImages() { source_.abandon(); }
  SceneImages(const SceneImages&) = delete;
  SceneImages& operator=(const SceneImages&) = delete;

  // All that is wanted, now or until then; the first errors otherwise.
  std::vector<Error> finish(Clock::time_point until = Clock::time_point::max());
  // What is near or in view of the eye comes first, from now on. seen: by group.
  void prioritise(const Vec3& eye, const Frustum& frustum, const std::vector<std::uint8_t>* seen);
  // Brings what was made ready meanwhile to the device, for about so long, and lets more be made ready. Where nothing
  // is left to do in the background, compares checksums of what nobody wanted. Errors of images and sections, each
  // once.
  std::vector<Error> advance(Clock::duration budget);
  // Maps are only brought once somebody wants them.
  void want(const ImageName& maps);
  // Within a limit maps that nobody wants any more may leave: in the background those that nobody wanted since the last
  // call, else all that nobody wants after it.
  void begin_wants();
  bool has(const ImageName& name) const { return at(name).level >= 0; }
  // Whether maps that are there show lamps as they shine now.
  bool is_lit(const ImageName& maps) const {
    return at(maps).lights == source_.lights() && at(maps).geometry == geometry_of(maps);
  }
  // Whether any came to do so in the background since a frame was begun.
  bool has_light_news() const { return light_came_; }
  void begin_frame() { light_came_ = false; }
  bool in_background() const { return options_.background; }

  // What stands for it where it is not there: grey, flat, the mean light of the others.
  const gpu::Texture2d& color(std::uint32_t index) const;
  const gpu::Texture2d& normal(std::uint32_t index) const;
  const LoadedLightmap& light(std::uint32_t index) const;
  const ReflectorMaps& maps(std::uint32_t reflector) const { return maps_[reflector]; }  // that has() says are there
  const SurroundTextures& surround(std::uint32_t index) const { return surrounds_[index]; }
  // A page with all that the bake knows of its texels, as lamps shine now, which only few ask for; in the background
  // null until it is there. in_pack: the pack's, which has it where it is not deferred.
  Result<const LightmapPage*> page(std::uint32_t index, const LightmapPage& in_pack);

  // Pages of light and maps show lamps that shine so many times as they were baked, by group; pages that are there at
  // once. Maps that are there follow: in the background one after the other, else once they are wanted and is_lit()
  // was seen to by finish(). added: what is added to pages, or null.
  Status set_lights(std::span<const Vec3> factors, MapFactors of_maps, std::shared_ptr<const PageChanges> added);

  LoadingState state() const;
  std::uint64_t map_bytes() const { return map_bytes_; }
  const ImageSource& source() const { return source_; }
  // Colours that came since the last call, for who wants their texels.
  std::vector<std::pair<std::uint32_t, Texture>> take_texels() { return std::exchange(texels_, {}); }

 private:
  struct Item {
    ImageName name;
    std::vector<std::uint64_t> bytes;  // by level
    float rank = 1e9f;
    bool wanted = true, asked_for = false;  // the latter: since begin_wants()
    bool failed = false;
    int level = -1;                          // on the device; -1: none
    int target = -1;                         // that it should have; -1: none
    int coming = -1;                         // being made ready or uploaded; -1: none
    std::uint64_t lights = 0, geometry = 0;  // of maps: ImageSource::lights() and so on that the level was made for
  };
  struct Made {
    std::size_t item = 0;
    int level = 0;
    bool again = false;        // maps that are there are made anew, for lamps
    bool light_alone = false;  // of these
    std::uint64_t bytes = 0;   // on the device, that were taken for it
    Result<PreparedImage> image = tl::unexpected<Error>(Error{});
  };
  struct Upload {
    std::size_t item = 0;
    int level = 0;
    bool again = false, light_alone = false;
    std::uint64_t bytes = 0;
    PreparedImage image;
    std::vector<TextureUpload> textures;
    std::size_t next = 0;
  };

  const Item& at(const ImageName& name) const { return items_[index_of(name)]; }
  std::size_t index_of(const ImageName& name) const { return first_[static_cast<std::size_t>(name.kind)] + name.index; }
  void plan();
  void drop(Item& item);
  void ask_for_more();
  bool wants_light(const Item& item) const;
  // Radiance maps are not shown while a lamp is elsewhere.
  std::uint64_t geometry_of(const ImageName& maps) const {
    return maps.kind == ImageKind::kMaps ? 0 : source_.geometry();
  }
  void begin(std::size_t item);
  void receive(std::vector<Error>& errors);
  void give_up(const Made& made, std::vector<Error>& errors);
  bool step_upload(Clock::time_point end);
  void check_more();
  void settle(Upload& upload);
  void settle_light(std::uint32_t index, PreparedImage& image, std::vector<TextureUpload>& textures);
  Status show_lights(std::uint32_t index);
  void settle_maps(Upload& upload);
  void settle_surround(Upload& upload);

  ImageSource source_;
  LoadingOptions options_;
  MemoryAccount account_;
  std::vector<Item> items_;
  std::array<std::size_t, 5> first_{};  // by kind, into items_
  std::vector<ImageUse> uses_;
  bool plan_is_due_ = true;
  std::size_t in_flight_ = 0;
  std::uint64_t bytes_in_flight_ = 0, again_in_flight_ = 0, map_bytes_ = 0;  // the second: of maps that are there
  bool light_came_ = false;                                                  // for these, and nobody has asked since
  std::vector<Upload> uploads_;
  std::vector<gpu::Texture2d> colors_, normals_;
  std::vector<LoadedLightmap> lights_;
  std::vector<ReflectorMaps> maps_;
  std::vector<SurroundTextures> surrounds_;
  struct KnownPage {
    Result<LightmapPage> page = tl::unexpected<Error>(Error{});
    std::uint64_t lights = 0;  // ImageSource::lights() that it was made for
  };
  std::map<std::uint32_t, KnownPage> pages_;
  std::set<std::uint32_t> coming_pages_;
  Mailbox<std::pair<std::uint32_t, KnownPage>> made_pages_;
  std::vector<Error> page_errors_;  // not told yet
  gpu::Texture2d grey_, flat_;
  LoadedLightmap some_light_;
  double lux_sum_ = 0;
  std::size_t lux_count_ = 0;
  std::vector<std::pair<std::uint32_t, Texture>> texels_;
  std::size_t next_check_ = 0;  // sections before it are checked
  bool checking_ = false;
  Mailbox<Made> made_;
  Mailbox<Status> checks_;
  Background background_;  // last: its threads end first
};

}  // namespace oriel
