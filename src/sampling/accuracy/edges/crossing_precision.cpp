#include "sampling/accuracy/edges/crossing_precision.h"

#include <algorithm>

#include "sampling/accuracy/borders/bracket_store.h"
#include "sampling/accuracy/borders/cell_tree.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/complex_cells.h"

namespace ifov::sampling {

namespace {

/// A bracket is halved at most this often at a time.
constexpr int kMostHalvings = 30;

}  // namespace

void CrossingPrecision::begin_pixel() {
  terms_.clear();
  place_.resize(brackets_.size());
}

void CrossingPrecision::add(std::uint32_t bracket, double gain) {
  std::uint32_t& place = place_[bracket];
  if (place < terms_.size() && terms_[place].bracket == bracket) {
    terms_[place].variance += gain;
  } else {
    place = static_cast<std::uint32_t>(terms_.size());
    terms_.push_back({bracket, gain});
  }
}

void CrossingPrecision::want(double target) {
  std::sort(terms_.begin(), terms_.end(), [](const Term& a, const Term& b) { return a.bracket < b.bracket; });
  double total = 0.0;
  std::size_t count = terms_.size();
  for (Term& term : terms_) {
    const double width = brackets_[term.bracket].width();
    term.variance = term.variance * width * width;
    total += term.variance;
  }
  if (total <= target) return;
  while (total > target && count > 0) {
    std::size_t most = 0;
    for (std::size_t i = 1; i < count; ++i)
      if (terms_[i].variance > terms_[most].variance) most = i;
    Term& term = terms_[most];
    if (term.halvings == kMostHalvings) {
      terms_.erase(terms_.begin() + static_cast<std::ptrdiff_t>(most));
      --count;
      continue;
    }
    total -= 0.75 * term.variance;
    term.variance *= 0.25;
    ++term.halvings;
    Bracket& bracket = brackets_[term.bracket];
    if (bracket.halvings == 0) active_.push_back(term.bracket);
    bracket.halvings = std::max(bracket.halvings, term.halvings);
  }
}

void CrossingPrecision::halve() {
  std::sort(active_.begin(), active_.end());
  const auto skip_known = [this] {
    std::erase_if(active_, [this](std::uint32_t index) {
      Bracket& b = brackets_[index];
      while (b.halvings > 0 && b.skip_known()) --b.halvings;
      for (std::uint32_t entry : b.cells)
        if (entry != 0) pixels_.stir(tree_[entry - 1].pixel);
      return b.halvings == 0;
    });
  };
  for (skip_known(); !active_.empty(); skip_known()) {
    const std::vector<std::uint32_t>& seen = brackets_.look_into(active_);
    std::size_t still = 0;
    for (std::size_t i = 0; i < active_.size(); ++i) {
      Bracket& b = brackets_[active_[i]];
      b.take(seen[i]);
      for (std::uint32_t entry : b.cells)
        if (entry != 0) pixels_.stir(tree_[entry - 1].pixel);
      if (b.third_label) {
        b.halvings = 0;
        for (std::uint32_t entry : b.cells)
          if (entry != 0 && tree_[entry - 1].kind != CellKind::split) {
            pixels_.note_suspect(tree_[entry - 1].pixel);
            complex_.settle(entry - 1);
          }
      } else if (--b.halvings > 0) {
        active_[still++] = active_[i];
      }
    }
    active_.resize(still);
  }
}

}  // namespace ifov::sampling
