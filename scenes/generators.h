// The sample scenes.
#pragma once

#include <array>

#include "formats/core/result.h"
#include "scenes/kit/scene_builder.h"

namespace oriel::sample {

// The Cornell box from its published measurements (Cornell University Program of Computer Graphics, "The Cornell Box",
// data of 1998), a thousandth of a unit being a millimetre: 0.55 m a side, open to the front, 38 diffuse triangles. The
// light fills a hole in the ceiling.
SampleScene make_cornell();

// The three kinds of scene of Udeshi and Hansen, "Towards Interactive Photorealistic Rendering of Indoor Scenes", EGWR
// 1999, of as many polygons. An office of 4083 with four workplaces and two ceiling panels; a
// classroom of 3135 rectangles with four lamps, where the teacher's table is polished and almost every edge throws a
// shadow; and the Cornell box of 217 with a glass sphere of 200, whose short block has a mirror for a top.
SampleScene make_office();
SampleScene make_classroom();
SampleScene make_glass_sphere();

// Three connected rooms of a small museum: A with fluted columns and a polished floor, B with a mirror, stairs and a
// window, C lit only through its doorway. Closed; 20 to 60 thousand triangles; a 600-frame walk.
struct GalleryOptions {
  float floor_roughness = 0.1f;  // of the tiles, [0, 1]
};
SampleScene make_gallery(const GalleryOptions& options = {});

// A closed room with curved metal: a mirror ball and a brushed one, both on the floor, and a standing lamp.
SampleScene make_studio();

// A closed room of 3 m with bodies of glass before coloured posts: a green block, a clear ball, a frosted screen.
SampleScene make_glass();

// A furnished room, 6 m a side and 2.7 m high, diffuse, twelve thousand triangles. Closed, it has a ceiling panel
// and no camera; a room in a landscape has a window instead, and a camera.
struct RoomOptions {
  bool closed = true;
  bool surroundings = true;  // of a room in a landscape: its ground and sky
};
// The ground is a square of kGroundSide, the sky a dome of kDomeRadius around the room that emits kSkyLuminance evenly.
inline constexpr float kGroundSide = 1000, kDomeRadius = 1000;  // metres
inline constexpr float kSkyLuminance = 3000;                    // cd/m²
inline constexpr float kGroundReflectance = 0.2f;
SampleScene make_room(const RoomOptions& options = {});

// A closed room of 8 m by 4 m, 2.7 m high, of what stands little proud of what is behind it: along one wall four
// sections with a panel on the wall, a board hung before it (half of how far it stands out is a gap) and a skirting,
// 1, 5, 10 and 20 mm proud; pictures in frames, a carpet, a cornice, a cupboard on a plinth. A camera for each kind of
// edge. Diffuse; its light is a wide window and a ceiling panel, so that no hard shadow falls along an edge.
SampleScene make_panels();
inline constexpr std::array<int, 4> kProud_mm{1, 5, 10, 20};

struct HouseOptions {
  std::uint64_t triangles = 100'000;
  int reflectors = 5;
};
inline constexpr int kMaxHouseReflectors = 36;

// A closed house of two storeys with six rooms each, stairs, windows and furniture whose tessellation makes the number
// of triangles (within 10 %), and `reflectors` planar reflectors: mirrors, polished floors and table tops in turn; a
// 600-frame walk. Errors: kUsage for triangles below what the house needs at least or above 20 million, or
// reflectors out of [0, kMaxHouseReflectors].
Result<SampleScene> make_house(const HouseOptions& options);

}  // namespace oriel::sample
