#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ifov::sampling {

/// An insert-only table from 64-bit keys to 32-bit values: open addressing in one flat array.
class FlatMap {
 public:
  static constexpr std::uint32_t kAbsent = ~std::uint32_t{0};

  FlatMap() { rehash(64); }

  std::uint32_t find(std::uint64_t key) const {
    for (std::size_t i = home(key);; i = (i + 1) & mask_) {
      if (slots_[i].value == kAbsent) return kAbsent;
      if (slots_[i].key == key) return slots_[i].value;
    }
  }

  /// The value of the key, which is `fresh` if the key was absent; `fresh` must not be kAbsent.
  std::uint32_t find_or_insert(std::uint64_t key, std::uint32_t fresh) {
    assert(fresh != kAbsent);
    if (2 * (size_ + 1) > slots_.size()) rehash(2 * slots_.size());
    for (std::size_t i = home(key);; i = (i + 1) & mask_) {
      if (slots_[i].value == kAbsent) {
        slots_[i] = {key, fresh};
        ++size_;
        return fresh;
      }
      if (slots_[i].key == key) return slots_[i].value;
    }
  }

  std::size_t size() const { return size_; }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t value = kAbsent;
  };

  /// Fibonacci hashing (Knuth, The Art of Computer Programming 3, 6.4): the high bits of a product, with the
  /// key's high half folded in, because labels and positions differ there as well.
  std::size_t home(std::uint64_t key) const {
    return static_cast<std::size_t>(((key ^ (key >> 32)) * 0x9e3779b97f4a7c15ull) >> shift_);
  }

  void rehash(std::size_t slots) {
    std::vector<Slot> old(slots);
    old.swap(slots_);
    mask_ = slots - 1;
    shift_ = 64 - std::countr_zero(slots);
    for (const Slot& slot : old) {
      if (slot.value == kAbsent) continue;
      std::size_t i = home(slot.key);
      while (slots_[i].value != kAbsent) i = (i + 1) & mask_;
      slots_[i] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t mask_ = 0, size_ = 0;
  int shift_ = 0;
};

}  // namespace ifov::sampling
