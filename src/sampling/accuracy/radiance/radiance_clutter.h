#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/weights/clutter_round.h"

namespace ifov::sampling {

class Lattice;
class RayLedger;
struct SourcePixel;

/// Cluttered pixels: rounds of jittered grids over the whole of them.
class RadianceClutter {
 public:
  /// `keep`: every value is kept, for a footprint that weighs those of a pixel unlike.
  RadianceClutter(std::vector<SourcePixel>& pixels, const Lattice& lattice, RayLedger& ledger, bool keep,
                  std::uint64_t seed);

  /// Plans one more round of about `count` values.
  void plan(std::size_t pixel, double count);
  /// Traces what was planned.
  void trace();

  /// Rounds weigh about as the inverse of the variance of a round of n values, between that where borders make it, n^(3/2), and that
  /// where paths do, n: by their sizes alone and never by what they found.
  static double round_weight(double count) { return count * std::sqrt(std::sqrt(count)); }
  /// Means over the rounds of a cluttered pixel, per column, with their variances. The footprint weighs values about
  /// `centre`; null: all alike.
  static void moments(const SourcePixel& pixel, const PixelFootprint* footprint, Point2 centre,
                      std::span<const int> columns, std::vector<ClutterRound::Moment>& moments);

 private:
  std::vector<SourcePixel>& pixels_;
  const Lattice& lattice_;
  RayLedger& ledger_;
  bool keep_;
  std::uint64_t seed_;
  std::size_t stride_;
  std::vector<std::size_t> planned_;  // pixels
};

}  // namespace ifov::sampling
