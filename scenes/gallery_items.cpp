#include "scenes/gallery_items.h"

#include <array>

#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

constexpr float kSunk = 0.01f;  // m: how far things reach into what they stand on or hang from
constexpr float kHalfTurn = kPi, kQuarterTurn = kPi / 2;

}  // namespace

void add_columns(SampleScene& scene, std::uint32_t stone) {
  const std::uint32_t marble = add_diffuse(scene, "marble", Vec3(0.72f, 0.70f, 0.66f));
  SampleMesh shaft{"column shaft", marble};
  FlutedShaft shape;
  shape.height = kGalleryHeight - 0.30f - 0.24f;
  add_fluted_shaft(shaft, Vec3(0, 0.24f, 0), shape);
  SampleMesh ends{"column ends", stone};
  add_box(ends, Vec3(-0.31f, -kSunk, -0.31f), Vec3(0.31f, 0.10f, 0.31f), kSides | kTop);
  // A torus and a fillet below the shaft, an echinus above it; both reach into their neighbours.
  std::vector<Vec2> base;
  for (int i = 0; i <= 10; ++i) {
    const float angle = kPi * (static_cast<float>(i) / 10.0f - 0.5f);
    base.emplace_back(0.245f + 0.055f * std::cos(angle), 0.155f + 0.055f * std::sin(angle));
  }
  base.emplace_back(0.24f, 0.212f);
  base.emplace_back(0.24f, 0.25f);
  base.emplace_back(0.19f, 0.25f);
  base.insert(base.begin(), Vec2(0.245f, 0.095f));
  add_lathe(ends, Vec3(0), base, 48);
  std::vector<Vec2> echinus{Vec2(0.16f, kGalleryHeight - 0.32f), Vec2(0.21f, kGalleryHeight - 0.32f),
                            Vec2(0.21f, kGalleryHeight - 0.29f)};
  for (int i = 0; i <= 8; ++i) {
    const float t = static_cast<float>(i) / 8.0f;
    echinus.emplace_back(0.20f + 0.09f * std::sin(t * kPi / 2), kGalleryHeight - 0.28f + 0.16f * t * t);
  }
  echinus.emplace_back(0.27f, kGalleryHeight - 0.09f);
  add_lathe(ends, Vec3(0), echinus, 48);
  add_box(ends, Vec3(-0.30f, kGalleryHeight - 0.10f, -0.30f), Vec3(0.30f, kGalleryHeight + kSunk, 0.30f),
          kSides | kBottom);

  const std::uint32_t shaft_mesh = add_mesh(scene, std::move(shaft)), ends_mesh = add_mesh(scene, std::move(ends));
  const std::array<std::pair<const char*, Vec3>, 6> places{{{"A column 1", Vec3(1.3f, 0, 2)},
                                                            {"A column 2", Vec3(4.7f, 0, 2)},
                                                            {"A column 3", Vec3(1.3f, 0, 6)},
                                                            {"A column 4", Vec3(4.7f, 0, 6)},
                                                            {"C column 1", Vec3(7.2f, 0, -5.2f)},
                                                            {"C column 2", Vec3(11.2f, 0, -5.2f)}}};
  for (const auto& [name, position] : places) {
    place(scene, shaft_mesh, std::string(name) + " shaft", position);
    place(scene, ends_mesh, std::string(name) + " ends", position);
  }
}

