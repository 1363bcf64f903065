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
  /// Values of a pixel's pilot round, about; of each stratum kFewest at least.
  static constexpr double kPilot = 16.0;
  static constexpr double kSure = 40.0;  ///< so many degrees of freedom tell a variance well
  static constexpr double kGains =
      0.9;  ///< where sequences of paths leave less of the variance than this, they are seen to gain

  bool begin_foretold(Radiance& radiance);
  template <class Visit>
  void visit_untold(const Radiance& radiance, const Visit& visit);
  bool begin_untold(Radiance& radiance);
  OutputSums::Row limits_of(int output);
  /// Values that a stratum of a pixel is to have in all, as outputs whose intervals are too wide want it.
  struct Want {
    std::size_t pixel, stratum;
    double have;
    double wanted = 0.0, freedom = 0.0;  ///< degrees of freedom by which it is known
    double gain = 1.0;                   ///< variance over that of paths drawn apart
    double share = 1.0;
    bool hope = false, paths_differ = false;
  };

  bool is_open(int output) const;
  void find_budget(int output);
  void find_wants(const Radiance& radiance, const LeafIntegrator& integrator);
  void ease_wants(const Radiance& radiance, const LeafIntegrator& integrator);
  bool raise_wants();
  bool plan_wants(Radiance& radiance, const LeafIntegrator& integrator);
  bool plan_stratum(Radiance& radiance, const LeafIntegrator& integrator, const Want& want,
                    std::span<const double> own, std::span<const double> unmet, double room);
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
  std::vector<Want> wants_;
  /// [want][steering column]: variance of one value, and what values have not met as if it were of one.
  std::vector<double> own_, unmet_;
  std::vector<double> now_, then_;  // [output][steering column]
  std::vector<int> steering_;       // columns whose intervals decide how many values are drawn
};

}  // namespace ifov::sampling
