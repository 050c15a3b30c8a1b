// Where the edges of shadows are in frames of a pack's sharp light, beside rays from the same pixels. Usage:
// sharp_edges SCENE PACK.oriel [--eyes N] [--size W,H] [--pictures NAME]. Eyes are the pack's cameras, up to a third of
// them, and others from 0.3 to 5 m that look at places by which a shadow ends. Each sees one lamp alone. A row of a
// table by lamp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "bake/import/import.h"
#include "bake/jobs/parallel.h"
#include "bake/trace/punctual.h"
#include "bake/trace/sampler.h"
#include "formats/cli/command.h"
#include "formats/core/color.h"
#include "formats/image/png.h"
#include "formats/pack/reader.h"
#include "formats/query/camera.h"
#include "formats/query/sharp_light.h"
#include "player/gpu/headless.h"
#include "player/passes/frame.h"
#include "tests/bench/sharp/bare_pack.h"
#include "tests/bench/sharp/lamp_sum.h"

namespace oriel {
namespace {

constexpr std::uint32_t kRaysOfPixel = 64;
constexpr float kLit = 0.5f, kSharp = 0.25f;  // of the light; from a pixel to the next: such edges are asked for places
constexpr int kFar = 6;                       // pixels: further away no edge is sought
constexpr float kPower = 1000;                // intensity of the lamp that is drawn

struct Settings {
  std::string scene, pack;
  std::vector<double> size = {1280, 720};
  std::uint32_t eyes = 30;
  std::string picture;
};

struct Eye {
  Camera camera;
  std::uint32_t lamp = 0;
};

class EdgeBench {
 public:
  EdgeBench(const Settings& settings, const BarePack& bare, const Accel& shown, const Accel& casters,
            const gpu::Device& device, Renderer& renderer)
      : settings_(settings),
        bare_(bare),
        shown_(shown),
        casters_(casters),
        device_(device),
        renderer_(renderer),
        width_(static_cast<int>(settings.size[0])),
        height_(static_cast<int>(settings.size[1])) {
    for (std::uint32_t k = 0; k < bare.pack.sharp_light.lamps.size(); ++k) planes_.push_back(bare.planes_of(k));
  }

  std::vector<Eye> eyes(std::span<const Camera> cameras) const {
    std::vector<Eye> out;
    const auto lamps = static_cast<std::uint32_t>(planes_.size());
    for (std::uint32_t k = 0; k < std::min<std::size_t>(cameras.size(), settings_.eyes / 3); ++k)
      out.push_back({cameras[k], k % lamps});
    std::vector<double> area{0};
    for (std::uint32_t t = 0; t < bare_.page.size(); ++t) area.push_back(area.back() + triangle_area(bare_.scene, t));
    for (std::uint32_t k = 0; out.size() < settings_.eyes && k < 4000000; ++k) {
      Sampler random(1, 0, k);
      const double at = double{random.next1()} * area.back();
      const auto t = static_cast<std::uint32_t>(std::ranges::upper_bound(area, at) - area.begin() - 1);
      const std::uint32_t lamp = k % lamps;
      if (!planes_[lamp].contains(bare_.plane[t])) continue;
      Vec2 in = random.next2();
      if (in.x + in.y > 1) in = 1.0f - in;
      const Vec3 p = point_on(bare_.scene, t, in), n = geometric_normal(bare_.scene, t);
      const Vec2 turn = random.next2();
      const Vec3 beside = p + 0.03f * glm::normalize(glm::cross(n, Vec3(turn.x, 1 - turn.x, turn.y)));
      if ((visible(p, n, lamp, Vec2(0.5f)) > kLit) == (visible(beside, n, lamp, Vec2(0.5f)) > kLit)) continue;
      const float distance = 0.3f * std::pow(5 / 0.3f, random.next1()) * 0.999f;
      const Vec3 way = sample_cone(n, 1.3f, random.next2());
      const Vec3 from = offset_origin(p, n, max_component(glm::abs(p)));
      if (casters_.intersect({from, way, distance + 0.1f})) continue;
      Camera camera = look_at(p + distance * way, p, 1.0f);
      camera.name = fmt::format("{:.2f} m", distance);
      out.push_back({camera, lamp});
    }
    return out;
  }

