// Reflections on curved surfaces: the march around a point against closed forms, on the GPU as on the CPU, and a ball
// in a room against the reflection that it must show.
#include <cstdio>
#include <optional>
#include <random>

#include "formats/core/half.h"
#include "formats/core/octahedral.h"
#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"
#include "tests/player/twins/surround_march.h"

namespace oriel {
namespace {

using testing::FrameTest;
using testing::Picture;

// A room around a ball, all closed forms. Pack space.
constexpr Vec3 kLower{-2, 0, -2}, kUpper{2, 3, 2};

Vec3 exit_point(const Vec3& from, const Vec3& direction) {
  float t = 1e30f;
  for (int axis = 0; axis < 3; ++axis)
    if (direction[axis] != 0)
      t = std::min(t, ((direction[axis] > 0 ? kUpper : kLower)[axis] - from[axis]) / direction[axis]);
  return from + t * direction;
}

// Squares of half a metre, a colour a wall: the same within a square, so that a colour tells a place.
Vec3 wall_light(const Vec3& p) {
  int wall = 0;
  float least = 1e30f;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const float off = std::abs(p[axis] - (side ? kUpper : kLower)[axis]);
      if (off < least) {
        least = off;
        wall = 2 * axis + side;
      }
    }
  const glm::ivec3 square = glm::floor(2.0f * (p + 0.013f));  // no edge where walls meet
  const bool odd = ((square[(wall / 2 + 1) % 3] + square[(wall / 2 + 2) % 3]) & 1) != 0;
  const Vec3 hue(0.2f + 0.15f * static_cast<float>(wall), wall % 2 ? 0.9f : 0.3f, 1 - 0.15f * static_cast<float>(wall));
  return 100.0f * (odd ? hue : 0.4f * hue);
}

SurroundMap room_map(const Vec3& centre, std::uint32_t size, const std::function<Vec3(const Vec3& place)>& light) {
  SurroundMap map;
  map.centre = centre;
  map.size = size;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const Vec2 at = (Vec2(x, y) + 0.5f) / static_cast<float>(size) * 2.0f - 1.0f;
      const Vec3 p = exit_point(centre, glm::normalize(direction_from_octahedral(at)));
      map.radiance.push_back(light(p));
      map.inverse_distance.push_back(1 / glm::length(p - centre));
      map.valid.push_back(1);
    }
  return map;
}

struct Ball {
  Vec3 centre{0.3f, 0.9f, 0.2f};
  float radius = 0.5f;
};

// A polished ball in the room, nothing else; `around` and `along` faces.
Pack ball_pack(const Ball& ball, const SurroundMap& map, int around = 192, int along = 96) {
  Pack pack;
  Material metal;
  metal.fresnel_map = 0;
  metal.kernel = 0;
  metal.metallic = 1;
  pack.materials = {metal};
  pack.kernels.emplace_back();
  pack.kernels[0].weights = {1};
  pack.fresnel_maps = {testing::flat_reflectance(Vec3(1))};
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const float theta = kPi * static_cast<float>(j) / static_cast<float>(along);
      const float phi = 2 * kPi * static_cast<float>(i) / static_cast<float>(around);
      const Vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      pack.mesh.positions.push_back(ball.centre + ball.radius * n);
      pack.mesh.normals.push_back(n);
      pack.mesh.uvs.emplace_back(0);
      pack.mesh.lightmap_uvs.emplace_back(0);
      if (j == along) continue;
      const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * around + x % around); };
      for (const std::uint32_t v : {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i + 1, j)})
        pack.mesh.indices.push_back(v);
    }
  MeshPart part;
  part.index_count = static_cast<std::uint32_t>(pack.mesh.indices.size());
  pack.mesh.parts = {part};
  pack.surround_maps = {map};
  pack.curved_reflectors = {{"ball", 0, 0, pack.mesh.indices}};
  return pack;
}

Camera looking_at(const Vec3& eye, const Vec3& target) {
  return look_at(eye, target, 0.7f);
}

// The ray through a pixel's centre, and where it meets the ball; false where it does not.
struct BallHit {
  Vec3 at{0}, normal{0}, mirror{0};
};
bool hit_ball(const Ball& ball, const Camera& camera, const Vec2& pixel, int width, int height, BallHit& out) {
  const Vec3 right = glm::normalize(glm::cross(camera.forward, camera.up)), up = glm::cross(right, camera.forward);
  const float t = std::tan(0.5f * camera.vertical_fov_rad);
  const Vec2 ndc = (pixel + 0.5f) / Vec2(width, height) * 2.0f - 1.0f;
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const Vec3 d = glm::normalize(camera.forward + t * aspect * ndc.x * right - t * ndc.y * up);
  const Vec3 to = ball.centre - camera.eye;
  const float b = glm::dot(to, d), disc = b * b - glm::dot(to, to) + ball.radius * ball.radius;
  if (disc <= 0) return false;
  out.at = camera.eye + (b - std::sqrt(disc)) * d;
  out.normal = (out.at - ball.centre) / ball.radius;
  out.mirror = glm::reflect(d, out.normal);
  return true;
}

