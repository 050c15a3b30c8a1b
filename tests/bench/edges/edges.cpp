// How right the light of packs is along the edges that a scene's cameras see: what a lightmap shows at the points of
// the pixels on both sides of an edge, beside the illuminance there by unbiased paths. Usage: edges_bench SCENE.glb
// PACK.oriel … [--width N] [--height N] [--points N] [--error E] [--threads N]. Or along a line on a surface, every
// centimetre: --line x,y,z,x,y,z --facing x,y,z
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "bake/import/import.h"
#include "bake/reference/illuminance.h"
#include "formats/assets/bilinear.h"
#include "formats/cli/command.h"
#include "formats/core/color.h"
#include "formats/pack/reader.h"
#include "formats/query/camera.h"

namespace oriel {
namespace {

constexpr float kRelief_m = 0.1f;           // how far apart the points on the two sides of an edge may be
constexpr double kOff = 0.05, kDark = 0.5;  // what an edge, and a pixel of it, may be off by
constexpr std::size_t kFewPoints = 8;       // an edge of fewer is too short to tell of

struct Settings {
  std::string scene;
  std::vector<std::string> packs;
  int width = 480, height = 320, threads = 0;
  std::size_t points = 400;  // a camera
  double error = 0.01;
  std::vector<double> line, facing = {0, 1, 0};  // world metres: both ends; the surface's normal
};

struct EdgePoint {
  std::string edge;  // "the point's surface beside its neighbour's"
  Vec3 position{0}, normal{0};
};

std::string name_at(const Scene& scene, const Hit& hit) {
  return scene.surfaces[scene.triangle_surface[hit.triangle]].name;
}

// The points of pixels whose neighbour shows another face close by, lamps left out; every n-th of them.
std::vector<EdgePoint> edge_points(const Accel& accel, const Camera& camera, const Settings& settings) {
  const Scene& scene = accel.scene();
  const auto w = static_cast<float>(settings.width), h = static_cast<float>(settings.height);
  std::vector<Hit> hits;
  for (int y = 0; y < settings.height; ++y)
    for (int x = 0; x < settings.width; ++x) {
      const PixelRay ray = pixel_ray(camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, w, h);
      hits.push_back(accel.intersect({ray.origin, ray.direction}));
    }
  const auto dark = [&](const Hit& hit) {
    return hit && hit.front && scene.material_of(hit.triangle).emission == Vec3(0);
  };
  std::vector<EdgePoint> all, some;
  const auto add_edge = [&](const Hit& a, const Hit& b) {
    if (!dark(a) || !dark(b)) return;
    const Vec3 p = point_on(scene, a.triangle, a.barycentric), q = point_on(scene, b.triangle, b.barycentric);
    const Vec3 n = geometric_normal(scene, a.triangle), m = geometric_normal(scene, b.triangle);
    const bool same_surface = scene.triangle_surface[a.triangle] == scene.triangle_surface[b.triangle];
    if (glm::distance(p, q) > kRelief_m || (same_surface && glm::dot(n, m) > 0.99f)) return;
    all.push_back({name_at(scene, a) + " beside " + name_at(scene, b), p, n});
    all.push_back({name_at(scene, b) + " beside " + name_at(scene, a), q, m});
  };
  const auto at = [&](int x, int y) { return hits[static_cast<std::size_t>(y * settings.width + x)]; };
  for (int y = 0; y < settings.height; ++y)
    for (int x = 0; x < settings.width; ++x) {
      if (x + 1 < settings.width) add_edge(at(x, y), at(x + 1, y));
      if (y + 1 < settings.height) add_edge(at(x, y), at(x, y + 1));
    }
  const std::size_t count = std::min(settings.points, all.size());
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
  return some;
}

// A pack's mesh for rays, and its light where they end.
class PackLight {
 public:
  static Result<PackLight> open(const std::string& path) {
    PackLight light;
    ORIEL_TRY(light.pack_, read_pack(path));
    const Mesh& mesh = light.pack_.mesh;
    Scene& scene = *light.scene_;
    scene.positions = mesh.positions;
    scene.normals = mesh.normals;
    scene.origin = mesh.origin;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      scene.triangles.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
    scene.triangle_surface.assign(scene.triangles.size(), 0);
    light.page_.assign(scene.triangles.size(), -1);
    for (const MeshPart& part : mesh.parts)
      for (std::uint32_t i = 0; i < part.index_count; i += 3)
        light.page_[(part.first_index + i) / 3] = part.lightmap_page;
    scene.materials.resize(1);
    scene.surfaces.resize(1);
    scene.surfaces[0].triangle_count = static_cast<std::uint32_t>(scene.triangles.size());
    scene.lower = scene.upper = mesh.positions.at(0);
    for (const Vec3& p : mesh.positions) scene.lower = glm::min(scene.lower, p), scene.upper = glm::max(scene.upper, p);
    ORIEL_TRY(Accel accel, Accel::build(scene));
    light.accel_ = std::make_unique<Accel>(std::move(accel));
    return light;
  }