void add_pictures(SampleScene& scene, std::uint32_t frame) {
  const auto first = static_cast<int>(scene.textures.size());
  scene.textures.push_back(painting_blocks(256));
  scene.textures.push_back(painting_hills(256));
  scene.textures.push_back(painting_circles(256));
  scene.textures.push_back(painting_stripes(256));
  static constexpr std::array<const char*, 4> kTitles{"blocks", "hills", "circles", "stripes"};
  static constexpr std::array<Vec2, 4> kSizes{Vec2(1.2f, 1.2f), Vec2(1.8f, 1.1f), Vec2(1.0f, 1.0f), Vec2(1.6f, 0.9f)};
  std::array<std::uint32_t, 4> canvases{}, frames{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 size = kSizes[i];
    SampleMesh canvas{std::string("canvas ") + kTitles[i],
                      add_material(scene, {.name = std::string("painting ") + kTitles[i],
                                           .base_color = Vec3(1),
                                           .texture = first + static_cast<int>(i)})};
    // A little before the wall, and 5 mm into the frame's inner sides.
    add_quad(canvas, {Vec3(-size.x / 2 - 0.005f, -size.y / 2 - 0.005f, 0.01f), Vec3(size.x + 0.01f, 0, 0),
                      Vec3(0, size.y + 0.01f, 0)});
    project_uvs(canvas, Vec3(-size.x / 2 - 0.005f, size.y / 2 + 0.005f, 0), Vec3(1 / (size.x + 0.01f), 0, 0),
                Vec3(0, -1 / (size.y + 0.01f), 0));
    canvases[i] = add_mesh(scene, std::move(canvas));
    SampleMesh border{std::string("frame ") + kTitles[i], frame};
    add_frame(border, size, 0.06f, 0.045f, kSunk);
    frames[i] = add_mesh(scene, std::move(border));
  }
  struct Hung {
    const char* name;
    std::size_t picture;
    Vec3 position;
    float yaw_rad;
  };
  static const std::array<Hung, 9> kHung{{{"A picture 1", 1, Vec3(0, 1.6f, 4), kQuarterTurn},
                                          {"A picture 2", 2, Vec3(0, 1.6f, 1.4f), kQuarterTurn},
                                          {"A picture 3", 0, Vec3(0, 1.6f, 6.7f), kQuarterTurn},
                                          {"A picture 4", 3, Vec3(6, 1.6f, 1.3f), -kQuarterTurn},
                                          {"A picture 5", 2, Vec3(6, 1.6f, 6.4f), -kQuarterTurn},
                                          {"B picture 1", 0, Vec3(11.2f, 1.6f, 0), 0},
                                          {"B picture 2", 3, Vec3(12.2f, 2.05f, 6.6f), -kQuarterTurn},
                                          {"C picture 1", 1, Vec3(9.2f, 1.6f, -8.2f), 0},
                                          {"C picture 2", 0, Vec3(12.2f, 1.6f, -2.4f), -kQuarterTurn}}};
  for (const Hung& hung : kHung) {
    place(scene, canvases[hung.picture], std::string(hung.name) + " canvas", hung.position, hung.yaw_rad);
    place(scene, frames[hung.picture], std::string(hung.name) + " frame", hung.position, hung.yaw_rad);
  }
}

void add_mirror_and_panel(SampleScene& scene, std::uint32_t frame) {
  SampleMesh mirror{
      "mirror",
      add_material(
          scene,
          {.name = "mirror", .base_color = Vec3(0.93f, 0.94f, 0.93f), .metallic = 1, .roughness = 0, .specular = 1})};
  const Vec2 size(2.4f, 1.8f);
  add_quad(mirror, {Vec3(-size.x / 2 - 0.005f, -size.y / 2 - 0.005f, 0.01f), Vec3(size.x + 0.01f, 0, 0),
                    Vec3(0, size.y + 0.01f, 0)});
  const Vec3 at(7.9f, 1.4f, 8);
  place(scene, std::move(mirror), at, kHalfTurn);
  SampleMesh border{"mirror frame", frame};
  add_frame(border, size, 0.05f, 0.03f, kSunk);
  place(scene, std::move(border), at, kHalfTurn);

  SampleMesh panel{"brushed panel", add_material(scene, {.name = "brushed metal",
                                                         .base_color = Vec3(0.77f, 0.74f, 0.70f),
                                                         .metallic = 1,
                                                         .roughness = 0.3f,
                                                         .specular = 1})};
  const Vec3 lower(-0.9f, -1.0f, -kSunk), upper(0.9f, 1.0f, 0.03f);
  add_box(panel, lower, upper, kFront);
  const Vec3 place_of_panel(3, 1.45f, 0);
  place(scene, std::move(panel), place_of_panel);
  SampleMesh edge{"brushed panel edge", add_diffuse(scene, "panel edge", Vec3(0.35f))};
  add_box(edge, lower, upper, kSides & ~(kFront | kBack));
  add_box(edge, lower, upper, kTop | kBottom);
  place(scene, std::move(edge), place_of_panel);
}

