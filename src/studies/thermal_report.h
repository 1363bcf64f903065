#pragma once

#include <string>
#include <vector>

#include "studies/clutter_trials.h"
#include "studies/common/figures.h"
#include "studies/common/report_figures.h"
#include "studies/sampling_sweep.h"

namespace ifov::studies {

/// Everything that study 2 found.
struct ThermalResults {
  std::vector<SweepPoint> grid, adaptive, accuracy;
  std::vector<std::pair<TrialSeries, TrialSummary>> series;
  ClutterStudy clutter;
  FigureTable figures;
};

/// The page: the paper's figures 10 and 11 and table 1, the shifts, clutter, and what they mean.
std::string thermal_report(const ThermalResults& results, ReportFigures& figures);

}  // namespace ifov::studies
