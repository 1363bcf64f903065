#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling/footprint_groups.h"
#include "sampling/image/bright_places.h"
#include "sampling/image/image_plan.h"
#include "sampling/image/levels.h"
#include "sampling/image/spread_places.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/pixel_writer.h"

namespace ifov::sampling {

/// A pixel that ImageSampler has done with.
struct SampledPixel {
  PixelEstimate estimate;
  std::uint32_t samples = 0;
  bool cut = false;  ///< had it been allowed to, it would have taken more
};

/// Pixels that are sampled together: pilots, plans, and all the rest; then the second level is pooled over those that are alike. What of
/// a pixel lies in bright places is sampled apart, each place by a pilot and a plan of its own: units are pixels, and after them these.
class ImageBlock {
 public:
  /// `trust` as of LikePixels::Shrinkage. Keeps references to the first three.
  ImageBlock(const TileProblem& problem, const ImagePlan& plan, Field& field, double trust);
  /// By place, until the next call.
  std::span<SampledPixel> sample(std::span<const Place> places);

 private:
  /// A bright place of a pixel.
  struct PartOfPixel {
    std::size_t pixel, number;
  };
  /// Of a pixel's variance, all columns together, and what that is known by (Satterthwaite 1946).
  struct Spread {
    double size = 0.0, over_freedom = 0.0;
    void add(double of, double freedom) {
      size += of;
      over_freedom += of * of / freedom;
    }
  };
  template <class PlanOf>
  void draw(std::uint64_t purpose, PlanOf plan_of, LevelSums& sums);
  void find_parts();
  std::size_t units() const { return places_.size() + parts_.size(); }
  bool is_part(std::size_t unit) const { return unit >= places_.size(); }
  std::size_t pixel_of(std::size_t unit) const {
    return is_part(unit) ? parts_[unit - places_.size()].pixel : unit;
  }
  /// Share of the pixel's response, by group of columns.
  std::span<const double> shares(std::size_t unit) const;
  double share(std::size_t unit, std::size_t column) const {
    return shares(unit)[footprints_.group_of(column)];
  }
  std::span<const Label> pilot_labels(std::size_t unit) const;
  void choose();
  void pool();
  void estimate(std::size_t k);
  void add_unit(std::size_t unit, bool mixed, PixelEstimate& estimate, Spread& spread) const;
  void take_means(std::size_t unit);
  void take_materials(std::size_t unit, std::size_t first_label);
  void take_rest(std::size_t unit);

  const TileProblem& problem_;
  const ImagePlan& plan_;
  Field& field_;
  double trust_;
  std::size_t columns_, stride_;
  ColumnFootprints footprints_;
  StudentTable student_;
  std::span<const Place> places_;
  std::vector<BrightShares> bright_;  // by pixel
  std::vector<PartOfPixel> parts_;    // pixel by pixel
  PixelPoints points_;
  LevelSums pilot_, main_;
  std::vector<PixelPlan> plans_;          // by unit
  std::vector<std::uint32_t> materials_;  // by pixel
  std::vector<SampledPixel> pixels_;
  std::vector<float> direct_, rest_,
      rest_variance_;  // means, and the variance of the latter, by unit, in rows of stride_
};

}  // namespace ifov::sampling
