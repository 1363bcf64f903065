#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "atmosphere/layer_optics.h"
#include "atmosphere/scattering/phase/propagation.h"

namespace ifov::atmosphere {

/// What gas does to light scattered many times, in three numbers.
struct GasPlacement {
  double depth = 0.0;  ///< vertical absorption depth of all gas
  /// Mean over the gas of the share of the column's scattering depth that is above it: near 0 for ozone, 0.5
  /// to 0.6 for well-mixed gases, near 1 for water vapour.
  double under = 0.5;
  /// Mean of that share's square: tells a mixture of high and low gas from one between.
  double under_square = 0.25;
};
GasPlacement gas_placement(const LayerOptics& optics);

/// Some light (radiance of a path, a flux, the spherical albedo; a flux has only `i`), split by order.
struct LightByOrder {
  StokesVector first;  ///< scattered once
  StokesVector rest;   ///< scattered more often
};

/// Reuses solutions: light scattered more than once as a function of wavelength and of gas absorption,
/// relative to light scattered once, for any number of quantities. Light scattered once follows every line of
/// the spectrum and is computed exactly at every wavenumber and absorption term; the ratio is smooth.
///
/// Nodes are wavelengths x depths of gas x profiles of gas (say ozone, a well-mixed gas, water vapour).
/// ln(rest / first) of I is interpolated linearly in the logarithm of wavelength, by cubics in ln(1 + 10
/// depth), and linearly between the profiles, in the shares that have the gas's means of GasPlacement; Q and
/// U of the rest are interpolated relative to its I.
class MultipleScatteringTable {
 public:
  struct Nodes {
    std::vector<double> wavelength_um;  ///< rising, at least 2
    std::vector<double> depth;          ///< of gas, rising from 0, at least 2
    std::size_t profiles = 1;           ///< 1 to 3, in the order of their GasPlacement::under, rising
  };
  /// The column at a node: gas of this profile scaled to this depth.
  using MakeOptics = std::function<LayerOptics(double wavelength_um, double depth, std::size_t profile)>;
  /// The quantities of one full solution, in an order of the caller's own; equally many at every node.
  using Solve = std::function<std::vector<LightByOrder>(double wavelength_um, const LayerOptics& optics)>;

  /// Solves every node once, on `threads` threads (0: all cores). Throws std::invalid_argument.
  MultipleScatteringTable(const Nodes& nodes, const MakeOptics& optics, const Solve& solve, int threads = 0);

  std::size_t quantities() const { return quantities_; }

  /// All light of every quantity from the light scattered once in a column with this gas. Beyond the nodes
  /// the outermost hold.
  void complete(double wavelength_um, const GasPlacement& gas, std::span<const StokesVector> first,
                std::span<StokesVector> total) const;

 private:
  struct Entry {
    double log_ratio = 0.0, q = 0.0, u = 0.0;
  };
  std::size_t row(std::size_t wavelength, std::size_t depth, std::size_t profile) const {
    return (wavelength * depth_.size() + depth) * profiles_ + profile;
  }
  std::vector<double> log_wavelength_, depth_;
  std::size_t profiles_ = 1, quantities_ = 0;
  std::vector<GasPlacement> placement_;  ///< [wavelength][profile]
  std::vector<Entry> entries_;           ///< [wavelength][depth][profile][quantity]
};

}  // namespace ifov::atmosphere
