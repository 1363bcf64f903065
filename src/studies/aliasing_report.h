#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "io/document/sampling_document.h"
#include "studies/chart_scene.h"
#include "studies/common/figures.h"
#include "studies/common/image_store.h"
#include "studies/common/report_figures.h"

namespace ifov::studies {

/// The charts rendered one way; errors in units of the contrast between black and white.
struct ChartResult {
  std::string name;
  io::SamplingDocument sampling;
  std::unique_ptr<ImageStore> image;  ///< of the first chart
  std::vector<double> error;          ///< of every pixel, chart by chart
  double rms = 0.0, error_99 = 0.0, worst = 0.0;
  double coverage = 0.0;        ///< share of intervals in mixed pixels that hold the truth
  double samples_per_px = 0.0;  ///< halo included
  std::uint32_t fewest_samples = std::numeric_limits<std::uint32_t>::max(), most_samples = 0;
  double seconds = 0.0;  ///< rendering on one thread, the fastest of the repeats, all charts
  ImageStore::Cost cost;
};

struct AliasingResults {
  std::vector<ChartResult> results;    ///< one ray, grid 10 x 10, adaptive, then others
  std::size_t chosen = 0;              ///< accuracy setting that is compared with the grid 10 x 10
  std::vector<double> black_fraction;  ///< exact, of the first chart
  FigureTable figures;
};

std::string aliasing_report(const AliasingResults& results, ReportFigures& figures);

}  // namespace ifov::studies
