// The shading equation on flat surfaces under known light, read back as cd/m².
#include "formats/core/color.h"
#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

// A quad that fills the view of facing_camera(), under E lux.
Pack lit_quad(const Vec3& irradiance) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].base_color = {0.5f, 0.25f, 1.0f};
  pack.lightmaps.push_back(flat_page(irradiance));
  add_quad(pack, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0, 0);
  return pack;
}

Camera facing_camera(float distance = 2) {
  Camera camera;
  camera.eye = {0, 0, distance};
  return camera;
}

void expect_light(const Vec3& found, const Vec3& expected, float relative = 1e-6f) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[c], expected[c], relative * std::fabs(expected[c]) + 1e-30f) << "channel " << c;
}

class Shading : public FrameTest {};

// Walls of boxes: at the seam of two fronts one's end lies behind the other, black, and wins where depths are equal.
TEST_F(Shading, SeamsOfBoxesHideTheirEnds) {
  constexpr int kRows = 720, kFrames = 8;
  Pack pack = lit_quad(Vec3(256));
  pack.lightmaps.push_back(flat_page(Vec3(0)));
  pack.mesh = {};
  for (const float left : {-4.0f, 0.0f}) add_quad(pack, {left, -2, 0}, {4, 0, 0}, {0, 4, 0}, 0, 0);
  add_quad(pack, {0, -2, 0}, {0, 0, -1}, {0, 4, 0}, 0, 1);
  Camera camera;
  camera.eye = {2.5f, 0, 3};
  camera.forward = glm::normalize(-camera.eye);
  int dark = 0;
  for (int frame = 1; frame <= kFrames; ++frame) {
    camera.up = {0.01f * static_cast<float>(frame), 1, 0};  // the seam crosses columns of pixels
    const Picture p = draw(pack, camera, 1280, kRows);
    for (int y = 0; y < kRows; ++y)
      for (int x = 2; x < p.width - 2; ++x)
        dark += p.at(x, y).y < 10 && std::min(p.at(x - 2, y).y, p.at(x + 2, y).y) > 10;
  }
  EXPECT_LE(dark, kFrames * kRows / 256) << "rasterisers place edges to a 256th of a pixel";
}

TEST_F(Shading, DiffuseIsAlbedoOverPiTimesIrradiance) {
  for (const float scale : {1e-6f, 1.0f, 1e3f, 1e9f}) {
    const Vec3 e = Vec3(1, 0.5f, 0.25f) * scale;
    const Picture p = draw(lit_quad(e), facing_camera(), 16, 9);
    expect_light(p.at(8, 4), Vec3(0.5f, 0.25f, 1.0f) * e / kPi, 0x1p-11f);
    expect_light(p.at(0, 0), p.at(15, 8));
  }
  // A power of two survives half floats exactly.
  expect_light(draw(lit_quad(Vec3(256)), facing_camera(), 8, 8).at(3, 3), Vec3(128, 64, 256) / kPi);
}

TEST_F(Shading, ReflectanceTakesFromTheDiffusePartAndShowsUndirectedLight) {
  Pack pack = lit_quad(Vec3(256));
  pack.fresnel_maps.push_back(flat_reflectance({0.25f, 0.5f, 0.125f}));
  pack.materials[0].fresnel_map = 0;
  pack.materials[0].metallic = 0.5f;
  pack.materials[0].emission = {8, 16, 32};
  const Vec3 d = Vec3(128, 64, 256) / kPi * 0.5f * 0.5f;
  const Vec3 s = Vec3(64, 128, 32) / kPi;
  expect_light(draw(pack, facing_camera(), 8, 8).at(3, 3), d + s + Vec3(8, 16, 32));
  FrameOptions options;
  options.show = Show::kD;
  expect_light(draw(pack, facing_camera(), 8, 8, options).at(3, 3), d);
  for (const Show show : {Show::kM, Show::kMK, Show::kMKR}) {
    options.show = show;
    expect_light(draw(pack, facing_camera(), 8, 8, options).at(3, 3), Vec3(0));
  }
}

