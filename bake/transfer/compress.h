// Clustered principal components of transfer (Sloan et al. 2003, "Clustered Principal Components for Precomputed
// Radiance Transfer"): a vertex is a cluster's mean and a few weights, and the player dots light with means and
// components once a cluster instead of once a vertex.
#pragma once

#include "bake/transfer/transfer.h"
#include "formats/assets/transfer.h"

namespace oriel {

struct CompressOptions {
  int clusters = 8;         // 1 to 256
  int components = 0;       // a cluster, 1 to 64; 0: as few as meet max_error, at most max_bytes
  float max_error = 0.02f;  // relative, root mean square over all vertices and coefficients
  int max_bytes = 48;       // a vertex
};
inline void fields(Archive& archive, CompressOptions& o) {
  archive(o.clusters, o.components, o.max_error, o.max_bytes);
}

// Clusters by k-means, then by which cluster's components fit best, until no vertex moves or 12 rounds; components by
// the eigenvectors of each cluster's covariance; weights as 16-bit fractions of the largest. Fills `error` with that of
// the result as stored. Deterministic. Error kStopped.
Result<CompressedTransfer> compress_transfer(const VertexTransfer& transfer, const CompressOptions& options,
                                             Context& context);

}  // namespace oriel
