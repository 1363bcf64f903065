#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/accuracy/basis/no_label.h"
#include "sampling/accuracy/weights/block_sums.h"
#include "sampling/accuracy/weights/clutter_round.h"
#include "sampling/accuracy/weights/pixel_model.h"
#include "sampling/random.h"

namespace ifov::sampling {

/// Values of a stratum in replicated nets: sequences whose paths are stratified among themselves, so that the spread of
/// the replicates' means shows what that gains. Only sums of such values are kept.
struct StratumNets {
  std::uint32_t size = 0;               ///< values planned per replicate; 0: none
  std::vector<std::uint32_t> drawn;     ///< points of each replicate's sequence used so far
  std::vector<std::uint32_t> paths;     ///< values planned
  std::vector<std::uint32_t> accepted;  ///< values whose label was the stratum's
  std::vector<double> sum;              ///< [replicate][column] of the accepted
};

/// Of a stratum whose values maps foretell in part (ControlVariates): its values are rests, and by column, of what is foretold,
struct StratumControl {
  std::vector<double> mean, variance;  ///< over the stratum (empty: nothing is foretold), and of that mean
  std::vector<double> spread;          ///< variance from place to place
  double freedom = 0.0;                ///< degrees of freedom behind `variance`
  /// Where footprints weigh places unlike, of each output of the pixel's model: [output][column], and [output]. Empty: all weigh alike.
  std::vector<float> weighed_mean, weighed_variance, weighed_freedom;
};

/// A label within a source pixel. It starts with values at jittered points; where many are needed, nets replace those.
struct Stratum {
  std::uint32_t label = kNoLabel;
  std::uint32_t round = 0;
  std::uint32_t paths = 0;        ///< of its one sequence used so far, where no footprint weighs its values
  std::vector<BlockSums> rounds;  ///< of accepted values, one per jittered grid
  /// Numbers in KeptValues of accepted values, where those are kept, round after round.
  std::vector<std::uint32_t> samples;
  StratumNets nets;
  std::vector<double> twin_squares;  ///< per column: half the squared differences of two paths at one point
  double twins = 0.0;
  /// Values whose label contradicts the traced model: per column sums of their differences from the
  /// label's mean, and of the squares.
  double strays = 0.0;
  std::vector<double> stray_sum, stray_squares;
  /// Per column: standard deviation of values nearby, as NearbySpread has it. Empty where all values of the label agree.
  std::vector<float> deviation;
  StratumControl control;

  bool foretold() const { return !control.mean.empty(); }
  std::size_t count() const;  ///< values that the estimate rests on
};

/// A pixel of the focal plane.
struct SourcePixel {
  int source = 0;  ///< index in the domain
  PixelModel model;
  std::vector<Stratum> strata;  ///< one per region of the model; for a cluttered pixel one, of all labels
  bool cluttered = false;
  std::vector<ClutterRound> rounds;          ///< of a cluttered pixel, whose strata have no values
  std::vector<const SourcePixel*> beside{};  ///< those around it that are of the same group

  double clutter_count() const;  ///< values of all rounds
};

/// A pixel of one label whose values all agree: it needs nothing but its weight.
struct PlainPixel {
  int source, output;
  std::uint32_t label;
  double weight;
};

/// Values that are kept because a footprint weighs those of a pixel unlike.
struct KeptValues {
  std::vector<Point2> x;                 ///< where they are
  std::vector<std::uint8_t> replicates;  ///< the sequence of their path
  std::vector<float> values;             ///< rows as long as the field's stride
};

}  // namespace ifov::sampling
