#include <algorithm>

#include "formats/shadow/silhouettes.h"

namespace oriel {

ShadowBody::ShadowBody(const Occluders& occluders) : points(occluders.points) {
  std::vector<std::array<std::uint32_t, 4>> sides;  // lower point, upper point, face, 1 where the face runs upwards
  for (const OccluderFace& face : occluders.faces) {
    const auto f = static_cast<std::uint32_t>(faces.size());
    faces.push_back(face.points);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = face.points[k], b = face.points[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), f, a < b ? 1u : 0u});
    }
    const DVec3 p = points[face.points[0]];
    const DVec3 n = glm::normalize(glm::cross(points[face.points[1]] - p, points[face.points[2]] - p));
    nx.push_back(static_cast<float>(n.x)), ny.push_back(static_cast<float>(n.y)), nz.push_back(static_cast<float>(n.z));
    offset.push_back(static_cast<float>(glm::dot(n, p)));
  }
  for (std::vector<float>* numbers : {&nx, &ny, &nz, &offset})
    numbers->resize((faces.size() + kFacesAtOnce - 1) / kFacesAtOnce * kFacesAtOnce);
  std::ranges::sort(sides);
  face_edges.resize(faces.size());
  for (std::size_t i = 0; i < sides.size();) {
    Edge edge{.a = sides[i][0], .b = sides[i][1]};
    for (std::size_t k = 0; k < 2 && i < sides.size() && sides[i][0] == edge.a && sides[i][1] == edge.b; ++k, ++i) {
      const std::uint32_t f = sides[i][2];
      edge.faces[k] = f, edge.along[k] = sides[i][3] != 0 ? 1 : -1;
      const std::uint32_t from = edge.along[k] > 0 ? edge.a : edge.b;
      for (std::size_t c = 0; c < 3; ++c)
        if (faces[f][c] == from) face_edges[f][c] = static_cast<std::uint32_t>(edges.size());
    }
    edges.push_back(edge);
  }
}

}  // namespace oriel
