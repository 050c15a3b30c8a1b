// Animations of a glTF document: how nodes move, for cameras and movers alike.
#pragma once

#include <span>

#include "bake/import/accessors.h"
#include "bake/jobs/context.h"

namespace oriel {

// One channel with its keys. The spans belong to the AccessorReader.
struct Track {
  using Interpolation = gltf::AnimationDesc::Sampler::Interpolation;

  std::uint32_t node = 0;
  char target = 't';  // t, r, s
  Interpolation interpolation = Interpolation::kLinear;
  std::span<const float> times, values;
  std::uint32_t components = 3;

  // Translation, quaternion (x, y, z, w) or scale at a key, and between keys; cubic splines are taken as straight.
  DVec4 value(std::size_t key) const;
  // `before` asks for the limit from the left, which differs at the keys of STEP.
  DVec4 at(double time_s, bool before) const;
};

// The tracks of one animation.
using Animation = std::vector<Track>;

// Whether `ancestor` is `node` or a node above it.
bool is_above(const gltf::Document& document, std::uint32_t ancestor, std::uint32_t node);
// Whether a channel translates, turns or scales a node that can.
bool is_motion(const gltf::Document& document, const gltf::AnimationDesc::Channel& channel);

// Every channel that moves one of `nodes` or a node above one of them, by animation. Warns of those channels
// that move nothing here, and of cubic splines. Error kInvalid for channels whose accessors do not fit.
Result<std::vector<Animation>> load_animations(const gltf::Document& document, std::span<const std::uint32_t> nodes,
                                               gltf::AccessorReader& accessors, Context& context);

// The rotation of a node's axes: orthonormal, right-handed, without scale, shear or mirroring; the identity where its
// x and y axes span no plane.
DMat3 rotation_of(const DMat4& world_from_node);

struct MotionKey {
  double time_s = 0;
  DMat4 world_from_node{1};
};

// Where a node is at every key of the tracks that move it or a node above it; at a jump twice at the same time; and
// more often where it turns fast or an ancestor's turn bends its way, so that straight lines between keys follow it.
// Empty where no track moves it; error kInvalid beyond 2^20 keys.
Result<std::vector<MotionKey>> motion_of(const gltf::Document& document, std::uint32_t node,
                                         const Animation& animation);

}  // namespace oriel
