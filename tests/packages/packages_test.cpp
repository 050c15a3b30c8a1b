// The player's Debian package: what is in it and what it needs.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

TEST(Packages, ThePlayerAloneWithoutTheBakersLibraries) {
  if (std::system("command -v cpack dpkg-deb dpkg-shlibdeps >/dev/null") != 0)
    GTEST_SKIP() << "cpack or dpkg-dev is not installed";
  const oriel::testing::TemporaryFolder folder;
  const fs::path log = folder.path() / "log";
  const std::string make = "cd '" ORIEL_BUILD_DIR "' && cpack -G DEB -D CPACK_COMPONENTS_ALL=player -B '" +
                           folder.path().string() + "' >'" + log.string() + "' 2>&1 && cd '" + folder.path().string() +
                           "' && { dpkg-deb -c oriel-play_*.deb; dpkg-deb -f oriel-play_*.deb; } >'" + log.string() +
                           "'";
  const int status = std::system(make.c_str());
  std::stringstream text;
  text << std::ifstream(log).rdbuf();
  const std::string found = text.str();
  ASSERT_EQ(status, 0) << found;
  for (const char* expected :
       {"usr/bin/oriel-play", "usr/share/applications/oriel-play.desktop", "usr/share/mime/packages/oriel.xml",
        "usr/share/man/man1/oriel-play.1", "Package: oriel-play", "libglfw3", "libepoxy0", "libegl1"})
    EXPECT_NE(found.find(expected), std::string::npos) << expected << " in " << found;
  for (const char* heavy : {"embree", "tbb", "openimageio", "openmesh", "draco", "usr/bin/oriel-bake"})
    EXPECT_EQ(found.find(heavy), std::string::npos) << heavy << " in " << found;
}

}  // namespace
}  // namespace oriel
