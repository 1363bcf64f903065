#include "sampling/accuracy/radiance.h"

#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/edges/edge_tracer.h"

namespace ifov::sampling {

Radiance::Radiance(const EdgeTracer& tracer, const Prober& prober, RayLedger& ledger, const LabelTable& table,
                   const LabelSpread& spread, const LatticeValues& lattice_values, std::uint64_t seed,
                   bool keep_values)
    : nearby_(tracer.lattice(), lattice_values, prober, ledger.field(), table, spread),
      strays_(tracer.model(), tracer.contradictions(), table, ledger.field()),
      pixels_(tracer.pixels(), spread, nearby_),
      rounds_(pixels_.others(), tracer.model(), strays_, table, ledger, keep_values ? &kept_ : nullptr, seed),
      nets_(pixels_.others(), tracer.model(), strays_, table, ledger, seed),
      clutter_(pixels_.others(), tracer.lattice(), ledger, keep_values, seed),
      estimates_(tracer.lattice(), lattice_values, table, spread),
      unseen_(spread, prober, table, ledger.field()),
      memory_(table, keep_values ? &kept_ : nullptr, static_cast<std::size_t>(ledger.field().stride())) {}

void Radiance::trace() {
  nets_.trace();
  clutter_.trace();
  rounds_.trace();
}

}  // namespace ifov::sampling
