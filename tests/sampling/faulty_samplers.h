#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/no_label.h"
#include "sampling/accuracy/parts.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/nearby_spread.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/radiance/strata.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/accuracy/radiance/unseen_values.h"

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

/// All as it is but what values have not met.
template <class Unseen>
class PartsOfUnseen : public sampling::AccuracyParts {
 public:
  std::unique_ptr<sampling::UnseenValues> unseen(const sampling::LabelSpread& spread,
                                                 const sampling::Prober& prober,
                                                 const sampling::StandoutValues& standouts,
                                                 const sampling::LabelTable& table,
                                                 const sampling::Field& field) const override {
    return std::make_unique<Unseen>(spread, prober, standouts, table, field);
  }
};

/// What values of the pixels around have met is not looked at. It shows many a fault of a pixel's own, and is left out where one is planted.
struct EachPixelAlone : sampling::UnseenValues {
  using UnseenValues::UnseenValues;
  double rare_beside(const sampling::SourcePixel&, const sampling::Stratum&, int, double) const override {
    return 0.0;
  }
};
using NothingBesideTells = PartsOfUnseen<EachPixelAlone>;

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

/// Labels that are narrower than the lattice's spacing are taken to be told of by what vertices happen to lie in them.
struct ThinLabelsTold final : sampling::StratumEstimates {
  using StratumEstimates::StratumEstimates;
  double told(const sampling::Stratum&) const override { return 1.0; }
};
class FewVerticesTell final : public sampling::AccuracyParts {
 public:
  std::unique_ptr<sampling::StratumEstimates> estimates(const sampling::Lattice& lattice,
                                                        const sampling::LatticeValues& values,
                                                        const sampling::LabelTable& table,
                                                        const sampling::LabelSpread& spread) const override {
    return std::make_unique<ThinLabelsTold>(lattice, values, table, spread);
  }
};

/// Values that stand in no block are not looked at.
struct AloneUntold final : sampling::StratumEstimates {
  using StratumEstimates::StratumEstimates;
  bool alone_tell() const override { return false; }
};

/// What values of a penumbra may be is taken to be their mean.
struct MeansAreFarthest final : EachPixelAlone {
  using EachPixelAlone::EachPixelAlone;
  double farthest_of(std::uint32_t label, int column, double mean) const override {
    return (mean_of(label, column) - mean) * (mean_of(label, column) - mean);
  }
};
using PenumbraeAreMeans = PartsOfUnseen<MeansAreFarthest>;

/// What rays and strays have met in a cluttered pixel is forgotten where no value has met it.
struct NothingKnownFarther final : EachPixelAlone {
  using EachPixelAlone::EachPixelAlone;
  double known_farther(const sampling::SourcePixel&, int) const override { return 0.0; }
};
using Forgetful = PartsOfUnseen<NothingKnownFarther>;

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
class OtherLabelsTell final : public NothingBesideTells {
 public:
  std::unique_ptr<sampling::StratumEstimates> estimates(const sampling::Lattice& lattice,
                                                        const sampling::LatticeValues& values,
                                                        const sampling::LabelTable& table,
                                                        const sampling::LabelSpread& spread) const override {
    return std::make_unique<AloneUntold>(lattice, values, table, spread);
  }
  std::unique_ptr<sampling::LabelSpread> spread(const sampling::Lattice& lattice,
                                                const sampling::LabelTable& table,
                                                const sampling::LatticeValues& values) const override {
    return std::make_unique<ToldByOthers>(lattice, table, values);
  }
  std::unique_ptr<sampling::NearbySpread> nearby(const sampling::Lattice& lattice,
                                                 const sampling::LatticeValues& values,
                                                 const sampling::Prober& prober, const sampling::Field& field,
                                                 const sampling::LabelTable& table,
                                                 const sampling::LabelSpread& spread) const override {
    return std::make_unique<FewTellNearby>(lattice, values, prober, field, table, spread);
  }
};

}  // namespace ifov::test
