#pragma once

#include <cstdint>

#include "sampling/random.h"

namespace ifov::sampling {

namespace detail {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

constexpr std::uint64_t reverse_bits(std::uint64_t x) {
  x = ((x >> 1) & 0x5555555555555555u) | ((x & 0x5555555555555555u) << 1);
  x = ((x >> 2) & 0x3333333333333333u) | ((x & 0x3333333333333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0f0f0f0f0fu) | ((x & 0x0f0f0f0f0f0f0f0fu) << 4);
  return __builtin_bswap64(x);
}

/// Owen scrambling of a word whose least significant bit is the first binary digit: every bit is flipped by a
/// hash of the bits below it (Laine and Karras 2011, with the constants of Vegdahl 2021).
constexpr std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Second dimension of Sobol's sequence, bits reversed (first digit lowest): the Pascal triangle modulo 2
/// applied to the index, as five butterflies (Ahmed 2024).
constexpr std::uint32_t sobol_second_reversed(std::uint32_t index) {
  index ^= (index >> 16);
  index ^= (index & 0xff00ff00u) >> 8;
  index ^= (index & 0xf0f0f0f0u) >> 4;
  index ^= (index & 0xccccccccu) >> 2;
  index ^= (index & 0xaaaaaaaau) >> 1;
  return index;
}

}  // namespace detail

/// Element `index` of the Owen-scrambled Sobol (0,2)-sequence `key`, dimensions 2 * dimension_pair and the
/// next. Every aligned run of 2^m elements is a (0,m,2)-net. Pairs are padded: each has its own scrambles and
/// its own nested shuffle of the index, so that no two pairs are correlated (Burley 2020).
inline Point2 sequence_point(std::uint64_t key, std::uint32_t index, std::uint32_t dimension_pair) {
  using namespace detail;
  const std::uint64_t shuffle = mix(key + 0x632be59bd9b4e019ull * (dimension_pair + 1ull));
  const std::uint64_t scrambles = mix(shuffle);
  const std::uint32_t shuffled =
      reverse_bits(scramble_reversed(reverse_bits(index), static_cast<std::uint32_t>(shuffle)));
  const std::uint32_t x = scramble_reversed(shuffled, static_cast<std::uint32_t>(scrambles));
  const std::uint32_t y =
      scramble_reversed(sobol_second_reversed(shuffled), static_cast<std::uint32_t>(scrambles >> 32));
  // One reversal of both words side by side swaps them.
  const std::uint64_t both = reverse_bits(std::uint64_t{y} << 32 | x);
  return {(static_cast<double>(both >> 32) + 0.5) * 0x1p-32,
          (static_cast<double>(both & 0xffffffffu) + 0.5) * 0x1p-32};
}

/// Radical inverse: the digits of `index` in `base`, mirrored at the point.
constexpr double radical_inverse(std::uint32_t index, std::uint32_t base) {
  const double inverse_base = 1.0 / base;
  double digit_value = 1.0, result = 0.0;
  for (; index != 0; index /= base) {
    digit_value *= inverse_base;
    result += digit_value * (index % base);
  }
  return result;
}

/// Element `index`, counted from 0, of the Halton sequence in bases 2 and 3 without its first point, the
/// origin (Halton 1960).
constexpr Point2 halton_point(std::uint32_t index) {
  return {radical_inverse(index + 1, 2), radical_inverse(index + 1, 3)};
}

}  // namespace ifov::sampling
