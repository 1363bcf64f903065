#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sampling/accuracy/basis/tile_memory.h"
#include "sampling/accuracy/detection.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "sampling/accuracy/leaf_integrator.h"
#include "sampling/accuracy/output_sums.h"
#include "sampling/accuracy/probing.h"
#include "sampling/accuracy/radiance.h"
#include "sampling/accuracy/spread.h"
#include "sampling/accuracy/stopping.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// The stages of the accuracy sampler on one tile, in the order of their calls.
class TileWork {
 public:
  TileWork(const TileProblem& problem, Field& field, const AccuracyOptions& options,
           const AccuracyFaults& faults, TileResult& result);

  void trace_lattice();   ///< labels and values at the vertices; limits from the first means
  void switch_clutter();  ///< leaves pixels to stratified samples where that is cheaper
  void trace_borders();   ///< edges, seeds, probes
  void estimate();        ///< radiance in rounds, intervals
  void report();          ///< counts, materials, the detection statement

 private:
  struct Output {
    int look = 0;  ///< those of an earlier run included
    int last_look = Stopping::kLooks;
    bool satisfied = false;
    SmallVector<double, 2> path_budget;  ///< per steering column: variance that paths may leave
  };

  /// A side of the lattice in a pixel, between two labels that look alike; in the order of `key` by chance.
  struct Meeting {
    int pixel;
    std::uint32_t low, high;
    std::uint64_t key;
    Prober::Between side;
  };

  void ask_vertices();
  void merge_twins();
  void look_at_constants();
  void look_around();
  std::vector<Meeting> meetings(const std::vector<std::uint8_t>& worth) const;
  void look_between(const std::vector<std::uint8_t>& worth);
  void take_means();
  void set_limits();
  void take_limits_from_sums();
  double foresight() const;
  double geometry_share(int source) const;
  double relative_weight(int source) const;
  bool constant_at_vertices(int source) const;
  std::vector<FocalPoint> random_points(int source) const;
  void leave_unsettled();
  bool was_looked_at(int source) const;
  void note_looks(const Radiance::Pixel& pixel);
  void tighten_borders();
  void gather(const LeafIntegrator& integrator, std::span<const int> columns, std::span<const int> outputs);
  bool doubtful(const Radiance::Pixel& pixel) const;
  bool plan_round(const LeafIntegrator& integrator, const std::vector<int>& outputs);
  bool steer_by_more(const LeafIntegrator& integrator, const std::vector<int>& outputs);
  static std::uint32_t net_size(const Radiance::Stratum& stratum, double wanted, double room);
  double half_width(const OutputSums::Row& sum, std::size_t column, int look) const;
  void finish(const LeafIntegrator& integrator, const std::vector<int>& outputs);
  void recall_values(std::size_t pixel);
  void remember_values();
  double clutter_to_come(int source, double predicted) const;
  void add_counts_before();
  void keep_memory();
  double first_clutter(const Radiance::Pixel& pixel) const;
  double next_clutter(const Radiance::Pixel& pixel, double wanted) const;
  int nearest_output(int source) const;
  int source_of(int output) const;
  /// The vertex in the corner of a source pixel; rows of them are lattice_.columns() + 1 apart.
  std::size_t first_vertex(int source) const {
    const int width = lattice_.domain().width(), k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
    return static_cast<std::size_t>(source / width * k) * static_cast<std::size_t>(row) +
           static_cast<std::size_t>(source % width * k);
  }

  const TileProblem& problem_;
  const AccuracyOptions& options_;
  TileResult& result_;
  int columns_;
  Stopping stopping_;
  Lattice lattice_;
  LabelTable table_;
  // Of the run before, where there is one; for the next, where it is to be kept.
  std::optional<TileMemory> memory_;
  RayLedger ledger_;
  Contrast contrast_;
  EdgeTracer tracer_;
  Prober prober_;
  LatticeValues lattice_values_;
  std::unique_ptr<LabelSpread> spread_;
  std::unique_ptr<Radiance> radiance_;
  std::vector<int> all_columns_;
  std::vector<int> steering_;  // columns whose intervals decide how many values are drawn
  std::vector<Output> outputs_;
  OutputSums sums_;  // of the last gather()
  KnownDetail known_;
  std::vector<int> not_looked_at_;  // source pixels whose random points are asked when borders are traced
  std::vector<float> predicted_;    // per source pixel: values that clutter would take by the lattice
  std::vector<RandomLooks> looks_;  // per source pixel: values at random points
  AccuracyFaults faults_;
};

}  // namespace ifov::sampling
