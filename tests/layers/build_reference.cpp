// Compiled by itself and never changed: what build_cost_test.cpp measures the build by.
#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace oriel_reference {

using Table = std::map<std::string, std::vector<std::function<int(const std::string&)>>>;

int count(const Table& table, const std::string& pattern) {
  int sum = 0;
  for (const auto& [name, functions] : table)
    if (std::regex_search(name, std::regex(pattern)))
      for (const auto& function : functions) sum += function(name);
  return sum;
}

std::vector<std::string> sorted(const Table& table) {
  std::vector<std::string> names;
  for (const auto& [name, functions] : table) names.push_back(name);
  std::ranges::sort(names, [](const std::string& a, const std::string& b) { return b < a; });
  return names;
}

}  // namespace oriel_reference
