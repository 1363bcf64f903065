#pragma once

#include <vector>

namespace ifov::sampling {

class Contrast;
class LabelSpread;
class Lattice;
class OutputIntervals;
class SourceGrid;
struct LatticeValues;
struct TileProblem;

/// The standard errors that the tolerance allows to pixels, and what part of them may come from borders.
class AllowedErrors {
 public:
  /// `normal`: half-widths of intervals in standard errors.
  AllowedErrors(const TileProblem& problem, const SourceGrid& grid, const Lattice& lattice,
                const LatticeValues& values, double normal, Contrast& contrast);

  /// From the means over the lattice, seen through the footprint.
  void take_from_lattice();
  /// The lattice may have been in step with what it looked at: limits follow the means that borders tell, of the drivers
  /// in all outputs.
  void take_from_sums(OutputIntervals& intervals);

  /// Share of a source pixel's allowed variance that borders may take: all of it where every label looks the same
  /// everywhere.
  double geometry_share(int source, const LabelSpread& spread) const;
  /// What borders have in the variance of an output pixel at its worst driver, over the square of its allowed standard
  /// error; `geometry`: their variance by driver.
  double border_part(int source, const double* geometry) const;
  /// Variance that borders may leave in a source pixel, in squares of its allowed standard error: more where it counts
  /// only in part in each output.
  double border_variance(int source, const LabelSpread& spread) const;

 private:
  std::vector<double> source_means() const;

  const TileProblem& problem_;
  const SourceGrid& grid_;
  const Lattice& lattice_;
  const LatticeValues& values_;
  Contrast& contrast_;
  double unit_;    ///< half-widths are divided by this
  double energy_;  ///< integral of the footprint's square
};

}  // namespace ifov::sampling
