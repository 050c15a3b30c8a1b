// Packs in pieces, and the folder that shows them. The viewer's own tests need node and Chromium: viewer_test.
#include <gmock/gmock.h>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/export/pieces.h"
#include "formats/export/sha256.h"
#include "formats/export/web_folder.h"
#include "formats/pack/reader.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// The examples of FIPS 180-4, in base64; and lengths around a block's end.
TEST(Sha256, GivesThePublishedDigests) {
  EXPECT_EQ(integrity_of(bytes_of_text("abc")), "sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
  EXPECT_EQ(integrity_of({}), "sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
  EXPECT_EQ(integrity_of(bytes_of_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
            "sha256-JI1qYdIGOLjlwCaTDD5gOaM85Flk/yFn9uzt1BnbBsE=");
}

TEST(Pieces, ArePacksOfTheirOwn) {
  const Pack pack = testing::tiny_pack();
  std::vector<WebPiece> pieces;
  const Status made = make_pieces(pack, [&](WebPiece piece) -> Status {
    pieces.push_back(std::move(piece));
    return {};
  });
  ASSERT_TRUE(made);
  ASSERT_EQ(pieces.size(), 1 + pack.lightmaps.size() + pack.textures.size() + pack.normal_textures.size());
  const auto scene = decode_pack(pieces[0].bytes);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(pieces[0].kind, "scene");
  EXPECT_EQ(scene->mesh.positions, pack.mesh.positions);
  EXPECT_EQ(scene->mesh.indices, pack.mesh.indices);
  ASSERT_EQ(scene->lightmaps.size(), pack.lightmaps.size());
  for (const Reflector& r : scene->reflectors) EXPECT_EQ(r.map_count, 0u);
}

TEST(CoarsePage, IsTheMeanOfWhatIsLit) {
  LightmapPage page;
  page.width = 5, page.height = 4;
  page.irradiance.assign(20, Vec3(1e6f));
  page.standard_error.assign(20, Vec3(0));
  page.state.assign(20, TexelState::kEmpty);
  page.irradiance[0] = Vec3(1, 2, 3), page.irradiance[6] = Vec3(3, 4, 5);
  page.state[0] = page.state[6] = TexelState::kValid;
  const LightmapPage coarse = coarse_page(page);
  ASSERT_EQ(coarse.width, 2u);
  ASSERT_EQ(coarse.height, 1u);
  EXPECT_EQ(coarse.irradiance[0], Vec3(2, 3, 4));
  EXPECT_EQ(coarse.irradiance[1], Vec3(0));
}

TEST(WebFolder, NamesItsFilesByTheirHashes) {
  const testing::TemporaryFolder folder;
  const auto written = write_web_folder(folder.path() / "a" / "b", testing::tiny_pack(), {"<Our> \"house\"", {}});
  ASSERT_TRUE(written) << written.error().text();
  std::string page, manifest, licences;
  for (const WebFile& file : written->files) {
    const auto bytes = read_file(folder.path() / "a" / "b" / file.name);
    ASSERT_TRUE(bytes) << file.name;
    EXPECT_EQ(bytes->size(), file.bytes);
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    if (file.name == "index.html") page = text;
    if (file.name == "licences.txt") licences = text;
    if (file.name.ends_with(".json")) manifest = text;
  }
  EXPECT_THAT(licences, HasSubstr("Arjun Barrett"));  // of what the script bundles
  EXPECT_THAT(page, HasSubstr("&lt;Our&gt; &quot;house&quot;"));
  EXPECT_THAT(page, HasSubstr("default-src 'none'; script-src 'self'"));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_THAT(page, HasSubstr(integrity_of(bytes_of_text(manifest))));
  const Json told = Json::parse(manifest).value();
  for (const auto& piece : told["pieces"]) {
    const auto bytes = read_file(folder.path() / "a" / "b" / piece["file"].get<std::string>());
    ASSERT_TRUE(bytes);
    EXPECT_EQ(integrity_of(*bytes), piece["integrity"]);
  }
}

}  // namespace
}  // namespace oriel
