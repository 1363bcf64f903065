#pragma once

#include <string>
#include <vector>

#include "io/document/sampling_document.h"
#include "studies/common/image_store.h"
#include "studies/common/study_options.h"
#include "studies/common/study_progress.h"
#include "studies/thermal_scene.h"

namespace ifov::studies {

/// One rendering of 3 x 3 pixels, judged by its centre pixel.
struct ThermalTrial {
  double radiance = 0.0;
  double error_c = 0.0;       ///< by the paper's linear conversion
  double half_width_c = 0.0;  ///< of the stated interval
  bool target_seen = false;   ///< the centre pixel is warmer than the ground, or holds no target
  ImageStore::Cost cost;      ///< over all pixels
};

ThermalTrial render_thermal(const ThermalScene& scene, const io::SamplingDocument& sampling,
                            std::uint64_t seed, const std::filesystem::path& folder,
                            const CancelToken* cancel);

/// What many trials say together.
struct TrialSummary {
  int trials = 0;
  double mean_samples = 0.0;  ///< points queried over the nine pixels and the halo
  double samples_95 = 0.0;    ///< not exceeded in 95 % of trials
  double rms_c = 0.0, error_95_c = 0.0;
  double coverage = 0.0;  ///< share of intervals that hold the truth, to one part in 1e6 of the radiance
  double seen = 0.0;      ///< share of trials in which the target was seen
  ImageStore::Cost mean_cost_total;  ///< summed over trials; divide by `trials`
  std::vector<double> absolute_error_c;

  double within(double tolerance_c) const;  ///< share of trials within a tolerance
};

/// A question asked of a family of scenes.
struct TrialSeries {
  std::string name;
  Family family;
  io::SamplingDocument sampling;
};

TrialSummary run_series(const TrialSeries& series, const TextureMap& texture,
                        const std::filesystem::path& folder, const StudyOptions& options,
                        StudyProgress& progress);

}  // namespace ifov::studies
