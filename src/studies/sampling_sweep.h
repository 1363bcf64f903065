#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/common/study_options.h"
#include "studies/common/study_progress.h"
#include "studies/thermal_trials.h"

namespace ifov::studies {

/// The paper's dome under one sampling after another.
struct SweepPoint {
  double setting = 0.0;  ///< sub-elements N per side, or the error asked for in degrees
  ThermalTrial trial;
};

/// N = 2, 4, … `largest`: N x N rays, or the paper's N/2 x N/2 sub-elements with at most N^2 samples.
std::vector<SweepPoint> grid_sweep(int largest, const std::filesystem::path& folder,
                                   const StudyOptions& options, StudyProgress& progress);
std::vector<SweepPoint> adaptive_sweep(int largest, const std::filesystem::path& folder,
                                       const StudyOptions& options, StudyProgress& progress);
/// Accuracy sampling for each error.
std::vector<SweepPoint> accuracy_sweep(const std::vector<double>& errors_c,
                                       const std::filesystem::path& folder, const StudyOptions& options,
                                       StudyProgress& progress);

/// Samples of the first point from which no later one errs by more than the tolerance; NaN where the last
/// still does.
double samples_that_stay_within(const std::vector<SweepPoint>& sweep, double tolerance_c);

/// The paper's adaptive sampling at N: a difference of any kind between black surfaces counts.
io::SamplingDocument paper_adaptive(int n);

}  // namespace ifov::studies