// The table is read at the cosine of the viewing angle, linearly in its square root.
TEST_F(Shading, ReflectanceFollowsTheViewingAngle) {
  Pack pack = lit_quad(Vec3(256));
  FresnelMap map;
  for (int i = 0; i < 5; ++i) map.table.emplace_back(1 - i / 4.0f);
  pack.fresnel_maps.push_back(map);
  pack.materials[0].fresnel_map = 0;
  pack.materials[0].base_color = Vec3(0);
  const int size = 33;
  const Picture p = draw(pack, facing_camera(), size, size);
  for (const int x : {0, 5, 16, 30}) {
    const float ndc = (static_cast<float>(x) + 0.5f) / size * 2 - 1;
    const float cos_theta = 1 / std::sqrt(1 + std::pow(ndc * std::tan(0.5f), 2.0f));
    expect_light(p.at(x, 16), Vec3((1 - std::sqrt(cos_theta)) * 256 / kPi), x == 16 ? 1.0f : 2e-4f);
  }
}

TEST_F(Shading, TexturesAreDecodedAndCutOut) {
  Pack pack = lit_quad(Vec3(256));
  pack.materials[0].base_color = Vec3(1);
  pack.materials[0].base_color_texture = 0;
  pack.textures.push_back({"t", 1, 1, Wrap::kRepeat, Wrap::kRepeat, false, {128, 255, 0, 127}});
  pack.sky = {7, 7, 7};
  const Picture p = draw(pack, facing_camera(), 4, 4);
  // Mesa's software rasteriser decodes sRGB by a polynomial that is off by up to 0.4 %.
  expect_light(p.at(2, 2), Vec3(0.2158605f, 1, 0) * 256.0f / kPi, 5e-3f);
  pack.materials[0].alpha_mode = AlphaMode::kMask;
  pack.materials[0].alpha_cutoff = 0.5f;
  expect_light(draw(pack, facing_camera(), 4, 4).at(2, 2), Vec3(7));
  pack.materials[0].alpha_cutoff = 0.45f;
  expect_light(draw(pack, facing_camera(), 4, 4).at(2, 2), p.at(2, 2));
}

// Stripes along a wall that is seen at 6 degrees: a pixel sees nine times as much along them as across.
TEST_F(Shading, SlantedSurfacesKeepTheirPattern) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].base_color_texture = 0;
  constexpr std::uint32_t kTexels = 128, kStripe = 4;
  Texture stripes{"t", kTexels, kTexels, Wrap::kRepeat, Wrap::kRepeat, false, {}};
  for (std::uint32_t i = 0; i < kTexels * kTexels; ++i)
    stripes.texels.insert(stripes.texels.end(), 4, i / kTexels / kStripe % 2 == 1 ? 255 : 0);
  for (std::size_t i = 3; i < stripes.texels.size(); i += 4) stripes.texels[i] = 255;
  pack.textures.push_back(std::move(stripes));
  add_quad(pack, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0, 0);
  pack.lightmaps = {flat_page(Vec3(kPi))};
  constexpr int kSize = 96;
  const Picture p = draw(pack, look_at({-4, 0, 0.4f}, {0, 0, 0}, 0.9f), kSize, kSize);
  Vec3 least(1), most(0);
  for (int y = kSize / 2 - 12; y < kSize / 2 + 12; ++y) {
    least = glm::min(least, p.at(kSize / 2, y));
    most = glm::max(most, p.at(kSize / 2, y));
  }
  EXPECT_LT(least.g, 0.1f);
  EXPECT_GT(most.g, 0.9f);
}

// Through a slanted grid of noise, what is behind shows in each hole: depth and light are cut alike.
TEST_F(Shading, SlantedCutOutsHaveNoHolesInWhatIsBehind) {
  Pack pack;
  pack.sky = {0, 0, 900};
  pack.materials.resize(2);
  pack.materials[0].base_color_texture = 0;
  pack.materials[0].alpha_mode = AlphaMode::kMask;
  pack.materials[0].alpha_cutoff = 0.5f;
  pack.materials[1].emission = {1, 0, 0};
  constexpr std::uint32_t kTexels = 64;
  Texture noise{"t", kTexels, kTexels, Wrap::kRepeat, Wrap::kRepeat, false, {}};
  for (std::uint32_t i = 0; i < kTexels * kTexels; ++i) {
    const auto alpha = static_cast<std::uint8_t>(i * 2654435761u >> 24);
    noise.texels.insert(noise.texels.end(), {255, 255, 255, alpha});
  }
  pack.textures.push_back(std::move(noise));
  add_quad(pack, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0, 0);
  add_quad(pack, {6, 50, -50}, {0, -100, 0}, {0, 0, 100}, 1, -1);
  pack.lightmaps = {flat_page(Vec3(kPi))};
  const Picture p = draw(pack, look_at({-4, 0, 0.4f}, {0, 0, 0}, 0.9f), 96, 96);
  int sky = 0, grid = 0;
  for (int i = 0; i < 96 * 96; ++i) {
    const Vec3 light = p.at(i % 96, i / 96);
    sky += light.b > 2;
    grid += light.g > 0.5f;
  }
  EXPECT_EQ(sky, 0);
  EXPECT_GT(grid, 500);
}

