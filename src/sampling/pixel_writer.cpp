#include "sampling/pixel_writer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sampling/pixel_limits.h"

namespace ifov::sampling {

double confidence_of(const TileProblem& problem) {
  return problem.tolerance != nullptr ? problem.tolerance->confidence() : 0.95;
}

namespace {

float half_width(double quantile, double variance) {
  // 0 stays 0 even where the quantile is infinite, and NaN stays NaN.
  return variance == 0.0 ? 0.0f : static_cast<float>(quantile * std::sqrt(variance));
}

}  // namespace

void write_pixel(const PixelEstimate& estimate, const TileProblem& problem, std::size_t pixel,
                 TileResult& result) {
  const std::size_t columns = static_cast<std::size_t>(result.columns);
  for (std::size_t c = 0; c < columns; ++c) {
    const std::size_t at = pixel * columns + c;
    result.mean[at] = static_cast<float>(estimate.mean[c]);
    result.variance_geometry[at] = static_cast<float>(estimate.variance_geometry[c]);
    result.variance_path[at] = static_cast<float>(estimate.variance_path[c]);
    result.half_width[at] =
        half_width(estimate.quantile, estimate.variance_geometry[c] + estimate.variance_path[c]);
  }
  if (problem.tolerance != nullptr) {
    std::vector<double> limits(columns);
    PixelLimits(*problem.tolerance, problem.later).of(pixel, estimate.mean, limits);
    double worst = 0.0;
    for (std::size_t c = 0; c < columns; ++c) {
      if (std::isinf(limits[c])) continue;
      const double width = result.half_width[pixel * columns + c];
      worst =
          std::max(worst, std::isnan(width) ? std::numeric_limits<double>::infinity() : width / limits[c]);
    }
    result.worst_ratio[pixel] = static_cast<float>(worst);
    const Reason above = std::isinf(worst) ? Reason::unjudged
                         : estimate.spent  ? Reason::samples
                                           : Reason::error;
    result.reasons[pixel] = worst <= 1.0 ? 0 : bit(above);
  }
  result.missable_fraction[pixel] = static_cast<float>(
      1.0 - std::pow(0.05, 1.0 / std::max(1.0, static_cast<double>(result.samples[pixel]))));
  for (const auto& [material, share] : estimate.materials)
    result.abundances.push_back(
        {static_cast<std::uint32_t>(pixel), material, static_cast<float>(share.fraction),
         std::isnan(share.variance) ? 1.0f : std::min(1.0f, half_width(estimate.quantile, share.variance))});
}

}  // namespace ifov::sampling
