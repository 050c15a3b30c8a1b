// Functions take five parameters at most: more are a concept that has no name yet. They are 60 lines long at most.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/layers/root.h"

namespace {

constexpr int kMost = 5;
constexpr int kMostLines = 60;

// Kernels, whose parameters are the formula's or the loop's, and what others call by a signature of theirs.
const std::set<std::string> kExempt{};

struct Token {
  std::string text;
  int line = 0;
};

bool is_word(const std::string& text) {
  return std::isalnum(static_cast<unsigned char>(text[0])) || text[0] == '_' || text[0] == '~';
}

// Names, numbers and signs of a source; comments, strings and preprocessor lines are left out.
std::vector<Token> tokens_of(const std::string& source) {
  std::vector<Token> out;
  int line = 1;
  const auto skip_to = [&](std::size_t& i, const std::string& end) {
    const std::size_t stop = std::min(source.find(end, i), source.size());
    line += static_cast<int>(std::count(source.begin() + i, source.begin() + stop, '\n'));
    i = stop + end.size() - 1;
  };
  for (std::size_t i = 0; i < source.size(); ++i) {
    const char c = source[i];
    if (c == '\n') ++line;
    if (source.compare(i, 2, "//") == 0 || c == '#') {
      while (i + 1 < source.size() && (source[i + 1] != '\n' || source[i] == '\\')) line += source[++i] == '\n';
    } else if (source.compare(i, 3, "R\"(") == 0) {
      skip_to(i, ")\"");
    } else if (c == '"' || (c == '\'' && !(out.size() && std::isdigit(static_cast<unsigned char>(source[i - 1]))))) {
      for (++i; i < source.size() && source[i] != c; ++i) i += source[i] == '\\';
    } else if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '~') {
      const std::size_t begin = i;
      while (std::isalnum(static_cast<unsigned char>(source[i + 1])) || source[i + 1] == '_') ++i;
      out.push_back({source.substr(begin, i + 1 - begin), line});
    } else if (!std::isspace(static_cast<unsigned char>(c))) {
      out.push_back({std::string(1, c), line});
    }
  }
  return out;
}

// A function that is declared or defined outside of functions.
struct Signature {
  std::string name;
  int parameters = 0;
  int line = 0;
  int lines = 0;          // to the end of its body; 0 without one
  std::size_t token = 0;  // its name's
};

class Signatures {
 public:
  explicit Signatures(const std::string& source) : tokens_(tokens_of(source)) {
    for (std::size_t i = 0, begin = 0; i < tokens_.size(); ++i) {
      const std::string& t = tokens_[i].text;
      if (t == "{" && !opens_scope(begin, i)) i = end_body(begin, behind(i) - 1);
      if (t == "(" && i > 0) i = add(i) - 1;
      const std::string before = i > 0 ? tokens_[i - 1].text : "";
      const bool shifts = before == "<" && i > 1 && tokens_[i - 2].text == "operator";  // operator<<
      if (t == "<" && before != "operator" && !shifts) i = behind(i) - 1;
      if (t == "=" && before != "operator" && (before == "]" || is_word(before)))  // an initial value
        while (tokens_.at(i + 1).text != ";") i = tokens_[i + 1].text == "<" ? i + 1 : behind(i + 1) - 1;
      if (t == "{" || t == "}" || t == ";") begin = i + 1;
    }
  }
  const std::vector<Signature>& all() const { return found_; }

 private:
  // Where the group ends that token i opens, or the token after it.
  std::size_t behind(std::size_t i) const {
    static const std::map<std::string, std::string> ends = {{"(", ")"}, {"{", "}"}, {"[", "]"}, {"<", ">"}};
    const auto end = ends.find(tokens_[i++].text);
    if (end == ends.end()) return i;
    while (tokens_.at(i).text != end->second) i = end->first != "<" && tokens_[i].text == "<" ? i + 1 : behind(i);
    return i + 1;
  }
  bool opens_scope(std::size_t begin, std::size_t end) const {
    for (; begin < end; ++begin) {
      const std::string& t = tokens_[begin].text;
      if (t == "namespace" || t == "class" || t == "struct" || t == "union" || t == "extern") return true;
      if (t == "template") begin = behind(begin + 1) - 1;
      if (t == "enum" || t == "(") return false;
    }
    return false;
  }
  // The statement that begins at `begin` ends with a body: if it is a function's, its length is known.
  std::size_t end_body(std::size_t begin, std::size_t end) {
    if (!found_.empty() && found_.back().token >= begin)
      found_.back().lines = tokens_[end].line - found_.back().line + 1;
    return end;
  }
  bool is_shift(std::size_t i) const { return tokens_[i].text == "<" && tokens_[i + 1].text == "<"; }
  // The function whose parameters begin at i; where it and what initializes its members end.
  std::size_t add(std::size_t i) {
    Signature f{tokens_[i - 1].text, tokens_[i + 1].text == ")" ? 0 : 1, tokens_[i].line, 0, i - 1};
    const std::size_t end = behind(i) - 1;
    for (std::size_t k = i + 1; k < end; k = is_shift(k) ? k + 2 : behind(k)) f.parameters += tokens_[k].text == ",";
    const bool constant = f.name[0] == 'k' && std::isupper(static_cast<unsigned char>(f.name[1]));
    if (!constant) found_.push_back(f);
    i = end + 1;
    while (is_word(tokens_.at(i).text)) ++i;  // const noexcept
    if (tokens_.at(i).text == ":")
      while (tokens_.at(i).text != "{" || is_word(tokens_[i - 1].text)) i = behind(i);
    return i;
  }

