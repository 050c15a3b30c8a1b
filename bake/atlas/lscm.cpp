#include "bake/atlas/lscm.h"

#include <complex>
#include <Eigen/SparseCholesky>

namespace oriel {
namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::SparseMatrix<Complex>;
using Vector = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;

constexpr double kThinnest = 1e-6;  // a triangle's weight is that of one of this height over its longest side

// Corners of a triangle in its own plane, as complex numbers.
std::array<Complex, 3> local_frame(const Triangle3& t) {
  const DVec3 e = t[1] - t[0], f = t[2] - t[0];
  const double length = glm::length(e);
  if (!(length > 0)) return {Complex(0), Complex(0), Complex(glm::length(f))};
  return {Complex(0), Complex(length), Complex(glm::dot(e, f) / length, glm::length(glm::cross(e, f)) / length)};
}

struct Pins {
  std::uint32_t first = 0, second = 0;
  double distance = 0;
};

Pins far_apart(std::span<const DVec3> position) {
  const auto furthest = [&](const DVec3& from) {
    std::uint32_t best = 0;
    double best_d = -1;
    for (std::uint32_t v = 0; v < position.size(); ++v) {
      const DVec3 d = position[v] - from;
      if (glm::dot(d, d) > best_d) best = v, best_d = glm::dot(d, d);
    }
    return best;
  };
  DVec3 middle(0);
  for (const DVec3& p : position) middle += p / static_cast<double>(position.size());
  Pins pins;
  pins.first = furthest(middle);
  pins.second = furthest(position[pins.first]);
  pins.distance = glm::length(position[pins.second] - position[pins.first]);
  return pins;
}

// The normal equations of Σ |Σ_j W_j U_j|² / twice the triangle's area, in the complex coordinates U of all vertices
// but the pinned ones: Hermitian, and positive definite where the patch hangs together.
struct System {
  Matrix matrix;
  Vector right;
};

System assemble(std::span<const Triangle3> corners, const PatchVertices& vertices, const Pins& pins,
                std::span<const int> unknown, int unknowns) {
  System out;
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(6 * corners.size());
  out.right = Vector::Zero(unknowns);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto p = local_frame(corners[i]);
    const Complex w[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]};
    const double longest = std::max({std::norm(w[0]), std::norm(w[1]), std::norm(w[2])});
    if (!(longest > 0)) continue;
    const double weight = 1 / std::max(w[2].real() * p[2].imag(), kThinnest * longest);
    for (std::size_t j = 0; j < 3; ++j) {
      const int row = unknown[vertices.of_corner[3 * i + j]];
      if (row < 0) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = vertices.of_corner[3 * i + k];
        const Complex value = weight * std::conj(w[j]) * w[k];
        if (unknown[v] < 0)
          out.right[row] -= value * (v == pins.second ? pins.distance : 0);
        else if (row >= unknown[v])
          entries.emplace_back(row, unknown[v], value);
      }
    }
  }
  out.matrix.resize(unknowns, unknowns);
  out.matrix.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace

std::vector<Triangle2> least_squares_conformal(const Patch& patch, std::span<const Triangle3> corners) {
  const PatchVertices vertices = number_vertices(patch);
  std::vector<DVec3> position(vertices.count);
  for (std::size_t c = 0; c < vertices.of_corner.size(); ++c) position[vertices.of_corner[c]] = corners[c / 3][c % 3];
  const Pins pins = far_apart(position);
  if (!(pins.distance > 0)) return {};
  std::vector<int> unknown(vertices.count, -1);
  int unknowns = 0;
  for (std::uint32_t v = 0; v < vertices.count; ++v)
    if (v != pins.first && v != pins.second) unknown[v] = unknowns++;

  const System system = assemble(corners, vertices, pins, unknown, unknowns);
  const Eigen::SimplicialLDLT<Matrix> solver(system.matrix);
  if (solver.info() != Eigen::Success) return {};
  const Vector solution = solver.solve(system.right);
  if (solver.info() != Eigen::Success || !solution.allFinite()) return {};
  std::vector<Triangle2> points(patch.size());
  for (std::size_t c = 0; c < vertices.of_corner.size(); ++c) {
    const std::uint32_t v = vertices.of_corner[c];
    const Complex u = unknown[v] >= 0 ? solution[unknown[v]] : Complex(v == pins.second ? pins.distance : 0);
    points[c / 3][c % 3] = {u.real(), u.imag()};
  }
  return points;
}

}  // namespace oriel
