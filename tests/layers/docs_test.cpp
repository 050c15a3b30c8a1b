// The docs are plain to read: lines fit a screen, sentences are short, and links lead somewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/layers/root.h"

namespace {

constexpr std::size_t kWidest = 140;  // characters of a line of prose
constexpr int kLongest = 40;          // words of a sentence
constexpr double kMean = 20;          // words of a page's sentences

std::string replaced(const std::string& text, const char* pattern, const char* by) {
  return std::regex_replace(text, std::regex(pattern), by);
}

// Paragraphs and points of lists, each as one line; without headings, tables, code and what is made by a program.
std::vector<std::string> paragraphs(std::istream& page) {
  static const std::regex other(R"(^(\||#|<|!|    ).*)"), point(R"(^\s*([-*]|\d+\.)\s+(.*)$)");
  std::vector<std::string> out(1);
  std::smatch match;
  bool fence = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) fence = !fence;
    const bool inside = !out.back().empty() && line.starts_with("    ");  // a list's point goes on
    if (fence || line.empty() || (std::regex_match(line, other) && !inside)) {
      out.emplace_back();
    } else if (std::regex_match(line, match, point)) {
      out.push_back(match[2]);
    } else {
      out.back() += " " + line;
    }
  }
  return out;
}

int words_of(const std::string& sentence) {
  static const std::regex word(R"(\S*[A-Za-z0-9]\S*)");
  return static_cast<int>(std::distance(std::sregex_iterator(sentence.begin(), sentence.end(), word), {}));
}

// Words of each sentence of a paragraph. Code and links' addresses count as a word.
std::vector<std::pair<int, std::string>> sentences(const std::string& paragraph) {
  static const std::regex end(R"([.!?]\)?\s+(?=[A-Z`*\[(0-9]))");
  const std::string text = replaced(replaced(paragraph, "`[^`]*`", "X"), R"(!?\[([^\]]*)\]\([^)]*\))", "$1");
  std::vector<std::pair<int, std::string>> out;
  for (std::sregex_token_iterator it(text.begin(), text.end(), end, -1), last; it != last; ++it)
    if (const int words = words_of(*it); words > 0) out.emplace_back(words, *it);
  return out;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> out = {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs"))
    if (entry.path().extension() == ".md") out.push_back(fs::relative(entry.path(), kRoot));
  return out;
}

TEST(Docs, TheCheckerCountsWordsOfSentences) {
  std::istringstream page(
      "# Not this\n\nOne two `three four`\nfive. Six [seven](eight.md#nine), 10.5 m!\n\n- eleven\n  twelve\n");
  std::vector<int> counts;
  for (const std::string& paragraph : paragraphs(page))
    for (const auto& [words, text] : sentences(paragraph)) counts.push_back(words);
  EXPECT_EQ(counts, (std::vector<int>{4, 4, 2}));
}

TEST(Docs, SentencesAreShort) {
  for (const fs::path& page : pages()) {
    std::ifstream in(kRoot / page);
    int longer = 0, count = 0, words = 0;
    std::string longest;
    for (const std::string& paragraph : paragraphs(in))
      for (const auto& [length, text] : sentences(paragraph)) {
        ++count, words += length;
        if (length > kLongest) ++longer, longest += "\n  " + std::to_string(length) + ": " + text;
      }
    EXPECT_EQ(longer, 0) << page << " has sentences of more than " << kLongest << " words:" << longest;
    EXPECT_LE(words, kMean * count) << page << " has sentences of " << double(words) / count << " words on average";
  }
}

TEST(Docs, LinesFitAScreen) {
  for (const fs::path& page : pages()) {
    std::ifstream in(kRoot / page);
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      const auto characters = static_cast<std::size_t>(std::count_if(
          line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
      if (line.starts_with("|") || line.starts_with("    ")) continue;
      EXPECT_LE(characters, kWidest) << page << ":" << number;
    }
  }
}

// What nobody sees is not kept.
TEST(Docs, PicturesAreShown) {
  std::string all;
  for (const fs::path& page : pages()) {
    std::ifstream in(kRoot / page);
    all.append(std::istreambuf_iterator<char>(in), {});
  }
  for (const auto& entry : fs::directory_iterator(kRoot / "docs/pictures"))
    EXPECT_NE(all.find(entry.path().filename().string()), std::string::npos) << entry.path();
}

TEST(Docs, LinksLeadToFiles) {
  static const std::regex link(R"(\]\(([^)#:\s]+)(#[^)]*)?\))");
  int seen = 0;
  for (const fs::path& page : pages()) {
    std::ifstream in(kRoot / page);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    for (std::sregex_iterator it(text.begin(), text.end(), link), last; it != last; ++it, ++seen)
      EXPECT_TRUE(fs::exists(kRoot / page.parent_path() / (*it)[1].str())) << page << " names " << (*it)[1];
  }
  EXPECT_GT(seen, 50);
}

}  // namespace
