// The sample scenes.
#pragma once

#include "formats/core/result.h"
#include "scenes/kit/scene_builder.h"

namespace oriel::sample {

// The Cornell box from its published measurements (Cornell University Program of Computer Graphics, "The Cornell Box",
// data of 1998), a thousandth of a unit being a millimetre: 0.55 m a side, open to the front, 38 diffuse triangles. The
// light fills a hole in the ceiling.
Scene make_cornell();

// Three connected rooms of a small museum: A with fluted columns and a polished floor, B with a mirror, stairs and a
// window, C lit only through its doorway. Closed; 20 to 60 thousand triangles; a 600-frame walk.
struct GalleryOptions {
  float floor_roughness = 0.1f;  // of the tiles, [0, 1]
};
Scene make_gallery(const GalleryOptions& options = {});

// A closed room with curved metal: a mirror ball and a brushed one, both on the floor, and a standing lamp.
Scene make_studio();

struct HouseOptions {
  std::uint64_t triangles = 100'000;
  int reflectors = 5;
};
inline constexpr int kMaxHouseReflectors = 36;

// A closed house of two storeys with six rooms each, stairs, windows and furniture whose tessellation makes the number
// of triangles (within 10 %), and `reflectors` planar reflectors: mirrors, polished floors and table tops in turn; a
// 600-frame walk. Errors: kUsage for triangles below what the house needs at least or above 20 million, or reflectors
// out of [0, kMaxHouseReflectors].
Result<Scene> make_house(const HouseOptions& options);
// How many triangles make_house would make.
Result<std::uint64_t> count_house(const HouseOptions& options);

}  // namespace oriel::sample
