// A polished floor seen at grazing angles: the player's reflections against path-traced ones, with K as the lobe that
// leaves the mirror direction, and centred on the mirror ray.
#include <gtest/gtest.h>
#include <unistd.h>

#include "bake/import/import.h"
#include "formats/core/file.h"
#include "formats/pack/reader.h"
#include "formats/pack/writer.h"
#include "scenes/kit/glb_writer.h"
#include "scenes/kit/shapes.h"
#include "tests/frames/frames.h"
#include "tests/support/exr.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

constexpr int kKernelWidth = 160, kKernelHeight = 90;
constexpr int kKernelSupersampling = 2;

// A polished floor of a dielectric, seen flat, under a lamp between it and a wall: its highlight lies to the eye's side
// of the mirror direction all along the floor.
sample::SampleScene floor_under_lamp() {
  sample::SampleScene scene;
  scene.name = "floor under a lamp";
  const auto quad = [&](const char* name, float grey, float rough, float nits, const Vec3& corner, const Vec3& a,
                        const Vec3& b) {
    sample::SampleMaterial m;
    m.name = name;
    m.base_color = Vec3(grey);
    m.roughness = rough;
    m.specular = 1;
    m.emission = Vec3(nits);
    sample::SampleMesh mesh{name, add_material(scene, m)};
    add_corners(mesh, corner, corner + a, corner + a + b, corner + b);
    place(scene, std::move(mesh));
  };
  quad("floor", 0.1f, 0.316228f, 0, {-4, 0, 3}, {8, 0, 0}, {0, 0, -9});
  quad("wall", 0.5f, 1, 0, {-4, 0, -6}, {8, 0, 0}, {0, 3, 0});
  quad("lamp", 0, 1, 5000, {-1, 2.5f, -3}, {2, 0, 0}, {0, 0, 1});
  scene.cameras.push_back({"low", {0, 1, 2.5f}, {0, 0, -3}, 0.9f});
  return scene;
}

// A metal floor before a wall of bright and dark bands, open to the sky.
sample::SampleScene polished_floor(float roughness) {
  sample::SampleScene scene;
  scene.name = "polished floor";
  const auto material = [&](const char* name, float grey, float metallic, float rough) {
    sample::SampleMaterial m;
    m.name = name;
    m.base_color = Vec3(grey);
    m.metallic = metallic;
    m.roughness = rough;
    return add_material(scene, m);
  };
  const std::uint32_t metal = material("metal", 0.9f, 1, roughness);
  const std::uint32_t band[] = {material("bright", 0.9f, 0, 1), material("dark", 0.05f, 0, 1)};
  const auto quad = [&](const std::string& name, std::uint32_t m, const Vec3& corner, const Vec3& a, const Vec3& b) {
    sample::SampleMesh mesh{name, m};
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
  RelativeError lobe, centred, alike;  // alike: the lobe, all of whose directions weigh alike
};

// The pack whose kernels do not say how they change with incidence: they stay at the mirror ray.
void forget_slices(const fs::path& from, const fs::path& to) {
  Pack pack = *read_pack(from);
  for (BrdfKernel& kernel : pack.kernels) kernel.slices.clear(), kernel.fits.clear(), kernel.slice_size = 0;
  for (FresnelMap& map : pack.fresnel_maps) map.factor.clear();
  EXPECT_TRUE(write_pack(to, pack));
}

// The pack as a baker writes it that knows no Fresnel factors.
void forget_factors(const fs::path& from, const fs::path& to) {
  Pack pack = *read_pack(from);
  for (FresnelMap& map : pack.fresnel_maps) {
    EXPECT_FALSE(map.factor.empty());
    map.factor.clear();
  }
  EXPECT_TRUE(write_pack(to, pack));
}

Errors measure(const sample::SampleScene& sample) {
  const fs::path folder = fs::temp_directory_path() / ("oriel-kernel-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto glb = write_glb(sample);
  EXPECT_TRUE(glb && write_file_atomically(folder / "floor.glb", *glb));
  EXPECT_EQ(test::run(folder, "oriel-bake floor.glb -o floor.oriel --sky 1000 --texel 10cm --samples 256"), 0);
  Context context;
  ImportOptions import;
  import.sky = Vec3(1000);
  const Scene scene = import_gltf(folder / "floor.glb", import, context)->scene;
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const ReferenceFrame reference =
      *render_reference({accel, lights, {}}, scene.cameras[0], {kKernelWidth, kKernelHeight, 256}, context);
  forget_factors(folder / "floor.oriel", folder / "alike.oriel");
  forget_slices(folder / "floor.oriel", folder / "centred.oriel");
  const auto played = [&](const std::string& pack) {
    EXPECT_EQ(test::run(folder, "oriel-play " + pack + " --offscreen --size " +
                                    std::to_string(kKernelSupersampling * kKernelWidth) + "x" +
                                    std::to_string(kKernelSupersampling * kKernelHeight) +
                                    " --camera 0 --show MKR -o " + pack + ".exr"),
              0);
    const auto image = read_exr(folder / (pack + ".exr"));
    EXPECT_TRUE(image) << (image ? "" : image.error().text());
    return *relative_error(shrink(*image, kKernelSupersampling), reference.specular);
  };
  const Errors errors{played("floor.oriel"), played("centred.oriel"), played("alike.oriel")};
  if (!::testing::Test::HasFailure()) fs::remove_all(folder);
  return errors;
}

TEST(KernelFrames, TheLobeIsWhereThePathTracerSeesIt) {
  for (const float roughness : {0.2f, 0.4f}) {
    const Errors e = measure(polished_floor(roughness));
    std::printf(
        "floor of roughness %.2f at grazing angles: nRMSE %.1f %% with the lobe, %.1f %% centred; bias %+.1f %% "
        "and %+.1f %%\n",
        roughness, 100 * e.lobe.n_rmse, 100 * e.centred.n_rmse, 100 * e.lobe.bias, 100 * e.centred.bias);
    EXPECT_LT(e.lobe.n_rmse, e.centred.n_rmse) << roughness;
  }
}

TEST(KernelFrames, LampsAreReflectedByTheFacetsThatTurnThemToTheEye) {
  const Errors e = measure(floor_under_lamp());
  std::printf(
      "dielectric floor under a lamp: nRMSE %.1f %%, bias %+.1f %%; all directions weighed alike %.1f %%, %+.1f %%\n",
      100 * e.lobe.n_rmse, 100 * e.lobe.bias, 100 * e.alike.n_rmse, 100 * e.alike.bias);
  EXPECT_LT(e.lobe.n_rmse, e.alike.n_rmse);
}

}  // namespace
}  // namespace oriel
