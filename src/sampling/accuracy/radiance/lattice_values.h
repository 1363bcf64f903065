#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/field.h"

namespace ifov::sampling {

/// Labels and values at the lattice's vertices, row by row (Lattice::columns() + 1 in a row), shared by the pixels around them.
struct LatticeValues {
  static constexpr std::uint32_t kMixed = ~std::uint32_t{0};

  std::size_t columns = 0;
  std::vector<std::uint32_t> labels;
  std::vector<std::uint32_t> own;  ///< the same before labels were merged; empty where none were
  std::vector<float> values;       ///< [vertex][column]
  std::vector<float> rest;         ///< the same less what is foretold (ControlVariates); empty: nothing is
  std::vector<std::uint8_t> constant;  ///< by label: whether its values are the same to the last bit
  std::vector<std::uint32_t> only;     ///< by pixel: the label of all its vertices, or kMixed

  /// Jittered points, which the seed moves, of pixels whose vertices all have constant labels.
  struct RandomPoints {
    std::vector<FocalPoint> points;
    std::vector<std::uint32_t> labels;
    std::vector<float> values;  ///< [point][column]
    const float* value(std::size_t point, std::size_t stride) const { return &values[point * stride]; }
  } random;

  const float* value(std::size_t vertex) const { return &values[vertex * columns]; }
  const float* value_or_rest(std::size_t vertex, bool foretold) const {
    return foretold ? &rest[vertex * columns] : value(vertex);
  }

  /// Whether all vertices of a pixel have the same label and value.
  bool flat(int pixel) const { return only[pixel] != kMixed && constant[only[pixel]] != 0; }
};

}  // namespace ifov::sampling
