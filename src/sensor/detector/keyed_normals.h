#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "math/normal.h"
#include "sampling/hash.h"

namespace ifov::sensor {

/// The middle of one of 2^52 equal parts of [0, 1], by a key and a number: never 0 and never 1.
inline double keyed_uniform(std::uint64_t key, std::uint64_t number) {
  return (static_cast<double>(static_cast<std::int64_t>(sampling::mix(key + number) >> 12)) + 0.5) * 0x1p-52;
}

/// Those of the numbers from `first` on.
inline void keyed_uniforms(std::uint64_t key, std::uint64_t first, std::span<double> values) {
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = keyed_uniform(key, first + k);
}

/// Normal variables of mean 0 and variance 1, likewise.
inline void keyed_normals(std::uint64_t key, std::uint64_t first, std::span<double> values) {
  keyed_uniforms(key, first, values);
  math::normal_quantiles(values);
}

}  // namespace ifov::sensor
