#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/footprint_weights.h"
#include "sampling/accuracy/nearby_spread.h"
#include "sampling/accuracy/radiance_clutter.h"
#include "sampling/accuracy/radiance_memory.h"
#include "sampling/accuracy/radiance_nets.h"
#include "sampling/accuracy/radiance_rounds.h"
#include "sampling/accuracy/source_pixels.h"
#include "sampling/accuracy/stratum_moments.h"
#include "sampling/accuracy/stray_values.h"
#include "sampling/accuracy/unseen_values.h"

namespace ifov::sampling {

class EdgeTracer;

/// The radiance within labels: values at stratified points, uniform inside each (pixel, label) stratum of a
/// group of source pixels, in rounds. docs/theory/accuracy_sampler.md, section 6.
class Radiance {
 public:
  /// `keep_values`: for a footprint that weighs the values of a pixel unlike.
  Radiance(const EdgeTracer& tracer, const Prober& prober, RayLedger& ledger, const LabelTable& table,
           const LabelSpread& spread, const LatticeValues& lattice_values, std::uint64_t seed,
           bool keep_values);

  SourcePixels& pixels() { return pixels_; }
  const SourcePixels& pixels() const { return pixels_; }

  RadianceRounds& rounds() { return rounds_; }
  RadianceNets& nets() { return nets_; }
  RadianceClutter& clutter() { return clutter_; }
  /// Traces what was planned in all three.
  void trace();

  const StratumEstimates& estimates() const { return estimates_; }
  const UnseenValues& unseen() const { return unseen_; }
  /// Moments of a stratum as the footprint weighs its values (weigh_by_footprint).
  void weigh(const Stratum& stratum, const PixelFootprint& footprint, Point2 centre,
             std::span<const int> columns, const StratumMoments& moments, WeighedMoments& out) const {
    weigh_by_footprint(stratum, kept_, footprint, centre, columns, moments, out);
  }
  const RadianceMemory& memory() const { return memory_; }

 private:
  NearbySpread nearby_;
  StrayValues strays_;
  SourcePixels pixels_;
  KeptValues kept_;
  RadianceRounds rounds_;
  RadianceNets nets_;
  RadianceClutter clutter_;
  StratumEstimates estimates_;
  UnseenValues unseen_;
  RadianceMemory memory_;
};

}  // namespace ifov::sampling
