#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "sampling/accuracy/output_sums.h"

namespace ifov::sampling {

class ClutterChoice;
class LeafIntegrator;
class OutputIntervals;
class Radiance;
class RayLedger;
struct AccuracyOptions;
struct OutputState;
struct SourcePixel;
struct Stratum;

/// Radiance in rounds: looks at the intervals of a group of source pixels, and plans more values where they are too wide.
class RoundPlanner {
 public:
  RoundPlanner(const AccuracyOptions& options, const RayLedger& ledger, const ClutterChoice& clutter,
               OutputIntervals& intervals);

  /// Rounds of values until the intervals of all `columns` of these outputs are as narrow as asked, or no value is left to
  /// be spent. `drivers` steer at first. Leaves the sums of all columns gathered.
  void run(Radiance& radiance, const LeafIntegrator& integrator, const std::vector<int>& outputs,
           std::span<const int> steering_channels, int columns);

 private:
  static constexpr double kFewest = 4.0;  ///< values of a stratum's first round, at least

  bool begin_foretold(Radiance& radiance);
  template <class Visit>
  void visit_untold(const Radiance& radiance, const Visit& visit);
  bool begin_untold(Radiance& radiance);
  OutputSums::Row limits_of(int output);
  bool plan_round(Radiance& radiance, const LeafIntegrator& integrator, const std::vector<int>& outputs);
  bool steer_by_more(const Radiance& radiance, const LeafIntegrator& integrator,
                     const std::vector<int>& outputs);
  static std::uint32_t net_size(const Stratum& stratum, double wanted, double room);
  static double next_clutter(const SourcePixel& pixel, double wanted);

  const AccuracyOptions& options_;
  const RayLedger& ledger_;
  const ClutterChoice& clutter_;
  OutputIntervals& intervals_;
  std::vector<OutputState>& outputs_;
  std::vector<int> all_columns_;
  /// Of values of a label, by steering column: their mean and standard deviation where they were drawn first.
  struct Told {
    std::vector<double> mean, deviation;
  };
  std::map<std::uint32_t, Told> told_;
  std::vector<double> mean_, limit_;  // of an output, by column
  std::vector<int> steering_;         // columns whose intervals decide how many values are drawn
};

}  // namespace ifov::sampling
