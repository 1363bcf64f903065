#include <algorithm>
#include <cmath>
#include <map>

#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/output_intervals.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/radiance_rounds.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/accuracy/round_planner.h"
#include "sampling/footprint_groups.h"

namespace ifov::sampling {

namespace {

/// What the lattice tells too little of has so many values of its own at most before it may say that it is sure.
constexpr double kMostUntold = 12.0;
/// Grids on which those of a sliver are sought.
constexpr std::uint32_t kSought = 3;
/// A label of which nothing is known but a value or two is looked at where it would matter so many limits were it wrong by all that it is.
constexpr double kLooked = 0.15;
}  // namespace

/// Calls visit(pixel, stratum, what it and its output differ by at most in limits, the same of all that either is) for the strata of
/// traced pixels whose label the lattice tells too little of; of the sums of the steering columns.
template <class Visit>
void RoundPlanner::visit_untold(const Radiance& radiance, const Visit& visit) {
  StratumMoments moments;
  for (std::size_t p = 0; p < radiance.pixels().others().size(); ++p) {
    const SourcePixel& pixel = radiance.pixels().others()[p];
    const PixelModel& model = pixel.model;
    if (pixel.cluttered || ledger_.spent(pixel.source) >= options_.max_samples_per_pixel) continue;
    for (std::size_t s = 0; s < pixel.strata.size(); ++s) {
      const Stratum& stratum = pixel.strata[s];
      if (stratum.nets.size > 0) continue;
      const double untold = 1.0 - radiance.estimates().told(stratum);
      if (untold <= 0.0) continue;
      radiance.estimates().moments(pixel, s, steering_, moments);
      const Told* told = told_.contains(stratum.label) ? &told_[stratum.label] : nullptr;
      double apart = 0.0, whole = 0.0;
      for (std::size_t o = 0; o < model.outputs.size(); ++o) {
        const int output = model.outputs[o];
        if (outputs_[output].test >= outputs_[output].last_test) continue;
        const OutputSums::Row sum = limits_of(output);
        for (std::size_t d = 0; d < steering_.size(); ++d) {
          const std::size_t group = intervals_.footprints().group_of(static_cast<std::size_t>(steering_[d]));
          const double share = untold * model.weight_of(s, o, group) / limit_[steering_[d]];
          const double own = moments.mean[d], all = sum.mean[d];
          double most = std::max(std::abs(own - all), std::sqrt(moments.variance[d]));
          if (told != nullptr && d < told->mean.size())
            most = std::max({most, told->deviation[d], std::abs(told->mean[d] - own)});
          apart = std::max(apart, share * most);
          whole = std::max(whole, share * std::max(std::abs(own), std::abs(all)));
        }
      }
      visit(p, s, apart, whole);
    }
  }
}

/// Neither do strata whose label is nowhere wide enough for the lattice to tell how its values differ: the few vertices in line with
/// a wire, a slit or the shadow of one agree, wrong as they may be, and of what lies between vertices one value is known. One
/// stratum of each such label, in which it weighs most, tells of it for all, if it would matter were it wrong by all that it is;
/// others take values where they would matter were they wrong by what they differ from their pixel, or among themselves.
bool RoundPlanner::begin_untold(Radiance& radiance) {
  bool any = false;
  const auto plan = [&](std::size_t p, std::size_t s, double count) {
    const SourcePixel& pixel = radiance.pixels().others()[p];
    if (pixel.strata[s].count() > 0 || pixel.strata[s].round >= kSought) return;
    radiance.rounds().plan(p, s, std::clamp(count, kFewest, kMostUntold));
    for (int o : pixel.model.outputs) outputs_[o].test = std::max(outputs_[o].test, 1);
    any = true;
  };
  struct Scout {
    std::size_t pixel, stratum;
    double weight;
  };
  std::map<std::uint32_t, Scout> scouts;
  visit_untold(radiance, [&](std::size_t p, std::size_t s, double, double whole) {
    const std::uint32_t label = radiance.pixels().others()[p].strata[s].label;
    if (whole <= kLooked || told_.contains(label)) return;
    const auto [at, fresh] = scouts.try_emplace(label, Scout{p, s, whole});
    if (!fresh && whole > at->second.weight) at->second = {p, s, whole};
  });
  for (const auto& [label, scout] : scouts) plan(scout.pixel, scout.stratum, kMostUntold);
  if (any) return true;
  StratumMoments moments;
  for (const auto& [label, scout] : scouts) {
    const SourcePixel& pixel = radiance.pixels().others()[scout.pixel];
    const StratumEstimates& estimates = radiance.estimates();
    estimates.moments(pixel, scout.stratum, all_columns_, moments);
    // Where no point of three grids comes to lie in it, its one value is all that is known.
    if (!moments.sampled) std::fill(moments.variance.begin(), moments.variance.end(), 0.0);
    radiance.estimates().learn(label, moments.variance);
    estimates.moments(pixel, scout.stratum, steering_, moments);
    for (double& variance : moments.variance) variance = std::sqrt(variance);
    told_[label] = {moments.mean, moments.variance};
  }
  visit_untold(radiance, [&](std::size_t p, std::size_t s, double apart, double) {
    if (apart > 1.0) plan(p, s, apart);
  });
  return any;
}

}  // namespace ifov::sampling
