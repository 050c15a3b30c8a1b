#include "bake/transfer/compress.h"

#include <algorithm>
#include <Eigen/Eigenvalues>
#include <limits>

#include "bake/jobs/parallel.h"
#include "formats/core/check.h"

namespace oriel {
namespace {

using Matrix = Eigen::MatrixXf;
using Vector = Eigen::VectorXf;

constexpr int kRounds = 12;
constexpr Eigen::Index kVerticesACompressTask = 512;  // vertices a task

struct Cluster {
  Vector mean;
  Matrix components;  // a column each, orthonormal, most important first
};

class Clustering {
 public:
  Clustering(const VertexTransfer& transfer, int clusters, Context& context)
      : data_(Eigen::Map<const Matrix>(transfer.coefficients.data(), static_cast<Eigen::Index>(transfer.stride()),
                                       static_cast<Eigen::Index>(transfer.vertices()))),
        of_(transfer.vertices()),
        clusters_(static_cast<std::size_t>(clusters)),
        context_(context) {}

  // Lloyd's rounds from means far apart, then rounds by the error of `components` components.
  Status run(int components) {
    start();
    ORIEL_TRY_VOID(assign());
    for (int round = 0; round < kRounds; ++round) {
      fit(round < kRounds / 2 ? 0 : components);
      ORIEL_TRY(const bool moved, assign());
      if (!moved && round >= kRounds / 2) break;
    }
    fit(static_cast<int>(data_.rows()));
    return {};
  }

  const Matrix& data() const { return data_; }
  const std::vector<Cluster>& clusters() const { return clusters_; }
  const std::vector<std::uint8_t>& of() const { return of_; }

 private:
  // The mean, then always the vertex farthest from all means so far.
  void start() {
    clusters_[0].mean = data_.rowwise().mean();
    Vector nearest = Vector::Constant(data_.cols(), std::numeric_limits<float>::max());
    for (std::size_t c = 1; c < clusters_.size(); ++c) {
      nearest = nearest.cwiseMin((data_.colwise() - clusters_[c - 1].mean).colwise().squaredNorm().transpose());
      Eigen::Index farthest = 0;
      nearest.maxCoeff(&farthest);
      clusters_[c].mean = data_.col(farthest);
    }
    for (Cluster& cluster : clusters_) cluster.components.resize(data_.rows(), 0);
  }

  void fit(int components) {
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
      std::vector<Eigen::Index> members;
      for (std::size_t v = 0; v < of_.size(); ++v)
        if (of_[v] == c) members.push_back(static_cast<Eigen::Index>(v));
      Cluster& cluster = clusters_[c];
      if (members.empty()) continue;  // keeps what it was; may win vertices again
      Eigen::MatrixXd rows = data_(Eigen::all, members).cast<double>();
      const Eigen::VectorXd mean = rows.rowwise().mean();
      cluster.mean = mean.cast<float>();
      cluster.components.resize(data_.rows(), 0);
      if (components <= 0) continue;
      rows.colwise() -= mean;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(rows * rows.transpose());
      cluster.components = solver.eigenvectors()
                               .rowwise()
                               .reverse()
                               .leftCols(std::min<Eigen::Index>(components, data_.rows()))
                               .cast<float>();
    }
  }

  float error(const Cluster& cluster, const Vector& v) const {
    const Vector off = v - cluster.mean;
    return off.squaredNorm() - (cluster.components.transpose() * off).squaredNorm();
  }

  // To the cluster whose mean and components fit best; whether any vertex moved.
  Result<bool> assign() {
    std::atomic<bool> moved{false};
    const auto blocks = static_cast<std::size_t>((data_.cols() + kVerticesACompressTask - 1) / kVerticesACompressTask);
    ORIEL_TRY_VOID(parallel_for(context_, "", blocks, [&](std::size_t block) {
      const auto begin = static_cast<Eigen::Index>(block) * kVerticesACompressTask;
      for (Eigen::Index v = begin; v < std::min(data_.cols(), begin + kVerticesACompressTask); ++v) {
        std::size_t best = 0;
        float least = std::numeric_limits<float>::max();
        for (std::size_t c = 0; c < clusters_.size(); ++c) {
          const float e = error(clusters_[c], data_.col(v));
          if (e < least) {
            least = e;
            best = c;
          }
        }
        std::uint8_t& of = of_[static_cast<std::size_t>(v)];
        if (of != best) moved = true;
        of = static_cast<std::uint8_t>(best);
      }
    }));
    return moved.load();
  }

