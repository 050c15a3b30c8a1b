#include "study/barczak2006/light_passes.h"

#include <algorithm>
#include <array>
#include <map>

#include "formats/core/check.h"

namespace oriel::study {
namespace {

constexpr std::size_t kHalf = 0xffff;  // the largest number in half a word

void sort_once(std::vector<std::uint32_t>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

std::size_t passes_for(std::size_t lights, std::size_t lights_a_pass) {
  return lights / lights_a_pass + (lights % lights_a_pass != 0 ? 1 : 0);
}

// Bits, a light each.
using LightSet = std::vector<std::uint64_t>;

// Elements of equal lights are one: that saves all passes of one of them, and no merge saves more.
std::vector<LightPass> grouped(std::vector<LightPass> elements) {
  std::map<std::vector<std::uint32_t>, std::vector<std::uint32_t>> cells_of;
  for (LightPass& element : elements) {
    sort_once(element.lights);
    if (element.lights.empty() || element.cells.empty()) continue;
    std::vector<std::uint32_t>& cells = cells_of[std::move(element.lights)];
    cells.insert(cells.end(), element.cells.begin(), element.cells.end());
  }
  std::vector<LightPass> out;
  out.reserve(cells_of.size());
  for (auto& [lights, cells] : cells_of) out.push_back({std::move(cells), lights});
  return out;
}

// Without a call, which std::popcount() is where no processor is named.
inline std::size_t bits_of(std::uint64_t x) {
  x -= x >> 1 & 0x5555555555555555u;
  x = (x & 0x3333333333333333u) + (x >> 2 & 0x3333333333333333u);
  x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  return x * 0x0101010101010101u >> 56;
}

// Elements, and what a merge of each pair of them is worth.
class PassMerger {
 public:
  PassMerger(std::vector<LightPass> elements, std::size_t lights_a_pass) {
    for (const LightPass& e : elements) lights_.insert(lights_.end(), e.lights.begin(), e.lights.end());
    sort_once(lights_);
    words_ = (lights_.size() + 63) / 64;
    for (std::size_t count = 0; count <= lights_.size(); ++count)
      passes_.push_back(static_cast<std::uint32_t>(passes_for(count, lights_a_pass)));
    for (LightPass& e : elements) {
      LightSet set(words_, 0);
      for (const std::uint32_t light : e.lights) {
        const auto bit = static_cast<std::size_t>(std::ranges::lower_bound(lights_, light) - lights_.begin());
        set[bit / 64] |= std::uint64_t{1} << bit % 64;
      }
      add(std::move(e.cells), set);
    }
    for (std::size_t i = 0; i < size(); ++i) score(i);
    for (std::size_t i = 0; i < size(); ++i) find_best(i);
  }

  std::vector<LightPass> merged() {
    for (;;) {
      const auto best = std::ranges::max_element(best_, {}, &Best::worth);
      if (best == best_.end() || best->worth == 0) return result();
      const auto first = static_cast<std::size_t>(best - best_.begin());
      ORIEL_CHECK_EQ(best->worth, worth_[first][best->with]);
      merge(first, best->with);
    }
  }

 private:
  struct Best {
    std::uint32_t worth = 0;
    std::size_t with = 0;
  };

  std::size_t size() const { return cells_.size(); }

  std::size_t add(std::vector<std::uint32_t> cells, const LightSet& set) {
    cells_.push_back(std::move(cells));
    sets_.insert(sets_.end(), set.begin(), set.end());
    counts_.push_back(count(set.data(), set.data()));
    best_.emplace_back();
    for (std::vector<std::uint32_t>& row : worth_) row.push_back(0);
    worth_.emplace_back(size(), 0);
    return size() - 1;
  }

  // Lights that both have.
  std::size_t count(const std::uint64_t* a, const std::uint64_t* b) const {
    std::size_t sum = 0;
    for (std::size_t w = 0; w < words_; ++w) sum += bits_of(a[w] & b[w]);
    return sum;
  }

  // CountPassesSaved, in the upper half; 0 where a merge takes no less. In the lower half, of those that save as much,
  // what is most alike comes first: with the fewest lights in all. (The thesis leaves that open. It ends with some 3 %
  // fewer passes than the first in order does.)
  std::uint32_t worth(std::size_t i, std::size_t j) const {
    const std::size_t a = counts_[i], b = counts_[j];
    if (i == j || a == 0 || b == 0) return 0;
    const std::size_t c = count(&sets_[i * words_], &sets_[j * words_]);
    const std::size_t before = passes_[a] + passes_[b], after = passes_[a - c] + passes_[b - c] + passes_[c];
    if (before <= after) return 0;
    const std::size_t saved = std::min(before - after, kHalf), unlike = std::min(a + b - c, kHalf);
    return static_cast<std::uint32_t>(saved << 16 | (kHalf - unlike));
  }

  // All pairs of i.
  void score(std::size_t i) {
    for (std::size_t j = 0; j < size(); ++j) worth_[i][j] = worth_[j][i] = worth(i, j);
  }

  void find_best(std::size_t i) {
    const auto best = std::ranges::max_element(worth_[i]);
    best_[i] = {*best, static_cast<std::size_t>(best - worth_[i].begin())};
  }

  void merge(std::size_t i, std::size_t j) {
    LightSet common(words_);
    for (std::size_t w = 0; w < words_; ++w) {
      common[w] = sets_[i * words_ + w] & sets_[j * words_ + w];
      sets_[i * words_ + w] &= ~common[w];
      sets_[j * words_ + w] &= ~common[w];
    }
    std::vector<std::uint32_t> cells = cells_[i];
    cells.insert(cells.end(), cells_[j].begin(), cells_[j].end());
    const std::size_t both = place(std::move(cells), common, {i, j});
    const std::array<std::size_t, 3> changed{i, j, both};
    for (const std::size_t k : changed) counts_[k] = count(&sets_[k * words_], &sets_[k * words_]);
    for (const std::size_t k : changed) score(k);
    for (std::size_t k = 0; k < size(); ++k) refresh(k, changed);
  }

  // Where the common part goes: to the place of one of the two that has no lights left, or to a new one.
  std::size_t place(std::vector<std::uint32_t> cells, const LightSet& set, const std::array<std::size_t, 2>& from) {
    for (const std::size_t k : from) {
      const std::uint64_t* left = &sets_[k * words_];
      if (count(left, left) > 0) continue;
      std::ranges::copy(set, sets_.begin() + static_cast<std::ptrdiff_t>(k * words_));
      cells_[k] = std::move(cells);
      return k;
    }
    return add(std::move(cells), set);
  }

  // The best partner of k, where pairs with `changed` have been scored anew.
  void refresh(std::size_t k, const std::array<std::size_t, 3>& changed) {
    const std::vector<std::uint32_t>& row = worth_[k];
    if (std::ranges::find(changed, k) != changed.end() || row[best_[k].with] < best_[k].worth) {
      find_best(k);
      return;
    }
    for (const std::size_t other : changed)
      if (row[other] >= best_[k].worth && row[other] > 0) best_[k] = {row[other], other};
  }

  std::vector<LightPass> result() const {
    std::vector<LightPass> out;
    for (std::size_t i = 0; i < size(); ++i) {
      if (counts_[i] == 0) continue;
      LightPass& pass = out.emplace_back(LightPass{cells_[i], {}});
      sort_once(pass.cells);
      for (std::size_t bit = 0; bit < lights_.size(); ++bit)
        if ((sets_[i * words_ + bit / 64] >> bit % 64 & 1) != 0) pass.lights.push_back(lights_[bit]);
    }
    return out;
  }

  std::vector<std::uint32_t> lights_;  // by bit
  std::size_t words_ = 0;              // of a set
  std::vector<std::uint32_t> passes_;  // by number of lights
  // By element; one without lights is no more.
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<std::uint64_t> sets_;  // words_ each
  std::vector<std::size_t> counts_;
  std::vector<std::vector<std::uint32_t>> worth_;  // by pair
  std::vector<Best> best_;
};

}  // namespace

std::size_t count_passes(std::span<const LightPass> elements, std::size_t lights_a_pass) {
  const std::size_t each = std::max<std::size_t>(lights_a_pass, 1);
  std::size_t sum = 0;
  for (const LightPass& element : elements) sum += passes_for(element.lights.size(), each);
  return sum;
}

std::vector<LightPass> merge_passes(std::vector<LightPass> elements, std::size_t lights_a_pass) {
  return PassMerger(grouped(std::move(elements)), std::max<std::size_t>(lights_a_pass, 1)).merged();
}

}  // namespace oriel::study
