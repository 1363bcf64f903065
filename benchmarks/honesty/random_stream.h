#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>

namespace ifov::benchmarks {

/// Random numbers of the benchmarks' own (splitmix64), so that none is shared with the samplers. All that follows
/// depends on the two keys alone.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t key, std::uint64_t second_key = 0)
      : state_(key * 0x632be59bd9b4e019ull ^ second_key * 0xd1342543de82ef95ull) {
    bits();
  }
  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /// In [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in the logarithm.
  double magnitude(double low, double high) { return low * std::pow(high / low, uniform()); }
  bool with(double probability) { return uniform() < probability; }
  /// 0 to count - 1.
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }
  template <class T>
  T one_of(std::initializer_list<T> choices) {
    return *std::next(choices.begin(), static_cast<std::ptrdiff_t>(index(choices.size())));
  }

 private:
  std::uint64_t state_;
};

}  // namespace ifov::benchmarks
