// A polished floor seen at grazing angles: the player's reflections against path-traced ones, with K as the lobe that
// leaves the mirror direction, and centred on the mirror ray.
#include <gtest/gtest.h>
#include <unistd.h>

#include "bake/scene/import.h"
#include "formats/core/file.h"
#include "formats/image/exr.h"
#include "scenes/kit/glb_writer.h"
#include "scenes/kit/shapes.h"
#include "tests/frames/frames.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

constexpr int kWidth = 160, kHeight = 90;
constexpr int kSupersampling = 2;

// A metal floor before a wall of bright and dark bands, open to the sky.
sample::Scene polished_floor(float roughness) {
  sample::Scene scene;
  scene.name = "polished floor";
  const auto material = [&](const char* name, float grey, float metallic, float rough) {
    sample::Material m;
    m.name = name;
    m.base_color = Vec3(grey);
    m.metallic = metallic;
    m.roughness = rough;
    return add_material(scene, m);
  };
  const std::uint32_t metal = material("metal", 0.9f, 1, roughness);
  const std::uint32_t band[] = {material("bright", 0.9f, 0, 1), material("dark", 0.05f, 0, 1)};
  const auto quad = [&](const std::string& name, std::uint32_t m, const Vec3& corner, const Vec3& a, const Vec3& b) {
    sample::Mesh mesh{name, m, {}, {}, {}, {}};
    add_corners(mesh, corner, corner + a, corner + a + b, corner + b);
    place(scene, std::move(mesh));
  };
  quad("floor", metal, {-4, 0, 3}, {8, 0, 0}, {0, 0, -9});
  for (int i = 0; i < 8; ++i) {
    const float y = 0.4f * static_cast<float>(i);
    quad("band " + std::to_string(i), band[i % 2], {-4, y, -6}, {8, 0, 0}, {0, 0.4f, 0});
  }
  scene.cameras.push_back({"low", {0, 1, 2.5f}, {0, 0, -3}, 0.9f});
  return scene;
}

struct Errors {
  RelativeError lobe, centred;
};

Errors measure(float roughness) {
  const fs::path folder = fs::temp_directory_path() / ("oriel-kernel-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto glb = write_glb(polished_floor(roughness));
  EXPECT_TRUE(glb && write_file_atomically(folder / "floor.glb", *glb));
  EXPECT_EQ(test::run(folder, "oriel-bake floor.glb -o floor.oriel --sky 1000 --texel 10cm --samples 256"), 0);
  Context context;
  ImportOptions import;
  import.sky = Vec3(1000);
  const Scene scene = import_gltf(folder / "floor.glb", import, context)->scene;
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const ReferenceFrame reference =
      *render_reference({accel, lights, {}}, scene.cameras[0], {kWidth, kHeight, 256}, context);
  const auto played = [&](const std::string& kernel) {
    EXPECT_EQ(test::run(folder, "oriel-play floor.oriel --offscreen --size " + std::to_string(kSupersampling * kWidth) +
                                    "x" + std::to_string(kSupersampling * kHeight) +
                                    " --camera 0 --show MKR --kernel " + kernel + " -o " + kernel + ".exr"),
              0);
    const auto image = read_exr(folder / (kernel + ".exr"));
    EXPECT_TRUE(image) << (image ? "" : image.error().text());
    return *relative_error(shrink(*image, kSupersampling), reference.specular);
  };
  const Errors errors{played("lobe"), played("centred")};
  if (!testing::Test::HasFailure()) fs::remove_all(folder);
  return errors;
}

TEST(KernelFrames, TheLobeIsWhereThePathTracerSeesIt) {
  for (const float roughness : {0.2f, 0.4f}) {
    const Errors e = measure(roughness);
    std::printf(
        "floor of roughness %.2f at grazing angles: nRMSE %.1f %% with the lobe, %.1f %% centred; bias %+.1f %% "
        "and %+.1f %%\n",
        roughness, 100 * e.lobe.n_rmse, 100 * e.centred.n_rmse, 100 * e.lobe.bias, 100 * e.centred.bias);
    EXPECT_LT(e.lobe.n_rmse, e.centred.n_rmse) << roughness;
  }
}

}  // namespace
}  // namespace oriel
