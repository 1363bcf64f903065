#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling/footprint_groups.h"
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

/// Pixels that are sampled together: pilots, plans, and all the rest; then the second level is pooled over those that are alike.
class ImageBlock {
 public:
  /// `trust` as of LikePixels::Shrinkage. Keeps references to the first three.
  ImageBlock(const TileProblem& problem, const ImagePlan& plan, Field& field, double trust);
  /// By place, until the next call.
  std::span<SampledPixel> sample(std::span<const Place> places);

 private:
  template <class PlanOf>
  void draw(std::uint64_t purpose, PlanOf plan_of, LevelSums& sums);
  std::span<const Label> pilot_labels(std::size_t k) const;
  void choose();
  void pool();
  void estimate(std::size_t k);
  void take_means(std::size_t k);
  void take_materials(std::size_t k, std::size_t first_label);
  void take_rest(std::size_t k);

  const TileProblem& problem_;
  const ImagePlan& plan_;
  Field& field_;
  double trust_;
  std::size_t columns_, stride_;
  ColumnFootprints footprints_;
  StudentTable student_;
  std::span<const Place> places_;
  PixelPoints points_;
  LevelSums pilot_, main_;
  std::vector<PixelPlan> plans_;
  std::vector<std::uint32_t> materials_;
  std::vector<SampledPixel> pixels_;
  std::vector<float> direct_, rest_,
      rest_variance_;  // means, and the variance of the latter, in rows of stride_
};

}  // namespace ifov::sampling
