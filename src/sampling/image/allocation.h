#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sampling/image/pixel_points.h"

namespace ifov::sampling {

/// What a pixel's value would vary by: per column, of one value of either level.
struct LevelVariances {
  std::vector<double> direct;  ///< within the strata of a pilot
  std::vector<double> rest;
  std::vector<double>
      between;  ///< of the rest's mean among like pixels, over which it is pooled; empty: it is not
};

/// A pixel twice: as a pilot shows it, by which its numbers of values are chosen, and as another does, by which what they lead to is
/// judged. One alone would choose most values where it happens to be too high, and then find that they help.
struct SurveyedPixel {
  LevelVariances chosen_by, judged_by;
  double share = 0.0;  ///< of the image's pixels that it stands for; 0: each for as many
};

/// How values are shared out among the pixels of an image so that the mean squared error of no column is above its limit and no
/// fewer would do: Neyman's allocation with a multiplier for each column (docs/theory/image_sampling.md). Numbers depend on a pilot
/// of the pixel, whose values come into its estimate with a weight that is the same in all pixels, so that no mean is biased.
class Allocation {
 public:
  /// Variances fall as n^-kExponent with n strata of the first level, 1/n in the second.
  static constexpr double kExponent = 1.25;
  static constexpr int kPilotAcross = 4, kPilotDown = 4, kMostSide = 64;
  static constexpr std::uint32_t kPilotWhole = 6, kLeastWhole = 4;
  /// Where paths are pooled: bright ones are rare, and what a pilot has missed neighbours are not to miss, too.
  static constexpr std::uint32_t kLeastPooled = 12;
  static constexpr PixelPlan pilot() { return {kPilotAcross, kPilotDown, kPilotWhole}; }

  /// `pixels` stand for all of the image. `limit`: of the mean squared error by column, infinite where it does not matter.
  /// `rest_cost`: of a value of the second level, over one of the first. `most`: values a pixel may have.
  Allocation(std::span<const SurveyedPixel> pixels, std::vector<double> limit, double rest_cost,
             std::uint32_t most);

  /// A pixel's variances, columns put together, in the units of this allocation.
  struct Sizes {
    double direct, rest, between;  ///< the last infinite where nothing is pooled
  };
  Sizes sizes(const LevelVariances& pixel) const;
  /// The plan of a pixel of these sizes, beside its pilot.
  PixelPlan plan(const Sizes& sizes) const;
  /// Whether the plan of a pixel is cut by `most`.
  bool is_cut(const Sizes& sizes) const;

  double pilot_direct_weight() const { return pilot_direct_weight_; }
  double pilot_rest_weight() const { return pilot_rest_weight_; }

  /// Variance of the estimate from those of one value of the pilot and of the rest of a pixel, each with its number of values.
  double direct_variance(double of_pilot, double of_main, std::uint32_t count) const;
  double rest_variance(double of_pilot, double of_main, std::uint32_t whole) const;

  /// Mean squared error over the limit, by column, as it was planned for; and values a pixel, the pilot's included.
  const std::vector<double>& planned() const { return planned_; }
  double planned_direct() const { return planned_direct_; }
  double planned_rest() const { return planned_rest_; }

 private:
  struct Numbers {
    double direct, rest;
  };
  Numbers numbers(const Sizes& sizes) const;
  /// The price from which on a pixel gets the least numbers.
  double price_of_least(const Sizes& sizes) const;
  double size(std::span<const double> variance) const;
  /// Mean squared errors that numbers of values leave, pilots included: of variances as of LevelVariances.
  double direct_left(double variance, double direct) const;
  double rest_left(double variance, double between, double rest) const;

  std::vector<double> column_weight_;  // multipliers over limits
  double price_ = 1.0;                 // of a value, as the reduction of error that it must bring
  double rest_cost_;
  std::uint32_t most_;
  double pilot_direct_weight_ = 0.0, pilot_rest_weight_ = 0.0;
  std::vector<double> planned_;
  double planned_direct_ = 0.0, planned_rest_ = 0.0;
};

}  // namespace ifov::sampling