TEST(SurroundMarch, FindsTheWallsOfARoom) {
  const Ball ball;
  const SurroundPyramid map = make_surround_pyramid(room_map(ball.centre, 256, wall_light));
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 n = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    if (glm::dot(d, n) < 0) d = -d;
    const Vec3 origin = ball.radius * n, expected = exit_point(ball.centre + origin, d) - ball.centre;
    const SurroundHit hit = march_surroundings(map, origin, d);
    ASSERT_GT(hit.inverse_distance, 0);
    EXPECT_NEAR(glm::length(hit.direction), 1, 1e-5f);
    worst = std::max<double>(worst, glm::length(hit.direction - glm::normalize(expected)));
    EXPECT_NEAR(1 / hit.inverse_distance, glm::length(expected - origin), 0.03f * glm::length(expected - origin));
  }
  EXPECT_LT(worst, 2 * 2.28 * 2.0 / 256) << "two texels at their widest";
}

TEST(SurroundMarch, TheDirectionAloneWhereNothingIsMet) {
  SurroundMap sky;
  sky.size = 16;
  sky.radiance.assign(256, Vec3(1));
  sky.inverse_distance.assign(256, 0);
  sky.valid.assign(256, 2);
  const Vec3 d = glm::normalize(Vec3(1, 2, 3));
  const SurroundHit hit = march_surroundings(make_surround_pyramid(sky), {0.1f, 0.1f, 0}, d);
  EXPECT_LT(glm::length(hit.direction - d), 1e-6f);
  EXPECT_EQ(hit.inverse_distance, 0);
}

// A ray that passes behind a near thing does not take it for what it hits.
TEST(SurroundMarch, PassesBehindWhatIsNear) {
  SurroundMap map = room_map({0, 1.5f, 0}, 128, wall_light);
  for (std::size_t i = 0; i < map.valid.size(); ++i) {  // a post towards +x, 0.5 m away
    const Vec2 at = (Vec2(i % 128, i / 128) + 0.5f) / 128.0f * 2.0f - 1.0f;
    const Vec3 d = glm::normalize(direction_from_octahedral(at));
    if (d.x > 0 && std::abs(d.z) < 0.06f) map.inverse_distance[i] = 2;
  }
  // From the -z side of the centre past the post's far side to the +z wall.
  const Vec3 origin(0.05f, 0, -0.3f), d = glm::normalize(Vec3(1, 0, 0.3f));
  const SurroundHit hit = march_surroundings(make_surround_pyramid(map), origin, d);
  const Vec3 expected = exit_point(map.centre + origin, d) - map.centre;
  EXPECT_LT(glm::length(hit.direction - glm::normalize(expected)), 0.05f);
}

// One that is hidden to its end sees the ground beside what hides it, and does not take that for what it hits.
TEST(SurroundMarch, SeesPastWhatHidesIt) {
  SurroundMap map = room_map({0, 1.5f, 0}, 128, wall_light);
  for (std::size_t i = 0; i < map.valid.size(); ++i) {  // all that lies towards +x is 0.5 m away
    const Vec2 at = (Vec2(i % 128, i / 128) + 0.5f) / 128.0f * 2.0f - 1.0f;
    if (glm::normalize(direction_from_octahedral(at)).x > 0.3f) map.inverse_distance[i] = 2;
  }
  const SurroundHit hit = march_surroundings(make_surround_pyramid(map), {0, 0, -0.8f}, {1, 0, 0});
  EXPECT_LT(hit.direction.x, 0.3f);
  EXPECT_GT(hit.direction.x, 0.2f);
  EXPECT_LT(hit.direction.z, -0.9f);
}

