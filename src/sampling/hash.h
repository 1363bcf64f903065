#pragma once

#include <cstdint>

namespace ifov::sampling {

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators"):
/// a bijection of 64-bit words whose outputs pass the usual tests for successive inputs.
constexpr std::uint64_t mix(std::uint64_t word) {
  word += 0x9e3779b97f4a7c15ull;
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9ull;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebull;
  return word ^ (word >> 31);
}

/// A hash of several words in order: random numbers are keyed by what they are for, e.g. mix(seed, pixel, index).
template <class... Words>
constexpr std::uint64_t mix(std::uint64_t first, std::uint64_t second, Words... rest) {
  return mix(mix(first) ^ second, static_cast<std::uint64_t>(rest)...);
}

/// A number in [0, 1) from a hashed word (53 bits).
constexpr double unit(std::uint64_t hashed) { return static_cast<double>(hashed >> 11) * 0x1p-53; }

}  // namespace ifov::sampling
