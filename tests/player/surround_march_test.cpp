// The march through a surround map against closed forms, on the GPU as on the CPU, and the pyramid that is made of a
// map.
#include <limits>
#include <random>

#include "tests/player/curved_scene.h"
#include "tests/player/twins/surround_march.h"

namespace oriel {
namespace {

using namespace test;
using testing::FrameTest;

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

// Light of a level is the mean of the texels below by solid angle, borders go on over the edges, gaps are filled.
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
  const double edge = std::pow(0.625, -1.5), other = std::pow(0.375, -1.5);  // solid angles, over the flat texel's
  EXPECT_NEAR(light(1, 0, 0), (1 + 4) * edge / (other + 2 * edge), 0.01);
  EXPECT_NEAR(light(0, 1, 1), light(1, 0, 0), 0.01f);
  EXPECT_NEAR(light(2, 0, 0), (60 * edge + 55 * other) / (8 * edge + 7 * other), 0.04);
  EXPECT_EQ(p.range, Vec2(1, 0.5f));
  ASSERT_EQ(p.inverse_distance.size(), 36u);
  EXPECT_EQ(p.inverse_distance[6 + 4], 0.5f);

  map.size = 1;  // the smallest map
  map.radiance.resize(1);
  map.inverse_distance.resize(1);
  map.valid.resize(1);
  EXPECT_EQ(make_surround_pyramid(map).extent, IVec2(3));
}

// 5 cos⁴ about an axis has a mean of 1 over all directions; over texels alike 1.1.
TEST(SurroundPyramid, TheCoarsestLevelIsTheMeanOverDirections) {
  SurroundMap map;
  map.size = 64;
  for (int i = 0; i < 64 * 64; ++i) {
    const Vec3 d = glm::normalize(direction_from_octahedral((Vec2(i % 64, i / 64) + 0.5f) / 32.0f - 1.0f));
    map.radiance.push_back(5.0f * d * d * d * d);
  }
  map.inverse_distance.assign(64 * 64, 1);
  map.valid.assign(64 * 64, 1);
  const SurroundPyramid p = make_surround_pyramid(map);
  const IVec2 at = pyramid_corner(64, 6) + 1;
  const Vec3 mean = p.scale * rgb_from_rgb9e5(p.light[static_cast<std::size_t>(at.y * p.extent.x + at.x)]);
  EXPECT_LT(glm::length(mean - 1.0f), 0.01f);
}

using SurroundFrames = FrameTest;

// The shader's march gives what the one on the CPU gives.
TEST_F(SurroundFrames, MarchAlikeOnBothSides) {
  const Ball ball;
  SurroundMap map = room_map(ball.centre, 128, wall_light);
  for (std::size_t i = 0; i < map.valid.size(); ++i)
    if (i % 128 > 80 && i / 128 % 32 > 12) map.inverse_distance[i] = 1.5f;  // near things that hide some of it
  const SurroundPyramid pyramid = make_surround_pyramid(map);
  SurroundData data = surround_data(map);
  SurroundTextures textures = std::move(data.place);
  const auto upload = [](TextureData whole) {
    TextureUpload all(std::move(whole));
    all.step(std::numeric_limits<std::size_t>::max());
    return std::move(all.texture);
  };
  textures.light = upload(std::move(data.light));
  textures.inverse_distance = upload(std::move(data.inverse_distance));
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

}  // namespace
}  // namespace oriel
