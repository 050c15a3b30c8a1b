// Marching reflected rays through radiance maps: against closed-form geometry, and the shader against its twin.
#include "tests/player/twins/march.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "player/gpu/framebuffer.h"
#include "player/gpu/headless.h"
#include "player/gpu/program.h"
#include "player/images/map_array.h"

namespace oriel {
namespace {

// Distance along a ray from a point of the plane, in lengths of `direction`; infinite where it meets nothing.
using Distance = std::function<float(const Vec3& from, const Vec3& direction)>;

RadianceMap capture(const Vec3& eye, std::uint32_t size, const Distance& distance, float half = 1) {
  RadianceMap map;
  map.eye = eye;
  map.lower = Vec2(-half);
  map.upper = Vec2(half);
  map.width = map.height = size;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const Vec2 share((static_cast<float>(x) + 0.5f) / static_cast<float>(size),
                       (static_cast<float>(y) + 0.5f) / static_cast<float>(size));
      const Vec3 on_plane(glm::mix(map.lower, map.upper, share), 0);
      const float t = distance(on_plane, on_plane - eye);
      map.radiance.emplace_back(share, 1);
      map.disparity.push_back(std::isfinite(t) ? 1 / (1 + t) : 0.0f);
      map.valid.push_back(std::isfinite(t) ? 1 : 2);
    }
  return map;
}

// A room before the plane: x, y in [-2, 2], z up to 3.
float room(const Vec3& from, const Vec3& direction) {
  float nearest = 3 / direction.z;
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0) continue;
    nearest = std::min(nearest, (std::copysign(2.0f, direction[axis]) - from[axis]) / direction[axis]);
  }
  return nearest;
}

// A board in it, 0.1 m wide, as high as the room and half a metre from the plane.
float room_with_post(const Vec3& from, const Vec3& direction) {
  const float t = 0.5f / direction.z;
  return std::fabs(from.x + t * direction.x) < 0.05f ? std::min(t, room(from, direction)) : room(from, direction);
}

// A wall across it at z = 0.5 with a slit 0.04 m wide.
float room_with_slit(const Vec3& from, const Vec3& direction) {
  const float t = 0.5f / direction.z;
  const bool through = std::fabs(from.x + t * direction.x) < 0.02f;
  return through ? room(from, direction) : std::min(t, room(from, direction));
}

struct Ray {
  Vec2 on_plane;
  Vec3 direction;
};

class March : public ::testing::Test {
 protected:
  float random(float low, float high) { return std::uniform_real_distribution<float>(low, high)(generator_); }
  // From a mirrored eye near the map's, through the element.
  Ray random_ray(float spread = 0.6f) {
    const Vec3 eye(random(-spread, spread), random(-spread, spread), -random(0.5f, 2));
    const Vec2 on_plane(random(-1, 1), random(-1, 1));
    return {on_plane, Vec3(on_plane, 0) - eye};
  }
  MapHit shoot(const RadianceMap& map, const Relief& relief, const Ray& ray) const {
    return march(relief, map_ray(map.eye, map.lower, map.upper, relief.size, ray.on_plane, ray.direction));
  }
  // How far along the ray a hit lies, in lengths of its direction.
  float distance_of(const MapHit& hit, const RadianceMap& map, const Ray& ray) const {
    const float pace = glm::length(ray.direction);
    return 1 / inverse_distance(hit.s, map.eye.z, pace, pace, ray.direction.z) / pace - 1;
  }
  std::mt19937 generator_{11};
};