// A screen of four colours: each pixel has its texel's share of the mean, in the open and through glass, dimmed or not.
TEST_F(Shading, ScreensShowTheirPicture) {
  for (const float transmission : {0.0f, 0.5f}) {
    Pack pack = lit_quad(Vec3(0));
    pack.materials[0].transmission = transmission;
    pack.materials[0].emission = {100, 50, 0};
    Texture picture;
    picture.width = picture.height = 2;
    picture.nearest = true;
    picture.texels = {255, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255, 188, 188, 0, 255};
    pack.textures = {picture};
    const float grey = linear_from_srgb(188 / 255.0f);
    pack.emission_textures = {{0, 0, Vec3(0.5f, 0.25f, 0)}};
    FrameOptions options;
    options.samples = 1;
    const Picture p = draw(pack, facing_camera(), 8, 8, options);
    expect_light(p.at(1, 1), {200, 0, 0}, 1e-3f);
    expect_light(p.at(6, 1), {200, 200, 0}, 1e-3f);  // where the mean is 0 nothing shines
    expect_light(p.at(1, 6), {0, 0, 0});
    expect_light(p.at(6, 6), Vec3(200, 200, 0) * grey, 0.01f);
    pack.emission_textures.clear();
    expect_light(draw(pack, facing_camera(), 8, 8, options).at(1, 6), {100, 50, 0}, 1e-3f);
  }
}

TEST_F(Shading, SeeThroughSurfacesDimAndAdd) {
  Pack pack;
  pack.sky = {64, 64, 64};
  pack.materials.resize(2);
  pack.materials[0].alpha_mode = AlphaMode::kBlend;
  pack.materials[0].alpha = 0.25f;
  pack.materials[0].emission = Vec3(16);
  pack.materials[1].transmission = 1;
  pack.materials[1].base_color = {1, 0.5f, 0.25f};
  add_quad(pack, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0, -1);
  expect_light(draw(pack, facing_camera(), 4, 4).at(1, 1), Vec3(0.25f * 16 + 0.75f * 64));
  add_quad(pack, {-4, -4, -1}, {8, 0, 0}, {0, 8, 0}, 1, -1);  // behind: drawn first
  expect_light(draw(pack, facing_camera(), 4, 4).at(1, 1), 4.0f + 0.75f * Vec3(64, 32, 16));
}

// An unlit pane of one mesh with those before: a colour, a share that covers.
void add_pane(Pack& pack, float z, const glm::uvec4& color) {
  add_quad(pack, {-4, -4, z}, {8, 0, 0}, {0, 8, 0}, 0, -1);
  if (pack.mesh.parts.size() > 1) pack.mesh.parts.pop_back(), pack.mesh.parts[0].index_count += 6;
  for (int corner = 0; corner < 4; ++corner)
    pack.mesh.colors.push_back(color.r | color.g << 8 | color.b << 16 | color.a << 24);
}

Pack unlit_panes() {
  Pack pack;
  pack.sky = Vec3(64);
  pack.materials.resize(1);
  pack.materials[0].alpha_mode = AlphaMode::kBlend;
  pack.materials[0].unlit = pack.materials[0].double_sided = true;
  pack.materials[0].emission = Vec3(100);
  return pack;
}

TEST_F(Shading, WhereAlphaIsOneBlendedSurfacesHide) {
  Pack pack = unlit_panes();
  add_pane(pack, 0, {255, 0, 0, 255});
  const Picture whole = draw(pack, facing_camera(), 4, 4);
  add_pane(pack, -1, {0, 255, 0, 255});
  add_pane(pack, -2, {0, 0, 255, 128});
  EXPECT_EQ(draw(pack, facing_camera(), 4, 4).rgb, whole.rgb);
  pack.materials[0].alpha_mode = AlphaMode::kOpaque;
  EXPECT_EQ(draw(pack, facing_camera(), 4, 4).rgb, whole.rgb);
}