  Status look(const Eye& eye, LampSum& sum);

 private:
  struct Pixel {
    std::uint32_t triangle = ~0u;
    Vec3 position{0}, normal{0};
    float shown = 0, right = 0;
    bool asked = false;  // right is that of many rays
  };

  float visible(const Vec3& p, const Vec3& n, std::uint32_t number, const Vec2& disk) const {
    const SharpLamp& lamp = bare_.pack.sharp_light.lamps[number];
    Ray ray;
    ray.origin = offset_origin(p, n, max_component(glm::abs(bare_.scene.upper - bare_.scene.lower)));
    ray.past_frosted = false;
    if (lamp.sun) {
      ray.direction =
          lamp.angular_radius_rad > 0 ? sample_cone(-lamp.direction, lamp.angular_radius_rad, disk) : -lamp.direction;
    } else {
      const Vec3 to = lamp.position - ray.origin;
      ray.max_distance = glm::length(to), ray.direction = to / ray.max_distance;
    }
    if (glm::dot(ray.direction, n) <= 0) return 0;
    return luminance(casters_.transmittance(ray));
  }

  Pixel& at(int x, int y) { return pixels_[static_cast<std::size_t>(y * width_ + x)]; }
  bool same(const Pixel& a, const Pixel& b) const {
    return a.triangle != ~0u && b.triangle != ~0u && bare_.plane[a.triangle] == bare_.plane[b.triangle];
  }
  struct Edge {
    Vec2 at;
    bool rises;
  };
  using Edges = std::map<std::array<int, 3>, Edge>;  // by pixel, and whether the next one is below

  // The frame's light, of one lamp alone.
  Result<std::vector<float>> draw(const Eye& eye);
  // What each pixel shows, beside one ray.
  Status find_pixels(const Eye& eye, std::span<const float> frame, LampSum& sum);
  // Many rays where one, or the frame, finds an edge, and from there on to where all is lit or dark.
  Status ask_edges(const Eye& eye);
  bool is_to_be_asked(int x, int y, bool first);
  void ask_many(const Eye& eye, int x, int y);
  // Where between a pixel and the next light passes kLit.
  Edges edges_of(float Pixel::*value);
  // Pixels to the nearest edge, kFar at most. like: of edges that go the same way, those that rise alike.
  static float nearest(const Edges& edges, const Vec2& from, const std::array<int, 2>& pixel,
                       const std::optional<std::array<bool, 2>>& like);
  void add_distances(const Edges& right, const Edges& shown, LampSum& sum);
  void add_wrong(const Eye& eye, const Edges& right, LampSum& sum);
  bool shows_one_surface(int x, int y);
  // Shown, right and their difference, one above the other.
  Status write_picture();

