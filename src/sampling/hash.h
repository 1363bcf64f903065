#pragma once

#include <cstdint>
#include <type_traits>

namespace ifov::sampling {

/// The finaliser of splitmix64 (Steele, Lea and Flood 2014): a bijection of 64-bit words in which every input bit
/// moves every output bit.
constexpr std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

/// Key of a random number from what it is for: integers and enums, in order, e.g. hash(seed, x, y, Purpose::probe).
/// Order matters, and so does the number of words.
template <class First, class... Rest>
constexpr std::uint64_t hash(First first, Rest... rest) {
  static_assert((std::is_integral_v<First> || std::is_enum_v<First>) &&
                ((std::is_integral_v<Rest> || std::is_enum_v<Rest>) && ...));
  std::uint64_t h = mix(static_cast<std::uint64_t>(first));
  ((h = mix(h + static_cast<std::uint64_t>(rest))), ...);
  return h;
}

}  // namespace ifov::sampling
