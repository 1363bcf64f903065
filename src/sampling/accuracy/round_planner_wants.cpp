#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/output_intervals.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/radiance_clutter.h"
#include "sampling/accuracy/radiance/radiance_nets.h"
#include "sampling/accuracy/radiance/radiance_rounds.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/accuracy/radiance/unseen_values.h"
#include "sampling/accuracy/round_planner.h"
#include "sampling/accuracy/weights/leaf_integrator.h"
#include "sampling/footprint_groups.h"

namespace ifov::sampling {

namespace {

/// Planned rounds aim at the limit, and so far beyond it where few degrees of freedom tell the variance, and where it is hoped to go
/// on falling as it did.
constexpr double kUnsureMargin = 1.2, kHopedMargin = 1.08;
/// A round holds at least this part of the values that there are: tests are counted.
constexpr double kLeastRound = 0.1;
/// Variances fall as values' number to minus this where their sequences are seen to gain so much.
constexpr double kSequenceFall = 2.0;
/// Of what a stratum's outputs want each as if it were alone, so much at least, and so much more than there is.
constexpr double kLeastShare = 0.3, kMostShare = 2.0, kLeastGrowth = 1.2;
/// What wants so much of what it has is not far from wanting more.
constexpr double kNearly = 0.8;
/// What sequences of paths gain, before their replicates have told.
constexpr double kHoped = 0.55;
/// After a pilot, a stratum grows at most this many times, until two rounds have told how its variance falls.
constexpr double kFirstGrowth = 14.0;
/// Later rounds grow at most this many times: the finer the grid, the faster texture gets exact.
constexpr double kGrowth = 3.0;
/// From here on replicated nets cost less than jittered values: early where paths make the variance and not
/// texture.
constexpr double kManyPaths = 320.0, kManyValues = 16384.0;
/// What rounds of n values in clutter are planned by: their variance falls as n to minus this, between borders (3/2)
/// and paths (1). A round holds at most this many times the values of those before it.
constexpr double kClutterFall = 1.35, kClutterGrowth = 6.0;
/// Where clutter has so many values and more than a little is wanted, rounds go a part of the way, so often: what they were planned by may be
/// too much, and what was drawn cannot be taken back. Few values may not have met what is rare, and each look at them is a chance to end
/// without it.
constexpr double kManyInClutter = 100.0, kFar = 1.3, kPartWay = 0.75, kLeastOfFew = 0.3;
constexpr std::size_t kPartWays = 3;

/// By group of columns; valid until the next call.
class Weights {
 public:
  Weights(const LeafIntegrator& integrator, const ColumnFootprints& footprints, std::span<const int> steering)
      : integrator_(integrator), weights_(footprints.groups()) {
    for (const int column : steering)
      groups_.push_back(footprints.group_of(static_cast<std::size_t>(column)));
  }
  /// False where all are 0.
  bool take(const SourcePixel& pixel, std::size_t stratum, std::size_t output) {
    for (std::size_t g = 0; g < weights_.size(); ++g)
      weights_[g] = pixel.cluttered ? integrator_.whole_weight(pixel.source, pixel.model.outputs[output], g)
                                    : pixel.model.weight_of(stratum, output, g);
    return std::any_of(weights_.begin(), weights_.end(), [](double w) { return w != 0.0; });
  }
  /// Of a steering column, by its position.
  double operator[](std::size_t d) const { return weights_[groups_[d]]; }

