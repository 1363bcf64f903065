#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sampling/accuracy/output_state.h"
#include "sampling/accuracy/output_sums.h"
#include "sampling/pixel_limits.h"

namespace ifov::sampling {

class LabelTable;
class LeafIntegrator;
class Radiance;

/// The intervals of a tile's output pixels, as the values so far have them.
class OutputIntervals {
 public:
  /// `later` may be null. `replicates`: whether paths have replicates that tell their variance.
  OutputIntervals(const Tolerance& tolerance, const LaterLight* later, const LabelTable& table, int outputs,
                  bool replicates);

  const Stopping& stopping() const { return stopping_; }
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
  void settle_paths(std::span<const int> outputs, std::size_t columns);

  PixelLimits limits_;
  const LabelTable& table_;
  Stopping stopping_;
  std::vector<OutputState> states_;
  OutputSums sums_;
  std::vector<Leading> leading_;  // of outputs
};

}  // namespace ifov::sampling