void add_benches(SampleScene& scene, std::uint32_t wood) {
  SampleMesh seat{"bench seat", wood};
  add_rounded_box(seat, Vec3(0, 0.425f, 0), Vec3(0.46f, 0.07f, 1.7f), 0.02f, 6);
  SampleMesh legs{"bench legs", add_diffuse(scene, "bench legs", Vec3(0.22f))};
  for (const float z : {-0.62f, 0.62f}) {
    add_box(legs, Vec3(-0.18f, -kSunk, z - 0.04f), Vec3(0.18f, 0.40f, z + 0.04f), kSides);
  }
  const std::uint32_t seat_mesh = add_mesh(scene, std::move(seat)), legs_mesh = add_mesh(scene, std::move(legs));
  struct Bench {
    const char* name;
    Vec3 position;
    float yaw_rad;
  };
  static const std::array<Bench, 3> kBenches{{{"A bench", Vec3(2.1f, 0, 4), 0},
                                              {"B bench", Vec3(7.3f, 0, 5.9f), kQuarterTurn},
                                              {"C bench", Vec3(11.5f, 0, -2.4f), 0}}};
  for (const Bench& bench : kBenches) {
    place(scene, seat_mesh, std::string(bench.name) + " seat", bench.position, bench.yaw_rad);
    place(scene, legs_mesh, std::string(bench.name) + " legs", bench.position, bench.yaw_rad);
  }
}

void add_sculptures(SampleScene& scene, std::uint32_t stone) {
  SampleMesh plinth{"plinth", stone};
  add_box(plinth, Vec3(-0.25f, -kSunk, -0.25f), Vec3(0.25f, 0.9f, 0.25f), kSides | kTop);
  const std::uint32_t plinth_mesh = add_mesh(scene, std::move(plinth));
  const Vec3 in_a(5.2f, 0, 4.95f), in_c(9.2f, 0, -4.4f), on_platform(11.0f, 0.75f, 6.6f);
  place(scene, plinth_mesh, "A plinth", in_a);
  place(scene, plinth_mesh, "C plinth", in_c);

  SampleMesh ball{"C ball", add_diffuse(scene, "blue glaze", Vec3(0.10f, 0.20f, 0.42f))};
  add_sphere(ball, Vec3(0, 0.9f + 0.28f, 0), 0.285f, 48, 24);
  place(scene, std::move(ball), in_c);

  SampleMesh stack{"A rings", add_diffuse(scene, "ochre", Vec3(0.66f, 0.40f, 0.10f))};
  std::vector<Vec2> rings{Vec2(0, 0.89f)};
  constexpr int kSegments = 8;
  for (int ring = 0; ring < 4; ++ring) {
    const float radius = 0.09f - 0.012f * static_cast<float>(ring);
    for (int i = 1; i < kSegments; ++i) {
      const float angle = kPi * (static_cast<float>(i) / kSegments - 0.5f);
      rings.emplace_back(0.14f - 0.015f * static_cast<float>(ring) + radius * std::cos(angle) * 0.7f,
                         0.97f + 0.15f * static_cast<float>(ring) + 0.075f * std::sin(angle));
    }
  }
  rings.emplace_back(0.0f, 1.50f);
  add_lathe(stack, Vec3(0), rings, 40);
  place(scene, std::move(stack), in_a);

  SampleMesh vase{"B vase", add_diffuse(scene, "celadon", Vec3(0.34f, 0.52f, 0.44f))};
  std::vector<Vec2> profile{Vec2(0.13f, -kSunk)};
  for (int i = 0; i <= 20; ++i) {
    const float t = static_cast<float>(i) / 20.0f;
    profile.emplace_back(0.16f + 0.13f * std::sin(t * 4.1f - 0.3f), 0.03f + 0.75f * t);
  }
  const Vec2 rim = profile.back();
  profile.emplace_back(rim.x - 0.02f, rim.y);
  profile.emplace_back(rim.x - 0.02f, rim.y - 0.25f);
  profile.emplace_back(0.0f, rim.y - 0.30f);
  add_lathe(vase, Vec3(0), profile, 40);
  place(scene, std::move(vase), on_platform);
}

}  // namespace oriel::sample
