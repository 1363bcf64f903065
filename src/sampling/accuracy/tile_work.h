#pragma once

#include <memory>

#include "sampling/accuracy/output_intervals.h"
#include "sampling/accuracy/tile_recall.h"
#include "sampling/accuracy/tile_report.h"
#include "sampling/accuracy/tile_tracing.h"
#include "sampling/footprint_groups.h"

namespace ifov::sampling {

class NearbySpread;
class StratumEstimates;
class UnseenValues;

/// The stages of the accuracy sampler on one tile, in the order of their calls.
class TileWork {
 public:
  TileWork(const TileProblem& problem, Field& field, const AccuracyOptions& options,
           const AccuracyParts& parts, TileResult& result);
  ~TileWork();

  void trace();  ///< borders between labels, as precise as the tile's first limits ask, then each pixel's own
  void estimate();  ///< radiance in rounds, intervals
  void report();    ///< counts, the detection statement

 private:
  void tighten_borders();
  void begin_radiance(int first, int last, const LeafIntegrator& integrator);

  const TileProblem& problem_;
  const AccuracyOptions& options_;
  const AccuracyParts& parts_;
  TileResult& result_;
  int columns_;
  ColumnFootprints footprints_;
  TileRecall recall_;
  TileTracing tracing_;
  int sources_;
  OutputIntervals intervals_;
  TileReport report_;
  std::unique_ptr<NearbySpread> nearby_;
  std::unique_ptr<StratumEstimates> estimates_;
  std::unique_ptr<UnseenValues> unseen_;
  std::unique_ptr<Radiance> radiance_;  // of the group of source pixels at hand
};

}  // namespace ifov::sampling
