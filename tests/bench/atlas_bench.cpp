// Quality, time and memory of automatic atlases: one line a scene.
#include <sys/resource.h>

#include <bit>
#include <chrono>
#include <cstdio>

#include "bake/atlas/atlas.h"
#include "bake/atlas/polygon.h"
#include "bake/atlas/texel_map.h"
#include "bake/import/import.h"
#include "formats/cli/command.h"
#include "formats/image/png.h"
#include "tests/bake/atlas/shapes.h"

namespace oriel {
namespace {

struct Arguments {
  std::vector<std::string> scenes;
  AtlasOptions atlas;
  std::string pictures;
  int threads = 0;
};

// Of all coordinates: equal where two runs made the same atlas.
std::uint64_t fingerprint(const Atlas& atlas) {
  std::uint64_t h = 14695981039346656037u;
  const auto add = [&](std::uint64_t value) { h = (h ^ value) * 1099511628211u; };
  for (std::size_t t = 0; t < atlas.uv.size(); ++t) {
    add(static_cast<std::uint32_t>(atlas.page[t]));
    for (const Vec2& uv : atlas.uv[t]) add(std::bit_cast<std::uint32_t>(uv.x)), add(std::bit_cast<std::uint32_t>(uv.y));
  }
  return h;
}

double peak_gib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1048576;
}

// Triangles of one page that overlap, found by clipping them: none, or a pair.
std::size_t pages_with_overlaps(const Atlas& atlas) {
  std::vector<std::vector<Triangle2>> triangles(atlas.pages.size());
  for (std::uint32_t t = 0; t < atlas.page.size(); ++t)
    if (atlas.page[t] >= 0) triangles[static_cast<std::size_t>(atlas.page[t])].push_back(texel_triangle(atlas, t));
  std::size_t count = 0;
  for (const auto& page : triangles) count += find_overlap(page, {1e-4, 2e-3}).has_value();
  return count;
}

Vec3 color_of(std::uint32_t chart) {
  const std::uint32_t h = (chart + 1) * 2654435761u;
  return Vec3(static_cast<float>(h >> 24), static_cast<float>(h >> 16 & 255), static_cast<float>(h >> 8 & 255)) * 0.6f +
         Vec3(80);
}

// Charts of a page in colours of their own; texels of two charts in white.
Status write_picture(const Atlas& atlas, const TexelMapPage& page, const std::string& path) {
  ByteImage image;
  image.width = page.width, image.height = page.height, image.channels = 3;
  image.pixels.assign(std::size_t{3} * page.width * page.height, 0);
  for (std::size_t i = 0; i < page.texel.size(); ++i) {
    const std::uint32_t chart = atlas.chart[page.fragments[page.first[i]].triangle];
    Vec3 color = color_of(chart);
    for (std::uint32_t f = page.first[i]; f < page.first[i + 1]; ++f)
      if (atlas.chart[page.fragments[f].triangle] != chart) color = Vec3(255);
    for (int c = 0; c < 3; ++c)
      image.pixels[3 * std::size_t{page.texel[i]} + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(color[c]);
  }
  return write_png(path, image);
}

// One mesh of about so many triangles: waves of 5 m on a square of 100 m.
Scene dunes(double triangles) {
  const auto side = static_cast<std::uint32_t>(std::sqrt(triangles / 2));
  std::vector<Vec3> p;
  std::vector<UVec3> t;
  for (std::uint32_t i = 0; i <= side; ++i)
    for (std::uint32_t j = 0; j <= side; ++j) {
      const float x = 100.0f * static_cast<float>(i) / static_cast<float>(side);
      const float z = 100.0f * static_cast<float>(j) / static_cast<float>(side);
      p.push_back({x, 0.8f * std::sin(1.2f * x) * std::cos(0.9f * z), z});
    }
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::uint32_t a = i * (side + 1) + j;
      t.insert(t.end(), {{a, a + 1, a + side + 2}, {a, a + side + 2, a + side + 1}});
    }
  Scene scene = shapes::empty_scene();
  shapes::add(scene, "dunes", p, t);
  return scene;
}

Result<Scene> load(const std::string& name, Context& context) {
  if (name.starts_with("dunes:")) return dunes(std::strtod(name.c_str() + 6, nullptr));
  if (name == "icosphere") {
    Scene scene = shapes::empty_scene();
    shapes::add_icosphere(scene, name, 1, 6);
    return scene;
  }
  ORIEL_TRY(ImportedScene imported, import_gltf(name, {}, context));
  return std::move(imported.scene);
}

Status bench(const std::string& name, const Arguments& args, Context& context) {
  ORIEL_TRY(const Scene scene, load(name, context));
  const double before = peak_gib();
  const auto start = std::chrono::steady_clock::now();
  ORIEL_TRY(const Atlas atlas, build_atlas(scene, args.atlas, context));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double after = peak_gib();
  const AtlasReport& r = atlas.report;
  const std::string label = std::filesystem::path(name).stem().string();
  std::string size = fmt::format("{} pages", atlas.pages.size());
  if (atlas.pages.size() == 1) size = fmt::format("{}x{}", atlas.pages[0].width, atlas.pages[0].height);
  fmt::print(
      "{:<16} {:>9} triangles, {:.4g} m, {}: {} charts, fill {:.1f} %, L2 {:.4f}, Linf {:.2f}, angle {:.4f}, area "
      "{:.4f}, "
      "overlapping texels {}, pages with overlaps {}, {:.2f} s, peak {:.2f} GiB (scene {:.2f}), {:016x}\n",
      label, scene.triangles.size(), atlas.texel_m, size, atlas.chart_count, 100 * atlas.covered_share, r.l2_stretch,
      r.linf_stretch, r.angle_distortion, r.area_distortion, r.overlapping_texels, pages_with_overlaps(atlas), seconds,
      after, before, fingerprint(atlas));
  std::fflush(stdout);
  if (args.pictures.empty()) return {};
  ORIEL_TRY(const auto map, build_texel_map(atlas, context));
  for (std::size_t p = 0; p < map.size(); ++p)
    ORIEL_TRY_VOID(write_picture(atlas, map[p], fmt::format("{}/{}-{}.png", args.pictures, label, p)));
  return {};
}

int run(const Arguments& args) {
  Context context;
  context.threads = args.threads;
  for (const std::string& name : args.scenes) {
    if (const Status done = bench(name, args, context); !done) {
      std::fprintf(stderr, "atlas_bench: %s\n", done.error().text().c_str());
      return static_cast<int>(done.error().code);
    }
  }
  return 0;
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  using namespace oriel;
  Arguments args;
  if (const auto code =
          parse_options(argc, argv, "Quality, time and memory of automatic atlases.",
                        {{"SCENE", "Arguments", "glTF files; icosphere (81 920 triangles) or dunes:N (one mesh of N)",
                          texts(args.scenes, "SCENE"), Use::kRequired},
                         {"--resolution", "Options", "Side of the one page", number(args.atlas.resolution, 0, 1e6)},
                         {"--texel", "Options", "Metres a texel", number(args.atlas.texel_m, 0, 1e6)},
                         {"--time-limit", "Options", "Seconds", number(args.atlas.time_limit_s, 0, 1e9)},
                         {"--padding", "Options", "Texels", number(args.atlas.padding, 0, 1e6)},
                         {"--threads", "Options", "0: all", number(args.threads, 0, 1024)},
                         {"--pictures", "Options", "Folder for a picture of each page", text(args.pictures, "DIR")}}))
    return *code;
  return run(args);
}
