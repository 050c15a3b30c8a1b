// Contexts, shader texts and their errors, and the maths that stands both in C++ and in shaders/lib.
#include "player/gpu/program.h"

#include <gtest/gtest.h>

#include <random>

#include "bake/radiance/reproject.h"
#include "formats/assets/lightmap.h"
#include "formats/assets/normal_map.h"
#include "formats/core/color.h"
#include "formats/query/lobe_light.h"
#include "player/gpu/framebuffer.h"
#include "player/gpu/headless.h"
#include "player/scene/textures.h"
#include "tests/player/twins/map_point.h"
#include "tests/player/twins/reflected_polygon.h"

namespace oriel {
namespace {
using gpu::Dialect;

constexpr const char* kPasses[] = {
    "depth",           "reflector_mask",    "reflector_emitters", "reflector_emitters_sharp",
    "scene",           "transparent",       "map_mesh",           "curved_light",
    "curved_surface",  "screen_curved",     "screen_pull",        "screen_push",
    "screen_convolve", "reflector_compose", "reflector_convolve", "screen_luminance",
    "screen_tonemap",  "mover_light",       "mover_bright_light", "glass",
    "glass_shape",     "glass_surface",     "screen_behind",      "screen_glass"};

TEST(Headless, OpensWithoutADisplay) {
  const auto context = gpu::HeadlessContext::create();
  ASSERT_TRUE(context) << context.error().text();
  const auto device = gpu::open_device();
  ASSERT_TRUE(device) << device.error().text();
  EXPECT_EQ(device->dialect, Dialect::kDesktop330);
  EXPECT_GE(device->texture_size, 4096);
  EXPECT_GT(device->point_size_max, 1);
  EXPECT_TRUE(gpu::check_gl("start"));
}

TEST(Headless, NoContextIsAnError) {
  const auto device = gpu::open_device();
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error().code, ErrorCode::kRuntime);
}

TEST(Headless, AnOpenGlErrorIsNamedOnce) {
  const auto context = gpu::HeadlessContext::create();
  ASSERT_TRUE(context);
  glEnable(0x1234);
  const Status status = gpu::check_gl("here");
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().text().find("here: found GL_INVALID_ENUM"), std::string::npos) << status.error().text();
  EXPECT_TRUE(gpu::check_gl("here"));
}

// Every pass compiles as OpenGL 3.3 core and as OpenGL ES 3.0, in a context of that kind.
TEST(Programs, CompileInBothDialects) {
  for (const Dialect dialect : {Dialect::kDesktop330, Dialect::kEs300}) {
    const auto context = gpu::HeadlessContext::create(dialect);
    ASSERT_TRUE(context) << context.error().text();
    const auto device = gpu::open_device();
    ASSERT_TRUE(device) << device.error().text();
    EXPECT_EQ(device->dialect, dialect);
    for (const char* name : kPasses) {
      const auto program = gpu::Program::create(name, dialect);
      EXPECT_TRUE(program) << program.error().text();
    }
    for (const char* name : {"scene", "depth"}) {
      const auto program = gpu::Program::create(name, dialect, "PLAIN");
      EXPECT_TRUE(program) << program.error().text();
    }
    for (const char* define : {"SHARP", "PLAIN SHARP", "REFLECTED SHARP SUNS"}) {
      const auto program = gpu::Program::create("scene", dialect, define);
      EXPECT_TRUE(program) << program.error().text();
    }
    const auto tree = gpu::Program::create("screen_glass", dialect, "TREE");
    EXPECT_TRUE(tree) << tree.error().text();
    if (dialect == Dialect::kEs300) continue;  // has no multisample textures
    const auto sampled = gpu::Program::create("screen_tonemap", dialect, "MULTISAMPLED");
    EXPECT_TRUE(sampled) << sampled.error().text();
  }
}

