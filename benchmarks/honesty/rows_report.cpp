#include "honesty/rows_report.h"

#include <cstdio>

#include "core/format.h"

namespace ifov::benchmarks {

std::vector<FigureRow> report_rows_study(const RowsStudy& study) {
  constexpr double kMostOutside = 0.07, kWorstZ = 8.0;
  std::vector<FigureRow> rows;
  for (const RowsOutcome& outcome : run_rows_study(study)) {
    const std::string form = name_of(outcome.form);
    std::printf(
        "    rows as %-6s %lld pixels, %.1f rays a pixel; off by more than their half-width %.2f %%; converged %.2f %%, of "
        "them off by more than their half-width %.2f %%, by more than 5 half-widths %.3f %%, worst z %.3g; scenes with "
        "coverage below 0.9: %d of %d\n",
        form.c_str(), static_cast<long long>(outcome.pixels), outcome.rays, 100.0 * outcome.outside,
        100.0 * outcome.converged, 100.0 * outcome.outside_converged, 100.0 * outcome.lies, outcome.worst_z,
        outcome.poor_scenes, study.steps);
    for (const RowsOutcome::Scene& scene : outcome.worst)
      std::printf("      %5.1f %% off, worst z %-8.3g %s: %s\n", 100.0 * scene.outside, scene.worst_z,
                  scene.document.c_str(), scene.description.c_str());
    std::fflush(stdout);
    rows.push_back({"rows_" + form + "_outside", json_number(outcome.outside), "share", "<= 0.07",
                    outcome.outside <= kMostOutside});
    rows.push_back({"rows_" + form + "_worst_z", json_number(outcome.worst_z), "sigma", "< 8",
                    outcome.worst_z < kWorstZ});
    rows.push_back({"rows_" + form + "_converged", json_number(outcome.converged), "share", ">= 0.95",
                    outcome.converged >= 0.95});
  }
  return rows;
}

}  // namespace ifov::benchmarks
