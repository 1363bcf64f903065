#pragma once

#include <cassert>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace ifov::sampling {

/// A vector whose first `Inline` elements live in the object itself: tiles hold thousands of lists that are
/// nearly always this short, and an allocation each costs more than what is done with them.
template <class T, std::size_t Inline>
class SmallVector {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return size_ <= Inline ? near_ : far_.data(); }
  const T* data() const { return size_ <= Inline ? near_ : far_.data(); }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) {
    assert(i < size_);
    return data()[i];
  }
  const T& operator[](std::size_t i) const {
    assert(i < size_);
    return data()[i];
  }
  T& back() {
    assert(size_ > 0);
    return data()[size_ - 1];
  }

  void clear() {
    size_ = 0;
    far_.clear();
  }
  void assign(std::size_t count, const T& value) {
    clear();
    if (count > Inline)
      far_.assign(count, value);
    else
      for (T& element : near_) element = value;  // all of them: a fixed number is no loop
    size_ = count;
  }
  T& push_back(const T& value) {
    if (size_ < Inline) {
      near_[size_] = value;
    } else {
      if (size_ == Inline) far_.assign(near_, near_ + size_);
      far_.push_back(value);
    }
    ++size_;
    return back();
  }

 private:
  T near_[Inline];
  std::vector<T> far_;  // all elements, once there are more
  std::size_t size_ = 0;
};

}  // namespace ifov::sampling
