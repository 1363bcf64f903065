#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "sampling/accuracy/output_state.h"
#include "sampling/accuracy/output_sums.h"
#include "sampling/pixel_limits.h"

namespace ifov::sampling {

class ClutterSums;
class ColumnFootprints;
class Field;
class LabelTable;
class LeafIntegrator;
class Radiance;
struct Abundance;
struct SourcePixel;
struct StratumMoments;
struct WeighedMoments;

/// The intervals of a tile's output pixels, as the values so far have them.
class OutputIntervals {
 public:
  /// `later` may be null.
  OutputIntervals(const Tolerance& tolerance, const LaterLight* later, const LabelTable& table,
                  const Field& field, int outputs, const ColumnFootprints& footprints);
  ~OutputIntervals();

  const Stopping& stopping() const { return stopping_; }
  const ColumnFootprints& footprints() const { return footprints_; }
  std::vector<OutputState>& states() { return states_; }

  /// Moments of every stratum of a group, per column, weighed into these outputs, which its source pixels reach.
  void gather(const Radiance& radiance, const LeafIntegrator& integrator, std::span<const int> columns,
              std::span<const int> outputs);
  /// What was gathered last.
  OutputSums::Row sum(int output) { return sums_[output]; }
  std::span<const double> means(int output) const { return sums_.means(output); }
  /// How wide intervals may be, of an output with these means by column of the field (PixelLimits::of) and the materials that it holds.
  void limits(int output, std::span<const double> mean, std::span<double> limit);
  /// Of the interval at the output's test; `column` in the order of those gathered.
  double half_width(int output, std::size_t column);

 private:
  struct Asked;
  struct Traced;
  struct Leading;
  void add_clutter(const Radiance& radiance, const LeafIntegrator& integrator, const SourcePixel& pixel,
                   const Asked& asked);
  void add_traced(const Radiance& radiance, const LeafIntegrator& integrator, const Traced& of,
                  WeighedMoments& weighed);
  void settle_paths(std::span<const int> outputs, std::size_t columns);

  void find_materials(const Radiance& radiance, const LeafIntegrator& integrator,
                      std::span<const int> outputs);

  PixelLimits limits_;
  const bool by_material_;
  const Field& field_;
  const LabelTable& table_;
  const ColumnFootprints& footprints_;
  Stopping stopping_;
  std::vector<OutputState> states_;
  OutputSums sums_;
  std::unique_ptr<ClutterSums> clutter_;
  std::vector<Leading> leading_;                      // of outputs
  std::vector<Abundance> held_;                       // output by output, where limits depend on it
  std::vector<std::size_t> first_held_, held_count_;  // by output
};

}  // namespace ifov::sampling