 private:
  const LeafIntegrator& integrator_;
  std::vector<double> weights_;
  std::vector<std::size_t> groups_;
};

/// Whether values differ more than what they have not met makes of it, in all columns.
bool mostly_met(std::span<const double> own, std::span<const double> unmet) {
  return std::equal(own.begin(), own.end(), unmet.begin(), [](double o, double u) { return u <= o; });
}

}  // namespace

/// Nets grow by doubling, at most fourfold between tests: their error falls faster than that of independent
/// values, by which `wanted` is reckoned.
std::uint32_t RoundPlanner::net_size(const Stratum& stratum, double wanted, double room) {
  constexpr double kGain = 8.0;  // about what nets save
  constexpr double kFirst =
      64.0;  // few values may have met something rare that says too much of the variance
  const double most =
      std::max(4.0, (room + static_cast<double>(stratum.count())) / RadianceNets::kReplicates);
  std::uint32_t size = std::max(4u, stratum.nets.size);
  // Of a net's values those outside the stratum do not count.
  const double target = stratum.nets.size == 0
                            ? std::min(kFirst, wanted / kGain / RadianceNets::kReplicates)
                            : size * std::min(4.0, wanted / static_cast<double>(stratum.count()));
  while (size < target && 2.0 * size <= most) size *= 2;
  return size;
}

/// Values of the next round where `wanted` independent ones would do; 0 where there are enough.
double RoundPlanner::next_clutter(const SourcePixel& pixel, double wanted) {
  const double have = pixel.clutter_count();
  if (wanted <= have) return 0.0;
  double growth = wanted / have;
  const bool many = have >= kManyInClutter;
  if (many && growth > kFar && pixel.rounds.size() <= kPartWays) growth = std::max(1.0, kPartWay * growth);
  const double next = have * std::pow(growth - 1.0, 1.0 / kClutterFall);
  return std::clamp(next, (many ? kLeastRound : kLeastOfFew) * have, kClutterGrowth * have);
}

bool RoundPlanner::is_open(int output) const {
  return !outputs_[output].satisfied && outputs_[output].test < outputs_[output].last_test;
}

/// Values by Neyman's allocation, for each output as if it were alone, of all strata in its pixels.
void RoundPlanner::find_wants(const Radiance& radiance, const LeafIntegrator& integrator) {
  const std::size_t n = steering_.size();
  wants_.clear();
  own_.clear();
  unmet_.clear();
  StratumMoments moments;
  std::vector<ClutterRound::Moment> clutter;
  Weights weights(integrator, intervals_.footprints(), steering_);
  for (std::size_t p = 0; p < radiance.pixels().others().size(); ++p) {
    const SourcePixel& pixel = radiance.pixels().others()[p];
    const PixelModel& model = pixel.model;
    if (std::none_of(model.outputs.begin(), model.outputs.end(), [&](int o) { return is_open(o); })) continue;
    const std::size_t strata = pixel.cluttered ? 1 : model.labels.size();
    for (std::size_t s = 0; s < strata; ++s) {
      if (!pixel.cluttered)
        radiance.estimates().moments(pixel, s, steering_, moments);
      else
        RadianceClutter::moments(pixel, nullptr, {}, steering_, clutter);
      Want want{p, s, pixel.cluttered ? pixel.clutter_count() : static_cast<double>(pixel.strata[s].count())};
      want.hope = !integrator.unit_box() && !pixel.cluttered && pixel.strata[s].rounds.size() == 1;
      want.paths_differ =
          !pixel.cluttered && StratumEstimates::paths_differ(pixel.strata[s], steering_, moments);
      for (std::size_t d = 0; d < n; ++d) {
        const double unseen = radiance.unseen().variance(pixel, s, steering_[d]);
        own_.push_back(pixel.cluttered ? clutter[d].variance * want.have : moments.variance[d]);
        unmet_.push_back(unseen * (pixel.cluttered ? want.have : std::max(1.0, want.have)));
      }
      const double *own = &own_[wants_.size() * n], *unmet = &unmet_[wants_.size() * n];
      for (std::size_t o = 0; o < model.outputs.size(); ++o) {
        if (!is_open(model.outputs[o])) continue;
        const OutputState& output = outputs_[model.outputs[o]];
        const OutputSums::Row sum = intervals_.sum(model.outputs[o]);
        weights.take(pixel, s, o);
        for (std::size_t d = 0; d < n; ++d) {
          const double g = output.growth[d], a = sum.deviation[d], b = sum.deviation_unmet[d];
          const double all = std::sqrt(a * a + (b * b - a * a) / g);
          const double alone =
              sum.gain[d] * weights[d] * std::sqrt(own[d] + unmet[d] / g) * all / output.path_budget[d];
          if (alone <= want.wanted) continue;
          want.wanted = alone;
          want.freedom = sum.path[d].degrees_of_freedom();
          want.gain = sum.gain[d];
        }
      }
      wants_.push_back(want);
    }
  }
}

/// What others want for themselves is an output's too: each stratum has only as many values as one of its outputs still needs.
void RoundPlanner::ease_wants(const Radiance& radiance, const LeafIntegrator& integrator) {
  const std::size_t n = steering_.size();
  // Variances of outputs by these weights, as values are and as they would be: of their ratio, as `path` knows the former better.
  now_.assign(outputs_.size() * n, 0.0);
  then_.assign(outputs_.size() * n, 0.0);
  const auto visit = [&](const auto& at) {
    for (std::size_t w = 0; w < wants_.size(); ++w) {
      const SourcePixel& pixel = radiance.pixels().others()[wants_[w].pixel];
      for (std::size_t o = 0; o < pixel.model.outputs.size(); ++o)
        if (is_open(pixel.model.outputs[o])) at(w, pixel, o);
    }
  };
  Weights weights(integrator, intervals_.footprints(), steering_);
  visit([&](std::size_t w, const SourcePixel& pixel, std::size_t o) {
    weights.take(pixel, wants_[w].stratum, o);
    const double have = std::max(1.0, wants_[w].have), more = std::max(have, wants_[w].wanted);
    for (std::size_t d = 0; d < n; ++d) {
      const double weight = weights[d];
      const std::size_t to = static_cast<std::size_t>(pixel.model.outputs[o]) * n + d;
      const double own = weight * weight * own_[w * n + d], unmet = weight * weight * unmet_[w * n + d];
      now_[to] += (own + unmet) / have;
      const double hoped =
          wants_[w].hope ? std::min(1.0, kHoped / intervals_.sum(pixel.model.outputs[o]).gain[d]) : 1.0;
      then_[to] += (hoped * own + unmet * have / more) / more;
    }
  });
  for (Want& want : wants_) want.share = 0.0;
  visit([&](std::size_t w, const SourcePixel& pixel, std::size_t o) {
    if (!weights.take(pixel, wants_[w].stratum, o)) return;
    const int output = pixel.model.outputs[o];
    const OutputSums::Row sum = intervals_.sum(output);
    for (std::size_t d = 0; d < n; ++d) {
      const std::size_t at = static_cast<std::size_t>(output) * n + d;
      if (now_[at] <= 0.0 || weights[d] == 0.0) continue;
      const double left = (sum.path[d].variance() - sum.foretold[d]) * then_[at] / now_[at];
      wants_[w].share = std::max(wants_[w].share, left / outputs_[output].path_budget[d]);
    }
  });
  for (Want& want : wants_)
    want.wanted = std::max(want.wanted * std::clamp(want.share, kLeastShare, kMostShare),
                           std::min(want.wanted, kLeastGrowth * want.have));
}

/// Values that weigh unlike leave more than their number says, and one of the lattice may be all but enough by what later tests ask: where
/// all have what they want by that and an output is too wide all the same, those that there are grow. False where none does.
bool RoundPlanner::raise_wants() {
  bool any = false;
  for (Want& want : wants_) {
    const double have = std::max(1.0, want.have);
    if (want.share <= 1.0 && want.wanted < kNearly * have) continue;
    want.wanted = std::clamp(want.share, kLeastGrowth, kMostShare) * have;
    any = true;
  }
  return any;
}

/// Plans what is wanted; false where that is nothing.
bool RoundPlanner::plan_wants(Radiance& radiance, const LeafIntegrator& integrator) {
  const std::size_t n = steering_.size();
  bool any = false;
  std::vector<std::uint8_t> tested(outputs_.size(), 0);
  for (std::size_t w = 0; w < wants_.size(); ++w) {
    const Want& want = wants_[w];
    const SourcePixel& pixel = radiance.pixels().others()[want.pixel];
    const std::uint32_t spent = ledger_.spent(pixel.source);
    if (spent >= options_.max_samples_per_pixel) continue;
    const double room = options_.max_samples_per_pixel - spent;
    if (pixel.cluttered) {
      const double more = std::min(next_clutter(pixel, want.wanted), room);
      if (more <= 0.0) continue;
      radiance.clutter().plan(want.pixel, more);
    } else if (!plan_stratum(radiance, integrator, want, std::span(own_).subspan(w * n, n),
                             std::span(unmet_).subspan(w * n, n), room)) {
      continue;
    }
    any = true;
    for (int o : pixel.model.outputs) tested[o] = 1;
  }
  for (std::size_t o = 0; o < tested.size(); ++o)
    if (tested[o] && !outputs_[o].satisfied) ++outputs_[o].test;
  return any;
}

/// `own`: variances of one value, `unmet`: of what values have not met.
bool RoundPlanner::plan_stratum(Radiance& radiance, const LeafIntegrator& integrator, const Want& want,
                                std::span<const double> own, std::span<const double> unmet, double room) {
  const SourcePixel& pixel = radiance.pixels().others()[want.pixel];
  const Stratum& stratum = pixel.strata[want.stratum];
  const double have = want.have;
  double wanted = want.wanted;
  if (wanted <= std::max(1.0, have)) return false;
  if (integrator.unit_box() &&
      (stratum.nets.size > 0 || (have > 0.0 && wanted > (want.paths_differ ? kManyPaths : kManyValues)))) {
    const std::uint32_t size = net_size(stratum, wanted, room);
    if (size == stratum.nets.size) return false;
    radiance.nets().plan(want.pixel, want.stratum, size);
    return true;
  }
  const bool pilot = stratum.rounds.size() < 2;
  if (!pilot && mostly_met(own, unmet)) wanted = StratumEstimates::with_trend(stratum, steering_, wanted);
  if (!pilot && have > 0.0 && want.gain < kGains)
    wanted = have * std::pow(wanted / have, 1.0 / kSequenceFall);
  const double margin =
      std::lerp(kUnsureMargin, want.gain < kGains ? kHopedMargin : 1.0, std::min(1.0, want.freedom / kSure));
  double more = std::max(margin * wanted - have, kLeastRound * have);
  if (have > 0.0) more = std::min(more, ((pilot ? kFirstGrowth : kGrowth) - 1.0) * have);
  if (have == 0.0)
    more = std::min(std::max(more, kFewest), std::max(kFewest, kPilot * pixel.model.area[want.stratum]));
  radiance.rounds().plan(want.pixel, want.stratum, std::min(std::max(more, kFewest), room));
  return true;
}

}  // namespace ifov::sampling
