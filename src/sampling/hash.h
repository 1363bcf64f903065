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

/// The key of more words after those that made `h`.
template <class... Words>
constexpr std::uint64_t extend(std::uint64_t h, Words... words) {
  static_assert(((std::is_integral_v<Words> || std::is_enum_v<Words>)&&...));
  ((h = mix(h + static_cast<std::uint64_t>(words))), ...);
  return h;
}

/// Key of a random number from what it is for: integers and enums, in order, e.g. hash(seed, x, y, Purpose::probe).
/// Order matters, and so does the number of words.
template <class First, class... Rest>
constexpr std::uint64_t hash(First first, Rest... rest) {
  static_assert(std::is_integral_v<First> || std::is_enum_v<First>);
  return extend(mix(static_cast<std::uint64_t>(first)), rest...);
}

}  // namespace ifov::sampling
