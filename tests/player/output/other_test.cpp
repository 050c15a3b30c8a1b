// Another pack or a picture under the first one's camera.
#include "player/output/other.h"

#include "formats/image/exr.h"
#include "formats/image/png.h"
#include "formats/pack/writer.h"
#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {
using namespace testing;

class OtherTest : public FrameTest {
 protected:
  Result<std::unique_ptr<Other>> open(const char* name) {
    return Other::open((folder_.path() / name).string(), device_);
  }
  TemporaryFolder folder_;
};

// The same building about another origin: what the camera sees is the same.
TEST_F(OtherTest, PacksOfOtherOriginsAreSeenFromTheSamePlace) {
  Pack pack;
  pack.mesh.origin = {100, 5, -3};
  pack.materials.resize(1);
  pack.lightmaps.push_back(flat_page(Vec3(100)));
  add_quad(pack, {-1, -1, 0}, {1.5f, 0, 0}, {0, 2, 0}, 0, 0);
  const Camera camera = look_at({0.5f, 0, 3}, {0.25f, 0, 0}, 1);
  const Picture here = draw(pack, camera, 24, 16);
  Pack moved = pack;
  moved.mesh.origin += DVec3(2, -1, 4);
  for (Vec3& p : moved.mesh.positions) p -= Vec3(2, -1, 4);
  ASSERT_TRUE(write_pack(folder_.path() / "moved.oriel", moved));
  const auto other = open("moved.oriel");
  ASSERT_TRUE(other) << other.error().text();
  EXPECT_FALSE((*other)->camera({}));
  const FrameOptions options;
  // A mover that it has not is no error.
  const std::vector<MoverMove> moves{{"door", {0, 0, 0}, 0}};
  ASSERT_TRUE((*other)->draw({camera, pack.mesh.origin, 24, 16, options, moves, 0}));
  const std::vector<float> light = (*other)->read_light();
  ASSERT_EQ(light.size(), here.rgb.size());
  EXPECT_EQ(light, here.rgb);
  EXPECT_GT(*std::max_element(light.begin(), light.end()), 1);
}

TEST_F(OtherTest, PicturesLieOverTheFrame) {
  const Vec3 color(1, 20, 300);
  ASSERT_TRUE(write_exr(folder_.path() / "a.exr", rgb_image(2, 2, std::vector<Vec3>(4, color)),
                        {{"oriel.eye", "101,5,-3"},
                         {"oriel.forward", "0,0,-1"},
                         {"oriel.up", "0,1,0"},
                         {"oriel.vertical_fov_deg", "40"}}));
  auto other = open("a.exr");
  ASSERT_TRUE(other) << other.error().text();
  const auto camera = (*other)->camera({100, 5, -3});
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->eye, Vec3(1, 0, 0));
  const FrameOptions options;
  ASSERT_TRUE((*other)->draw({*camera, {}, 8, 4, options, {}, 0}));
  std::vector<float> light = (*other)->read_light();
  ASSERT_EQ(light.size(), 96u);
  EXPECT_EQ(light[0], 0) << "beside the picture";
  EXPECT_EQ(light[3 * 4 + 2], 300);

  // As shown: no exposure changes it.
  ASSERT_TRUE(write_png(folder_.path() / "a.png", {1, 1, 3, {10, 128, 250}}));
  other = open("a.png");
  ASSERT_TRUE(other) << other.error().text();
  EXPECT_FALSE((*other)->camera({})) << "it does not tell";
  ASSERT_TRUE((*other)->draw({*camera, {}, 1, 1, options, {}, 0}));
  for (const float ev100 : {-3.0f, 12.0f})
    EXPECT_EQ(*(*other)->read_display(ev100, ToneCurve::kAces), (std::vector<std::uint8_t>{10, 128, 250}));
}

TEST_F(OtherTest, SaysWhyItCannotBeShown) {
  const auto refused = [&](const char* name) {
    const auto other = open(name);
    EXPECT_FALSE(other) << name;
    return other ? std::string() : other.error().text();
  };
  EXPECT_NE(refused("absent.oriel").find("absent.oriel"), std::string::npos);
  EXPECT_NE(refused("absent.exr").find("absent.exr"), std::string::npos);
  EXPECT_NE(refused("a.jpg").find("expected a pack (.oriel) or a picture"), std::string::npos);
  ASSERT_TRUE(write_exr(folder_.path() / "grey.exr", FloatImage{1, 1, 1, {1}}));
  EXPECT_NE(refused("grey.exr").find("found 1 channel"), std::string::npos);
  ASSERT_TRUE(write_exr(folder_.path() / "broken.exr", FloatImage{1, 1, 3, {std::nanf(""), -1, INFINITY}}));
  const auto other = open("broken.exr");
  ASSERT_TRUE(other);
  const FrameOptions options;
  ASSERT_TRUE((*other)->draw({Camera(), {}, 1, 1, options, {}, 0}));
  EXPECT_EQ((*other)->read_light(), (std::vector<float>{0, 0, 1e30f}));
}

}  // namespace
}  // namespace oriel
