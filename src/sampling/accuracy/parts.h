#pragma once

#include <cstdint>
#include <memory>

namespace ifov::sampling {

class ControlVariates;
class Dither;
class Field;
class LabelSpread;
class LabelTable;
class Lattice;
class NearbySpread;
class Prober;
class StandoutValues;
class StratumEstimates;
class UnseenValues;
struct LatticeValues;

/// The parts of the accuracy sampler on which its intervals rest, made anew for each tile.
class AccuracyParts {
 public:
  virtual ~AccuracyParts() = default;

  /// Where the grids of brackets begin.
  virtual std::unique_ptr<Dither> dither() const;
  /// How values of a label differ; `table` knows the means over the lattice and nothing else yet.
  virtual std::unique_ptr<LabelSpread> spread(const Lattice& lattice, const LabelTable& table,
                                              const LatticeValues& values) const;
  /// How values near a pixel differ.
  virtual std::unique_ptr<NearbySpread> nearby(const Lattice& lattice, const LatticeValues& values,
                                               const Prober& prober, const Field& field,
                                               const LabelTable& table, const LabelSpread& spread) const;
  /// Means and variances of strata.
  virtual std::unique_ptr<StratumEstimates> estimates(const Lattice& lattice, const LatticeValues& values,
                                                      const LabelTable& table,
                                                      const LabelSpread& spread) const;
  /// What maps foretell of values.
  virtual std::unique_ptr<ControlVariates> controls(Field& field, const Lattice& lattice,
                                                    const LabelTable& table, std::uint64_t seed) const;
  /// What values have not met.
  virtual std::unique_ptr<UnseenValues> unseen(const LabelSpread& spread, const Prober& prober,
                                               const StandoutValues& standouts, const LabelTable& table,
                                               const Field& field) const;
};

}  // namespace ifov::sampling
