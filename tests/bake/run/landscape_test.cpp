// A room whose light comes from a landscape of square kilometres.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/pack/reader.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

// By its area the ground outweighs all that is in the room, and has its light after one bounce: the room has not. It
// was 18 % too dark when bounces ended by area.
TEST(Landscape, ARoomInItHasAllItsLight) {
  const fs::path folder = fs::temp_directory_path() / ("oriel-landscape-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const std::string line = fmt::format(
      "cd '{0}' && '{1}/oriel-scenes' dome -o dome.glb > log && '{1}/oriel-bake' dome.glb -o dome.oriel --error 10% "
      "--only radiosity --cache off >> log 2>&1",
      folder.string(), ORIEL_BIN_DIR);
  ASSERT_EQ(std::system(line.c_str()), 0);
  const auto pack = read_pack(folder / "dome.oriel");
  ASSERT_TRUE(pack) << pack.error().text();
  const auto radiosity = Json::parse(pack->plan).value().at("radiosity");
  EXPECT_GE(radiosity.at("sweeps").get<int>(), 6);
  const auto& paths = radiosity.at("certificate");
  EXPECT_GT(paths.at("bias").get<double>(), -0.1);
  EXPECT_LT(paths.at("bias").get<double>(), 0.1);
  EXPECT_LT(paths.at("bias_95_interval").get<double>(), 0.05) << "or it says nothing";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace oriel
