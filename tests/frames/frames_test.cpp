// The whole pipeline, judged: generate a scene, bake it, play it offscreen, and compare with path-traced frames.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "bake/scene/import.h"
#include "formats/core/color.h"
#include "formats/core/file.h"
#include "formats/image/exr.h"
#include "tests/frames/frames.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

constexpr int kWidth = 160, kHeight = 90;
constexpr int kSupersampling = 4;  // player frames are rendered larger and averaged, as the reference's pixels are

struct Reference {
  Scene scene;
  ReferenceFrame frame;
  std::vector<char> mirror;  // pixels whose first surface is a mirror
  std::vector<char> gloss;   // or rougher metal
};

class Frames : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("oriel-frames-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }

  void bake(const std::string& scene, const std::string& options) {
    ASSERT_EQ(test::run(folder_, "oriel-scenes " + scene + " -o " + scene + ".glb"), 0) << log();
    ASSERT_EQ(test::run(folder_, "oriel-bake " + scene + ".glb -o " + scene + ".oriel " + options), 0) << log();
    ASSERT_EQ(test::run(folder_, "oriel-inspect validate " + scene + ".oriel"), 0) << log();
  }

  FloatImage play(const std::string& scene, const std::string& camera, const std::string& show) {
    const std::string out = scene + "-" + show + ".exr";
    EXPECT_EQ(test::run(folder_, "oriel-play " + scene + ".oriel --offscreen --size " +
                                     std::to_string(kSupersampling * kWidth) + "x" +
                                     std::to_string(kSupersampling * kHeight) + " --camera " + camera + " --show " +
                                     show + " -o " + out),
              0)
        << log();
    auto image = read_exr(folder_ / out);
    EXPECT_TRUE(image) << (image ? "" : image.error().text());
    return image ? test::shrink(*image, kSupersampling) : FloatImage{};
  }

  Reference reference(const std::string& scene_name, const std::string& camera_name, std::uint32_t samples) {
    Context context;
    Reference r;
    r.scene = import_gltf(folder_ / (scene_name + ".glb"), {}, context)->scene;
    const Accel accel = *Accel::build(r.scene);
    const LightSet lights(r.scene);
    const Camera* camera = nullptr;
    for (const Camera& c : r.scene.cameras)
      if (c.name == camera_name || camera_name == "0") camera = camera ? camera : &c;
    EXPECT_NE(camera, nullptr) << camera_name;
    r.frame = *render_reference({accel, lights, {}}, *camera, {kWidth, kHeight, samples}, context);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const Hit hit = accel.intersect(
            camera_ray(*camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, kWidth, kHeight));
        const SceneMaterial* m =
            hit ? &r.scene.materials[r.scene.surfaces[r.scene.triangle_surface[hit.triangle]].material] : nullptr;
        r.mirror.push_back(m && m->roughness == 0 && m->metallic == 1 && hit.front);
        r.gloss.push_back(m && m->roughness > 0 && m->metallic == 1 && hit.front);
      }
    return r;
  }

  std::string log() const {
    const auto bytes = read_file(folder_ / "log");
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
  }

  fs::path folder_;
};

TEST(Compare, SeesADarkerFrame) {
  const std::vector<Vec3> reference(16, Vec3(2)), noise(16, Vec3(0));
  FloatImage frame{4, 4, 3, std::vector<float>(48, 1.8f)};
  EXPECT_NEAR(test::compare(frame, reference, noise).rel_rmse, 0.1, 1e-3);
  EXPECT_NEAR(test::compare(frame, reference, noise).n_rmse, 0.1, 1e-6);
  EXPECT_NEAR(test::compare(frame, reference, noise).bias, -0.1, 1e-6);
  EXPECT_LT(test::psnr_srgb(frame, reference, 0.3f, std::vector<char>(16, 1)), 40);
}

void report(const char* what, const test::FrameError& e) {
  std::printf("%s: relRMSE %.2f %% (net of the reference's noise %.2f %%: %.2f %%), bias %+.2f %%\n", what,
              100 * e.rel_rmse, 100 * e.noise, 100 * e.net(), 100 * e.bias);
}

TEST_F(Frames, CornellDiffuseAgreesWithTheReference) {
  bake("cornell", "--texel 1cm --samples 512");
  const Reference r = reference("cornell", "0", 1024);
  const test::FrameError d = test::compare(play("cornell", "0", "D"), r.frame.diffuse, r.frame.diffuse_noise);
  report("cornell D", d);
  EXPECT_LE(d.net(), 0.05);
  EXPECT_LE(std::abs(d.bias), 0.01);
}

TEST_F(Frames, GalleryDiffuseAndMirrorAgreeWithTheReference) {
  bake("gallery", "--samples 512");
  const Reference r = reference("gallery", "mirror", 1024);
  const test::FrameError d = test::compare(play("gallery", "mirror", "D"), r.frame.diffuse, r.frame.diffuse_noise);
  report("gallery D", d);
  EXPECT_LE(d.net(), 0.05);

  const auto pixels = std::count(r.mirror.begin(), r.mirror.end(), 1);
  ASSERT_GT(pixels, kWidth * kHeight / 50) << "the camera 'mirror' must show the mirror";
  double mean = 0;
  for (const Vec3& v : r.frame.total) mean += luminance(v) / static_cast<double>(r.frame.total.size());
  const double psnr =
      test::psnr_srgb(play("gallery", "mirror", "all"), r.frame.total, static_cast<float>(0.18 / mean), r.mirror);
  std::printf("gallery mirror: PSNR %.1f dB over %ld pixels\n", psnr, static_cast<long>(pixels));
  EXPECT_GE(psnr, 25);
}

TEST_F(Frames, StudioBallsAgreeWithTheReference) {
  bake("studio", "--samples 256");
  const Reference r = reference("studio", "balls", 256);
  double mean = 0;
  for (const Vec3& v : r.frame.total) mean += luminance(v) / static_cast<double>(r.frame.total.size());
  const FloatImage frame = play("studio", "balls", "all");
  for (const auto& [name, mask] : {std::pair("mirror", &r.mirror), std::pair("glossy", &r.gloss)}) {
    const auto pixels = std::count(mask->begin(), mask->end(), 1);
    ASSERT_GT(pixels, kWidth * kHeight / 50) << name;
    const double psnr = test::psnr_srgb(frame, r.frame.total, static_cast<float>(0.18 / mean), *mask);
    std::printf("studio, %s metal: PSNR %.1f dB over %ld pixels\n", name, psnr, static_cast<long>(pixels));
    EXPECT_GE(psnr, 25) << name;
  }
}

}  // namespace
}  // namespace oriel
