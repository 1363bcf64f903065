#pragma once

#include <cstdint>
#include <vector>

namespace ifov::sampling {

class Field;
class LabelSpread;
class LabelTable;
class Lattice;
class Prober;
struct LatticeValues;
struct SourcePixel;

/// How much values differ in a pixel and those around it, by what the lattice has met there: what values of a stratum have
/// not met yet may lie as far from them.
class NearbySpread {
 public:
  NearbySpread(const Lattice& lattice, const LatticeValues& values, const Prober& prober, const Field& field,
               const LabelTable& table, const LabelSpread& spread)
      : lattice_(lattice), values_(values), prober_(prober), field_(field), table_(table), spread_(spread) {}

  virtual ~NearbySpread() = default;

  /// Per column the standard deviation of the lattice's values of the label in the pixel and those around it, of all labels
  /// where few are its own or its values differ by nature; of all labels for kNoLabel, in a cluttered pixel with those
  /// that looks and probes have met. Empty where all values of the label agree.
  virtual std::vector<float> deviation(const SourcePixel& pixel, std::uint32_t label) const;

 protected:
  /// The same, of the label's own values alone. Returns the number of vertices that tell.
  double of_label(const SourcePixel& pixel, std::uint32_t label, std::vector<float>& deviation) const;

 private:
  double widen(const SourcePixel& pixel, std::uint32_t label, std::vector<float>& deviation) const;

  const Lattice& lattice_;
  const LatticeValues& values_;
  const Prober& prober_;
  const Field& field_;
  const LabelTable& table_;
  const LabelSpread& spread_;
};

}  // namespace ifov::sampling
