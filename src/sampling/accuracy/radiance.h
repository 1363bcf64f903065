#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/tile_memory.h"
#include "sampling/accuracy/block_sums.h"
#include "sampling/accuracy/clutter_round.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "sampling/accuracy/lattice_values.h"
#include "sampling/accuracy/leaf_integrator.h"
#include "sampling/accuracy/probing.h"
#include "sampling/accuracy/spread.h"
#include "sampling/accuracy/stopping.h"

namespace ifov::sampling {

/// Mean of one stratum (a label within a source pixel) and the variance of one of its values.
struct StratumMoments {
  std::vector<double> mean, variance;  ///< per asked column; `variance` is that of one value
  double freedom = 0.0;                ///< degrees of freedom behind `variance`
  double share = 1.0;    ///< variance of `mean` in units of `variance`: 1 / n where values weigh alike
  bool sampled = false;  ///< false: lattice values only, which count as one random value
};

/// Of a stratum whose values weigh by a footprint, per asked column.
struct WeighedMoments {
  std::vector<double> mean;
  /// Variance of `mean` in units of StratumMoments::variance, were all paths drawn apart.
  double share = 1.0;
  std::vector<double> variance;  ///< of `mean`, as the replicates of the paths' sequences differ
  double freedom = 0.0;          ///< degrees of freedom behind `variance`; 0: values are too few for it
};

/// The radiance within labels: values at stratified points, uniform inside each (pixel, label) stratum of a
/// group of source pixels, in rounds. docs/theory/accuracy_sampler.md, section 6.
class Radiance {
 public:
  /// A stratum starts with values at jittered points. Where paths vary so much that many are needed, those
  /// are replaced by replicated nets: scrambled sequences whose paths are stratified among themselves, so
  /// that the spread of the replicates' means shows what that gains. Only sums of such values are kept.
  struct Nets {
    std::uint32_t size = 0;               ///< values planned per replicate; 0: none
    std::vector<std::uint32_t> drawn;     ///< points of each replicate's sequence used so far
    std::vector<std::uint32_t> paths;     ///< values planned
    std::vector<std::uint32_t> accepted;  ///< values whose label was the stratum's
    std::vector<double> sum;              ///< [replicate][column] of the accepted
  };
  struct Stratum {
    std::uint32_t label = EdgeTracer::kNoLabel;
    std::uint32_t round = 0;
    std::uint32_t paths = 0;        ///< of its one sequence used so far, where no footprint weighs its values
    std::vector<BlockSums> rounds;  ///< of accepted values, one per jittered grid
    /// Indices of accepted values where those are kept, round after round.
    std::vector<std::uint32_t> samples;
    Nets nets;
    std::vector<double> twin_squares;  ///< per column: half the squared differences of two paths at one point
    double twins = 0.0;
    /// Values whose label contradicts the traced model: per column sums of their differences from the
    /// label's mean, and of the squares.
    double strays = 0.0;
    std::vector<double> stray_sum, stray_squares;
    /// Per column: standard deviation of the lattice's values of the label in the pixel and those around it, of all labels
    /// where few are its own or its values differ by nature (in a cluttered pixel of all labels, with those that looks and
    /// probes have met in it). Empty where all values of the label agree.
    std::vector<float> deviation;
    std::size_t count() const;  ///< values that the estimate rests on
  };
  struct Pixel {
    int source = 0;  ///< index in the domain
    PixelModel model;
    std::vector<Stratum> strata;  ///< one per region of the model; for a cluttered pixel one, of all labels
    bool cluttered = false;
    std::vector<ClutterRound> rounds;  ///< of a cluttered pixel, whose strata have no values
    double clutter_count() const;      ///< values of all rounds
  };

  /// `keep_values`: for a footprint that weighs the values of a pixel unlike.
  Radiance(const EdgeTracer& tracer, const Prober& prober, RayLedger& ledger, const LabelTable& table,
           const LabelSpread& spread, const LatticeValues& lattice_values, const AccuracyFaults& faults,
           std::uint64_t seed, bool keep_values);

  /// Few replicates know their variance badly: with 8, one interval in a hundred errs by four standard errors.
  static constexpr int kStratumReplicates = 24;
  /// Sequences of paths in a jittered round. Each has one value in every block of 2 x 2 cells.
  static constexpr std::uint32_t kRoundReplicates = 4;
  /// Points of a stratum's second round that get a second path each.
  static constexpr int kTwins = 16;

  /// A pixel of one label whose values all agree: it needs nothing but its weight.
  struct PlainPixel {
    int source, output;
    std::uint32_t label;
    double weight;
  };
  const std::vector<PlainPixel>& plain_pixels() const { return plain_pixels_; }

  bool knows_more_than_values(const Pixel& pixel) const;
  /// Variance of the mean of a stratum's values by what they have not met and values nearby show.
  double unseen(const Pixel& pixel, std::size_t stratum, int column) const;

