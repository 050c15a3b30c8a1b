// What passes set, shaders declare: OpenGL ignores a uniform whose name is misspelt, and the picture is merely wrong.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

#include "tests/layers/root.h"

namespace {

// Names that a shader declares.
std::set<std::string> declared_in(const std::string& shader) {
  static const std::regex declaration(R"(uniform\s+([^;]*);)"), name(R"((u_\w+)\s*(\[[^\]]*\])?\s*(,|$))");
  std::set<std::string> out;
  for (std::sregex_iterator it(shader.begin(), shader.end(), declaration), last; it != last; ++it) {
    const std::string names = (*it)[1];
    for (std::sregex_iterator n(names.begin(), names.end(), name); n != last; ++n) out.insert((*n)[1]);
  }
  return out;
}

// Names that a source hands to a program. Those that it puts together are not among them.
std::set<std::string> set_in(const std::string& source) {
  static const std::regex name(R"re("(u_\w+)")re");
  std::set<std::string> out;
  for (std::sregex_iterator it(source.begin(), source.end(), name), last; it != last; ++it) out.insert((*it)[1]);
  return out;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Uniforms, TheCheckerReadsNames) {
  const std::set<std::string> declared = declared_in("uniform highp vec3 u_a, u_b[4];\nfloat u_c;\nuniform int u_d;");
  EXPECT_EQ(declared, (std::set<std::string>{"u_a", "u_b", "u_d"}));
  const std::set<std::string> names = set_in(R"(program.set("u_a", 1); program.set("u_dd", 2);)");
  EXPECT_EQ(names, (std::set<std::string>{"u_a", "u_dd"}));
  EXPECT_FALSE(declared.contains("u_dd"));
}

TEST(Uniforms, AreDeclaredByAShader) {
  std::set<std::string> declared;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "shaders"))
    if (entry.is_regular_file()) declared.merge(declared_in(text_of(entry.path())));
  EXPECT_GT(declared.size(), 100u);
  for (const char* top : {"player", "preview"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") {
        for (const std::string& name : set_in(text_of(entry.path())))
          EXPECT_TRUE(declared.contains(name)) << entry.path() << " sets " << name << ", which no shader declares";
      }
}

}  // namespace
