// What `oriel-bake material --plot` writes.
#include "bake/material/plot.h"

#include <gtest/gtest.h>

#include <sstream>

namespace oriel {
namespace {

std::vector<std::vector<double>> numbers(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::strtod(cell.c_str(), nullptr));
  }
  return rows;
}

NamedMaterial named(const std::string& name, float alpha) {
  for (NamedMaterial m : named_materials())
    if (m.name == name) {
      m.lobe.alpha = alpha;
      return m;
    }
  ADD_FAILURE() << name;
  return {};
}

// Figure 6 of Bastos et al. 1999: red over green over blue from above, all towards white at grazing angles.
TEST(Plot, GoldTurnsWhiteAtGrazingAngles) {
  const auto files = plot_files(named("gold", 1e-3f), FacetModel::kGgx);
  ASSERT_EQ(files[0].name, "gold_reflectance.csv");
  const auto rows = numbers(files[0].text);
  ASSERT_EQ(rows.size(), 181u);
  const auto &above = rows.front(), &grazing = rows[178];
  EXPECT_GT(above[2], above[3] + 0.2);
  EXPECT_GT(above[3], above[4] + 0.2);
  EXPECT_EQ(grazing[0], 89);
  for (int c = 2; c < 5; ++c) EXPECT_GT(grazing[static_cast<std::size_t>(c)], 0.9);
  EXPECT_LT(grazing[2] - grazing[4], 0.1 * (above[2] - above[4]));
  for (std::size_t i = 130; i + 1 < rows.size(); ++i) EXPECT_LE(rows[i][4], rows[i + 1][4]) << "blue rises";
}

TEST(Plot, EveryMaterialGivesFiniteTablesOfAnyWidth) {
  for (const float alpha : {1e-4f, 1.0f})
    for (const char* name : {"chromium", "water"}) {
      const auto files = plot_files(named(name, alpha), FacetModel::kBeckmann);
      ASSERT_EQ(files.size(), 7u);
      for (const PlotFile& file : files) {
        EXPECT_EQ(file.text.find("nan"), std::string::npos) << file.name;
        EXPECT_EQ(file.text.find("inf"), std::string::npos) << file.name;
        EXPECT_EQ(file.name.find(name), 0u);
      }
    }
}

TEST(Plot, SameBytesEachTime) {
  const auto a = plot_files(named("copper", 0.1f), FacetModel::kGgx),
             b = plot_files(named("copper", 0.1f), FacetModel::kGgx);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].text, b[i].text);
}

}  // namespace
}  // namespace oriel
