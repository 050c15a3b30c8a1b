// Errors of baked lightmaps against a reference in two independent halves, on the scene's own lightmap coordinates
// (docs/notes/metrics.md defines them). Prints one JSON object a lightmap and set of texels.
#include <fmt/format.h>

#include <cstdio>
#include <map>

#include "bake/atlas/texel_map.h"
#include "bake/import/import.h"
#include "formats/cli/command.h"
#include "tests/support/exr.h"

namespace oriel {
namespace {

constexpr std::uint32_t kNone = ~0u;

struct Options {
  std::string scene, reference_a, reference_b;
  int resolution = 256;
  std::vector<std::string> hidden;     // two bakes that differ where texels are partly hidden
  std::vector<std::string> lightmaps;  // EXR files
  std::vector<double> scales;          // one a lightmap: what turns its values into the reference's quantity
  std::string without;                 // open texels once more, without objects whose names hold this
};

struct Texel {
  std::size_t index;
  std::string object_class;  // the object's name without digits
};

struct Charts {
  int size = 0;
  std::vector<std::uint32_t> chart, surface;  // by texel, of what lies under its centre; kNone: nothing
};

Charts charts_of(const Scene& scene, const Atlas& atlas) {
  Charts c{static_cast<int>(atlas.pages[0].width), {}, {}};
  c.chart.assign(static_cast<std::size_t>(c.size) * c.size, kNone), c.surface = c.chart;
  for (std::uint32_t t = 0; t < atlas.page.size(); ++t) {
    if (atlas.page[t] != 0) continue;
    const auto p = texel_triangle(atlas, t);
    const auto cross = [](const DVec2& a, const DVec2& b) { return a.x * b.y - a.y * b.x; };
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    const DVec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
    for (int y = std::max(0, static_cast<int>(low.y)); y < std::min<double>(c.size, high.y); ++y)
      for (int x = std::max(0, static_cast<int>(low.x)); x < std::min<double>(c.size, high.x); ++x) {
        const DVec2 centre(x + 0.5, y + 0.5);
        bool inside = area != 0;
        for (std::size_t k = 0; k < 3; ++k) inside &= cross(p[(k + 1) % 3] - p[k], centre - p[k]) / area >= -1e-9;
        if (!inside) continue;
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(c.size) + static_cast<std::size_t>(x);
        c.chart[i] = atlas.chart[t], c.surface[i] = scene.triangle_surface[t];
      }
  }
  return c;
}

// The texel and the eight around it that are on the page.
template <class Visit>
void around(const Charts& c, std::size_t i, const Visit& visit) {
  const int x = static_cast<int>(i) % c.size, y = static_cast<int>(i) / c.size;
  for (int v = std::max(0, y - 1); v <= std::min(c.size - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(c.size - 1, x + 1); ++u)
      visit(static_cast<std::size_t>(v) * static_cast<std::size_t>(c.size) + static_cast<std::size_t>(u));
}

// Texels whose centre and whose 8 neighbours' centres lie in one chart.
std::vector<Texel> interior_texels(const Scene& scene, const Charts& c) {
  std::vector<Texel> texels;
  for (std::size_t i = 0; i < c.chart.size(); ++i) {
    int same = 0;
    around(c, i, [&](std::size_t k) { same += c.chart[k] == c.chart[i]; });
    if (c.chart[i] == kNone || same < 9) continue;
    std::string name = scene.surfaces[c.surface[i]].name;
    std::erase_if(name, [](char letter) { return letter >= '0' && letter <= '9'; });
    texels.push_back({i, name});
  }
  return texels;
}

DVec3 pixel(const FloatImage& image, std::size_t i) {
  return {image.pixels[i * image.channels], image.pixels[i * image.channels + 1], image.pixels[i * image.channels + 2]};
}

bool is_finite(const DVec3& v) {
  return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b);
}

struct Errors {
  double relative = 0, normalised = 0;  // root mean squares, not net
  double bias = 0;
};

Errors errors(const FloatImage& x, double scale, const FloatImage& a, const FloatImage& b,
              const std::vector<Texel>& texels, const DVec3& mean, bool halves) {
  Errors e;
  DVec3 sum(0), truth(0);
  for (const Texel& t : texels) {
    const DVec3 r = 0.5 * (pixel(a, t.index) + pixel(b, t.index));
    const DVec3 d = halves ? 0.5 * (pixel(a, t.index) - pixel(b, t.index)) : scale * pixel(x, t.index) - r;
    sum += d, truth += r;
    for (int c = 0; c < 3; ++c) {
      e.relative += d[c] * d[c] / (r[c] * r[c] + 1e-4 * mean[c] * mean[c]);
      e.normalised += d[c] * d[c] / (mean[c] * mean[c]);
    }
  }
  const double n = 3.0 * static_cast<double>(texels.size());
  e.relative = std::sqrt(e.relative / n), e.normalised = std::sqrt(e.normalised / n);
  e.bias = (sum.r + sum.g + sum.b) / (truth.r + truth.g + truth.b);
  return e;
}

DVec3 mean_light(const FloatImage& a, const FloatImage& b, const std::vector<Texel>& texels) {
  DVec3 sum(0);
  for (const Texel& t : texels) sum += 0.5 * (pixel(a, t.index) + pixel(b, t.index));
  return sum / static_cast<double>(texels.size());
}

// Those that no other body covers, nor their neighbours: all around the reference is above 5 % of its mean.
std::vector<Texel> open_texels(const Charts& charts, const FloatImage& a, const FloatImage& b,
                               std::vector<Texel> texels) {
  const auto brightest = [](const DVec3& v) { return std::max({v.r, v.g, v.b}); };
  const DVec3 mean = mean_light(a, b, texels);
  const double least = 0.05 * (mean.r + mean.g + mean.b) / 3;
  std::erase_if(texels, [&](const Texel& t) {
    bool dark = false;
    around(charts, t.index, [&](std::size_t k) { dark |= brightest(0.5 * (pixel(a, k) + pixel(b, k))) <= least; });
    return dark;
  });
  return texels;
}

// What the reference's own noise explains is taken out. Texels that are no number are left out, and counted.
void print(const std::string& file, const char* set, const FloatImage& x, double scale, const FloatImage& a,
           const FloatImage& b, std::vector<Texel> texels) {
  const std::size_t lost = std::erase_if(texels, [&](const Texel& t) { return !is_finite(pixel(x, t.index)); });
  const DVec3 mean = mean_light(a, b, texels);
  const auto net = [](double total, double own) { return std::sqrt(std::max(0.0, total * total - own * own)); };
  const Errors e = errors(x, scale, a, b, texels, mean, false), noise = errors(x, scale, a, b, texels, mean, true);
  std::map<std::string, std::vector<Texel>> classes;
  for (const Texel& t : texels) classes[t.object_class].push_back(t);
  std::string by_class;
  for (const auto& [name, own] : classes) {
    const Errors total = errors(x, scale, a, b, own, mean, false), halves = errors(x, scale, a, b, own, mean, true);
    by_class += fmt::format("{}\"{}\": {{\"texels\": {}, \"bias\": {:.6f}, \"bias_noise\": {:.6f}, \"nRMSE\": {:.6f}}}",
                            by_class.empty() ? "" : ", ", name, own.size(), total.bias, std::abs(halves.bias),
                            net(total.normalised, halves.normalised));
  }
  fmt::print(
      "{{\"file\": \"{}\", \"set\": \"{}\", \"texels\": {}, \"not_finite\": {}, \"relRMSE\": {:.6f}, \"nRMSE\": "
      "{:.6f}, "
      "\"bias\": {:.6f}, \"reference_relRMSE\": {:.6f}, \"reference_nRMSE\": {:.6f}, \"classes\": {{{}}}}}\n",
      file, set, texels.size(), lost, net(e.relative, noise.relative), net(e.normalised, noise.normalised), e.bias,
      noise.relative, noise.normalised, by_class);
}

Result<FloatImage> load(const std::string& file, int resolution) {
  ORIEL_TRY(FloatImage image, read_exr(file));
  const auto side = static_cast<std::uint32_t>(resolution);
  if (image.width != side || image.height != side || image.channels < 3)
    return fail(ErrorCode::kInvalid, file, "found {} x {} pixels of {} channels, expected {} x {} of 3", image.width,
                image.height, image.channels, side, side);
  return image;
}

Status compare(const Options& o) {
  Context context;
  ORIEL_TRY(const ImportedScene imported, import_gltf(o.scene, {}, context));
  AtlasOptions atlas_options;
  atlas_options.source = AtlasOptions::Source::kUv1;
  atlas_options.resolution = o.resolution;
  ORIEL_TRY(const Atlas atlas, build_atlas(imported.scene, atlas_options, context));
  ORIEL_TRY(const FloatImage a, load(o.reference_a, o.resolution));
  ORIEL_TRY(const FloatImage b, load(o.reference_b, o.resolution));
  const Charts charts = charts_of(imported.scene, atlas);
  std::vector<Texel> texels = interior_texels(imported.scene, charts);
  std::erase_if(texels, [&](const Texel& t) { return !is_finite(pixel(a, t.index) + pixel(b, t.index)); });
  // Inside other geometry, and fronts of sheets that are lit from behind: what a few stray paths bring is no reference.
  constexpr double kBlack = 0.005;  // of the mean
  const auto light = [&](const Texel& t) { return glm::length(pixel(a, t.index) + pixel(b, t.index)); };
  double mean = 0;
  for (const Texel& t : texels) mean += light(t) / static_cast<double>(texels.size());
  std::erase_if(texels, [&](const Texel& t) { return light(t) <= kBlack * mean; });
  const std::vector<Texel> open = open_texels(charts, a, b, texels);
  std::vector<Texel> chosen = open;
  std::erase_if(chosen, [&](const Texel& t) { return t.object_class.find(o.without) != std::string::npos; });
  std::vector<Texel> whole = texels;
  if (o.hidden.size() == 2) {
    ORIEL_TRY(const FloatImage black, load(o.hidden[0], o.resolution));
    ORIEL_TRY(const FloatImage visible, load(o.hidden[1], o.resolution));
    std::erase_if(whole, [&](const Texel& t) {
      return glm::all(glm::lessThan(pixel(black, t.index), 0.9999 * pixel(visible, t.index)));
    });
  }
  if (whole.empty()) return fail(ErrorCode::kInvalid, o.scene, "found no interior texel that the reference lights");
  for (std::size_t i = 0; i < o.lightmaps.size(); ++i) {
    ORIEL_TRY(const FloatImage x, load(o.lightmaps[i], o.resolution));
    const double scale = i < o.scales.size() ? o.scales[i] : 1;
    print(o.lightmaps[i], "interior", x, scale, a, b, texels);
    print(o.lightmaps[i], "open", x, scale, a, b, open);
    if (!o.without.empty()) print(o.lightmaps[i], "chosen", x, scale, a, b, chosen);
    if (o.hidden.size() == 2) print(o.lightmaps[i], "unhidden", x, scale, a, b, whole);
  }
  return {};
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  using namespace oriel;
  Options o;
  const auto factor = [](const std::string& typed) -> Result<double> {
    double scale = 1;
    ORIEL_TRY_VOID(number(scale, -1e30, 1e30).set(typed));
    return scale;
  };
  const auto digits = [](const double& scale) { return fmt::format("{}", scale); };
  if (const auto code = parse_options(
          argc, argv, "Errors of lightmaps against a reference in two independent halves.",
          {{"SCENE", "Arguments", "With lightmap coordinates", text(o.scene, "SCENE"), Use::kRequired},
           {"REFERENCE_A", "Arguments", "EXR file", text(o.reference_a, "FILE"), Use::kRequired},
           {"REFERENCE_B", "Arguments", "EXR file", text(o.reference_b, "FILE"), Use::kRequired},
           {"--resolution", "Options", "Side of the page in texels", number(o.resolution, 1, 65536)},
           {"--hidden", "Options", "Given twice: bakes with and without --hidden-black", texts(o.hidden, "FILE")},
           {"--lightmap", "Options", "EXR files to be judged; repeatable", texts(o.lightmaps, "FILE"), Use::kRequired},
           {"--scale", "Options", "A factor for each of them", each(o.scales, "X", factor, digits)},
           {"--without", "Options", "Open texels once more, without objects whose names (less digits) hold this",
            text(o.without, "TEXT")}}))
    return *code;
  if (const Status done = compare(o); !done) {
    std::fprintf(stderr, "lightmap_compare: %s\n", done.error().text().c_str());
    return static_cast<int>(done.error().code);
  }
  return 0;
}
