#include "tests/fuzz/scenes/shapes.h"

namespace oriel::fuzz {
namespace {

std::uint32_t add_vertex(Primitive& p, const Vec3& position, const Vec3& normal, const Vec2& uv) {
  p.positions.push_back(position);
  p.normals.push_back(normal);
  p.uvs.push_back(uv);
  return static_cast<std::uint32_t>(p.positions.size()) - 1;
}

// A grid of points of a surface: at(s, t) for s and t in [0, 1].
template <class At>
void add_grid(Primitive& p, int columns, int rows, const At& at) {
  const auto first = static_cast<std::uint32_t>(p.positions.size());
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const Vec2 uv(static_cast<float>(i) / static_cast<float>(columns),
                    static_cast<float>(j) / static_cast<float>(rows));
      const auto [position, normal] = at(uv);
      add_vertex(p, position, normal, uv);
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = first + static_cast<std::uint32_t>(j * (columns + 1) + i), b = a + 1;
      const std::uint32_t c = a + static_cast<std::uint32_t>(columns) + 1, d = c + 1;
      p.indices.insert(p.indices.end(), {a, b, d, a, d, c});
    }
}

}  // namespace

void add_quad(Primitive& p, const Vec3& origin, const Vec3& u, const Vec3& v, int n) {
  const Vec3 normal = normalize_or(glm::cross(u, v), Vec3(0, 1, 0));
  add_grid(p, n, n, [&](const Vec2& at) { return std::pair(origin + at.x * u + at.y * v, normal); });
}

void add_box(Primitive& p, const Vec3& low, const Vec3& high, bool inwards) {
  const Vec3 s = high - low, x(s.x, 0, 0), y(0, s.y, 0), z(0, 0, s.z);
  const auto side = [&](const Vec3& origin, const Vec3& u, const Vec3& v) {
    inwards ? add_quad(p, origin, v, u) : add_quad(p, origin, u, v);
  };
  side(low, z, y);
  side(low + x, y, z);
  side(low, x, z);
  side(low + y, z, x);
  side(low, y, x);
  side(low + z, x, y);
}

void add_sphere(Primitive& p, const Vec3& centre, float radius, int around, bool inwards) {
  const float side = inwards ? -1 : 1;
  add_grid(p, around, std::max(2, around / 2), [&](const Vec2& at) {
    const float phi = side * 2 * kPi * at.x, theta = kPi * at.y;
    const Vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    return std::pair(centre + radius * n, side * n);
  });
}

void add_wave(Primitive& p, const Vec3& centre, float size, int steps) {
  add_grid(p, steps, steps, [&](const Vec2& at) {
    const float a = 2 * kPi * at.x;
    const Vec3 position = centre + size * Vec3(at.x - 0.5f, 0.1f * std::sin(a), 0.5f - at.y);
    return std::pair(position, normalize_or(Vec3(-0.2f * kPi * std::cos(a), 1, 0), Vec3(0, 1, 0)));
  });
}

void add_tube(Primitive& p, const Vec3& from, float length, float radius, int around) {
  add_grid(p, around, 2, [&](const Vec2& at) {
    const float a = -2 * kPi * at.x;
    const Vec3 n(0, std::cos(a), std::sin(a));
    return std::pair(from + radius * n + Vec3(length * (1 - at.y), 0, 0), n);
  });
}

void damage(Primitive& p, Random& random) {
  const std::size_t triangles = p.indices.size() / 3;
  if (triangles == 0 || triangles > 10000) return;
  const auto any = [&] { return 3 * static_cast<std::size_t>(random.below(static_cast<int>(triangles))); };
  if (random.chance(0.3f)) {  // doubled, also turned over
    const std::size_t t = any();
    const std::uint32_t a = p.indices[t], b = p.indices[t + 1], c = p.indices[t + 2];
    if (random.chance(0.5f))
      p.indices.insert(p.indices.end(), {a, b, c});
    else
      p.indices.insert(p.indices.end(), {a, c, b});
  }
  if (random.chance(0.3f)) {  // a sliver: a thousandth to a billionth as wide as long
    const std::size_t t = any();
    const Vec3 a = p.positions[p.indices[t]], b = p.positions[p.indices[t + 1]], c = p.positions[p.indices[t + 2]];
    const auto width = static_cast<float>(random.decades(1e-9, 1e-3));
    const std::uint32_t i = add_vertex(p, a, p.normals[p.indices[t]], Vec2(0));
    add_vertex(p, b, p.normals[p.indices[t]], Vec2(0));
    add_vertex(p, 0.5f * (a + b) + width * (c - a), p.normals[p.indices[t]], Vec2(1));
    p.indices.insert(p.indices.end(), {i, i + 1, i + 2});
  }
  if (random.chance(0.2f)) {  // a point and a line
    const std::uint32_t i = p.indices[any()], j = p.indices[any()];
    p.indices.insert(p.indices.end(), {i, i, i, i, j, i});
  }
  if (random.chance(0.2f))
    for (Vec3& n : p.normals)
      if (random.chance(0.2f)) n = random.chance(0.5f) ? Vec3(0) : Vec3(random.between(-1, 1), -n.y, n.z);
  if (random.chance(0.2f)) p.normals.clear();
  if (random.chance(0.2f)) std::fill(p.uvs.begin(), p.uvs.end(), Vec2(random.between(-2, 2)));
  if (random.chance(0.1f))
    for (Vec2& uv : p.uvs) uv *= static_cast<float>(random.decades(1e-6, 1e6));
  if (random.chance(0.2f) && !p.normals.empty())
    for (const Vec3& n : p.normals)
      p.tangents.emplace_back(random.chance(0.5f) ? n : Vec3(0), random.chance(0.5f) ? 1 : -1);
}

}  // namespace oriel::fuzz
