// The browser's viewer stands in the repository as it is built, so that nobody needs node to build Oriel. These tests
// prove that it is made of the sources that stand beside it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include "tests/layers/root.h"

namespace {

int run(const std::string& command) {
  return std::system(("cd '" + kRoot.string() + "' && " + command).c_str());
}

TEST(WebViewer, IsBuiltOfTheSourcesThatAreThere) {
  EXPECT_EQ(run("sha256sum --check --quiet --strict web/dist.sha256"), 0)
      << "a source or web/dist changed: cd web && npm ci && npm run build";
}

TEST(WebViewer, TheListHoldsEveryFile) {
  std::ifstream in(kRoot / "web/dist.sha256");
  std::set<std::string> listed;
  for (std::string hash, file; in >> hash >> file;) listed.insert(file);
  for (const char* folder : {"web/src", "web/page", "web/shaders", "web/dist"})
    for (const auto& entry : fs::directory_iterator(kRoot / folder)) {
      const std::string file = fs::relative(entry.path(), kRoot).string();
      EXPECT_TRUE(listed.contains(file)) << file;
    }
}

// A byte more is found.
TEST(WebViewer, TheCheckSeesAChange) {
  EXPECT_NE(run("sed 's/^./0/; s/^0\\(.\\)/1\\1/' web/dist.sha256 | sha256sum --check --status -"), 0);
}

TEST(WebViewer, IsTheSameWhenItIsBuiltAgain) {
  if (!fs::exists(kRoot / "web/node_modules/esbuild")) GTEST_SKIP() << "web/node_modules is not installed (npm ci)";
  const fs::path again = fs::temp_directory_path() / "oriel-web-again";
  ASSERT_EQ(run("node web/build.mjs '" + again.string() + "'"), 0);
  EXPECT_EQ(run("diff -r web/dist '" + again.string() + "'"), 0);
  fs::remove_all(again);
}

}  // namespace
