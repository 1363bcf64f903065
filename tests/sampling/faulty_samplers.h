#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/no_label.h"
#include "sampling/accuracy/parts.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/nearby_spread.h"
#include "sampling/accuracy/radiance/spread.h"

// Accuracy samplers one part of which is planted with a fault: tests show that it would be noticed.

namespace ifov::test {

template <class Parts>
class SamplerOf final : public sampling::AccuracySampler {
 public:
  using AccuracySampler::AccuracySampler;

 private:
  const sampling::AccuracyParts& parts() const override { return parts_; }
  Parts parts_;
};

/// All grids of brackets begin alike, so that their errors agree on aligned scenes.
class Undithered final : public sampling::AccuracyParts {
 public:
  std::unique_ptr<sampling::Dither> dither() const override { return std::make_unique<Fixed>(); }

 private:
  class Fixed final : public sampling::Dither {
    double phase(std::uint64_t) const override { return 0.5; }
  };
};

/// What is known of how values differ is another class's word.
template <class Spread, class Nearby>
class OtherSpread : public sampling::AccuracyParts {
 public:
  std::unique_ptr<sampling::LabelSpread> spread(const sampling::Lattice& lattice,
                                                const sampling::LabelTable& table,
                                                const sampling::LatticeValues& values) const final {
    return std::make_unique<Spread>(lattice, table, values);
  }
  std::unique_ptr<sampling::NearbySpread> nearby(const sampling::Lattice& lattice,
                                                 const sampling::LatticeValues& values,
                                                 const sampling::Prober& prober, const sampling::Field& field,
                                                 const sampling::LabelTable& table,
                                                 const sampling::LabelSpread& spread) const final {
    return std::make_unique<Nearby>(lattice, values, prober, field, table, spread);
  }
};

/// Labels that the lattice has met fewer than four times, or not at all, claim to be exact.
struct CertainOfFew final : sampling::LabelSpread {
  CertainOfFew(const sampling::Lattice& lattice, const sampling::LabelTable& table,
               const sampling::LatticeValues& values)
      : LabelSpread(lattice, table, values) {
    for (std::uint32_t label = 0; label < labels_; ++label)
      if (table.count(label) < 4) constant_[label] = 1;
    for (std::vector<double>* variances : {&local_, &total_, &rare_})
      std::fill_n(&(*variances)[labels_ * columns_], columns_, 0.0);
  }
};
/// Nothing but its own values tells how those of a label differ.
struct NoneNearby final : sampling::NearbySpread {
  using NearbySpread::NearbySpread;
  std::vector<float> deviation(const sampling::SourcePixel&, std::uint32_t) const override { return {}; }
};
using CertainFew = OtherSpread<CertainOfFew, NoneNearby>;

/// What all labels tell of a label of few values is taken for its own.
struct ToldByOthers final : sampling::LabelSpread {
  ToldByOthers(const sampling::Lattice& lattice, const sampling::LabelTable& table,
               const sampling::LatticeValues& values)
      : LabelSpread(lattice, table, values) {
    for (double& blocks : blocks_) blocks = 1e6;
  }
};
/// Few values tell as much as many do.
struct FewTellNearby final : sampling::NearbySpread {
  FewTellNearby(const sampling::Lattice& lattice, const sampling::LatticeValues& values,
                const sampling::Prober& prober, const sampling::Field& field,
                const sampling::LabelTable& table, const sampling::LabelSpread& spread)
      : NearbySpread(lattice, values, prober, field, table, spread), spread_(spread) {}
  std::vector<float> deviation(const sampling::SourcePixel& pixel, std::uint32_t label) const override {
    std::vector<float> deviation;
    if (label == sampling::kNoLabel) return NearbySpread::deviation(pixel, label);
    if (!spread_.constant(label)) of_label(pixel, label, deviation);
    return deviation;
  }

 private:
  const sampling::LabelSpread& spread_;
};
using OtherLabelsTell = OtherSpread<ToldByOthers, FewTellNearby>;

}  // namespace ifov::test