// Every ray that stays in the map's frame finds the wall that the closed form finds, to a fraction of a pixel.
TEST_F(March, FindsTheWallsOfARoom) {
  const RadianceMap map = capture({0.2f, -0.1f, -1}, 256, room);
  const Relief relief = make_relief(map);
  int seen = 0, unseen_inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray = random_ray();
    const float expected = room(Vec3(ray.on_plane, 0), ray.direction);
    const Vec3 point = Vec3(ray.on_plane, 0) + expected * ray.direction;
    const Vec2 through = Vec2(map.eye) + (Vec2(point) - Vec2(map.eye)) * (-map.eye.z / (point.z - map.eye.z));
    const bool inside = std::fabs(through.x) < 0.98f && std::fabs(through.y) < 0.98f;
    const MapHit hit = shoot(map, relief, ray);
    if (hit.trust <= 0) {
      unseen_inside += inside;
      continue;
    }
    ++seen;
    EXPECT_EQ(hit.trust, 1) << "nothing hides anything in an empty room";
    EXPECT_NEAR(distance_of(hit, map, ray) / expected, 1, 0.02f) << i;
  }
  EXPECT_GT(seen, 10000);
  EXPECT_EQ(unseen_inside, 0);
}

// The checker above sees a wrong map.
TEST_F(March, AWrongDepthIsSeen) {
  const RadianceMap map =
      capture({0.2f, -0.1f, -1}, 256, [](const Vec3& p, const Vec3& d) { return 0.8f * room(p, d); });
  const Relief relief = make_relief(map);
  int wrong = 0;
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = random_ray();
    const MapHit hit = shoot(map, relief, ray);
    const float expected = room(Vec3(ray.on_plane, 0), ray.direction);
    wrong += hit.trust > 0 && std::fabs(distance_of(hit, map, ray) / expected - 1) > 0.02f;
  }
  EXPECT_GT(wrong, 500);
}

// A ray that the map sees all the way is right about the post; one that passes behind it says so.
TEST_F(March, WhatAPostHidesIsTrustedLess) {
  const RadianceMap map = capture({0, 0, -1}, 256, room_with_post);
  const Relief relief = make_relief(map);
  int on_post = 0, wrong = 0, hidden = 0, trusted = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray = random_ray(1.5f);
    const MapHit hit = shoot(map, relief, ray);
    if (hit.trust <= 0) continue;
    if (hit.trust < 1) {
      ++hidden;
      continue;
    }
    ++trusted;
    const float expected = room_with_post(Vec3(ray.on_plane, 0), ray.direction);
    on_post += expected < room(Vec3(ray.on_plane, 0), ray.direction);
    wrong += std::fabs(distance_of(hit, map, ray) / expected - 1) > 0.02f;
  }
  EXPECT_GT(on_post, 500);
  EXPECT_GT(hidden, 500);
  // Within a pixel of the post's two edges, which are a hundredth of the picture each.
  EXPECT_LT(wrong, trusted / 50);
}

// Whether a ray passes a slit of a few pixels is what the pixel says where it crosses the wall, neither its neighbours'
// word nor that of where steps happen to end. Where the hit's light is taken, little of the other surface is mixed in.
TEST_F(March, ASlitIsAsWideAsItsPixels) {
  const RadianceMap map = capture({0.6f, 0.3f, -0.4f}, 256, room_with_slit);
  const Relief relief = make_relief(map);
  const float s_wall = 0.4f / 0.9f;
  const auto is_wall = [&](const Vec2& pixel) { return relief.at(IVec2(pixel)) > 0.9f * s_wall; };
  int passed = 0, stopped = 0, wrong = 0, mixed = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec2 on_plane = random_ray().on_plane, at(random(-0.05f, 0.05f), random(-0.5f, 0.5f));
    const Vec2 pixel = (Vec2(map.eye) + (at - Vec2(map.eye)) * s_wall + 1.0f) * 128.0f;
    const bool expected = is_wall(pixel);
    // Within kTouching of a border both are right.
    if (is_wall(pixel - Vec2(0.4f, 0)) != expected || is_wall(pixel + Vec2(0.4f, 0)) != expected) continue;
    const MapHit hit = shoot(map, relief, {on_plane, Vec3(at - on_plane, 0.5f)});
    const bool at_wall = std::fabs(hit.s / s_wall - 1) < kNear;
    (expected ? stopped : passed) += 1;
    wrong += (hit.trust == 1 && at_wall) != expected;
    const float left = std::floor(hit.at.x - 0.5f), share = hit.at.x - 0.5f - left;
    if (hit.trust <= 0 || left < 0 || left > 254) continue;
    mixed += (is_wall({left, hit.at.y}) != at_wall && share < 0.8f) ||
             (is_wall({left + 1, hit.at.y}) != at_wall && share > 0.2f);
  }
  EXPECT_GT(passed, 1000);
  EXPECT_GT(stopped, 1000);
  EXPECT_LT(wrong, 5);
  EXPECT_LT(mixed, 5);
}

