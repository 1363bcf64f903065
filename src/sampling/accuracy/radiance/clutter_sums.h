#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sampling/accuracy/weights/clutter_round.h"

namespace ifov::sampling {

class LeafIntegrator;
struct SourcePixel;

/// Moments of cluttered pixels as the footprints of groups weigh their values. Each round is weighed once, for all outputs and
/// groups, and what it says is added to what those before it said: pixels are asked after every round.
class ClutterSums {
 public:
  /// Of a source pixel, one of its outputs and a column: over the rounds so far, with their weights.
  struct Sum {
    double mean = 0.0, variance = 0.0, fourth = 0.0;
  };
  /// Of an output, one of a column each; valid until the next call of take().
  struct Sums {
    std::span<const Sum> of_columns;
    double total = 0.0;  ///< of the rounds' weights
    ClutterRound::Moment moment(std::size_t position) const {
      const Sum& s = of_columns[position];
      return {s.mean / total, s.variance / (total * total),
              s.fourth > 0.0 ? s.variance * s.variance / s.fourth : 0.0};
    }
  };

  /// Brings the pixel up to date in these columns. `by_group`: positions among them.
  void take(const SourcePixel& pixel, const LeafIntegrator& integrator, std::span<const int> columns,
            std::span<const std::vector<std::size_t>> by_group);
  /// Of the pixel that was taken last; `output`: position among its outputs.
  Sums of(std::size_t output) const;

 private:
  struct Pixel {
    std::size_t rounds = 0, outputs = 0;
    double total = 0.0;
    std::vector<int> columns;
    std::vector<Sum> sums;  // [output][column]
  };
  Pixel& room_for(const SourcePixel& pixel, std::size_t columns);

  std::vector<Pixel> pixels_;  // by number of the source pixel
  Pixel passing_;              // of what there is no room to keep
  Pixel* taken_ = nullptr;
  std::size_t kept_ = 0;  // sums
};

}  // namespace ifov::sampling