// Light of a level is the mean of the texels below, borders go on over the edges, gaps are filled.
TEST(SurroundPyramid, LevelsBordersAndGaps) {
  SurroundMap map;
  map.size = 4;
  for (int i = 0; i < 16; ++i) map.radiance.push_back(Vec3(static_cast<float>(i)));
  map.inverse_distance.assign(16, 1);
  map.inverse_distance[3] = 0.5f;
  map.valid.assign(16, 1);
  map.valid[5] = 0;
  const SurroundPyramid p = make_surround_pyramid(map);
  const auto light = [&](int level, int x, int y) {
    const IVec2 at = pyramid_corner(4, level) + 1 + IVec2(x, y);
    return p.scale * rgb_from_rgb9e5(p.light[static_cast<std::size_t>(at.y * p.extent.x + at.x)]).g;
  };
  EXPECT_NEAR(light(0, 2, 3), 14, 0.04f);
  EXPECT_NEAR(light(0, -1, 1), 8, 0.04f);  // the row is turned over
  EXPECT_NEAR(light(0, 1, 4), 14, 0.04f);
  EXPECT_NEAR(light(1, 0, 0), (0 + 1 + 4) / 3.0f, 0.01f);
  EXPECT_NEAR(light(0, 1, 1), light(1, 0, 0), 0.01f);
  EXPECT_NEAR(light(2, 0, 0), (15 * 16 / 2 - 5) / 15.0f, 0.04f);
  EXPECT_EQ(p.range, Vec2(1, 0.5f));
  ASSERT_EQ(p.inverse_distance.size(), 36u);
  EXPECT_EQ(p.inverse_distance[6 + 4], 0.5f);

  map.size = 1;  // the smallest map
  map.radiance.resize(1);
  map.inverse_distance.resize(1);
  map.valid.resize(1);
  EXPECT_EQ(make_surround_pyramid(map).extent, IVec2(3));
}

using CurvedFrames = FrameTest;

// The shader's march gives what the one on the CPU gives.
TEST_F(CurvedFrames, MarchAlikeOnBothSides) {
  const Ball ball;
  SurroundMap map = room_map(ball.centre, 128, wall_light);
  for (std::size_t i = 0; i < map.valid.size(); ++i)
    if (i % 128 > 80 && i / 128 % 32 > 12) map.inverse_distance[i] = 1.5f;  // near things that hide some of it
  const SurroundPyramid pyramid = make_surround_pyramid(map);
  SurroundData data = surround_data(map);
  SurroundTextures textures = std::move(data.place);
  textures.light = upload_texture(std::move(data.light));
  textures.inverse_distance = upload_texture(std::move(data.inverse_distance));
  std::vector<Vec4> origins, directions;
  std::mt19937 random(9);
  std::normal_distribution<float> normal;
  constexpr int kRays = 1000;
  for (int i = 0; i < kRays; ++i) {
    const Vec3 n = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    if (i % 10 == 0) d = n;  // straight away from the centre
    origins.emplace_back(ball.radius * n, 0);
    directions.emplace_back(glm::dot(d, n) < 0 ? -d : d, 0);
  }
  gpu::ShaderText fragment = *gpu::assemble_shader("lib/surround.glsl", gpu::Dialect::kDesktop330);
  fragment.text +=
      "uniform sampler2D u_origins, u_directions, u_distances;\nuniform int u_size;\nuniform vec2 u_range;\n"
      "layout(location = 0) out vec4 o_hit;\nvoid main() {\n  ivec2 at = ivec2(gl_FragCoord.xy);\n"
      "  o_hit = march_surroundings(u_distances, u_size, u_range, texelFetch(u_origins, at, 0).xyz,\n"
      "                             texelFetch(u_directions, at, 0).xyz);\n}\n";
  const auto program = gpu::Program::create_from(
      "test", *gpu::assemble_shader("passes/screen_fullscreen.vert", gpu::Dialect::kDesktop330), fragment);
  ASSERT_TRUE(program) << program.error().text();
  const gpu::Texture2d from(gpu::kRgba32f, kRays, 1, origins.data()), to(gpu::kRgba32f, kRays, 1, directions.data());
  const gpu::Texture2d out(gpu::kRgba32f, kRays, 1, nullptr);
  const auto framebuffer = gpu::Framebuffer::create("test", &out, nullptr);
  ASSERT_TRUE(framebuffer);
  const gpu::VertexArray no_vertices = gpu::make_vertex_array();
  glBindVertexArray(no_vertices.name());
  framebuffer->bind();
  glViewport(0, 0, kRays, 1);
  gpu::apply({});
  from.bind(0);
  to.bind(1);
  textures.inverse_distance.bind(2);
  program->use();
  program->set("u_origins", 0);
  program->set("u_directions", 1);
  program->set("u_distances", 2);
  program->set("u_size", textures.size);
  program->set("u_range", textures.range);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<Vec4> hits(kRays);
  glReadPixels(0, 0, kRays, 1, GL_RGBA, GL_FLOAT, hits.data());
  for (std::size_t i = 0; i < kRays; ++i) {
    const SurroundHit hit = march_surroundings(pyramid, Vec3(origins[i]), Vec3(directions[i]));
    // The device filters with 8 bits between texels.
    EXPECT_LT(glm::length(Vec3(hits[i]) - hit.direction), 2e-3f) << i;
    EXPECT_NEAR(hits[i].w, hit.inverse_distance, 0.01f * hit.inverse_distance) << i;
  }
}

