// Transfer of an object that moves, in clusters of principal components (Sloan et al. 2003).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace oriel {

// T of a vertex with B = albedo · Σ T_i L_i: B the radiance it sends out, L the radiance around in spherical harmonics
// (formats/core/sh.h), both in the object's axes. T = mean + Σ_k weight_k component_k of the vertex's cluster.
struct CompressedTransfer {
  int bands = 0;                      // 2 to 6
  int channels = 1;                   // 1 or 3: the same for all colours, or R, G, B
  int clusters = 0;                   // 1 to 256
  int components = 0;                 // 1 to 64
  std::vector<float> basis;           // by cluster: the mean, then the components; each channels · bands² long
  std::vector<float> weight_scale;    // by cluster and component: what the code 32767 stands for
  std::vector<std::uint8_t> cluster;  // by vertex
  std::vector<std::int16_t> weight;   // by vertex and component
  float error = 0;                    // relative, root mean square, of what is stored here against what was baked

  std::size_t stride() const { return static_cast<std::size_t>(channels * bands * bands); }
  std::size_t vertices() const { return cluster.size(); }
  int bytes_per_vertex() const { return 1 + 2 * components; }
  // T of one vertex. out.size() is stride().
  void expand(std::size_t vertex, std::span<float> out) const {
    const float* mean = basis.data() + cluster[vertex] * static_cast<std::size_t>(components + 1) * stride();
    for (std::size_t i = 0; i < stride(); ++i) out[i] = mean[i];
    for (std::size_t k = 0; k < static_cast<std::size_t>(components); ++k) {
      const std::size_t at = cluster[vertex] * static_cast<std::size_t>(components) + k;
      const float w =
          weight_scale[at] * static_cast<float>(weight[vertex * static_cast<std::size_t>(components) + k]) / 32767;
      const float* component = mean + (k + 1) * stride();
      for (std::size_t i = 0; i < stride(); ++i) out[i] += w * component[i];
    }
  }
};

}  // namespace oriel