  std::vector<Token> tokens_;
  std::vector<Signature> found_;
};

bool takes_many(const Signature& f) {
  return f.parameters > kMost;
}
bool is_long(const Signature& f) {
  return f.lines > kMostLines;
}

std::string named(const std::string& source, bool (*is_meant)(const Signature&)) {
  std::string out;
  const Signatures signatures(source);
  for (const Signature& f : signatures.all())
    if (is_meant(f)) out += f.name + " ";
  return out;
}

struct Sources {
  std::size_t functions = 0;
  std::map<std::string, std::string> met;  // name to place
};
Sources search_all(bool (*is_meant)(const Signature&)) {
  Sources out;
  for (const char* top : {"formats", "bake", "player", "preview", "scenes", "trade"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream in(entry.path());
      const std::string text(std::istreambuf_iterator<char>(in), {});
      const Signatures signatures(text);
      out.functions += signatures.all().size();
      for (const Signature& f : signatures.all())
        if (is_meant(f)) out.met[f.name] = entry.path().string() + ":" + std::to_string(f.line);
    }
  return out;
}

// All that are meant, and no others, are exempt.
void expect_exempt(const Sources& sources, const std::set<std::string>& exempt, const std::string& limit) {
  EXPECT_GT(sources.functions, 3000u);
  for (const auto& [name, place] : sources.met)
    EXPECT_TRUE(exempt.contains(name)) << place << ": " << name << ", expected at most " << limit;
  for (const std::string& name : exempt) EXPECT_TRUE(sources.met.contains(name)) << name << " needs no exemption";
}

TEST(Functions, TheCheckerCountsParameters) {
  const auto long_ones = [](const std::string& source) { return named(source, takes_many); };
  EXPECT_EQ(long_ones("int f(int a, int b, int c, int d, int e, int f);"), "f ");
  EXPECT_EQ(long_ones("int f(int a, int b, int c, int d, int e); // , int f"), "");
  EXPECT_EQ(long_ones("void f(std::map<int, std::pair<int, int>> a, const char* b = \",,,\", P c = {1, 2, 3});"), "");
  EXPECT_EQ(long_ones("std::function<void(int, int, int, int, int, int)> f;\n#define F(a, b, c, d, e, f)\n"), "");
  EXPECT_EQ(long_ones("const Mat3 kM(1, 0, 0, 0, 1, 0, 0, 0, 1), kN = m(1, 2, 3, 4, 5, 6);"), "");
  EXPECT_EQ(long_ones("void f(int a) { g(1, 2, 3, 4, 5, 6); }\nvoid h(int a, int b, int c, int d, int e, int f) {}"),
            "h ");
  EXPECT_EQ(
      long_ones("class A : B {\n A(int a, int b) noexcept : x_(1, 2, 3, 4, 5, 6), y_{1} {}\n"
                " bool operator<(const A& o) const;\n int m(int a, int b, int c, int d, int e, int f = 1 << 4);\n};"),
      "m ");
}

TEST(Functions, TheCheckerCountsLines) {
  const auto lines = [](int count) { return std::string(count, '\n'); };
  EXPECT_EQ(named("void f() {" + lines(59) + "}\nvoid g() {" + lines(60) + "}", is_long), "g ");
  EXPECT_EQ(
      named("struct A {\n void f(int a) const { if (a) {" + lines(60) + "} }\n void g();" + lines(60) + "};", is_long),
      "f ");
  EXPECT_EQ(
      named("A::A(int a)\n : a_{a}, b_(a) {" + lines(60) + "}\nvoid f();\nint k[] = {" + lines(70) + "};", is_long),
      "A ");
}

TEST(Functions, TakeFiveParametersAtMost) {
  expect_exempt(search_all(takes_many), kExempt, "5 parameters");
}
TEST(Functions, HaveSixtyLinesAtMost) {
  expect_exempt(search_all(is_long), {}, "60 lines");
}

}  // namespace
