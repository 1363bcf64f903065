#include "sampling/accuracy/parts.h"

#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/radiance/control_variates.h"
#include "sampling/accuracy/radiance/nearby_spread.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/accuracy/radiance/unseen_values.h"

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

std::unique_ptr<StratumEstimates> AccuracyParts::estimates(const Lattice& lattice,
                                                           const LatticeValues& values,
                                                           const LabelTable& table,
                                                           const LabelSpread& spread) const {
  return std::make_unique<StratumEstimates>(lattice, values, table, spread);
}

std::unique_ptr<ControlVariates> AccuracyParts::controls(Field& field, const Lattice& lattice,
                                                         const LabelTable& table, std::uint64_t seed) const {
  return std::make_unique<ControlVariates>(field, lattice, table, seed);
}

std::unique_ptr<UnseenValues> AccuracyParts::unseen(const LabelSpread& spread, const Prober& prober,
                                                    const StandoutValues& standouts, const LabelTable& table,
                                                    const Field& field) const {
  return std::make_unique<UnseenValues>(spread, prober, standouts, table, field);
}

}  // namespace ifov::sampling
