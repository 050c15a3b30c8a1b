// What is seen from where people walk.
#include "formats/pack/encoding/planes.h"
#include "formats/pack/fields.h"
#include "formats/pack/sections.h"

namespace oriel {

void encode(ByteWriter& out, const VisibleSets& sets) {
  out.put(sets.groups);
  out.put(static_cast<std::uint32_t>(sets.runs.size()));
  out.put(sets.side);
  out.put(sets.below_m);
  out.put(sets.above_m);
  out.put(static_cast<std::uint32_t>(sets.seen.size() / sets.set_bytes()));
  out.put(sets.made_for.high);
  out.put(sets.made_for.low);
  put_planes(out, std::span<const TriangleRun>(sets.runs));
  // Each set as what differs from the one before: neighbours see mostly the same.
  std::vector<std::uint8_t> changes(sets.seen);
  for (std::size_t i = changes.size(); i-- > sets.set_bytes();) changes[i] ^= changes[i - sets.set_bytes()];
  out.put_array(std::span<const std::uint8_t>(changes));
}

Status decode(ByteReader& in, VisibleSets& sets) {
  sets.groups = in.get<std::uint32_t>();
  const auto runs = in.get<std::uint32_t>();
  sets.side = in.get<std::uint32_t>();
  sets.below_m = in.get<float>();
  sets.above_m = in.get<float>();
  const auto cells = in.get<std::uint32_t>();
  sets.made_for.high = in.get<std::uint64_t>();
  sets.made_for.low = in.get<std::uint64_t>();
  if (in.ok() && (sets.groups == 0 || sets.groups > kMaxGroups))
    return invalid("", "found {} groups of triangles, expected 1 to {}", sets.groups, kMaxGroups);
  if (in.ok() && (sets.side == 0 || sets.side > kMaxSide))
    return invalid("", "found eye cells of {} walk cells a side, expected 1 to {}", sets.side, kMaxSide);
  sets.runs = get_planes<TriangleRun>(in, runs);
  sets.seen = in.get_array<std::uint8_t>(std::uint64_t{cells} * sets.set_bytes());
  for (std::size_t i = sets.set_bytes(); i < sets.seen.size(); ++i) sets.seen[i] ^= sets.seen[i - sets.set_bytes()];
  return {};
}

}  // namespace oriel