TEST_F(March, TheSkyIsSeenAtInfinityAndUnseenPixelsAreNot) {
  const Distance sky = [](const Vec3&, const Vec3&) { return std::numeric_limits<float>::infinity(); };
  RadianceMap map = capture({0, 0, -1}, 32, sky);
  const Ray ray{{0.1f, 0.2f}, {0.2f, -0.1f, 1}};
  const MapHit hit = shoot(map, make_relief(map), ray);
  EXPECT_EQ(hit.trust, 1);
  EXPECT_EQ(hit.s, 0);
  EXPECT_NEAR(hit.at.x, (0.2f + 1) * 16, 1e-4f) << "the direction of the ray from the map's eye";
  EXPECT_NEAR(hit.at.y, (-0.1f + 1) * 16, 1e-4f);
  map.valid.assign(map.valid.size(), 0);
  EXPECT_EQ(shoot(map, make_relief(map), ray).trust, 0);
}

// Nothing but finite numbers, whatever the map's size and the ray's slope.
TEST_F(March, Extremes) {
  for (const std::uint32_t size : {1u, 2u, 3u, 65u, 300u})
    for (const float scale : {1e-3f, 1.0f, 1e3f}) {
      const RadianceMap map = capture(
          Vec3(0, 0, -1) * scale, size, [&](const Vec3& p, const Vec3& d) { return room(p / scale, d / scale); },
          scale);
      const Relief relief = make_relief(map);
      for (const float rise : {1e-12f, 1e-6f, 1e-3f, 1.0f, 1e6f})
        for (int i = 0; i < 50; ++i) {
          const Ray ray{Vec2(random(-9, 9), random(-9, 9)) * scale, Vec3(random(-1, 1), random(-1, 1), rise) * scale};
          const MapHit hit = shoot(map, relief, ray);
          ASSERT_TRUE(std::isfinite(hit.s) && std::isfinite(hit.at.x) && std::isfinite(hit.at.y));
          ASSERT_GE(hit.trust, 0);
          ASSERT_LE(hit.trust, 1);
          const float pace = glm::length(ray.direction);
          const float inverse = inverse_distance(hit.s, map.eye.z, pace, pace, ray.direction.z);
          ASSERT_TRUE(hit.trust <= 0 || std::isfinite(inverse));
        }
    }
}

// Ranges only skip: without what they know, in small steps, rays end at the same places.
TEST_F(March, RangesSkipNothing) {
  const RadianceMap map = capture({0, 0, -1}, 40, room);
  const Relief relief = make_relief(map);
  Relief blind = relief;
  for (auto& level : blind.ranges)
    for (Vec2& range : level) range = {0, kUnseenDisparity};
  for (int i = 0; i < 4000; ++i) {
    const Ray ray = random_ray();
    const MapHit a = shoot(map, relief, ray), b = shoot(map, blind, ray);
    EXPECT_EQ(a.trust > 0, b.trust > 0) << i;
    EXPECT_NEAR(a.s, b.s, 0.02f) << i;
  }
}

