#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "honesty/plain_reference.h"
#include "honesty/plain_tracer.h"
#include "honesty/sun_photons.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::benchmarks {

/// What a pixel's channels truly are: between `mean` and `mean + above`, give or take the standard error.
struct PlainTruthPixel {
  std::vector<double> mean, error, above;
};

/// The truth of a loaded document's pixels by PlainTracer and SunPhotons; nothing of the sampler's is in it.
class PlainTruth {
 public:
  PlainTruth(const session::Session& session, PlainHints hints);

  std::size_t channels() const { return spectra_.channels(); }

  /// How much the pixels' radiance scatters about its mean (relative, the channel where it is most), from few
  /// paths: where to look.
  std::vector<double> spread(std::uint64_t key) const;

  /// Goes on until every channel's standard error is at most what `wanted(pixel index in `pixels`, means so far)`
  /// says, or a pixel has taken `most_paths`, or all have taken as many photons each as `most_photons` says.
  using Wanted = std::function<std::vector<double>(std::size_t, std::span<const double>)>;
  std::vector<PlainTruthPixel> pixels(std::span<const PixelIndex> pixels, const Wanted& wanted,
                                      double most_paths, double most_photons, std::uint64_t key) const;

 private:
  void add_photons(std::span<const PixelIndex> pixels, const Wanted& wanted, double most_photons,
                   std::uint64_t key, std::vector<PlainTruthPixel>& truth) const;
  void add_point_glints(std::span<const PixelIndex> pixels, std::vector<PlainTruthPixel>& truth) const;

  const session::Session::Parts& parts_;
  PlainHints hints_;
  PlainSpectra spectra_;
  PlainFootprint footprint_;
  PlainTracer tracer_;
  std::unique_ptr<SunPhotons> photons_;  ///< where there are mirrors in the Sun
};

}  // namespace ifov::benchmarks
