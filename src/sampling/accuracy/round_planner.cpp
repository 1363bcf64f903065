#include "sampling/accuracy/round_planner.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/clutter_choice.h"
#include "sampling/accuracy/output_intervals.h"
#include "sampling/accuracy/radiance/leaf_integrator.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/radiance_clutter.h"
#include "sampling/accuracy/radiance/radiance_nets.h"
#include "sampling/accuracy/radiance/radiance_rounds.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/accuracy/radiance/unseen_values.h"

namespace ifov::sampling {

namespace {

/// A pilot round draws about this many values per pixel, and at least kFewest per stratum.
constexpr double kPilot = 16.0;
/// Planned rounds aim a little beyond the limit, because variances are estimates.
constexpr double kMargin = 1.15;
/// After a pilot, a stratum grows at most this many times, until two rounds have told how its variance falls.
constexpr double kFirstGrowth = 12.0;
/// Later rounds grow at most this many times: the finer the grid, the faster texture gets exact.
constexpr double kGrowth = 2.5;
/// From here on replicated nets cost less than jittered values: early where paths make the variance and not
/// texture.
constexpr double kManyPaths = 320.0, kManyValues = 16384.0;
/// Of the variance that borders leave, values may take this share at least, whatever means from maps have taken.
constexpr double kLeastOfValues = 0.3;
/// What rounds of n values in clutter are planned by: their variance falls as n to minus this, between borders (3/2)
/// and paths (1). A round holds at most this many times the values of those before it.
constexpr double kClutterFall = 1.35, kClutterGrowth = 6.0;

}  // namespace

RoundPlanner::RoundPlanner(const AccuracyOptions& options, const RayLedger& ledger,
                           const ClutterChoice& clutter, OutputIntervals& intervals)
    : options_(options),
      ledger_(ledger),
      clutter_(clutter),
      intervals_(intervals),
      outputs_(intervals.states()) {}

void RoundPlanner::run(Radiance& radiance, const LeafIntegrator& integrator, const std::vector<int>& outputs,
                       std::span<const int> steering_channels, int columns) {
  all_columns_.resize(static_cast<std::size_t>(columns));
  std::iota(all_columns_.begin(), all_columns_.end(), 0);
  steering_.assign(steering_channels.begin(), steering_channels.end());
  do {
    while (plan_round(radiance, integrator, outputs)) radiance.trace();
  } while (steer_by_more(radiance, integrator, outputs));
}

/// Drivers stand for all columns. Where they are satisfied and another column is not, it steers as well. Leaves the sums
/// of all columns behind.
bool RoundPlanner::steer_by_more(const Radiance& radiance, const LeafIntegrator& integrator,
                                 const std::vector<int>& outputs) {
  const std::size_t n = all_columns_.size();
  if (steering_ != all_columns_)
    intervals_.gather(radiance, integrator, all_columns_, outputs);  // else plan_round just did
  if (steering_.size() == n) return false;
  std::vector<double> limit(n);
  std::vector<int> more;
  for (int o : outputs) {
    if (outputs_[o].test >= outputs_[o].last_test) continue;
    const OutputSums::Row sum = intervals_.sum(o);
    if (!sum.paths_vary(n)) continue;
    intervals_.limits(o, intervals_.means(o), limit);
    double worst = 1.0 + 1e-6;
    int column = -1;
    for (std::size_t c = 0; c < n; ++c) {
      const double ratio = intervals_.half_width(o, c) / limit[c];
      if (ratio > worst && sum.path[c].variance() > 0.0) worst = ratio, column = static_cast<int>(c);
    }
    if (column < 0) continue;
    if (std::find(steering_.begin(), steering_.end(), column) != steering_.end()) continue;
    outputs_[o].satisfied = false;
    if (std::find(more.begin(), more.end(), column) == more.end()) more.push_back(column);
  }
  steering_.insert(steering_.end(), more.begin(), more.end());
  return !more.empty();
}

/// Nets grow by doubling, at most fourfold between tests: their error falls faster than that of independent
/// values, by which `wanted` is reckoned.
std::uint32_t RoundPlanner::net_size(const Stratum& stratum, double wanted, double room) {
  constexpr double kGain = 8.0;  // about what nets save
  constexpr double kFirst =
      64.0;  // few values may have met something rare that says too much of the variance
  const double most =
      std::max(4.0, (room + static_cast<double>(stratum.count())) / RadianceNets::kReplicates);
  std::uint32_t size = std::max(4u, stratum.nets.size);
  const double target = stratum.nets.size == 0 ? std::min(kFirst, wanted / kGain / RadianceNets::kReplicates)
                                               : std::min(4.0 * size, wanted / RadianceNets::kReplicates);
  while (size < target && 2.0 * size <= most) size *= 2;
  return size;
}

/// Values of the next round where `wanted` independent ones would do; 0 where there are enough.
double RoundPlanner::next_clutter(const SourcePixel& pixel, double wanted) {
  const double have = pixel.clutter_count();
  if (wanted <= have) return 0.0;
  const double next = have * std::pow(wanted / have - 1.0, 1.0 / kClutterFall);
  return std::clamp(next, 0.3 * have, kClutterGrowth * have);
}

/// Strata whose values are foretold need some of their own before they may say that they are.
bool RoundPlanner::begin_foretold(Radiance& radiance) {
  bool any = false;
  for (std::size_t p = 0; p < radiance.pixels().others().size(); ++p) {
    const SourcePixel& pixel = radiance.pixels().others()[p];
    for (std::size_t s = 0; s < pixel.strata.size(); ++s) {
      const Stratum& stratum = pixel.strata[s];
      if (!stratum.foretold() || stratum.round > 0 || stratum.nets.size > 0) continue;
      radiance.rounds().plan(p, s, std::max(kFewest, kPilot * pixel.model.area[s]));
      for (int o : pixel.model.outputs) outputs_[o].test = std::max(outputs_[o].test, 1);
      any = true;
    }
  }
  return any;
}

/// Leaves in limit_ how wide the intervals of an output may be, in the steering columns.
OutputSums::Row RoundPlanner::limits_of(int output) {
  const OutputSums::Row sum = intervals_.sum(output);
  for (std::size_t d = 0; d < steering_.size(); ++d) mean_[steering_[d]] = sum.mean[d];
  intervals_.limits(output, mean_, limit_);
  return sum;
}

/// Looks at the intervals so far and plans values where they are too wide; false when nothing is left to do.
bool RoundPlanner::plan_round(Radiance& radiance, const LeafIntegrator& integrator,
                              const std::vector<int>& outputs) {
  const std::size_t n = steering_.size();
  bool begun = clutter_.begin_rounds(options_.clutter_switch, radiance, outputs_);
  begun = begin_foretold(radiance) || begun;
  if (begun) return true;
  intervals_.gather(radiance, integrator, steering_, outputs);
  mean_.assign(all_columns_.size(), 0.0);
  limit_.resize(mean_.size());
  if (begin_untold(radiance)) return true;

  for (int o : outputs) {
    OutputState& output = outputs_[o];
    if (output.satisfied) continue;
    const OutputSums::Row sum = intervals_.sum(o);
    output.satisfied = true;
    if (!sum.paths_vary(n)) continue;  // no value would make it better
    limits_of(o);
    output.path_budget.assign(n, 0.0);
    for (std::size_t d = 0; d < n; ++d) {
      const double limit_d = limit_[steering_[d]];
      const double from_borders =
          intervals_.stopping().normal() * intervals_.stopping().normal() * sum.geometry[d];
      const bool wide = intervals_.half_width(o, d) > limit_d && sum.path[d].variance() > 0.0;
      if (wide) output.satisfied = false;
      const double planned_t = intervals_.stopping().student(
          std::max(output.test + 1, 2), std::max(sum.path[d].degrees_of_freedom(), 20.0));
      const double budget =
          std::max(limit_d * limit_d - from_borders, 0.2 * limit_d * limit_d) / (planned_t * planned_t);
      output.path_budget[d] = std::max(budget - sum.foretold[d], kLeastOfValues * budget);
      // Few degrees of freedom may keep an interval wide whose variance is small: more values still.
      if (wide)
        output.path_budget[d] =
            std::min(output.path_budget[d], 0.7 * (sum.path[d].variance() - sum.foretold[d]));
    }
  }

  bool any = false;
  std::vector<std::uint8_t> tested(outputs_.size(), 0);
  StratumMoments moments;
  std::vector<ClutterRound::Moment> clutter;
  std::vector<double> deviation(n);
  for (std::size_t p = 0; p < radiance.pixels().others().size(); ++p) {
    const SourcePixel& pixel = radiance.pixels().others()[p];
    const PixelModel& model = pixel.model;
    const std::uint32_t spent = ledger_.spent(pixel.source);
    if (spent >= options_.max_samples_per_pixel) continue;
    if (std::all_of(model.outputs.begin(), model.outputs.end(), [&](int o) { return outputs_[o].satisfied; }))
      continue;
    const double room = options_.max_samples_per_pixel - spent;
    const std::size_t strata = pixel.cluttered ? 1 : model.labels.size();
    for (std::size_t s = 0; s < strata; ++s) {
      if (!pixel.cluttered)
        radiance.estimates().moments(pixel, s, steering_, moments);
      else
        RadianceClutter::moments(pixel, nullptr, {}, steering_, clutter);
      const double count =
          pixel.cluttered ? pixel.clutter_count() : static_cast<double>(pixel.strata[s].count());
      for (std::size_t d = 0; d < n; ++d) {
        const double unseen = radiance.unseen().variance(pixel, s, steering_[d]);
        deviation[d] = pixel.cluttered ? std::sqrt((clutter[d].variance + unseen) * count)
                                       : std::sqrt(moments.variance[d] + unseen * std::max(1.0, count));
      }
      double wanted = 0.0;
      for (std::size_t o = 0; o < model.outputs.size(); ++o) {
        const OutputState& output = outputs_[model.outputs[o]];
        if (output.satisfied || output.test >= output.last_test) continue;
        const OutputSums::Row sum = intervals_.sum(model.outputs[o]);
        const double weight =
            pixel.cluttered ? integrator.whole_weight(pixel.source, model.outputs[o]) : model.weight_of(s, o);
        for (std::size_t d = 0; d < n; ++d)
          wanted = std::max(wanted,
                            sum.gain[d] * weight * deviation[d] * sum.deviation[d] / output.path_budget[d]);
      }
      if (pixel.cluttered) {
        const double more = std::min(next_clutter(pixel, wanted), room);
        if (more <= 0.0) continue;
        radiance.clutter().plan(p, more);
      } else {
        const Stratum& stratum = pixel.strata[s];
        const double have = count;
        if (wanted <= std::max(1.0, have)) continue;
        const bool paths_differ = StratumEstimates::paths_differ(stratum, steering_, moments);
        if (integrator.unit_box() &&
            (stratum.nets.size > 0 || (have > 0.0 && wanted > (paths_differ ? kManyPaths : kManyValues)))) {
          const std::uint32_t size = net_size(stratum, wanted, room);
          if (size == stratum.nets.size) continue;
          radiance.nets().plan(p, s, size);
          any = true;
          for (int o : model.outputs) tested[o] = 1;
          continue;
        }
        if (stratum.rounds.size() >= 2)
          wanted = std::min(StratumEstimates::with_trend(stratum, steering_, wanted), kGrowth * have);
        else if (have > 0.0)
          wanted = std::min(wanted, kFirstGrowth * have);
        double more = kMargin * wanted - have;
        if (have == 0.0) more = std::min(std::max(more, kFewest), std::max(kFewest, kPilot * model.area[s]));
        radiance.rounds().plan(p, s, std::min(std::max(more, kFewest), room));
      }
      any = true;
      for (int o : model.outputs) tested[o] = 1;
    }
  }
  for (std::size_t o = 0; o < tested.size(); ++o)
    if (tested[o] && !outputs_[o].satisfied) ++outputs_[o].test;
  return any;
}

}  // namespace ifov::sampling
