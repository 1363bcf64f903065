#pragma once

#include <memory>
#include <optional>

#include "io/document/document_values.h"

namespace ifov::io {

class SamplerSettings;

/// Accuracy sampling with all its defaults.
std::shared_ptr<const SamplerSettings> usual_sampler();

struct SamplingDocument {
  std::shared_ptr<const SamplerSettings> method =
      usual_sampler();  ///< of one of sampler_models(); never null
  int tile_px = 64;
  int mirror_reflections = 8;    ///< flat mirrors in turn by way of which sunlight is sought
  std::optional<int> max_depth;  ///< surfaces a path may meet; absent: no limit, ended without bias
  SourcePosition position;
};

}  // namespace ifov::io
