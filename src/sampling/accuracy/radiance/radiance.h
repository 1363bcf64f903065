#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sampling/random.h"

namespace ifov::sampling {

class ControlVariates;
class EdgeTracer;
class LabelSpread;
class LabelTable;
class LeafIntegrator;
class NearbySpread;
class PixelFootprint;
class RadianceClutter;
class RadianceMemory;
class RadianceNets;
class RadianceRounds;
class RayLedger;
class SourcePixels;
class StratumEstimates;
class UnseenValues;
struct Stratum;
struct StratumMoments;
struct WeighedMoments;

/// The radiance within labels: values at stratified points, uniform inside each (pixel, label) stratum of a
/// group of source pixels, in rounds. It holds the parts that plan, trace, keep and weigh them.
/// docs/theory/accuracy_sampler.md, section 6.
class Radiance {
 public:
  /// Judges of values, each for the whole tile.
  struct Judges {
    const LabelSpread& spread;
    const NearbySpread& nearby;
    StratumEstimates& estimates;
    const UnseenValues& unseen;
    const ControlVariates& controls;
  };
  /// `keep_values`: for a footprint that weighs the values of a pixel unlike.
  Radiance(const EdgeTracer& tracer, RayLedger& ledger, const LabelTable& table, const Judges& judges,
           std::uint64_t seed, bool keep_values);
  ~Radiance();

  /// Source pixels [first, last).
  void add_pixels(int first, int last, const LeafIntegrator& integrator);
  /// Before any value is planned: follows what tracing has changed. False where pixels must be added anew.
  bool refresh(const LeafIntegrator& integrator);
  /// In order, those of a tile's outputs in which the pixels weigh.
  std::vector<int> outputs_reached(int tile_outputs) const;
  SourcePixels& pixels();
  const SourcePixels& pixels() const;

  RadianceRounds& rounds();
  RadianceNets& nets();
  RadianceClutter& clutter();
  /// Traces what was planned in all three.
  void trace();

  const StratumEstimates& estimates() const { return judges_.estimates; }
  StratumEstimates& estimates() { return judges_.estimates; }
  const UnseenValues& unseen() const { return judges_.unseen; }
  /// Moments of a stratum as the footprint weighs its values, in the columns at these positions (weigh_by_footprint).
  void weigh(const Stratum& stratum, const PixelFootprint& footprint, Point2 centre,
             std::span<const int> columns, std::span<const std::size_t> own, const StratumMoments& moments,
             WeighedMoments& out) const;
  const RadianceMemory& memory() const;

 private:
  struct Parts;
  Judges judges_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ifov::sampling