TEST(Programs, ErrorsNameTheFileAndTheLine) {
  const auto context = gpu::HeadlessContext::create();
  ASSERT_TRUE(context);
  auto vertex = gpu::assemble_shader("passes/screen_fullscreen.vert", Dialect::kDesktop330);
  auto fragment = gpu::assemble_shader("passes/screen_tonemap.frag", Dialect::kDesktop330);
  ASSERT_TRUE(vertex && fragment);
  // In the middle of an included file, and in the file itself after two inclusions.
  const auto broken_at = [&](const char* before, const char* expected) {
    gpu::ShaderText broken = *fragment;
    broken.text.insert(broken.text.find(before), "nothing_of_the_kind ");
    const auto program = gpu::Program::create_from("screen_tonemap", *vertex, broken);
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().code, ErrorCode::kRuntime);
    const std::string text = program.error().text();
    EXPECT_NE(text.find("passes/screen_tonemap.frag: does not compile"), std::string::npos) << text;
    EXPECT_NE(text.find(expected), std::string::npos) << text;
  };
  broken_at("vec3 srgb_from_linear", "lib/color.glsl:6");
  broken_at("void main()", "passes/screen_tonemap.frag:24");
  EXPECT_FALSE(gpu::Program::create("no_such_pass", Dialect::kDesktop330));
}

TEST(Programs, PlacesOfEveryDriverAreNamed) {
  gpu::ShaderText source;
  source.origin = {"", "a.frag:1", "b.glsl:7"};
  EXPECT_EQ(gpu::name_places("0:3(5): error: x", source), "b.glsl:7: error: x");                          // Mesa
  EXPECT_EQ(gpu::name_places("0(2) : error C1\n0(3) : y", source), "a.frag:1 : error C1\nb.glsl:7 : y");  // NVIDIA
  EXPECT_EQ(gpu::name_places("ERROR: 0:2: 'x'", source), "ERROR: a.frag:1: 'x'");                         // others
  for (const char* other : {"", "0:1 0:99 0:x v0:2 0(2", "99999999999999999999:3x", "0:99999999999999999999999"}) {
    const std::string kept = gpu::name_places(other, gpu::ShaderText{});
    EXPECT_EQ(kept, other);
  }
}

TEST(Framebuffers, AnImpossibleOneIsRefused) {
  const auto context = gpu::HeadlessContext::create();
  ASSERT_TRUE(context);
  const gpu::Texture2d color(gpu::kRgba8, 4, 4, nullptr);
  const auto wrong = gpu::Framebuffer::create("a test", nullptr, &color);  // colour as depth
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().text().find("a test: found framebuffer status"), std::string::npos) << wrong.error().text();
  gpu::check_gl("").has_value();
}

// Runs `body`, which turns vec4 a, vec4 b of a row of inputs into o_value, on the GPU.
std::vector<Vec4> run_shader(const std::string& library, const std::string& body, const std::vector<Vec4>& a,
                             const std::vector<Vec4>& b) {
  const gpu::ShaderText vertex = *gpu::assemble_shader("passes/screen_fullscreen.vert", Dialect::kDesktop330);
  gpu::ShaderText fragment;
  fragment.text = "#version 330 core\n";
  EXPECT_FALSE(gpu::shader_source(library).empty()) << library;
  fragment.text += gpu::shader_source(library);
  fragment.text +=
      "uniform sampler2D u_a;\nuniform sampler2D u_b;\nlayout(location = 0) out vec4 o_value;\nvoid main() {\n"
      "  ivec2 at = ivec2(gl_FragCoord.xy);\n  vec4 a = texelFetch(u_a, at, 0), b = texelFetch(u_b, at, 0);\n" +
      body + "}\n";
  const auto program = gpu::Program::create_from("test", vertex, fragment);
  EXPECT_TRUE(program) << (program ? "" : program.error().text());
  if (!program) return {};
  const int count = static_cast<int>(a.size());
  const gpu::Texture2d in_a(gpu::kRgba32f, count, 1, a.data()), in_b(gpu::kRgba32f, count, 1, b.data());
  const gpu::Texture2d out(gpu::kRgba32f, count, 1, nullptr);
  const auto framebuffer = gpu::Framebuffer::create("test", &out, nullptr);
  const gpu::VertexArray vertices = gpu::make_vertex_array();
  glBindVertexArray(vertices.name());
  framebuffer->bind();
  glViewport(0, 0, count, 1);
  in_a.bind(0);
  in_b.bind(1);
  program->use();
  program->set("u_a", 0);
  program->set("u_b", 1);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<Vec4> values(a.size());
  glReadPixels(0, 0, count, 1, GL_RGBA, GL_FLOAT, values.data());
  EXPECT_TRUE(gpu::check_gl("test"));
  return values;
}

