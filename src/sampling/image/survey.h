#pragma once

#include <functional>
#include <memory>

#include "sampling/tile.h"

namespace ifov::sampling {

/// What a sampler found of an image as a whole before its first tile; what it is, the sampler knows. Never changed.
class ImageSurvey {
 public:
  virtual ~ImageSurvey() = default;
  /// That it took.
  RayCounts rays;
};

struct SurveyRequest {
  const TileProblem& image;                       ///< its tile is the whole image
  std::function<std::unique_ptr<Field>()> field;  ///< one for each thread, like those of the tiles
  int threads = 0;                                ///< as of parallel_for(); the result does not depend on it
};

}  // namespace ifov::sampling
