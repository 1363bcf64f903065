#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/parts.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/strata.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/accuracy/radiance/unseen_values.h"

// Accuracy samplers one part of which is planted with a fault: the benchmark has to notice it.

namespace ifov::benchmarks {

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

/// The estimates of strata, but that one value, of the lattice or a path's, claims to be exact.
struct EstimatesOfSingles final : sampling::StratumEstimates {
  EstimatesOfSingles(const sampling::Lattice& lattice, const sampling::LatticeValues& values,
                     const sampling::LabelTable& table, const sampling::LabelSpread& spread)
      : StratumEstimates(lattice, values, table, spread), lattice_(lattice), values_(values) {}

  void moments(const sampling::SourcePixel& pixel, std::size_t s, std::span<const int> columns,
               sampling::StratumMoments& out) const override {
    StratumEstimates::moments(pixel, s, columns, out);
    const sampling::Stratum& stratum = pixel.strata[s];
    if (stratum.nets.size > 0) return;
    double blocks = 0.0;
    for (const sampling::BlockSums& round : stratum.rounds) blocks += round.blocks();
    if (out.sampled ? blocks == 0.0 : vertices(pixel, stratum.label) < 2)
      std::fill(out.variance.begin(), out.variance.end(), 0.0);
  }
  double told(const sampling::Stratum&) const override { return 1.0; }

 private:
  int vertices(const sampling::SourcePixel& pixel, std::uint32_t label) const {
    const int k = lattice_.cells_per_pixel();
    int count = 0;
    for (int j = 0; j <= k; ++j)
      for (int i = 0; i <= k; ++i)
        count += values_.labels[lattice_.first_vertex(pixel.source) +
                                static_cast<std::size_t>(j * (lattice_.columns() + 1) + i)] == label;
    return count;
  }

  const sampling::Lattice& lattice_;
  const sampling::LatticeValues& values_;
};
struct NothingUnseenBySingles final : sampling::UnseenValues {
  using UnseenValues::UnseenValues;
  double variance(const sampling::SourcePixel& pixel, std::size_t s, int column) const override {
    if (!pixel.cluttered && pixel.strata[s].count() < 2) return 0.0;
    return UnseenValues::variance(pixel, s, column);
  }
};
class CertainSingles final : public sampling::AccuracyParts {
 public:
  std::unique_ptr<sampling::StratumEstimates> estimates(const sampling::Lattice& lattice,
                                                        const sampling::LatticeValues& values,
                                                        const sampling::LabelTable& table,
                                                        const sampling::LabelSpread& spread) const override {
    return std::make_unique<EstimatesOfSingles>(lattice, values, table, spread);
  }
  std::unique_ptr<sampling::UnseenValues> unseen(const sampling::LabelSpread& spread,
                                                 const sampling::Prober& prober,
                                                 const sampling::StandoutValues& standouts,
                                                 const sampling::LabelTable& table,
                                                 const sampling::Field& field) const override {
    return std::make_unique<NothingUnseenBySingles>(spread, prober, standouts, table, field);
  }
};

}  // namespace ifov::benchmarks
