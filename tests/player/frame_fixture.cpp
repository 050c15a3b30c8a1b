#include "tests/player/frame_fixture.h"

namespace oriel::testing {

void add_quad(Pack& pack, const Vec3& corner, const Vec3& right, const Vec3& up, std::uint32_t material,
              std::int32_t page) {
  Mesh& mesh = pack.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 normal = normalize_or(glm::cross(right, up), Vec3(0, 0, 1));
  for (int i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(i == 1 || i == 2), y = static_cast<float>(i >= 2);
    mesh.positions.push_back(corner + right * x + up * y);
    mesh.normals.push_back(normal);
    mesh.uvs.emplace_back(x, 1 - y);
    mesh.lightmap_uvs.emplace_back(x, y);
  }
  MeshPart part;
  part.first_index = static_cast<std::uint32_t>(mesh.indices.size());
  part.index_count = 6;
  part.material = material;
  part.lightmap_page = page;
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
  mesh.parts.push_back(part);
}

LightmapPage page_of(std::uint32_t side, const std::function<Vec3(std::uint32_t x, std::uint32_t y)>& light) {
  LightmapPage page;
  page.width = page.height = side;
  for (std::uint32_t i = 0; i < side * side; ++i) page.irradiance.push_back(light(i % side, i / side));
  page.standard_error.assign(std::size_t{side} * side, Vec3(0));
  page.state.assign(std::size_t{side} * side, TexelState::kValid);
  return page;
}

LightmapPage flat_page(const Vec3& irradiance) {
  return page_of(4, [&](auto, auto) { return irradiance; });
}

FresnelMap flat_reflectance(const Vec3& reflectance) {
  FresnelMap map;
  map.table.assign(8, reflectance);
  return map;
}

void add_mirror(Pack& pack, const std::vector<Vec3>& eyes, std::uint32_t size,
                const std::function<Seen(const Vec2& on_plane, const Vec3& direction)>& seen) {
  const auto first = static_cast<std::uint32_t>(pack.mesh.positions.size());
  add_quad(pack, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0, -1);
  Reflector reflector;
  reflector.name = "mirror";
  reflector.lower = {-1, -1};
  reflector.upper = {1, 1};
  reflector.area_m2 = 4;
  reflector.elements_x = reflector.elements_y = 1;
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) reflector.indices.push_back(first + i);
  for (const Vec3& eye : eyes) {
    RadianceMap map;
    map.eye = eye;
    map.lower = reflector.lower;
    map.upper = reflector.upper;
    map.width = map.height = size;
    map.has_emission = true;
    for (std::uint32_t y = 0; y < size; ++y) {
      for (std::uint32_t x = 0; x < size; ++x) {
        const Vec2 share((static_cast<float>(x) + 0.5f) / static_cast<float>(size),
                         (static_cast<float>(y) + 0.5f) / static_cast<float>(size));
        const Vec2 on_plane = map.lower + share * (map.upper - map.lower);
        const Seen s = seen(on_plane, Vec3(on_plane, 0) - eye);
        map.radiance.push_back(s.radiance);
        map.disparity.push_back(std::isfinite(s.z) ? -eye.z / (s.z - eye.z) : 0.0f);
        map.valid.push_back(std::isfinite(s.z) ? 1 : 2);
      }
    }
    pack.radiance_maps.push_back(map);
  }
  reflector.map_count = static_cast<std::uint32_t>(eyes.size());
  pack.reflectors.push_back(reflector);
}

void add_bare_mirror(Pack& pack, const Vec3& corner, const Vec3& right, const Vec3& up, std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(pack.mesh.positions.size());
  add_quad(pack, corner, right, up, material, -1);
  Reflector reflector;
  reflector.material = material;
  const Vec3 x = glm::normalize(right), y = glm::normalize(up);
  reflector.pack_from_reflector =
      Mat4(Vec4(x, 0), Vec4(y, 0), Vec4(glm::cross(x, y), 0), Vec4(corner + 0.5f * (right + up), 1));
  reflector.upper = 0.5f * Vec2(glm::length(right), glm::length(up));
  reflector.lower = -reflector.upper;
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) reflector.indices.push_back(first + i);
  pack.reflectors.push_back(reflector);
}

void add_pixel_meshes(Pack& pack) {
  for (const RadianceMap& map : pack.radiance_maps) {
    MapMesh& mesh = pack.map_meshes.emplace_back();
    for (std::uint32_t i = 0; i < map.valid.size(); ++i) {
      if (map.valid[i] == 0) continue;
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)})
        mesh.vertices.emplace_back((Vec2(i % map.width, i / map.width) + corner) / Vec2(map.width, map.height),
                                   map.valid[i] == 2 ? 0.0f : map.disparity[i]);
      for (const std::uint32_t v : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + v);
    }
  }
}

Vec3 Picture::at(int x, int y) const {
  const std::size_t i =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3;
  return {rgb[i], rgb[i + 1], rgb[i + 2]};
}

bool Picture::finite() const {
  for (const float v : rgb) {
    if (!std::isfinite(v) || v < 0) return false;
  }
  return !rgb.empty();
}

void FrameTest::SetUp() {
  auto context = gpu::HeadlessContext::create();
  ASSERT_TRUE(context) << context.error().text();
  context_ = std::move(*context);
  auto device = gpu::open_device();
  ASSERT_TRUE(device) << device.error().text();
  device_ = *device;
  auto renderer = Renderer::create(device_);
  ASSERT_TRUE(renderer) << renderer.error().text();
  renderer_ = std::move(*renderer);
}

Picture FrameTest::draw(Pack pack, const Camera& camera, int width, int height, const FrameOptions& options) {
  if (pack.map_meshes.empty()) add_pixel_meshes(pack);
  auto scene = GpuScene::create(std::move(pack), device_);
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
  if (!scene) return {};
  const View view = make_view(camera, width, height, (*scene)->bounds());
  const auto stats = renderer_->render(**scene, view, options);
  EXPECT_TRUE(stats) << (stats ? "" : stats.error().text());
  if (!stats) return {};
  return {width, height, renderer_->read_light(), *stats};
}

}  // namespace oriel::testing