// Each pixel of a mirror ball shows what its reflected rays meet: near to the mean over the pixel, and light that none
// of the pixels within two of it sees only where the filter reaches over an edge.
TEST_F(CurvedFrames, AMirrorBallShowsTheRoom) {
  const Ball ball;
  const Camera camera = looking_at({0.1f, 1.5f, 1.9f}, ball.centre);
  constexpr int kWidth = 240, kHeight = 200, kSub = 4;
  FrameOptions options;
  options.show = Show::kMKR;
  const Picture picture =
      draw(ball_pack(ball, room_map(ball.centre, 512, wall_light)), camera, kWidth, kHeight, options);
  ASSERT_TRUE(picture.finite());
  EXPECT_EQ(picture.stats.reflectors, 1u);
  EXPECT_EQ(renderer_->read_reflective()[kHeight / 2 * kWidth + kWidth / 2], 0);
  EXPECT_EQ(renderer_->read_reflective()[0], -1);
  // The light that a point of the picture shows; nothing outside the ball and in its rim, where all is squeezed.
  const auto light_at = [&](const Vec2& pixel) -> std::optional<Vec3> {
    BallHit hit;
    if (!hit_ball(ball, camera, pixel, kWidth, kHeight, hit)) return {};
    if (glm::dot(hit.normal, glm::normalize(camera.eye - hit.at)) < 0.25f) return {};
    return wall_light(exit_point(hit.at, hit.mirror));
  };
  int pixels = 0, strange = 0;
  double squared = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      Vec3 low(1e30f), high(0), mean(0);
      int seen = 0, within = 0;
      for (int k = 0; k < 25; ++k)
        if (const auto light = light_at(Vec2(x + k % 5 - 2, y + k / 5 - 2))) {
          low = glm::min(low, *light);
          high = glm::max(high, *light);
          ++seen;
        }
      for (int k = 0; k < kSub * kSub; ++k)
        if (const auto light = light_at(Vec2(x, y) + (Vec2(k % kSub, k / kSub) + 0.5f) / float(kSub) - 0.5f)) {
          mean += *light / float(kSub * kSub);
          ++within;
        }
      if (seen < 25 || within < kSub * kSub) continue;
      ++pixels;
      const Vec3 shown = picture.at(x, y);
      squared += glm::dot(shown - mean, shown - mean) / 3;
      strange += glm::any(glm::lessThan(shown, low - 1.0f)) || glm::any(glm::greaterThan(shown, high + 1.0f));
    }
  EXPECT_GT(pixels, 5000);
  EXPECT_LT(strange, 0.005 * pixels);
  const double psnr = 10 * std::log10(100.0 * 100.0 * pixels / squared);
  EXPECT_GT(psnr, 25) << "of squares with edges as sharp as can be";
  std::printf("mirror ball: %d pixels, PSNR %.1f dB\n", pixels, psnr);
}

Pack glossy(Pack pack) {
  BrdfKernel& kernel = pack.kernels[0];
  kernel.size = 9;
  kernel.alpha = 0.2f;
  kernel.half_extent = 0.5f;
  kernel.weights.assign(81, 1.0f / 81);
  return pack;
}

// The largest difference of neighbours in the middle of a picture of 120 by 100.
float roughest(const Picture& p) {
  float most = 0;
  for (int y = 30; y < 70; ++y)
    for (int x = 40; x < 80; ++x) most = std::max(most, glm::length(p.at(x, y) - p.at(x + 1, y)));
  return most;
}

// A flat side beside the map's centre, which it faces away from little more than towards.
Pack side_pack(const Vec3& centre, const SurroundMap& map) {
  Pack pack = glossy(ball_pack({}, map));
  for (std::size_t v = 0; v < pack.mesh.positions.size(); ++v) {
    const Vec3 n = pack.mesh.normals[v];
    pack.mesh.positions[v] = centre + Vec3(0.6f + 0.4f * n.x, 0.4f * n.y, 0.02f);
  }
  std::fill(pack.mesh.normals.begin(), pack.mesh.normals.end(), Vec3(0, 0, 1));
  return pack;
}

