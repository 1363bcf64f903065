#pragma once

#include <cstdint>
#include <vector>

namespace ifov::sampling {

/// The cells that borders cross, a list for each pixel, in the order in which they were met.
class EdgeCells {
 public:
  explicit EdgeCells(std::size_t pixels) : lists_(pixels) {}

  void reserve(std::size_t cells) { entries_.reserve(cells); }

  /// Adds a cell to its pixel's list, behind the others.
  void add(std::uint32_t pixel, std::uint32_t cell) {
    const auto entry = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({cell, kNone});
    List& list = lists_[pixel];
    (list.last == kNone ? list.first : entries_[list.last].next) = entry;
    list.last = entry;
  }

  /// Whether a border crosses the pixel; its cells are all uniform otherwise.
  bool crossed(std::uint32_t pixel) const { return lists_[pixel].first != kNone; }

  /// Calls keep(cell) for each cell of a pixel; those for which it says false leave the list.
  template <class Keep>
  void filter(std::uint32_t pixel, const Keep& keep) {
    List& list = lists_[pixel];
    std::uint32_t* link = &list.first;
    list.last = kNone;
    while (*link != kNone) {
      Entry& entry = entries_[*link];
      if (!keep(entry.cell)) {
        *link = entry.next;
        continue;
      }
      list.last = *link;
      link = &entry.next;
    }
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  struct Entry {
    std::uint32_t cell, next;
  };
  struct List {
    std::uint32_t first = kNone, last = kNone;
  };
  std::vector<Entry> entries_;
  std::vector<List> lists_;
};

}  // namespace ifov::sampling
