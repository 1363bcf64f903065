#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sampling/accuracy/output_state.h"
#include "sampling/accuracy/output_sums.h"
#include "sampling/accuracy/radiance/clutter_sums.h"
#include "sampling/pixel_limits.h"

namespace ifov::sampling {

class ColumnFootprints;
class LabelTable;
class LeafIntegrator;
class Radiance;
struct SourcePixel;
struct StratumMoments;
struct WeighedMoments;

/// The intervals of a tile's output pixels, as the values so far have them.
class OutputIntervals {
 public:
  /// `later` may be null.
  OutputIntervals(const Tolerance& tolerance, const LaterLight* later, const LabelTable& table, int outputs,
                  const ColumnFootprints& footprints);

  const Stopping& stopping() const { return stopping_; }
  const ColumnFootprints& footprints() const { return footprints_; }
  std::vector<OutputState>& states() { return states_; }

  /// Moments of every stratum of a group, per column, weighed into these outputs, which its source pixels reach.
  void gather(const Radiance& radiance, const LeafIntegrator& integrator, std::span<const int> columns,
              std::span<const int> outputs);
  /// What was gathered last.
  OutputSums::Row sum(int output) { return sums_[output]; }
  std::span<const double> means(int output) const { return sums_.means(output); }
  /// How wide intervals may be, of an output with these means by column of the field (PixelLimits::of).
  void limits(int output, std::span<const double> mean, std::span<double> limit) {
    limits_.of(static_cast<std::size_t>(output), mean, limit);
  }
  /// Of the interval at the output's test; `column` in the order of those gathered.
  double half_width(int output, std::size_t column);

 private:
  /// The label that most of an output's variance comes from: of the stratum that has most of it.
  struct Leading {
    std::uint32_t label;
    double variance;
  };
  /// The columns that are asked, and by group their positions and themselves.
  struct Asked {
    std::span<const int> columns;
    std::vector<std::vector<std::size_t>> positions;
    std::vector<std::vector<int>> columns_of;
  };
  void add_clutter(const Radiance& radiance, const LeafIntegrator& integrator, const SourcePixel& pixel,
                   const Asked& asked);
  void settle_paths(std::span<const int> outputs, std::size_t columns);
  /// A traced pixel, one of its outputs, and the group that some of the asked columns are of.
  struct Traced {
    const SourcePixel& pixel;
    const std::vector<StratumMoments>& moments;  ///< by region
    std::size_t output, group;
    std::span<const int> columns;      ///< all that are asked
    std::span<const std::size_t> own;  ///< positions of the group's
  };
  void add_traced(const Radiance& radiance, const LeafIntegrator& integrator, const Traced& of,
                  WeighedMoments& weighed);

  PixelLimits limits_;
  const LabelTable& table_;
  const ColumnFootprints& footprints_;
  Stopping stopping_;
  std::vector<OutputState> states_;
  OutputSums sums_;
  ClutterSums clutter_;
  std::vector<ClutterRound::Moment> moments_;  // of clutter
  std::vector<Leading> leading_;               // of outputs
};

}  // namespace ifov::sampling
