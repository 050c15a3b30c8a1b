#include "study/udeshi1999/bright_elements.h"

#include <algorithm>
#include <cmath>

#include "bake/jobs/parallel.h"
#include "bake/scene/shade.h"
#include "formats/core/color.h"

namespace oriel::study {
namespace {

constexpr double kElements = 256;  // about so many of a scene
constexpr std::size_t kElementsATask = 64;

// A side of a piece of a triangle, by its middle.
struct Piece {
  std::uint32_t triangle;
  Vec2 middle;  // barycentric
  Vec3 normal;
  float area;
};

void add_pieces(const Scene& scene, std::uint32_t triangle, double target_area, std::vector<Piece>& pieces) {
  const double area = triangle_area(scene, triangle);
  const int cuts = std::max(1, static_cast<int>(std::lround(std::sqrt(area / target_area))));
  const float part = 1 / (3 * static_cast<float>(cuts));
  const Vec3 normal = geometric_normal(scene, triangle);
  const auto piece_area = static_cast<float>(area / (double{1} * cuts * cuts));
  const auto add = [&](int u, int v) {
    const Vec2 middle = part * Vec2(static_cast<float>(u), static_cast<float>(v));
    pieces.push_back({triangle, middle, normal, piece_area});
    if (scene.material_of(triangle).double_sided) pieces.push_back({triangle, middle, -normal, piece_area});
  };
  for (int u = 0; u < cuts; ++u)
    for (int v = 0; u + v < cuts; ++v) {
      add(3 * u + 1, 3 * v + 1);
      if (u + v + 1 < cuts) add(3 * u + 2, 3 * v + 2);
    }
}

// As a lamp of what it reflects diffusely.
LampPoint shining_back(const PreviewScene& scene, std::span<const LampPoint> lamps, const Piece& piece) {
  const Scene& s = scene.scene();
  const Vec3 place = point_on(s, piece.triangle, piece.middle);
  const EyePoint at{{place, piece.normal, piece.normal}, spawn_origin(s, piece.triangle, piece.middle, piece.normal)};
  Vec3 light(0);
  for (const LampPoint& lamp : lamps)
    if (const auto shone = shine(lamp, at, s)) light += shone->light * scene.accel->transmittance(shone->ray);
  const ShadePoint shade = shade_point(s, piece.triangle, piece.middle);
  LampPoint out;
  out.place = Vec4(at.origin, 1), out.normal = piece.normal;
  out.power = light * shade.diffuse * (shade.coverage * piece.area / kPi);
  out.soft = piece.area / kPi;
  return out;
}

}  // namespace

Result<std::vector<LampPoint>> bright_elements(const PreviewScene& scene, std::span<const LampPoint> lamps,
                                               std::size_t count, Context& context) {
  const Scene& s = scene.scene();
  double area = 0;
  const auto triangles = static_cast<std::uint32_t>(s.triangles.size());
  for (std::uint32_t t = 0; t < triangles; ++t) area += triangle_area(s, t);
  std::vector<Piece> pieces;
  for (std::uint32_t t = 0; t < triangles; ++t) add_pieces(s, t, area / kElements, pieces);
  std::vector<LampPoint> elements(pieces.size());
  ORIEL_TRY_VOID(
      parallel_for(context, "", (pieces.size() + kElementsATask - 1) / kElementsATask, [&](std::size_t task) {
        for (std::size_t i = task * kElementsATask; i < std::min(pieces.size(), (task + 1) * kElementsATask); ++i)
          elements[i] = shining_back(scene, lamps, pieces[i]);
      }));
  const auto brightest = elements.begin() + static_cast<std::ptrdiff_t>(std::min(count, elements.size()));
  std::partial_sort(elements.begin(), brightest, elements.end(),
                    [](const LampPoint& a, const LampPoint& b) { return luminance(a.power) > luminance(b.power); });
  Vec3 all(0), taken(0);
  for (const LampPoint& element : elements) all += element.power;
  for (auto e = elements.begin(); e != brightest; ++e) taken += e->power;
  elements.erase(brightest, elements.end());
  std::erase_if(elements, [](const LampPoint& element) { return luminance(element.power) <= 0; });
  const float share = luminance(all) / std::max(luminance(taken), 1e-30f);
  for (LampPoint& element : elements) element.power *= share, element.soft *= share;
  return elements;
}

}  // namespace oriel::study
