#include "sampling/accuracy/parts.h"

#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/radiance/nearby_spread.h"
#include "sampling/accuracy/radiance/spread.h"

namespace ifov::sampling {

std::unique_ptr<Dither> AccuracyParts::dither() const { return std::make_unique<Dither>(); }

std::unique_ptr<LabelSpread> AccuracyParts::spread(const Lattice& lattice, const LabelTable& table,
                                                   const LatticeValues& values) const {
  return std::make_unique<LabelSpread>(lattice, table, values);
}

std::unique_ptr<NearbySpread> AccuracyParts::nearby(const Lattice& lattice, const LatticeValues& values,
                                                    const Prober& prober, const Field& field,
                                                    const LabelTable& table,
                                                    const LabelSpread& spread) const {
  return std::make_unique<NearbySpread>(lattice, values, prober, field, table, spread);
}

}  // namespace ifov::sampling