  const Settings& settings_;
  const BarePack& bare_;
  const Accel &shown_, &casters_;
  const gpu::Device& device_;
  Renderer& renderer_;
  int width_, height_;
  std::vector<std::set<std::uint32_t>> planes_;  // by lamp
  std::vector<Pixel> pixels_;
  Context context_;
  std::size_t number_ = 0;                                     // of the next picture
  std::map<std::uint32_t, std::unique_ptr<GpuScene>> scenes_;  // by lamp
};

void EdgeBench::ask_many(const Eye& eye, int x, int y) {
  Pixel& pixel = at(x, y);
  pixel.right = 0, pixel.asked = true;
  for (std::uint32_t k = 0; k < kRaysOfPixel; ++k) {
    Sampler random(2, static_cast<std::uint64_t>(y * width_ + x), k);
    const Vec2 within = Vec2(x, y) + random.next2();
    const PixelRay ray =
        pixel_ray(eye.camera, within.x, within.y, static_cast<float>(width_), static_cast<float>(height_));
    const float along = glm::dot(pixel.normal, pixel.position - ray.origin) / glm::dot(pixel.normal, ray.direction);
    pixel.right += visible(ray.origin + along * ray.direction, pixel.normal, eye.lamp, random.next2()) / kRaysOfPixel;
  }
}

Result<std::vector<float>> EdgeBench::draw(const Eye& eye) {
  std::unique_ptr<GpuScene>& scene = scenes_[eye.lamp];
  if (!scene) {
    Pack alone = bare_.pack;
    for (std::uint32_t k = 0; k < alone.sharp_light.lamps.size(); ++k)
      alone.sharp_light.lamps[k].intensity = Vec3(k == eye.lamp ? kPower : 0),
      alone.sharp_light.lamps[k].light_group = ~0u;
    ORIEL_TRY(scene, GpuScene::create(alone, device_));
  }
  ORIEL_TRY_VOID(renderer_.render(*scene, make_view(eye.camera, width_, height_, scene->bounds()), {}));
  return renderer_.read_light();
}

Status EdgeBench::find_pixels(const Eye& eye, std::span<const float> frame, LampSum& sum) {
  // Its light without shadows: a record of no triangle for all.
  LightmapPage open_page;
  open_page.width = open_page.height = 1, open_page.sharp_at = {1};
  SharpLight open;
  open.lamps = {bare_.pack.sharp_light.lamps[eye.lamp]}, open.lamps[0].intensity = Vec3(kPower);
  open.lamps[0].light_group = ~0u, open.words = {0, 1, SharpShine{0, false, 0}.code()};
  pixels_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), {});
  std::vector<std::size_t> texels(static_cast<std::size_t>(height_)), by_pixel(texels.size());
  ORIEL_TRY_VOID(parallel_for(context_, "", texels.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width_; ++x) {
      const PixelRay ray = pixel_ray(eye.camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                                     static_cast<float>(width_), static_cast<float>(height_));
      const Hit hit = shown_.intersect({ray.origin, ray.direction});
      if (!hit || !hit.front) continue;
      Pixel pixel{hit.triangle, point_on(bare_.scene, hit.triangle, hit.barycentric),
                  geometric_normal(bare_.scene, hit.triangle)};
      const float lux = sharp_irradiance(open, open_page, {Vec2(0.5f), pixel.position, pixel.normal}).r;
      if (!(lux > 1e-3f * kPower) && !(open.lamps[0].sun && lux > 0.02f * kPower) && !(lux > 1)) continue;
      pixel.right =
          visible(pixel.position, pixel.normal, eye.lamp, Sampler(3, row, static_cast<std::uint32_t>(x)).next2());
      const float own = lux / kPower * max_component(bare_.pack.sharp_light.lamps[eye.lamp].intensity);
      if (!planes_[eye.lamp].contains(bare_.plane[hit.triangle]) ||
          (pixel.right > kLit && bare_.has_in_texels(hit.triangle, bare_.uv(hit.triangle, hit.barycentric), own))) {
        texels[row] += pixel.right > kLit;
        continue;
      }
      by_pixel[row] += pixel.right > kLit;
      pixel.shown = frame[3 * static_cast<std::size_t>(y * width_ + x)] * kPi / lux;
      at(x, y) = pixel;
    }
  }));
  sum.lit_in_texels = std::accumulate(texels.begin(), texels.end(), sum.lit_in_texels);
  sum.lit_by_pixel = std::accumulate(by_pixel.begin(), by_pixel.end(), sum.lit_by_pixel);
  return {};
}

bool EdgeBench::is_to_be_asked(int x, int y, bool first) {
  const Pixel& p = at(x, y);
  if (p.triangle == ~0u || p.asked) return false;
  if (first && ((p.shown > 0.02f && p.shown < 0.98f) || (p.shown > kLit) != (p.right > kLit))) return true;
  for (int k = 0; k < 9; ++k) {
    const Pixel& q = at(x + k % 3 - 1, y + k / 3 - 1);
    if (same(p, q) && (first ? (q.right > kLit) != (p.right > kLit) : q.asked && q.right > 0 && q.right < 1))
      return true;
  }
  return false;
}

