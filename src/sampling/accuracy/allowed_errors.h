#pragma once

#include <span>
#include <vector>

namespace ifov::sampling {

class ColumnFootprints;
class Contrast;
class LabelSpread;
class Lattice;
class OutputIntervals;
class SourceGrid;
class SourcePixels;
class SteeringColumns;
struct LatticeValues;
struct TileProblem;

/// The standard errors that the tolerance allows to pixels, and what part of them may come from borders.
class AllowedErrors {
 public:
  /// `normal`: half-widths of intervals in standard errors.
  AllowedErrors(const TileProblem& problem, const ColumnFootprints& footprints, const SourceGrid& grid,
                const Lattice& lattice, const LatticeValues& values, double normal, SteeringColumns& steering,
                Contrast& contrast);

  /// From the means over the lattice, seen through the footprint. Columns that tell neighbours apart steer from here on.
  void take_from_lattice();
  /// Those of contrasts; no column that comes to steer later counts there.
  void set_contrasts();
  /// The same of all that is in one pixel, whether the lattice has met it or not; true where columns were added, whose limits take_from_sums() has to set.
  bool cover(const SourcePixels& traced);
  /// The lattice may have been in step with what it looked at: limits follow the means that borders tell, of the steering columns in all outputs.
  void take_from_sums(OutputIntervals& intervals);

  /// 1 over the variance allowed by the lattice's means, by column: 0 where nothing is asked. Valid until the next call.
  std::span<const double> inverse_squares(int source);

  /// Share of a source pixel's allowed variance that borders may take: all of it where every label looks the same everywhere.
  double geometry_share(int source, const LabelSpread& spread) const;
  /// What borders have in the variance of an output pixel at its worst column, over the square of its allowed standard error; `geometry`: their variance by steering column.
  double border_part(int source, const double* geometry) const;
  /// Variance that borders may leave in a source pixel, in squares of its allowed standard error: more where it counts only in part in each output.
  double border_variance(int source, const LabelSpread& spread) const;

 private:
  std::vector<double> source_means() const;
  void find_lattice_limits();
  void cover_lattice();

  const TileProblem& problem_;
  const ColumnFootprints& footprints_;
  const SourceGrid& grid_;
  const Lattice& lattice_;
  const LatticeValues& values_;
  SteeringColumns& steering_;
  Contrast& contrast_;
  std::vector<double> lattice_limits_;  // allowed standard errors by the lattice's means, [output][column]
  std::vector<double> inverse_;         // inverse_squares() of the output named last
  int inverse_of_ = -1;
  double unit_;    ///< half-widths are divided by this
  double energy_;  ///< integral of the footprint's square, of the sharpest
};

}  // namespace ifov::sampling
