#include "study/herf1997/soft_shadow.h"

#include <algorithm>

namespace oriel::study {
namespace {

// What a vertex in the plane may come to lie beside it by the rounding of its coordinates and of their way here.
double rounding_of(const ShadowReceiver& receiver, const ShadowLight& light) {
  double size = 0;
  const DVec3 far = receiver.corner + receiver.x * static_cast<double>(receiver.width) +
                    receiver.y * static_cast<double>(receiver.height);
  for (int k = 0; k < 3; ++k) size = std::max({size, std::abs(receiver.corner[k]), std::abs(far[k])});
  for (const ShadowLightSample& s : light.samples)
    for (int k = 0; k < 3; ++k) size = std::max(size, std::abs(s.position[k]));
  return 64 * 0x1p-53 * size;
}

}  // namespace

OccluderView SoftShadows::view(const Occluders& occluders, const ShadowReceiver& receiver,
                               const ShadowLight& light) const {
  return view_occluders(occluders, receiver, light, options_.touching + rounding_of(receiver, light));
}

const BlockedRows& SoftShadows::block(const OccluderView& view, const ShadowReceiver& receiver) {
  const auto samples = static_cast<int>(view.apexes.size());
  rows_.reset(receiver.width, receiver.height, samples);
  std::array<std::vector<FaceEdges>, kLanes> beside_light;
  for (int first = 0; first < samples; first += kLanes) {
    const int count = std::min(kLanes, samples - first);
    projected_.project(view, first, receiver.height, options_.simd);
    if (!view.beside_light.empty())
      for (int i = 0; i < count; ++i)
        beside_light[i] = edges_beside_light(view, view.apexes[static_cast<std::size_t>(first + i)], receiver.height);
    const SampleBatch batch{view, projected_, beside_light, first, count};
    switch (options_.method) {
      case CountMethod::kImages:
        fill_images(batch, rows_);
        break;
      case CountMethod::kSpanBuffers:
        fill_span_buffers(batch, rows_);
        break;
      case CountMethod::kEdgeFlags:
        fill_edge_flags(batch, rows_);
        break;
      case CountMethod::kBitRows:
        fill_bit_rows(batch, options_.simd, rows_);
        break;
    }
  }
  return rows_;
}

void SoftShadows::run(const Occluders& occluders, const ShadowReceiver& receiver, const ShadowLight& light,
                      std::vector<float>& out) {
  const OccluderView seen = view(occluders, receiver, light);
  out.resize(static_cast<std::size_t>(receiver.width) * static_cast<std::size_t>(receiver.height));
  LightSum(seen, receiver, light).run(block(seen, receiver), options_.simd, out);
}

}  // namespace oriel::study