// From both sides, whatever the order of its triangles.
TEST_F(Shading, LayersOfOneMeshCoverEachOther) {
  Pack pack = unlit_panes();
  pack.materials[0].base_color = Vec3(1);
  const std::vector<glm::uvec4> colors{
      {255, 0, 0, 51}, {0, 255, 0, 102}, {0, 0, 255, 153}, {255, 255, 0, 51}, {0, 255, 255, 204}};
  for (int i = 0; i < 5; ++i) add_pane(pack, -0.3f * static_cast<float>(i), colors[static_cast<std::size_t>(i)]);
  const auto over = [&](Vec3 light, int pane) {
    const glm::uvec4 c = colors[static_cast<std::size_t>(pane)];
    const float share = static_cast<float>(c.a) / 255;
    return (1 - share) * light + share * 100.0f / 255.0f * Vec3(c);
  };
  Vec3 front(64), back(64);
  for (int i = 0; i < 5; ++i) front = over(front, 4 - i), back = over(back, i);
  expect_light(draw(pack, facing_camera(), 4, 4).at(1, 1), front, 0.02f);
  Camera behind = facing_camera(-3);
  behind.forward = {0, 0, 1};
  expect_light(draw(pack, behind, 4, 4).at(1, 1), back, 0.02f);
}

// A shade whose sides are parts of their own, as far away: before its far inside lies its near outside.
TEST_F(Shading, TheInsideOfAShellLiesBehindItsOutside) {
  Pack pack;
  pack.sky = {64, 64, 64};
  pack.materials.resize(2);
  for (Material& m : pack.materials) m.alpha_mode = AlphaMode::kBlend, m.alpha = 0.25f;
  pack.materials[0].emission = Vec3(16);
  pack.materials[1].emission = Vec3(80);
  const auto add_side = [&](std::uint32_t material, float outward) {
    add_quad(pack, {-4 * outward, -4, 1}, {8 * outward, 0, 0}, {0, 8, 0}, material, -1);
    add_quad(pack, {4 * outward, -4, -1}, {-8 * outward, 0, 0}, {0, 8, 0}, material, -1);
    pack.mesh.parts.pop_back();
    pack.mesh.parts.back().index_count *= 2;
  };
  add_side(0, 1), add_side(1, -1);
  const float inside = 0.25f * 80 + 0.75f * 64;
  expect_light(draw(pack, facing_camera(3), 4, 4).at(1, 1), Vec3(0.25f * 16 + 0.75f * inside));
}

TEST_F(Shading, BackFacesAreOpenOrDark) {
  Pack pack = lit_quad(Vec3(256));
  pack.sky = {3, 4, 5};
  Camera behind = facing_camera(-2);
  behind.forward = {0, 0, 1};
  expect_light(draw(pack, behind, 4, 4).at(1, 1), Vec3(3, 4, 5));
  pack.materials[0].double_sided = true;
  pack.materials[0].emission = Vec3(2);
  expect_light(draw(pack, behind, 4, 4).at(1, 1), Vec3(2));  // the lightmap holds the front's light
}

TEST_F(Shading, UnlitSurfacesShowTheirColourAtAnyExposure) {
  Pack pack = lit_quad(Vec3(256));
  pack.materials[0].unlit = true;
  pack.mesh.parts[0].lightmap_page = -1;
  draw(pack, facing_camera(), 4, 4);
  for (const float ev : {-5.0f, 0.0f, 20.0f}) {
    const auto pixels = renderer_->read_display(ev, ToneCurve::kAces);
    ASSERT_TRUE(pixels);
    EXPECT_NEAR((*pixels)[0], 188, 1);  // sRGB of 0.5
    EXPECT_NEAR((*pixels)[1], 137, 1);
    EXPECT_EQ((*pixels)[2], 255);
  }
  const auto metered = renderer_->meter();
  ASSERT_TRUE(metered);
  EXPECT_FALSE(metered->has_value()) << "nothing but unlit pixels";
}

// A pane that shines half as bright as the unlit white behind it, over a half of it.
TEST_F(Shading, LightOfPanesIsAddedToUnlitSurfacesByTheirWhite) {
  Pack pack = lit_quad(Vec3(256));
  pack.materials[0].unlit = true;
  pack.materials[0].emission = Vec3(400);
  pack.mesh.parts[0].lightmap_page = -1;
  pack.materials.resize(2);
  pack.materials[1].base_color = Vec3(0);
  pack.materials[1].alpha = 0.5f;
  pack.materials[1].alpha_mode = AlphaMode::kBlend;
  pack.materials[1].emission = {0, 200, 0};
  add_quad(pack, {-1, -1, 0.1f}, {2, 0, 0}, {0, 2, 0}, 1, -1);
  const Vec3 light = draw(pack, facing_camera(), 4, 4).at(1, 1);
  EXPECT_LT(glm::length(light - Vec3(0.25f * 400, 0.125f * 400 + 100, 0.5f * 400)), 0.1f);
  const auto pixels = renderer_->read_display(3, ToneCurve::kAces);
  ASSERT_TRUE(pixels);
  EXPECT_NEAR((*pixels)[0], 137, 1);  // sRGB of 0.25
  EXPECT_NEAR((*pixels)[1], 165, 1);  // of 0.375
  EXPECT_NEAR((*pixels)[2], 188, 1);
}