  std::vector<Pixel>& pixels() { return pixels_; }
  /// Source pixels [first, last).
  void add_pixels(int first, int last, const LeafIntegrator& integrator);
  /// Keeps what a later run may go on from; `predicted` values were expected of it as clutter.
  void remember(const Pixel& pixel, double predicted, TileMemory& memory) const;
  /// Takes up the values that an earlier run left of the pixel, where they still fit what is traced. False where some
  /// do not: these are left out.
  bool recall(std::size_t pixel, const TileMemory& memory);
  /// Values that an earlier run has spent on a source pixel as clutter, and how many had been expected; 0 where it was
  /// not.
  struct ClutterBefore {
    double values = 0.0, predicted = 0.0;
  };
  static ClutterBefore clutter_before(const TileMemory& memory, int source);
  /// Before any value is planned: follows what tracing has changed. False where pixels must be added anew.
  bool refresh(const LeafIntegrator& integrator);

  /// Plans about `count` more values in a stratum, or one more round of about `count` values in a cluttered pixel.
  void plan(std::size_t pixel, std::size_t stratum, double count);
  void plan_clutter(std::size_t pixel, double count);
  /// Leaves the pixel's traced model for rounds over the whole of it.
  void turn_to_clutter(std::size_t pixel);
  /// Replaces a stratum's values by nets of `count` values per replicate, or makes its nets that large.
  void plan_stratum_nets(std::size_t pixel, std::size_t stratum, std::uint32_t count);
  /// Traces what was planned.
  void trace();

  /// Moments over the given columns. Weights of values under output `centre` follow the footprint (null:
  /// equal).
  void moments(const Pixel& pixel, std::size_t stratum, std::span<const int> columns,
               StratumMoments& out) const;

  /// Whether most of the variance of a stratum's values comes from their paths rather than from where they are, in
  /// some of these columns; false before twins have told.
  bool paths_differ(const Stratum& stratum, std::span<const int> columns,
                    const StratumMoments& moments) const;

  /// The number of values that reaches what `count` values would reach at the variance of the last round, if
  /// the variance within blocks goes on falling with their size as it did from the round before.
  double with_trend(const Pixel& pixel, std::size_t stratum, std::span<const int> drivers,
                    double count) const;

  /// Moments of sampled values that weigh by a footprint as well; leaves the mean as it is where they weigh nothing.
  void weigh(const Pixel& pixel, std::size_t stratum, const PixelFootprint& footprint, Point2 centre,
             std::span<const int> columns, const StratumMoments& moments, WeighedMoments& out) const;

  /// Means over the rounds of a cluttered pixel, per column, with their variances. The footprint weighs values about
  /// `centre`; null: all alike.
  void clutter(const Pixel& pixel, const PixelFootprint* footprint, Point2 centre,
               std::span<const int> columns, std::vector<ClutterRound::Moment>& moments) const;

 private:
  struct Planned {
    std::size_t pixel, stratum;
    std::uint32_t block;
    std::uint8_t replicate;
    bool twin;  ///< a second path at the point of the value before
    bool same_block(const Planned& other) const {
      return pixel == other.pixel && stratum == other.stratum && block == other.block;
    }
  };
  struct PlannedRound {
    std::size_t pixel, stratum;
    double count;
  };
  /// The requests of a round, of about so many values.
  void request_round(std::size_t pixel, std::size_t stratum, double count);
  void trace_requests();
  void plan_paths(Stratum& stratum, std::uint64_t key, std::size_t first);
  void plan_twins(std::size_t first);
  void add_block(std::size_t first, std::size_t last, std::span<const std::uint32_t> labels,
                 const float* values);

  void fill(Pixel& pixel, const LeafIntegrator& integrator) const;

  struct PlannedNet {
    std::size_t pixel, stratum;
  };
  void find_deviation(const Pixel& pixel, Stratum& stratum) const;
  double widen_deviation(const Pixel& pixel, std::uint32_t label, std::vector<float>& deviation) const;
  template <class Request>
  void request_net(std::size_t pixel, std::size_t stratum, const Request& request);
  void trace_nets();
  void trace_clutter();
  /// Whether a value that was planned for a stratum belongs to it. What lies on the wrong side of a border is
  /// part of the border's variance and does not; what the border cannot explain was missed by tracing: it
  /// does, as the model counts its area to the stratum, and is kept in mind.
  bool belongs(Stratum& stratum, FocalPoint point, std::uint32_t label, const float* value) const;
  void net_moments(const Nets& nets, std::span<const int> columns, StratumMoments& out) const;

  const EdgeTracer& tracer_;
  const Prober& prober_;
  RayLedger& ledger_;
  const LabelTable& table_;
  const LabelSpread& spread_;
  const LatticeValues& lattice_;
  const AccuracyFaults& faults_;
  std::uint64_t seed_;
  std::size_t stride_;
  bool keep_values_;

  std::vector<Pixel> pixels_;
  std::vector<PlainPixel> plain_pixels_;
  std::vector<Planned> planned_;
  std::vector<PathRequest> requests_;
  // Requests are made as they are traced: those of all values planned together may not fit into memory.
  std::vector<PlannedRound> planned_rounds_;
  std::vector<PlannedNet> planned_nets_;
  std::vector<std::size_t> clutter_planned_;  // pixels
  // Of the values kept: where they are, the sequence of their path, rows of stride_ floats.
  std::vector<Point2> x_;
  std::vector<std::uint8_t> replicates_;
  std::vector<float> values_;
};

}  // namespace ifov::sampling
