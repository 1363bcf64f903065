#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sampling/accuracy/allowed_errors.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/clutter_choice.h"
#include "sampling/accuracy/edges/contrast.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "sampling/accuracy/lattice_values.h"
#include "sampling/accuracy/output_intervals.h"
#include "sampling/accuracy/probing.h"
#include "sampling/accuracy/random_look.h"
#include "sampling/accuracy/source_grid.h"
#include "sampling/accuracy/tile_recall.h"
#include "sampling/accuracy/tile_report.h"

namespace ifov::sampling {

class AccuracyParts;
class Dither;

/// The stages of the accuracy sampler on one tile, in the order of their calls: it holds the parts that do the work.
class TileWork {
 public:
  TileWork(const TileProblem& problem, Field& field, const AccuracyOptions& options,
           const AccuracyParts& parts, TileResult& result);
  ~TileWork();

  void trace_lattice();   ///< labels and values at the vertices; limits from the first means
  void switch_clutter();  ///< leaves pixels to stratified samples where that is cheaper
  void trace_borders();   ///< edges, seeds, probes
  void estimate();        ///< radiance in rounds, intervals
  void report();          ///< counts, materials, the detection statement

 private:
  void look_around();
  void leave_unsettled();
  void tighten_borders();
  bool tighten_pixels();
  void begin_radiance(int first, int last, const LeafIntegrator& integrator);
  std::vector<int> outputs_reached() const;

  const TileProblem& problem_;
  const AccuracyOptions& options_;
  const AccuracyParts& parts_;
  TileResult& result_;
  int columns_;
  Lattice lattice_;
  SourceGrid grid_;
  LabelTable table_;
  TileRecall recall_;
  RayLedger ledger_;
  Contrast contrast_;
  std::unique_ptr<Dither> dither_;
  EdgeTracer tracer_;
  Prober prober_;
  LatticeValues lattice_values_;
  OutputIntervals intervals_;
  AllowedErrors errors_;
  ClutterChoice clutter_;
  RandomLook look_;
  TileReport report_;
  std::unique_ptr<LabelSpread> spread_;
  std::unique_ptr<Radiance> radiance_;  // of the group of source pixels at hand
  KnownDetail known_;
  std::vector<int> not_looked_at_;  // source pixels whose random points are asked when borders are traced
};

}  // namespace ifov::sampling