Status EdgeBench::ask_edges(const Eye& eye) {
  for (bool first = true, more = true; more; first = false) {
    std::vector<std::vector<int>> asked(static_cast<std::size_t>(height_));
    for (int y = 1; y + 1 < height_; ++y)
      for (int x = 1; x + 1 < width_; ++x)
        if (is_to_be_asked(x, y, first)) asked[static_cast<std::size_t>(y)].push_back(x);
    more = std::ranges::any_of(asked, [](const std::vector<int>& row) { return !row.empty(); });
    ORIEL_TRY_VOID(parallel_for(context_, "", asked.size(), [&](std::size_t row) {
      for (const int x : asked[row]) ask_many(eye, x, static_cast<int>(row));
    }));
  }
  return {};
}

EdgeBench::Edges EdgeBench::edges_of(float Pixel::*value) {
  Edges out;
  for (int y = 0; y + 1 < height_; ++y)
    for (int x = 0; x + 1 < width_; ++x)
      for (const bool down : {false, true}) {
        const Pixel &a = at(x, y), &b = at(x + !down, y + down);
        if (!same(a, b) || (a.*value < kLit) == (b.*value < kLit)) continue;
        const float share = (kLit - a.*value) / (b.*value - a.*value);
        out.insert({{x, y, down}, {Vec2(x, y) + (down ? Vec2(0, share) : Vec2(share, 0)), b.*value > a.*value}});
      }
  return out;
}

float EdgeBench::nearest(const Edges& edges, const Vec2& from, const std::array<int, 2>& pixel,
                         const std::optional<std::array<bool, 2>>& like) {
  float best = kFar;
  for (int j = -kFar; j <= kFar; ++j)
    for (int i = -kFar; i <= kFar; ++i)
      for (const bool down : {false, true}) {
        const auto found = edges.find({pixel[0] + i, pixel[1] + j, down});
        if (found == edges.end() || (like && (*like)[0] == down && found->second.rises != (*like)[1])) continue;
        best = std::min(best, glm::distance(from, found->second.at));
      }
  return best;
}

void EdgeBench::add_distances(const Edges& right, const Edges& shown, LampSum& sum) {
  for (const auto& [key, edge] : right) {
    const Pixel &a = at(key[0], key[1]), &b = at(key[0] + !key[2], key[1] + key[2]);
    if (a.asked && b.asked && std::abs(a.right - b.right) >= kSharp)
      sum.off.push_back(nearest(shown, edge.at, {key[0], key[1]}, std::array{key[2] != 0, edge.rises}));
  }
}

// At outlines the frame's pixels show more than one.
bool EdgeBench::shows_one_surface(int x, int y) {
  if (x == 0 || y == 0 || x + 1 == width_ || y + 1 == height_) return false;
  for (int k = 0; k < 9; ++k)
    if (!same(at(x, y), at(x + k % 3 - 1, y + k / 3 - 1))) return false;
  return true;
}

void EdgeBench::add_wrong(const Eye& eye, const Edges& right, LampSum& sum) {
  std::size_t wrong = 0;
  Vec3 where(0);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const Pixel& p = at(x, y);
      if (!p.asked) continue;
      if (p.right > 0.02f && p.right < 0.98f) ++sum.soft, sum.squares += (p.shown - p.right) * (p.shown - p.right);
      if ((p.shown > kLit) == (p.right > kLit) || std::abs(p.shown - p.right) < kSharp) continue;
      if (!shows_one_surface(x, y) || nearest(right, Vec2(x, y), {x, y}, std::nullopt) <= kOff) continue;
      ++(p.shown > kLit ? sum.lit_in_shadow : sum.dark_in_light), ++wrong, where = p.position;
    }
  if (wrong <= sum.worst_count) return;
  sum.worst_count = wrong;
  const auto in_world = [&](const Vec3& p) {
    const DVec3 w = DVec3(p) + bare_.scene.origin;
    return fmt::format("{:.3f},{:.3f},{:.3f}", w.x, w.y, w.z);
  };
  sum.worst =
      fmt::format("{} from {}: {}, the last at {}", eye.camera.name, in_world(eye.camera.eye), wrong, in_world(where));
}

