// The whole pipeline, judged: generate a scene, bake it, play it offscreen, and compare with path-traced frames.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "bake/import/import.h"
#include "formats/core/file.h"
#include "formats/image/display.h"
#include "formats/query/camera.h"
#include "tests/frames/frames.h"
#include "tests/support/exr.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

constexpr int kWidth = 160, kHeight = 90;
constexpr int kSupersampling = 4;  // player frames are rendered larger and averaged, as the reference's pixels are

struct Reference {
  Scene scene;
  ReferenceFrame frame;
  std::vector<std::uint8_t> mirror;  // pixels whose first surface is a mirror
  std::vector<std::uint8_t> gloss;   // or rougher metal
};

class Frames : public ::testing::Test {
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
    return image ? shrink(*image, kSupersampling) : FloatImage{};
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
        const PixelRay ray =
            pixel_ray(*camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, kWidth, kHeight);
        const Hit hit = accel.intersect({ray.origin, ray.direction});
        const SceneMaterial* m = hit ? &r.scene.material_of(hit.triangle) : nullptr;
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

void report(const char* what, const RelativeError& e) {
  std::printf("%s: relRMSE %.2f %% (net of the reference's noise %.2f %%: %.2f %%), bias %+.2f %%\n", what,
              100 * e.rel_rmse, 100 * e.noise, 100 * e.net(), 100 * e.bias);
}

TEST_F(Frames, CornellDiffuseAgreesWithTheReference) {
  bake("cornell", "--texel 1cm --samples 512");
  const Reference r = reference("cornell", "0", 1024);
  const RelativeError d = *relative_error(play("cornell", "0", "D"), test::diffuse(r.frame), r.frame.diffuse_noise);
  report("cornell D", d);
  EXPECT_LE(d.net(), 0.05);
  EXPECT_LE(std::abs(d.bias), 0.01);
}

TEST_F(Frames, GalleryDiffuseAndMirrorAgreeWithTheReference) {
  bake("gallery", "--samples 512");
  const Reference r = reference("gallery", "mirror", 1024);
  const RelativeError d =
      *relative_error(play("gallery", "mirror", "D"), test::diffuse(r.frame), r.frame.diffuse_noise);
  report("gallery D", d);
  EXPECT_LE(d.net(), 0.05);

  const auto pixels = std::count(r.mirror.begin(), r.mirror.end(), 1);
  ASSERT_GT(pixels, kWidth * kHeight / 50) << "the camera 'mirror' must show the mirror";
  const float white = white_of(r.frame.total);
  const double ratio = psnr_db(mean_over(
      squared_difference(shown(play("gallery", "mirror", "all"), white), shown(r.frame.total, white)), r.mirror));
  std::printf("gallery mirror: PSNR %.1f dB over %ld pixels\n", ratio, static_cast<long>(pixels));
  EXPECT_GE(ratio, 25);
}

TEST_F(Frames, StudioBallsAgreeWithTheReference) {
  bake("studio", "--samples 256");
  const Reference r = reference("studio", "balls", 256);
  const float white = white_of(r.frame.total);
  const FloatImage difference =
      squared_difference(shown(play("studio", "balls", "all"), white), shown(r.frame.total, white));
  for (const auto& [name, mask] : {std::pair("mirror", &r.mirror), std::pair("glossy", &r.gloss)}) {
    const auto pixels = std::count(mask->begin(), mask->end(), 1);
    ASSERT_GT(pixels, kWidth * kHeight / 50) << name;
    const double ratio = psnr_db(mean_over(difference, *mask));
    std::printf("studio, %s metal: PSNR %.1f dB over %ld pixels\n", name, ratio, static_cast<long>(pixels));
    EXPECT_GE(ratio, 25) << name;
  }
}

}  // namespace
}  // namespace oriel
