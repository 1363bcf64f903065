#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "sampling/image/allocation.h"
#include "sampling/image/rest_model.h"
#include "sampling/image/survey.h"

namespace ifov::sampling {

/// What ImageSampler finds of an image before its first tile: from the pilots of pixels that lie all over it, the limits of its
/// columns' errors, how values are shared out, and how much pixels of a kind vary. The pixels of the tiles draw pilots of their own,
/// so that nothing here knows the numbers that enter them.
class ImagePlan final : public ImageSurvey {
 public:
  /// Pixels that are looked at: an eighth of the image, within these.
  static constexpr int kLeastPixels = 256, kMostPixels = 2048;

  /// Needs the tolerance of the request's problem. Throws Cancelled.
  static std::unique_ptr<const ImagePlan> find(const SurveyRequest& request, std::uint32_t most_samples,
                                               bool pooling);

  const Allocation& allocation() const { return *allocation_; }
  /// Of the root mean square error by column; infinite where a column is not judged.
  const std::vector<double>& limits() const { return limits_; }
  /// Field::leader() by column.
  const std::vector<std::size_t>& leaders() const { return leaders_; }

  /// How much pixels vary that show mostly one material: what is known of a pixel before a value of its own. By column.
  struct Kind {
    LevelVariances mean;
    double pixels = 0.0;
  };
  const Kind& kind(std::uint32_t material) const;

  /// What variances that samples tell of themselves have to be multiplied by, of pixels of one material and of others: from pilots that
  /// were drawn twice, whose means differ by what is true. Where borders run, fours tell too much; nets tell too much of the second
  /// level. With the first level's goes what the two have in common.
  double direct_factor(bool mixed, std::size_t column) const { return direct_factor_[mixed ? 1 : 0][column]; }
  double rest_factor(std::size_t column) const { return rest_factor_[column]; }

  /// The same of what pixels have of bright places, its shares of their responses included; of nothing where there are none.
  const Kind& bright() const { return bright_; }
  double bright_direct_factor(std::size_t column) const { return bright_direct_factor_[column]; }
  void moderate_bright_pilot(LevelVariances& own) const;

  /// What the second level is where it is pooled; null where it is not.
  const RestModel* rest_model() const { return rest_model_.get(); }

  /// A pilot's variances, factors included, put together with those of its pixel's kind.
  void moderate_pilot(LevelVariances& own, std::uint32_t material) const;

  /// Values of its own that those of its kind count for when a pixel's variance is told: few in the first level, because edges are
  /// where they are; more in the second, which is alike in a kind.
  static constexpr double kDirectPrior = 4.0, kRestPrior = 7.0;
  /// Share of what a pixel differs by from the survey's model that it also differs by from its neighbours.
  static constexpr double kNearShare = 1.0;
  /// Degrees of freedom of own and kind put together.
  static double moderated(double own, double freedom, double of_kind, double prior) {
    return (freedom * own + prior * of_kind) / (freedom + prior);
  }

 private:
  ImagePlan() = default;
  std::vector<double> limits_;
  std::vector<std::size_t> leaders_;
  std::unique_ptr<const Allocation> allocation_;
  std::array<std::vector<double>, 2> direct_factor_;
  std::vector<double> rest_factor_;
  std::unique_ptr<const RestModel> rest_model_;
  std::map<std::uint32_t, Kind> kinds_;
  Kind all_, bright_;
  std::vector<double> bright_direct_factor_;
};

/// Whether labels show more than one material.
bool shows_several(const Field& field, std::span<const Label> labels);

/// The material that most labels of a pixel show; the least number of those that are as frequent.
std::uint32_t main_material(const Field& field, std::span<const Label> labels);

}  // namespace ifov::sampling