class SharedMaths : public ::testing::Test {
 protected:
  void SetUp() override {
    context_ = std::move(*gpu::HeadlessContext::create());
    ASSERT_TRUE(gpu::open_device());
  }
  float random(float low, float high) { return std::uniform_real_distribution<float>(low, high)(generator_); }
  std::unique_ptr<gpu::HeadlessContext> context_;
  std::mt19937 generator_{7};
};

void expect_same(const Vec4& gpu, const Vec4& cpu, float scale) {
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(gpu[c], cpu[c], 4e-6f * scale) << "component " << c;
}

TEST_F(SharedMaths, MapPoints) {
  std::vector<Vec4> eyes, pixels;
  for (int i = 0; i < 500; ++i) {
    const float scale = std::exp2(random(-20, 20));
    eyes.emplace_back(random(-1, 1) * scale, random(-1, 1) * scale, -random(1e-3f, 1) * scale, scale);
    pixels.emplace_back(random(-1, 1) * scale, random(-1, 1) * scale, i % 10 == 0 ? 0.0f : random(0, 1), 0);
  }
  const auto found = run_shader("lib/reprojection.glsl", "o_value = map_point(a.xyz, b.xy, b.z);\n", eyes, pixels);
  for (std::size_t i = 0; i < found.size(); ++i) {
    expect_same(found[i], map_point(Vec3(eyes[i]), Vec2(pixels[i]), pixels[i].z), eyes[i].w);
    // The baker's own reprojection agrees.
    RadianceMap map;
    map.eye = Vec3(eyes[i]);
    map.lower = Vec2(pixels[i]) - 0.5f;
    map.upper = Vec2(pixels[i]) + 0.5f;
    map.width = map.height = 1;
    if (eyes[i].w > 0.1f && eyes[i].w < 10) expect_same(unproject(map, {0.5f, 0.5f}, pixels[i].z), found[i], eyes[i].w);
  }
}

// A quad and a triangle around b.xyz with sides of b.w, above the surface, in lobes of a. The shader's quotient of
// angle and sine is an interpolation: what it leaves out of the integral of a lobe is less than rounding does.
TEST_F(SharedMaths, PolygonsInLobes) {
  std::vector<Vec4> matrices, places;
  for (int i = 0; i < 4000; ++i) {
    const float width = std::exp2(random(-10, 0)), tilt = random(-1.5f, 0.5f), side = std::exp2(random(-4, 1));
    matrices.emplace_back(1 / width, -tilt / width, random(0.5f, 1) / width, tilt);
    places.emplace_back(random(-1, 1), random(-1, 1), 0.5f * side + random(0, 1), side);
  }
  const auto found = run_shader("lib/lobe_light.glsl",
                                "vec3 v[4];\n"
                                "v[0] = b.xyz + b.w * vec3(-1, -1, 0);\nv[1] = b.xyz + b.w * vec3(-1, 1, 0.5);\n"
                                "v[2] = b.xyz + b.w * vec3(1, 1, 0);\nv[3] = b.xyz + b.w * vec3(1, -1, -0.5);\n"
                                "float quad = reflected_polygon(a, v);\nv[3] = v[2];\n"
                                "float triangle = reflected_polygon(a, v);\n"
                                "vec3 w = from_lobe(a, b.xyz);\n"
                                "vec3 back = vec3(a.x * w.x + a.y * w.z, a.z * w.y, a.w * w.x + w.z) - b.xyz;\n"
                                "o_value = vec4(quad, triangle, length(back) / length(b.xyz), 0);\n",
                                matrices, places);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec4 &m = matrices[i], &p = places[i];
    const std::array<Vec3, 4> v = {Vec3(p) + p.w * Vec3(-1, -1, 0), Vec3(p) + p.w * Vec3(-1, 1, 0.5f),
                                   Vec3(p) + p.w * Vec3(1, 1, 0), Vec3(p) + p.w * Vec3(1, -1, -0.5f)};
    const LobeFit fit{m.x, m.y, m.z, m.w, 1};
    expect_same({Vec2(found[i]), 0, 0},
                {reflected_polygon(fit, v), reflected_polygon(fit, std::span(v).first(3)), 0, 0}, 1);
    EXPECT_LT(found[i].z, 1e-4f);
  }
}

