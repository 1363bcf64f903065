#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "sampling/accuracy/basis/small_vector.h"

namespace ifov::sampling {

/// What tracing says about one source pixel (a pixel of the focal plane), and how much each part weighs in
/// the output pixels whose footprints reach it, by groups of columns that have one. Weights of one part in all outputs follow each
/// other, those of an output by group.
struct PixelModel {
  struct Border {
    std::uint32_t inner, outer;
  };
  struct Loose {
    std::uint32_t corner[4];
    bool two_labels;
  };
  std::size_t groups = 1;                ///< of columns
  SmallVector<int, 1> outputs;           ///< row-major indices in the tile
  SmallVector<std::uint32_t, 2> labels;  ///< one region per label
  SmallVector<double, 2> area;           ///< of each region, px^2
  SmallVector<double, 2> weight;   ///< [region][output][group]: integral of the footprint over the region
  SmallVector<Border, 1> borders;  ///< pairs of labels that share traced borders
  /// [pair][output][group]: variance of the weight that lies on the wrong side
  SmallVector<double, 1> border_variance;
  SmallVector<Loose, 1> loose;  ///< cells counted by their corners, those of the same two labels together
  SmallVector<double, 1> loose_weight;  ///< [cell][output][group]

  /// Outputs and their groups.
  std::size_t slots() const { return outputs.size() * groups; }
  double weight_of(std::size_t region, std::size_t output, std::size_t group) const {
    return weight[region * slots() + output * groups + group];
  }
  double border_variance_of(std::size_t pair, std::size_t output, std::size_t group) const {
    return border_variance[pair * slots() + output * groups + group];
  }
  double loose_weight_of(std::size_t cell, std::size_t output, std::size_t group) const {
    return loose_weight[cell * slots() + output * groups + group];
  }

  std::uint32_t region_of(std::uint32_t label) const {
    std::uint32_t r = 0;
    while (r < labels.size() && labels[r] != label) ++r;
    return r;
  }

  /// Leaves nothing but the outputs.
  void forget_parts() {
    labels.clear();
    area.clear();
    weight.clear();
    borders.clear();
    border_variance.clear();
    loose.clear();
    loose_weight.clear();
  }

  // Index of a part; without area and weight where it is new.
  std::size_t add_region(std::uint32_t label) {
    const std::size_t r = region_of(label);
    if (r < labels.size()) return r;
    labels.push_back(label);
    area.push_back(0.0);
    append(weight);
    return r;
  }
  std::size_t add_border(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    for (std::size_t i = 0; i < borders.size(); ++i)
      if (borders[i].inner == a && borders[i].outer == b) return i;
    borders.push_back({a, b});
    append(border_variance);
    return borders.size() - 1;
  }
  /// What no model follows between the same two labels (a strip too thin for the cells, say) is the same all
  /// along, so that such errors add up: one entry.
  std::size_t add_loose_pair(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    for (std::size_t i = 0; i < loose.size(); ++i)
      if (loose[i].two_labels && loose[i].corner[0] == a && loose[i].corner[3] == b) return i;
    return add_loose({{a, a, b, b}, true});
  }
  /// Where three labels meet, each cell errs for itself.
  std::size_t add_loose(const Loose& entry) {
    loose.push_back(entry);
    append(loose_weight);
    return loose.size() - 1;
  }

 private:
  template <std::size_t Inline>
  void append(SmallVector<double, Inline>& weights) const {
    for (std::size_t o = 0; o < slots(); ++o) weights.push_back(0.0);
  }
};

}  // namespace ifov::sampling
