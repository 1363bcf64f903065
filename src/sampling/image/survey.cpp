#include "sampling/image/survey.h"

#include "sampling/pixel_sampler.h"

namespace ifov::sampling {

std::unique_ptr<const ImageSurvey> PixelSampler::survey(const SurveyRequest&) const { return nullptr; }

}  // namespace ifov::sampling
