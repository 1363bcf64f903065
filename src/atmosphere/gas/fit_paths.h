#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "atmosphere/gas/gas_spectra.h"

namespace ifov::atmosphere {

/// Paths by which terms are made and judged, through a model atmosphere with its amounts of the gas: sections of its height, each of
/// several lengths.
class FitPaths {
 public:
  /// The model atmosphere, by its name.
  FitPaths(std::string_view model, const TermGas& gas, const StateGrid& states);

  /// From the ground up.
  struct Section {
    double from_km, to_km;
  };
  static constexpr std::array<Section, 6> kSections{
      {{0.0, 100.0}, {2.0, 100.0}, {5.0, 100.0}, {10.0, 100.0}, {0.0, 1.0}, {0.0, 5.0}}};

  double molecules_cm2() const { return molecules_cm2_; }  ///< of the whole column
  /// Vertical depths of something that absorbs, [section]; `log_k(state)` is ln cm2 per molecule, by the state of the grid.
  template <class LogK>
  std::array<double, kSections.size()> depths(const LogK& log_k) const {
    std::array<double, kSections.size()> depth{};
    for (const Layer& layer : layers_) {
      double sum = 0.0;
      for (std::size_t s = 0; s < 4; ++s) sum += layer.place.weight[s] * log_k(layer.place.state[s]);
      const double here = std::exp(sum) * layer.molecules_cm2;
      for (std::size_t k = 0; k < kSections.size(); ++k)
        if (layer.in[k]) depth[k] += here;
    }
    return depth;
  }

 private:
  struct Layer {
    double molecules_cm2;
    StateGrid::Place place;
    std::array<bool, kSections.size()> in;
  };
  std::vector<Layer> layers_;
  double molecules_cm2_ = 0.0;
};

}  // namespace ifov::atmosphere
