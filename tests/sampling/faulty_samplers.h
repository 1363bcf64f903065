#pragma once

#include <algorithm>
#include <memory>

#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/lattice_values.h"
#include "sampling/accuracy/parts.h"
#include "sampling/accuracy/spread.h"

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

/// Labels that were met once claim to be exact.
class CertainSingles final : public sampling::AccuracyParts {
 public:
  std::unique_ptr<sampling::LabelSpread> spread(const sampling::Lattice& lattice,
                                                const sampling::LabelTable& table,
                                                const sampling::LatticeValues& values) const override {
    return std::make_unique<Spread>(lattice, table, values);
  }

 private:
  class Spread final : public sampling::LabelSpread {
   public:
    Spread(const sampling::Lattice& lattice, const sampling::LabelTable& table,
           const sampling::LatticeValues& values)
        : LabelSpread(lattice, table, values) {
      for (std::uint32_t label = 0; label < labels_; ++label)
        if (table.count(label) < 2) constant_[label] = 1;
    }
  };
};

/// What is known of all labels is taken to be known of each.
class OtherLabelsTell final : public sampling::AccuracyParts {
 public:
  std::unique_ptr<sampling::LabelSpread> spread(const sampling::Lattice& lattice,
                                                const sampling::LabelTable& table,
                                                const sampling::LatticeValues& values) const override {
    return std::make_unique<Spread>(lattice, table, values);
  }

 private:
  class Spread final : public sampling::LabelSpread {
   public:
    Spread(const sampling::Lattice& lattice, const sampling::LabelTable& table,
           const sampling::LatticeValues& values)
        : LabelSpread(lattice, table, values) {
      for (double& blocks : blocks_) blocks = 1e6;
    }
  };
};

}  // namespace ifov::test
