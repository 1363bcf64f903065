#include "sampling/accuracy/radiance/radiance.h"

#include "core/call_scope.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "sampling/accuracy/radiance/footprint_weights.h"
#include "sampling/accuracy/radiance/radiance_clutter.h"
#include "sampling/accuracy/radiance/radiance_memory.h"
#include "sampling/accuracy/radiance/radiance_nets.h"
#include "sampling/accuracy/radiance/radiance_rounds.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/radiance/stray_values.h"

namespace ifov::sampling {

/// Each knows those above it that it needs, and none below.
struct Radiance::Parts {
  Parts(const EdgeTracer& tracer, RayLedger& ledger, const LabelTable& table, const Judges& judges,
        std::uint64_t seed, bool keep)
      : strays(tracer.model(), tracer.contradictions(), table, ledger.field()),
        pixels(tracer.pixels(), judges.spread, judges.nearby, tracer.lattice().domain().width()),
        rounds(pixels.others(), tracer.model(), strays, table, ledger, judges.controls,
               keep ? &kept : nullptr, seed),
        nets(pixels.others(), tracer.model(), strays, table, ledger, judges.controls, seed),
        clutter(pixels.others(), tracer.lattice(), ledger, keep, seed),
        memory(table, keep ? &kept : nullptr, static_cast<std::size_t>(ledger.field().stride())) {}

  StrayValues strays;
  SourcePixels pixels;
  KeptValues kept;
  RadianceRounds rounds;
  RadianceNets nets;
  RadianceClutter clutter;
  RadianceMemory memory;
};

Radiance::Radiance(const EdgeTracer& tracer, RayLedger& ledger, const LabelTable& table, const Judges& judges,
                   std::uint64_t seed, bool keep_values)
    : judges_(judges), parts_(std::make_unique<Parts>(tracer, ledger, table, judges, seed, keep_values)) {}

Radiance::~Radiance() = default;

void Radiance::add_pixels(int first, int last, const LeafIntegrator& integrator) {
  parts_->pixels.add(first, last, integrator);
}

bool Radiance::refresh(const LeafIntegrator& integrator) { return parts_->pixels.refresh(integrator); }

std::vector<int> Radiance::outputs_reached(int tile_outputs) const {
  std::vector<std::uint8_t> reached(static_cast<std::size_t>(tile_outputs), 0);
  for (const PlainPixel& pixel : parts_->pixels.plain()) reached[pixel.output] = 1;
  for (const SourcePixel& pixel : parts_->pixels.others())
    for (int o : pixel.model.outputs) reached[o] = 1;
  std::vector<int> outputs;
  for (int o = 0; o < tile_outputs; ++o)
    if (reached[o]) outputs.push_back(o);
  return outputs;
}

SourcePixels& Radiance::pixels() { return parts_->pixels; }
const SourcePixels& Radiance::pixels() const { return parts_->pixels; }
RadianceRounds& Radiance::rounds() { return parts_->rounds; }
RadianceNets& Radiance::nets() { return parts_->nets; }
RadianceClutter& Radiance::clutter() { return parts_->clutter; }
const RadianceMemory& Radiance::memory() const { return parts_->memory; }

void Radiance::trace() {
  parts_->nets.trace();
  parts_->clutter.trace();
  parts_->rounds.trace();
}

void Radiance::weigh(const Stratum& stratum, const PixelFootprint& footprint, Point2 centre,
                     std::span<const int> columns, std::span<const std::size_t> own,
                     const StratumMoments& moments, WeighedMoments& out) const {
  stop_if_cancelled();
  weigh_by_footprint(stratum, parts_->kept, footprint, centre, columns, own, moments, out);
}

}  // namespace ifov::sampling