// Where a map shows things that are nearer to its centre than the surface that it is for, no distance fits: light is
// shown without creases, whatever those distances are.
TEST_F(CurvedFrames, WhatLiesWithinTheSurfaceMakesNoCreases) {
  const Vec3 centre(0, 1.5f, 0);
  const Camera camera = looking_at(centre + Vec3(1.6f, 0, 1), centre + Vec3(0.6f, 0, 0));
  SurroundMap map = room_map(centre, 128, [](const Vec3& at) { return Vec3(10 + 2 * at.x + 3 * at.y); });
  FrameOptions options;
  options.show = Show::kMK;
  const float smooth = roughest(draw(side_pack(centre, map), camera, 120, 100, options));
  ASSERT_GT(smooth, 0);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> inverse(2, 20);
  for (float& i : map.inverse_distance) i = inverse(random);
  const float rough = roughest(draw(side_pack(centre, map), camera, 120, 100, options));
  EXPECT_LT(rough, 2 * smooth);
}

// A lobe shows the mean of the room weighted by it: for a room of even light that light, and less contrast otherwise.
TEST_F(CurvedFrames, ALobeBlurs) {
  const Ball ball;
  const Camera camera = looking_at({0.1f, 1.5f, 1.9f}, ball.centre);
  FrameOptions options;
  options.show = Show::kMK;
  const Picture even = draw(glossy(ball_pack(ball, room_map(ball.centre, 64, [](const Vec3&) { return Vec3(7); }))),
                            camera, 60, 50, options);
  ASSERT_TRUE(even.finite());
  EXPECT_LT(glm::length(even.at(30, 25) - Vec3(7)), 0.05f);
  const Pack room = ball_pack(ball, room_map(ball.centre, 256, wall_light));
  const auto contrast = [&](const Pack& pack) {
    const Picture p = draw(pack, camera, 120, 100, options);
    double sum = 0;
    for (int y = 40; y < 60; ++y)
      for (int x = 50; x < 70; ++x) sum += glm::length(p.at(x, y) - p.at(x + 1, y));
    return sum;
  };
  EXPECT_LT(contrast(glossy(room)), 0.3 * contrast(room));
  options.blur = Blur::kOff;
  EXPECT_EQ(contrast(glossy(room)), contrast(room));
}

// Off, stages, an eye at the surface and within, a ball on the floor, one pixel, orthographic: finite everywhere.
TEST_F(CurvedFrames, ExtremesStayFinite) {
  Ball ball;
  ball.centre.y = ball.radius;  // touches the floor
  const Pack pack = ball_pack(ball, room_map(ball.centre, 64, wall_light), 24, 12);
  FrameOptions options;
  const Camera far = looking_at({0.1f, 1.5f, 1.9f}, ball.centre);
  for (const Show show : {Show::kAll, Show::kM, Show::kMK, Show::kMKR, Show::kD}) {
    options.show = show;
    EXPECT_TRUE(draw(pack, far, 64, 48, options).finite());
  }
  options.show = Show::kAll;
  Camera plan = looking_at({0.3f, 2.9f, 0.2f}, ball.centre);
  plan.up = {0, 0, -1};
  plan.vertical_fov_rad = 0;
  plan.half_height = 1;
  for (const Camera& camera :
       {plan, looking_at(ball.centre + Vec3(0, 0, 0.5001f), ball.centre + Vec3(1, 0, 0.5f)),
        looking_at(ball.centre, ball.centre + Vec3(1, 0, 0)), looking_at({0.3f, 0.5f, 1000}, ball.centre)})
    EXPECT_TRUE(draw(pack, camera, 32, 32, options).finite());
  EXPECT_TRUE(draw(pack, far, 1, 1, options).finite());
  options.reflections = Reflections::kOff;
  EXPECT_EQ(draw(pack, far, 32, 32, options).stats.reflectors, 0u);
}

// A see-through ball adds its reflection to what is behind.
TEST_F(CurvedFrames, AGlassBallReflectsToo) {
  const Ball ball;
  Pack pack = ball_pack(ball, room_map(ball.centre, 64, [](const Vec3&) { return Vec3(10); }));
  pack.materials[0].metallic = 0;
  pack.materials[0].transmission = 1;
  pack.fresnel_maps = {testing::flat_reflectance(Vec3(0.25f))};
  pack.sky = Vec3(4);
  const Camera camera = looking_at({0.1f, 1.5f, 1.9f}, ball.centre);
  const Picture picture = draw(pack, camera, 60, 50);
  ASSERT_TRUE(picture.finite());
  EXPECT_LT(glm::length(picture.at(30, 25) - Vec3(0.75f * 4 + 0.25f * 10)), 0.1f);
}

}  // namespace
}  // namespace oriel
