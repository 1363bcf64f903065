#include "sampling/accuracy/parts.h"

#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/spread.h"

namespace ifov::sampling {

std::unique_ptr<Dither> AccuracyParts::dither() const { return std::make_unique<Dither>(); }

std::unique_ptr<LabelSpread> AccuracyParts::spread(const Lattice& lattice, const LabelTable& table,
                                                   const LatticeValues& values) const {
  return std::make_unique<LabelSpread>(lattice, table, values);
}

}  // namespace ifov::sampling