  Matrix data_;  // a column a vertex
  std::vector<std::uint8_t> of_;
  std::vector<Cluster> clusters_;
  Context& context_;
};

// What `components` components a cluster give, as stored.
CompressedTransfer store(const VertexTransfer& transfer, const Clustering& clustering, int components) {
  CompressedTransfer out;
  out.bands = transfer.bands;
  out.channels = transfer.channels;
  out.clusters = static_cast<int>(clustering.clusters().size());
  out.components = components;
  out.cluster = clustering.of();
  const auto count = static_cast<std::size_t>(components);
  const std::size_t stride = transfer.stride();
  for (const Cluster& cluster : clustering.clusters()) {
    out.basis.insert(out.basis.end(), cluster.mean.data(), cluster.mean.data() + stride);
    Matrix filled = Matrix::Zero(static_cast<Eigen::Index>(stride), components);
    const Eigen::Index have = std::min<Eigen::Index>(components, cluster.components.cols());
    filled.leftCols(have) = cluster.components.leftCols(have);
    out.basis.insert(out.basis.end(), filled.data(), filled.data() + stride * count);
  }
  const auto weights = [&](std::size_t v) -> Vector {
    const Cluster& cluster = clustering.clusters()[out.cluster[v]];
    const Eigen::Index have = std::min<Eigen::Index>(components, cluster.components.cols());
    Vector w = Vector::Zero(components);
    w.head(have) = cluster.components.leftCols(have).transpose() *
                   (clustering.data().col(static_cast<Eigen::Index>(v)) - cluster.mean);
    return w;
  };
  out.weight_scale.assign(clustering.clusters().size() * count, 0);
  for (std::size_t v = 0; v < out.cluster.size(); ++v) {
    const Vector w = weights(v);
    for (std::size_t k = 0; k < count; ++k) {
      float& scale = out.weight_scale[out.cluster[v] * count + k];
      scale = std::max(scale, std::abs(w[static_cast<Eigen::Index>(k)]));
    }
  }
  double difference = 0, whole = 0;
  std::vector<float> expanded(stride);
  for (std::size_t v = 0; v < out.cluster.size(); ++v) {
    const Vector w = weights(v);
    for (std::size_t k = 0; k < count; ++k) {
      const float scale = out.weight_scale[out.cluster[v] * count + k];
      const float code = scale > 0 ? w[static_cast<Eigen::Index>(k)] / scale * 32767 : 0.0f;
      out.weight.push_back(static_cast<std::int16_t>(std::lround(code)));
    }
    out.expand(v, expanded);
    for (std::size_t i = 0; i < stride; ++i) {
      const double exact = transfer.coefficients[v * stride + i];
      difference += (expanded[i] - exact) * (expanded[i] - exact);
      whole += exact * exact;
    }
  }
  out.error = whole > 0 ? static_cast<float>(std::sqrt(difference / whole)) : 0;
  return out;
}

}  // namespace

Result<CompressedTransfer> compress_transfer(const VertexTransfer& transfer, const CompressOptions& options,
                                             Context& context) {
  ORIEL_CHECK(options.clusters >= 1 && options.clusters <= 256 && options.components <= 64);
  const int clusters = std::min(options.clusters, std::max(1, static_cast<int>(transfer.vertices())));
  const int most = std::clamp((options.max_bytes - 1) / 2, 1, std::min(64, static_cast<int>(transfer.stride())));
  const int components = options.components > 0 ? std::min(options.components, static_cast<int>(transfer.stride())) : 0;
  Clustering clustering(transfer, clusters, context);
  ORIEL_TRY_VOID(clustering.run(components > 0 ? components : std::min(most, 8)));
  if (components > 0) return store(transfer, clustering, components);
  for (int k = std::min(4, most); k < most; k += 2) {
    CompressedTransfer tried = store(transfer, clustering, k);
    if (tried.error <= options.max_error) return tried;
  }
  return store(transfer, clustering, most);
}

}  // namespace oriel