TEST_F(Shading, ExposureIsTheMetersAndTheUsers) {
  draw(lit_quad(Vec3(256)), facing_camera(), 50, 20);
  const float y = luminance(Vec3(128, 64, 256) / kPi);
  const auto metered = renderer_->meter();
  ASSERT_TRUE(metered && *metered);
  EXPECT_NEAR(white_of_exposure(**metered) * 0.18f, y, 1e-3f * y);
  const auto pixels = renderer_->read_display(std::log2(256 / kPi / 1.2f), ToneCurve::kNone);
  ASSERT_TRUE(pixels);
  EXPECT_EQ((*pixels)[2], 255);
  EXPECT_NEAR((*pixels)[0], 188, 1);
}

TEST_F(Shading, WithoutLightmapsOrAnythingAtAll) {
  Pack pack = lit_quad(Vec3(256));
  pack.lightmaps.clear();
  pack.mesh.parts[0].lightmap_page = -1;
  expect_light(draw(pack, facing_camera(), 4, 4).at(1, 1), Vec3(0));
  Pack empty;
  empty.sky = {1, 2, 3};
  expect_light(draw(empty, facing_camera(), 4, 4).at(1, 1), Vec3(1, 2, 3));
}

TEST_F(Shading, SizesFromOnePixelTo4096) {
  const Pack pack = lit_quad(Vec3(256));
  for (const auto& [w, h] : {std::pair{1, 1}, {1, 7}, {4096, 2}, {3, 4096}}) {
    const Picture p = draw(pack, facing_camera(), w, h);
    EXPECT_TRUE(p.finite()) << w << "x" << h;
    expect_light(p.at(w / 2, h / 2), Vec3(128, 64, 256) / kPi);
  }
  auto scene = GpuScene::create(pack, device_);
  ASSERT_TRUE(scene);
  const View view = make_view(facing_camera(), device_.texture_size + 1, 1, (*scene)->bounds());
  const auto refused = renderer_->render(**scene, view, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
  EXPECT_NE(refused.error().message.find(std::to_string(device_.texture_size + 1)), std::string::npos);
}

// The same picture of a building, a coin and a mountain range.
TEST_F(Shading, EveryScaleOfGeometry) {
  for (const float scale : {1e-4f, 1.0f, 1e6f}) {
    Pack pack = lit_quad(Vec3(256));
    for (Vec3& p : pack.mesh.positions) p *= scale;
    add_quad(pack, Vec3(-0.1f, -0.1f, -0.05f) * scale, Vec3(0.2f, 0, 0) * scale, Vec3(0, 0.2f, 0) * scale, 0,
             -1);  // hidden
    const Picture p = draw(pack, facing_camera(2 * scale), 16, 16);
    for (int i = 0; i < 16; ++i) expect_light(p.at(i, i), Vec3(128, 64, 256) / kPi);
  }
}

TEST_F(Shading, OrthographicCamera) {
  Pack pack = lit_quad(Vec3(256));
  Camera camera = facing_camera();
  camera.vertical_fov_rad = 0;
  camera.half_height = 8;  // the quad is half the picture
  const Picture p = draw(pack, camera, 16, 16);
  expect_light(p.at(8, 8), Vec3(128, 64, 256) / kPi);
  expect_light(p.at(4, 4), Vec3(128, 64, 256) / kPi);
  expect_light(p.at(3, 8), Vec3(0));
}

// What a pack must not be at all, its reader and writer say (validate_test).
TEST_F(Shading, WhatTheDeviceCannotHoldIsRefused) {
  Pack too_large = lit_quad(Vec3(1));
  too_large.textures.push_back({"t", 1u << 20, 1, Wrap::kRepeat, Wrap::kRepeat, false, {}});
  const auto refused = GpuScene::create(too_large, device_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kRuntime);
}

}  // namespace
}  // namespace oriel