TEST_F(March, TheShaderDoesTheSame) {
  const auto context = gpu::HeadlessContext::create();
  ASSERT_TRUE(context && gpu::open_device());
  const std::vector<RadianceMap> maps{capture({0, 0, -1}, 48, room), capture({0.3f, 0.2f, -0.8f}, 96, room_with_post)};
  const std::array layers{&maps[0], &maps[1]};
  MapArrayData data = MapArrayData::make(layers);
  const auto upload_array = [](TextureData texels) {
    TextureUpload upload(std::move(texels));
    upload.step(std::numeric_limits<std::size_t>::max());
    return std::move(upload.array);
  };
  const MapArray array{upload_array(std::move(data.light)),
                       upload_array(std::move(data.disparity)),
                       upload_array(std::move(data.ranges)),
                       std::move(data.scale),
                       {{48, 48}, {96, 96}}};
  constexpr int kRays = 1500;
  std::vector<Ray> rays;
  std::vector<Vec4> starts, directions;
  for (int i = 0; i < kRays; ++i) {
    rays.push_back(random_ray());
    starts.emplace_back(rays.back().on_plane, i % 2, 0);
    directions.emplace_back(rays.back().direction, 0);
  }
  auto vertex = gpu::assemble_shader("passes/screen_fullscreen.vert", gpu::Dialect::kDesktop330);
  gpu::ShaderText fragment;
  fragment.text = "#version 330 core\n" + std::string(gpu::shader_source("lib/march.glsl")) + R"(
uniform sampler2D u_starts;
uniform sampler2D u_directions;
uniform sampler2DArray u_disparity;
uniform sampler2DArray u_ranges;
uniform vec4 u_eyes[2];
layout(location = 0) out vec4 o_value;
void main() {
  vec3 start = texelFetch(u_starts, ivec2(gl_FragCoord.xy), 0).xyz;
  vec3 direction = texelFetch(u_directions, ivec2(gl_FragCoord.xy), 0).xyz;
  int layer = int(start.z);
  vec4 eye = u_eyes[layer];
  MapRay ray = map_ray(eye.xyz, vec2(-1.0), vec2(1.0), vec2(eye.w), start.xy, direction);
  MapHit hit = march(u_disparity, u_ranges, layer, ivec2(eye.w), ray);
  o_value = vec4(hit.at, hit.s, hit.trust);
}
)";
  const auto program = gpu::Program::create_from("march", *vertex, fragment);
  ASSERT_TRUE(program) << program.error().text();
  const gpu::Texture2d a(gpu::kRgba32f, kRays, 1, starts.data()), b(gpu::kRgba32f, kRays, 1, directions.data());
  const gpu::Texture2d out(gpu::kRgba32f, kRays, 1, nullptr);
  const auto framebuffer = gpu::Framebuffer::create("test", &out, nullptr);
  const gpu::VertexArray vertices = gpu::make_vertex_array();
  glBindVertexArray(vertices.name());
  framebuffer->bind();
  glViewport(0, 0, kRays, 1);
  a.bind(0);
  b.bind(1);
  array.disparity.bind(2);
  array.ranges.bind(3);
  program->use();
  program->set("u_starts", 0);
  program->set("u_directions", 1);
  program->set("u_disparity", 2);
  program->set("u_ranges", 3);
  const std::vector<Vec4> eyes{Vec4(maps[0].eye, 48), Vec4(maps[1].eye, 96)};
  program->set("u_eyes", eyes);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<Vec4> found(kRays);
  glReadPixels(0, 0, kRays, 1, GL_RGBA, GL_FLOAT, found.data());
  ASSERT_TRUE(gpu::check_gl("test"));
  const Relief reliefs[] = {make_relief(maps[0]), make_relief(maps[1])};
  int hits = 0, different = 0;
  for (int i = 0; i < kRays; ++i) {
    const MapHit hit = shoot(maps[i % 2], reliefs[i % 2], rays[i]);
    hits += hit.trust > 0;
    const Vec4 difference = glm::abs(found[i] - Vec4(hit.at, hit.s, hit.trust));
    // Filtered texels have 8 bits of weight (OpenGL 3.3, table 6.1): a hundredth of a pixel.
    different += difference.x > 0.05f || difference.y > 0.05f || difference.z > 1e-3f || difference.w > 1e-3f;
  }
  EXPECT_GT(hits, kRays / 2);
  EXPECT_LE(different, kRays / 200) << "rays that meet an edge to the last digit may fall to either side of it";
}

}  // namespace
}  // namespace oriel