  // Luminance of the irradiance, lux, at a point (world) of a surface that faces along `normal`, as a player filters
  // it.
  double at(const DVec3& world, const Vec3& normal) const {
    constexpr float kAbove_m = 1e-4f;
    const Vec3 p(world - scene_->origin);
    const Hit hit = accel_->intersect({p + kAbove_m * normal, -normal, 10 * kAbove_m});
    if (!hit || page_[hit.triangle] < 0) return 0;
    const UVec3 corners = scene_->triangles[hit.triangle];
    const std::vector<Vec2>& uvs = pack_.mesh.lightmap_uvs;
    const Vec2 uv = uvs[corners.x] + hit.barycentric.x * (uvs[corners.y] - uvs[corners.x]) +
                    hit.barycentric.y * (uvs[corners.z] - uvs[corners.x]);
    return luminance(irradiance_at(pack_.lightmaps[static_cast<std::size_t>(page_[hit.triangle])], uv));
  }

 private:
  PackLight() : scene_(std::make_unique<Scene>()) {}
  Pack pack_;
  std::unique_ptr<Scene> scene_;  // at one place: accel_ refers to it
  std::unique_ptr<Accel> accel_;
  std::vector<std::int32_t> page_;  // by triangle
};

struct EdgeSum {
  double shown = 0, right = 0;
  std::size_t points = 0;
};

// A row of the table: an edge is off by the light of all of its points together.
void print_row(const std::string& camera, const std::string& pack, std::span<const EdgePoint> points,
               std::span<const double> right, std::span<const double> shown) {
  std::map<std::string, EdgeSum> edges;
  double squares = 0, darkest = 1e9;
  std::size_t dark = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EdgeSum& edge = edges[points[i].edge];
    edge.shown += shown[i], edge.right += right[i], ++edge.points;
    const double ratio = right[i] > 0 ? shown[i] / right[i] : 1;
    squares += (ratio - 1) * (ratio - 1);
    darkest = std::min(darkest, ratio);
    dark += ratio < kDark;
  }
  std::size_t told = 0, off = 0;
  double worst = 0;
  std::string where;
  for (const auto& [name, edge] : edges) {
    if (edge.points < kFewPoints) continue;
    ++told;
    const double by = edge.shown / edge.right - 1;
    off += std::abs(by) > kOff;
    if (std::abs(by) > std::abs(worst)) worst = by, where = name;
  }
  std::printf("| %s | %s | %zu | %.1f | %zu of %zu | %+.1f (%s) | %.2f | %zu |\n", camera.c_str(), pack.c_str(),
              points.size(), 100 * std::sqrt(squares / static_cast<double>(std::max<std::size_t>(points.size(), 1))),
              off, told, 100 * worst, where.c_str(), darkest, dark);
  std::fflush(stdout);
}

// The light along the line, right and as packs show it.
Status print_line(const Settings& settings, const Transport& transport, std::span<const PackLight> packs,
                  Context& context) {
  constexpr double kStep_m = 0.01;
  if (settings.line.size() != 6 || settings.facing.size() != 3)
    return fail(ErrorCode::kUsage, "--line, --facing", "expected 6 and 3 numbers");
  const std::vector<double>& l = settings.line;
  const DVec3 from(l[0], l[1], l[2]), to(l[3], l[4], l[5]);
  const Vec3 normal(glm::normalize(DVec3(settings.facing[0], settings.facing[1], settings.facing[2])));
  std::vector<MeasurePoint> meters;
  const auto steps = static_cast<int>(glm::distance(from, to) / kStep_m);
  for (int i = 0; i <= steps; ++i) meters.push_back({from + i * kStep_m * glm::normalize(to - from), normal});
  ORIEL_TRY(const auto lux, illuminance_at(transport, meters, {.relative_error = settings.error}, context));
  for (std::size_t i = 0; i < meters.size(); ++i) {
    const double right = luminance(Vec3(lux[i].direct + lux[i].indirect));
    std::printf("| %.2f m | %.1f lux |", kStep_m * static_cast<double>(i), right);
    for (const PackLight& pack : packs) {
      const double shown = pack.at(meters[i].position, normal);
      std::printf(" %.1f lux, %+.1f %% |", shown, 100 * (shown / right - 1));
    }
    std::printf("\n");
  }
  return {};
}

Status run(const Settings& settings) {
  Context context;
  context.threads = settings.threads;
  ORIEL_TRY(const ImportedScene imported, import_gltf(settings.scene, {}, context));
  const Scene& scene = imported.scene;
  ORIEL_TRY(const Accel accel, Accel::build(scene));
  const LightSet lights(scene);
  std::vector<PackLight> packs;
  for (const std::string& path : settings.packs) {
    ORIEL_TRY(PackLight pack, PackLight::open(path));
    packs.push_back(std::move(pack));
  }
  if (!settings.line.empty()) return print_line(settings, {accel, lights, {}}, packs, context);
  std::printf(
      "| camera | pack | points | rms, %% | edges off by more than %.0f %% | worst, %% | darkest | below %.1f |\n",
      100 * kOff, kDark);
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const Camera& camera : scene.cameras) {
    const std::vector<EdgePoint> points = edge_points(accel, camera, settings);
    std::vector<MeasurePoint> meters;
    for (const EdgePoint& p : points) meters.push_back({DVec3(p.position) + scene.origin, DVec3(p.normal)});
    if (meters.empty()) continue;
    ORIEL_TRY(const auto lux, illuminance_at({accel, lights, {}}, meters, {.relative_error = settings.error}, context));
    std::vector<double> right;
    for (const PointIlluminance& e : lux) right.push_back(luminance(Vec3(e.direct + e.indirect)));
    for (std::size_t k = 0; k < packs.size(); ++k) {
      std::vector<double> shown;
      for (std::size_t i = 0; i < points.size(); ++i)
        shown.push_back(packs[k].at(meters[i].position, points[i].normal));
      print_row(camera.name, settings.packs[k], points, right, shown);
    }
  }
  return {};
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  using namespace oriel;
  Settings settings;
  if (const auto code = parse_options(
          argc, argv, "Errors of baked light along edges",
          {{"SCENE", "Arguments", "That was baked", text(settings.scene, "SCENE"), Use::kRequired},
           {"PACK", "Arguments", "Bakes of it", texts(settings.packs, "PACK"), Use::kRequired},
           {"--width", "Options", "Of the frames whose pixels are looked at", number(settings.width, 1, 1e6)},
           {"--height", "Options", "Likewise", number(settings.height, 1, 1e6)},
           {"--points", "Options", "At most so many a camera", number(settings.points, 1, 1e9)},
           {"--error", "Options", "Standard error of the illuminance they are held against",
            number(settings.error, 1e-9, 1e9)},
           {"--threads", "Options", "0: all", number(settings.threads, 0, 1024)},
           {"--line", "Options", "Both ends of a line on a surface, world metres: x,y,z,x,y,z",
            numbers(settings.line, -1e9, 1e9)},
           {"--facing", "Options", "That surface's normal: x,y,z", numbers(settings.facing, -1e9, 1e9)}}))
    return *code;
  const Status done = run(settings);
  if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
  return done ? 0 : static_cast<int>(done.error().code);
}