Status EdgeBench::write_picture() {
  ByteImage picture{static_cast<std::uint32_t>(width_), 3 * static_cast<std::uint32_t>(height_), 3, {}};
  for (int part = 0; part < 3; ++part)
    for (const Pixel& p : pixels_) {
      const bool asked = p.triangle != ~0u;
      const float v = part == 0 ? p.shown : part == 1 ? p.right : std::abs(p.shown - p.right);
      const auto byte = asked ? static_cast<std::uint8_t>(255 * std::clamp(v, 0.0f, 1.0f)) : std::uint8_t{60};
      picture.pixels.insert(picture.pixels.end(), {byte, byte, asked ? byte : std::uint8_t{120}});
    }
  return write_png(fmt::format("{}{}.png", settings_.picture, number_++), picture);
}

Status EdgeBench::look(const Eye& eye, LampSum& sum) {
  ORIEL_TRY(const std::vector<float> frame, draw(eye));
  ORIEL_TRY_VOID(find_pixels(eye, frame, sum));
  ORIEL_TRY_VOID(ask_edges(eye));
  const Edges right = edges_of(&Pixel::right);
  add_distances(right, edges_of(&Pixel::shown), sum);
  add_wrong(eye, right, sum);
  if (!settings_.picture.empty()) ORIEL_TRY_VOID(write_picture());
  ++sum.eyes;
  return {};
}

Status run(const Settings& settings) {
  Context context;
  ORIEL_TRY(const Pack full, read_pack(settings.pack));
  if (full.sharp_light.empty()) return fail(ErrorCode::kInvalid, settings.pack, "found no light by pixel");
  ImportOptions options;
  ORIEL_TRY(ImportedScene imported, import_gltf(settings.scene, options, context));
  // A bake may take the file's unit for another.
  const auto size_of = [](const std::vector<Vec3>& positions) {
    Vec3 lower = positions.at(0), upper = lower;
    for (const Vec3& p : positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
    return double{glm::distance(lower, upper)};
  };
  options.unit_m = size_of(full.mesh.positions) / size_of(imported.scene.positions);
  if (std::abs(options.unit_m - 1) > 1e-3) {
    ORIEL_TRY(imported, import_gltf(settings.scene, options, context));
  }
  const BarePack bare(full);
  ORIEL_TRY(const Accel shown, Accel::build(bare.scene));
  ORIEL_TRY(const Accel casters, Accel::build(imported.scene));
  ORIEL_TRY(const auto window, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  ORIEL_TRY(const auto renderer, Renderer::create(device));
  EdgeBench bench(settings, bare, shown, casters, device, *renderer);
  std::map<std::uint32_t, LampSum> sums;
  for (const Eye& eye : bench.eyes(full.cameras)) ORIEL_TRY_VOID(bench.look(eye, sums[eye.lamp]));
  print_table(sums);
  return {};
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  using namespace oriel;
  Settings settings;
  if (const auto code =
          parse_options(argc, argv, "Edges of shadows by pixel beside rays",
                        {{"SCENE", "Arguments", "That was baked", text(settings.scene, "SCENE"), Use::kRequired},
                         {"PACK", "Arguments", "A bake of it", text(settings.pack, "PACK"), Use::kRequired},
                         {"--eyes", "Options", "How many", number(settings.eyes, 1, 1e6)},
                         {"--size", "Options", "Pixels of a frame: W,H", numbers(settings.size, 1, 1e5)},
                         {"--pictures", "Options", "Writes NAME0.png and so on: shown, right, and their difference",
                          text(settings.picture, "NAME")}}))
    return *code;
  const Status done = run(settings);
  if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
  return done ? 0 : static_cast<int>(done.error().code);
}
