#pragma once

#include <array>
#include <vector>

#include "sampling/image/survey.h"
#include "sampling/tolerance.h"

namespace ifov::sampling {

class PixelSampler;
/// A pixel as a sampler has it, and as it was measured beside that.
struct AuditedPixel {
  double weight = 1.0;                        ///< pixels of the image that it stands for, up to a factor
  bool mixed = false;                         ///< more than one material
  std::vector<double> value, variance;        ///< by column, as the sampler says
  std::array<std::vector<double>, 2> half{};  ///< independent means of many values
};

/// Looks at three times as many pixels as are wanted, all over the image, and measures of these about as many as are wanted, half
/// of them chosen by their variance. Adds to `rays`. Throws Cancelled.
std::vector<AuditedPixel> audited_pixels(const PixelSampler& sampler, const ImageSurvey* survey,
                                         const SurveyRequest& request, int wanted, RayCounts& rays);

/// How far a pixel is off, in standard deviations, and what it weighs.
struct ConformalScore {
  double score, weight;
};
/// The least score that a further pixel stays below with this probability, whatever scores are like: by weights, of which that pixel
/// has the mean. The largest where there are too few. Sorts.
double conformal_quantile(std::vector<ConformalScore>& scores, double confidence);

}  // namespace ifov::sampling
