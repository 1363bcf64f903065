#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace ifov::sampling {

class AccuracyParts;
class AllowedErrors;
class ClutterChoice;
class ColumnFootprints;
class EdgeTracer;
class ControlVariates;
class Field;
class LabelSpread;
class LabelTable;
class Lattice;
class Prober;
class RandomLook;
class RayLedger;
class SourceGrid;
class StandoutValues;
class SteeringColumns;
class TileRecall;
struct AccuracyOptions;
struct LatticeValues;
struct TileProblem;

/// The first half of the work on a tile: labels and values at the lattice's vertices, the limits that follow from them,
/// and the borders between labels.
class TileTracing {
 public:
  TileTracing(const TileProblem& problem, Field& field, const AccuracyOptions& options,
              const AccuracyParts& parts, const ColumnFootprints& footprints, TileRecall& recall);
  ~TileTracing();

  void trace_lattice();   ///< labels and values at the vertices; limits from the first means
  void switch_clutter();  ///< leaves pixels to stratified samples where that is cheaper
  void trace_borders();   ///< edges, pilot rays, probes

  const Lattice& lattice() const;
  const SourceGrid& grid() const;
  const LabelTable& table() const;
  RayLedger& ledger();
  EdgeTracer& tracer();
  const Prober& prober() const;
  const RandomLook& look() const;
  AllowedErrors& errors();
  const ClutterChoice& clutter() const;
  const SteeringColumns& steering() const;  ///< may grow while borders are traced and tightened
  /// Once the lattice is traced.
  const LatticeValues& lattice_values() const;
  const LabelSpread& spread() const;
  const StandoutValues& standouts() const;
  const ControlVariates& controls() const;

 private:
  void tell_uneven();
  struct Parts;

  std::vector<std::uint8_t> worth_probing() const;
  void probe_around();
  void leave_unsettled();

  const TileProblem& problem_;
  const AccuracyOptions& options_;
  const AccuracyParts& parts_of_method_;
  const ColumnFootprints& footprints_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ifov::sampling
