// Movers: which nodes of a document they are, and their surfaces apart from the scene that stands still.
#pragma once

#include "bake/import/place.h"
#include "bake/import/tracks.h"
#include "formats/query/mover_pose.h"

namespace oriel {

// A mover is a node with the key mover, or one that an animation translates or turns and that is no camera's. It takes
// what is below it along, except other movers. Nodes that show no mesh are none (but animated ones that carry a light),
// with a warning where they were asked for.
MoverNodes find_movers(const PosedNodes& nodes, Context& context);

// Fills scene.movers out of place_meshes' surfaces, with the first animation that moves each. What shines of an
// animated one, and its point and spot lights, are lamps with a motion (Scene::lamp_motions). Without an animation a
// mover that shines stands still, and so do lights below a mover; both with a warning.
Status place_movers(const PosedNodes& nodes, std::span<const Animation> animations, Scene& scene, Context& context);

// A mover apart from the scene: its surfaces in object space. Materials and images have the scene's indices, which gets
// copies of those materials that movers share with it; images that it does not use are empty.
struct TakenMover {
  SceneMover mover;
  Scene scene;
};

// Takes the movers out of the scene; what is left has new bounds and its old origin. Error kInvalid where nothing would
// be left.
Result<std::vector<TakenMover>> take_movers(Scene& scene);

// Puts movers, with their nodes' origins, and lamps, with the middle of what shines of a node, elsewhere: that is their
// rest then. The bounds grow as needed. Error kUsage for a name that no mover and no lamp has, and for a lamp that the
// file animates.
Status move_nodes(std::span<const MoverMove> moves, Scene& scene);

}  // namespace oriel
