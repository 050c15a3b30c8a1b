// What is seen from where people walk.
#include "formats/pack/sections.h"

namespace oriel {

void describe(Serial& s, VisibleSets& sets) {
  s(sets.groups);
  const std::uint32_t runs = s.count(sets.runs);
  s(sets.side, sets.below_m, sets.above_m);
  auto cells = static_cast<std::uint32_t>(s.reading() ? 0 : sets.seen.size() / sets.set_bytes());
  s(cells, sets.made_for.high, sets.made_for.low);
  if (sets.groups == 0 || sets.groups > kMaxGroups)
    s.refuse("found {} groups of triangles, expected 1 to {}", sets.groups, kMaxGroups);
  if (sets.side == 0 || sets.side > kMaxSide)
    s.refuse("found eye cells of {} walk cells a side, expected 1 to {}", sets.side, kMaxSide);
  s.planes(sets.runs, runs);
  // Each set as what differs from the one before: neighbours see mostly the same.
  const std::size_t bytes = sets.set_bytes();
  std::vector<std::uint8_t> changes(sets.seen);
  for (std::size_t i = changes.size(); i-- > bytes;) changes[i] ^= changes[i - bytes];
  s.array(changes, std::uint64_t{cells} * bytes);
  if (!s.reading() || !s.ok()) return;
  for (std::size_t i = bytes; i < changes.size(); ++i) changes[i] ^= changes[i - bytes];
  sets.seen = std::move(changes);
}

void describe(Serial& s, ReflectedSets& sets) {
  const std::uint32_t bytes = s.count(sets.seen);
  s(sets.made_for.high, sets.made_for.low);
  s.array(sets.seen, bytes);
}

}  // namespace oriel
