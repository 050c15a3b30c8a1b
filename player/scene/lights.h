// Lamps of a pack that shine otherwise than they were baked.
#pragma once

#include <span>
#include <vector>

#include "formats/pack/pack.h"
#include "formats/query/mover_pose.h"

namespace oriel {

// Of a pack as it was read: what set_lamps() changes in it.
class BakedLamps {
 public:
  BakedLamps() = default;
  explicit BakedLamps(const Pack& pack);

  // By group: its lamps shine so many times as they were baked, R, G, B. Changes the pack's emission, emitters, bright
  // lights, sky, and the harmonics of its probes by each group's share of them; not its lightmaps and maps. Factors of
  // 1 give what was baked to the bit.
  void scale_light(std::span<const Vec3> factors, Pack& pack) const;
  // By group: where its lamps are, from where they were baked. Changes the corners of the pack's emitters.
  void place(std::span<const MoverPose> poses, Pack& pack) const;

  std::span<const Vec3> emission() const { return emission_; }  // by material, cd/m²
  const Vec3& sky() const { return sky_; }                      // cd/m²

 private:
  std::vector<Vec3> emission_, emitters_, bright_;
  std::vector<std::vector<Vec3>> corners_;  // of emitters
  std::vector<std::vector<float>> harmonics_;
  Vec3 sky_{0};
};

// The mean radiance of a day's sky, cd/m², its hours being shown that many times as they were baked.
Vec3 sky_of_day(const Day& day, std::span<const Vec3> factors);

// The pack's bright lights, of which lamps of groups are there. The pack's own stay where they were baked: so lamps are
// found.
std::vector<BrightLight> placed_lights(const Pack& pack, std::span<const MoverPose> poses);

// Of a triangle or quadrangle; whether one of a group's emitters is the square of a point or spot, which faces a
// reflector and does not turn with its lamp.
Vec3 middle_of(std::span<const Vec3> corners);
bool stands_for_point(const Pack& pack, const LightGroup& group, std::span<const Vec3> corners);

// What light of which groups have these shares becomes, over what it was; exactly 1 where all factors are 1.
Vec3 mean_factor(const Pack& pack, std::span<const Vec3> factors, std::vector<Vec3> LightGroup::*shares,
                 std::size_t index);

}  // namespace oriel
