#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace ifov::sampling {

class LabelSpread;
class LabelTable;
class Lattice;
struct LatticeValues;
struct SourcePixel;
struct Stratum;

/// Mean of one stratum (a label within a source pixel) and the variance of one of its values.
struct StratumMoments {
  std::vector<double> mean, variance;  ///< per asked column; `variance` is that of one value
  double freedom = 0.0;                ///< degrees of freedom behind `variance`
  double share = 1.0;    ///< variance of `mean` in units of `variance`: 1 / n where values weigh alike
  bool sampled = false;  ///< false: lattice values only, which count as one random value
};

/// Means and variances of strata from their values, and where those are few, from the lattice and the tile.
class StratumEstimates {
 public:
  StratumEstimates(const Lattice& lattice, const LatticeValues& values, const LabelTable& table,
                   const LabelSpread& spread);

  virtual ~StratumEstimates() = default;

  /// Over the given columns.
  virtual void moments(const SourcePixel& pixel, std::size_t stratum, std::span<const int> columns,
                       StratumMoments& out) const;

  /// How much the lattice tells of how values of a stratum's label differ, 0 to 1. A label narrower than the lattice's spacing
  /// has no block of it: vertices in line with it all stand at one place across it, and where none is, one value stands for all.
  virtual double told(const Stratum& stratum) const;

  /// How single values of a label differ of which the lattice tells too little, by column, as values of one of its strata have
  /// shown. Until then they may differ by all that the label, or the tile, is, once borders are traced (doubt()), which take no more
  /// rays for it.
  void learn(std::uint32_t label, std::vector<double> variances) { learnt_[label] = std::move(variances); }
  void doubt() { doubts_ = true; }

  /// Whether values that stand in no block of a round tell how values differ.
  virtual bool alone_tell() const { return true; }

  /// Whether most of the variance of a stratum's values comes from their paths rather than from where they are, in
  /// some of these columns; false before twins have told.
  static bool paths_differ(const Stratum& stratum, std::span<const int> columns,
                           const StratumMoments& moments);

  /// The number of values that reaches what `count` values would reach at the variance of the last round, if
  /// the variance within blocks goes on falling with their size as it did from the round before.
  static double with_trend(const Stratum& stratum, std::span<const int> steering_channels, double count);

 private:
  void of_values(const Stratum& stratum, std::span<const int> columns, StratumMoments& out) const;
  void of_lattice(const SourcePixel& pixel, const Stratum& stratum, std::span<const int> columns,
                  StratumMoments& out) const;
  void widen_untold(const Stratum& stratum, std::span<const int> columns, std::span<double> variance) const;

  const Lattice& lattice_;
  const LatticeValues& values_;
  const LabelTable& table_;
  const LabelSpread& spread_;
  std::vector<double> level_;  // mean of all values of the tile, by column
  std::map<std::uint32_t, std::vector<double>> learnt_;
  bool doubts_ = false;
};

}  // namespace ifov::sampling