TEST_F(SharedMaths, LobesBetweenIncidences) {
  std::vector<Vec4> below, above;
  for (int i = 0; i < 500; ++i) {
    const float tilt = random(-0.5f, 0.5f), width = random(0.05f, 1);
    below.emplace_back(1 / width, tilt / width, random(1, 3) / width, -tilt);
    above.emplace_back(below.back() * Vec4(0.9f, 0.8f, 0.7f, 0.6f));
  }
  const auto found =
      run_shader("lib/lobe_light.glsl", "o_value = lobe_in_surface_frame(mix_lobes(a, b, 0.3), 0.6);\n", below, above);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const LobeFit cpu = in_surface_frame(mix_lobes(below[i], above[i], 0.3f), 0.6f, 1);
    expect_same(found[i], {cpu.m11, cpu.m13, cpu.m22, cpu.m31},
                1 + 10 * glm::length(Vec4(cpu.m11, cpu.m13, cpu.m22, cpu.m31)));
  }
}

TEST_F(SharedMaths, SrgbAndToneCurves) {
  std::vector<Vec4> colors;
  for (int i = 0; i <= 1000; ++i)
    colors.emplace_back(static_cast<float>(i) / 1000, 0.0031308f, std::exp2(random(-30, 0)), 0);
  const auto found =
      run_shader("lib/color.glsl", "o_value = vec4(srgb_from_linear(a.rgb), luminance(a.rgb));\n", colors, colors);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3 c(colors[i]);
    expect_same(found[i], Vec4(srgb_from_linear(c), luminance(c)), 2);
  }
  std::vector<Vec4> light;
  for (int i = -40; i <= 120; ++i) light.emplace_back(std::exp2(static_cast<float>(i)), 0, -1, 0);
  const auto shown =
      run_shader("lib/tonemap.glsl", "o_value = vec4(tonemap_aces(a.rgb), tonemap_none(a.rgb).r);\n", light, light);
  for (std::size_t i = 1; i < shown.size(); ++i) {
    EXPECT_GE(shown[i].x, shown[i - 1].x);
    EXPECT_LE(shown[i].x, 1);
    EXPECT_EQ(shown[i].y, 0);
    EXPECT_EQ(shown[i].z, 0);
    EXPECT_EQ(shown[i].w, std::min(light[i].x, 1.0f));
  }
  EXPECT_NEAR(shown[40].x, 2.54f / 3.16f, 1e-5f);  // of 1
}

TEST_F(SharedMaths, NormalMaps) {
  std::vector<Vec4> normals, texels, steps;
  for (int i = 0; i < 500; ++i) {
    normals.emplace_back(normalize_or(Vec3(random(-1, 1), random(-1, 1), random(-1, 1)), Vec3(0, 0, 1)), random(-2, 2));
    texels.emplace_back(i % 70 == 0 ? Vec3(0.5f) : Vec3(random(0, 1), random(0, 1), random(0, 1)), 0);
    steps.emplace_back(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1));
  }
  const auto tilted = run_shader("lib/normal_map.glsl",
                                 "vec4 t = vec4(b.yzx * exp2(20.0 * b.x), -1.0);\n"
                                 "o_value = vec4(tilted_normal(a.xyz, t, b.xyz, a.w), 0.0);\n",
                                 normals, texels);
  for (std::size_t i = 0; i < tilted.size(); ++i) {
    const Vec3 texel(texels[i]);
    const Vec4 t(Vec3(texel.y, texel.z, texel.x) * std::exp2(20 * texel.x), -1);
    expect_same(tilted[i], Vec4(tilted_normal(Vec3(normals[i]), t, texel, normals[i].w), 0), 10);
  }
  const auto tangent = run_shader("lib/normal_map.glsl",
                                  "o_value = tangent_of_steps(a.xyz, b.xyz, b.wxy, a.xy, b.yw);\n", normals, steps);
  for (std::size_t i = 0; i < tangent.size(); ++i) {
    const Vec4 &a = normals[i], &b = steps[i];
    expect_same(tangent[i], tangent_of_steps(Vec3(a), Vec3(b), Vec3(b.w, b.x, b.y), Vec2(a), Vec2(b.y, b.w)), 1);
  }
  const auto ratio =
      run_shader("lib/normal_map.glsl",
                 "o_value = vec4(directional_ratio(b.xyz, a.xyz, b.zyx), directional_ratio(a.xyz, b.zyx, "
                 "a.yzx), 0.0, 0.0);\n",
                 normals, steps);
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    const Vec3 a(normals[i]), b(steps[i]), c(b.z, b.y, b.x);
    expect_same(ratio[i], Vec4(directional_ratio(b, a, c), directional_ratio(a, c, Vec3(a.y, a.z, a.x)), 0, 0), 10);
  }
}

TEST_F(SharedMaths, LobeDirections) {
  std::vector<Vec4> views, places;
  for (int i = 0; i < 500; ++i) {
    views.emplace_back(normalize_or(Vec3(random(-1, 1), random(-1, 1), random(-1, 1)), Vec3(0, 0, 1)), random(0, 1));
    const float scale = std::exp2(random(-20, 4));
    places.emplace_back(random(-1, 1) * scale, random(-1, 1) * scale, i % 17 == 0 ? 1.0f : random(0, 1), 9);
  }
  // The frame of the shader: a helper axis makes it from the direction.
  const auto found = run_shader("lib/kernel.glsl",
                                "vec3 across = normalize(cross(a.xyz, vec3(0.31, 0.64, 0.7)));\n"
                                "o_value = vec4(lobe_direction(a.xyz, across, cross(across, a.xyz), b.xy), 1.0);\n",
                                views, places);
  const auto rows =
      run_shader("lib/kernel.glsl", "o_value = vec4(kernel_row(b.z, int(b.w)), 0.0, 0.0);\n", views, places);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3 mirror(views[i]), across = glm::normalize(glm::cross(mirror, Vec3(0.31f, 0.64f, 0.7f)));
    const Vec2 u(places[i]);
    const float q = 0.25f * glm::dot(u, u);
    const Vec3 direction = ((1 - q) * mirror + u.x * across + u.y * glm::cross(across, mirror)) / (1 + q);
    expect_same(found[i], Vec4(direction, 1), 2);
    EXPECT_NEAR(glm::length(direction), 1, 1e-5f);
    const RowPosition row = kernel_row(places[i].z, 9);
    EXPECT_NEAR(rows[i].x + rows[i].y, static_cast<float>(row.row) + row.next, 1e-5f);
    EXPECT_LE(rows[i].x, 7);
    EXPECT_LE(row.row, 7);
  }
}

// R at random angles, against the definition of the table.
TEST_F(SharedMaths, ReflectanceTable) {
  FresnelMap map, other;
  for (int i = 0; i < 17; ++i) map.table.emplace_back(random(0, 1), random(0, 1), random(0, 1));
  other.table.assign(30, Vec3(0.5f));
  const gpu::Texture2d table = upload_reflectance_tables({other, map});
  std::vector<Vec4> angles;
  for (int i = 0; i <= 300; ++i) angles.emplace_back(static_cast<float>(i) / 300, 0, 0, 0);
  table.bind(2);
  // The sampler of the table is u_b's unit in this one.
  std::vector<Vec4> row(table.width());
  for (int i = 0; i < table.width(); ++i) row[i] = i < 17 ? Vec4(map.table[i], 1) : Vec4(0);
  row.resize(angles.size());
  const auto found = run_shader("lib/reflectance.glsl",
                                "o_value = vec4(reflectance_from_table(u_b, 0, 17, a.x), 1.0);\n", angles, row);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const float at = std::sqrt(angles[i].x) * 16;
    const int low = std::min(static_cast<int>(at), 15);
    expect_same(found[i], Vec4(glm::mix(map.table[low], map.table[low + 1], at - static_cast<float>(low)), 1), 5);
  }
}

}  // namespace
}  // namespace oriel
