#include "sampling/accuracy/round_planner.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/clutter_choice.h"
#include "sampling/accuracy/output_intervals.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/radiance_rounds.h"
#include "sampling/accuracy/radiance/source_pixels.h"

namespace ifov::sampling {

namespace {

/// From this test on rounds are generous, as tests run out: most where what is not met is known badly.
constexpr int kGenerous = 7;
/// What is too wide by a little is to have this part of its variance at most, where it is told well and where not: before that test, and
/// from it on.
constexpr double kSoon = 0.95, kLate = 0.9, kGenerousSoon = 0.8, kGenerousLate = 0.6;
/// Of the variance that borders leave, values may take this share at least, whatever means from maps have taken.
constexpr double kLeastOfValues = 0.3;

/// How many times the values there are leave a variance of `budget`, where they leave `own`, which falls as 1 / n, and `unmet`,
/// which falls as 1 / n^2.
double growth_to(double budget, double own, double unmet) {
  own = std::max(own, 0.0);
  return std::max(1.0, (own + std::sqrt(own * own + 4.0 * budget * unmet)) / (2.0 * budget));
}

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
  bool begun = clutter_.begin_rounds(options_.clutter_switch, radiance, outputs_);
  begun = begin_foretold(radiance) || begun;
  if (begun) return true;
  intervals_.gather(radiance, integrator, steering_, outputs);
  mean_.assign(all_columns_.size(), 0.0);
  limit_.resize(mean_.size());
  const std::size_t labels_told = told_.size();
  if (begin_untold(radiance)) return true;
  if (told_.size() > labels_told) intervals_.gather(radiance, integrator, steering_, outputs);
  for (int o : outputs) find_budget(o);
  find_wants(radiance, integrator);
  ease_wants(radiance, integrator);
  return plan_wants(radiance, integrator) || (raise_wants() && plan_wants(radiance, integrator));
}

/// Whether an output's interval is narrow enough, and what variance paths may leave in it.
void RoundPlanner::find_budget(int o) {
  const std::size_t n = steering_.size();
  OutputState& output = outputs_[o];
  const OutputSums::Row sum = intervals_.sum(o);
  output.satisfied =
      true;  // perhaps no longer: values drawn for its neighbours may have widened its interval
  if (!sum.paths_vary(n)) return;  // no value would make it better
  limits_of(o);
  output.path_budget.assign(n, 0.0);
  output.growth.assign(n, 1.0);
  for (std::size_t d = 0; d < n; ++d) {
    const double limit_d = limit_[steering_[d]];
    const double from_borders =
        intervals_.stopping().normal() * intervals_.stopping().normal() * sum.geometry[d];
    const bool wide = intervals_.half_width(o, d) > limit_d && sum.path[d].variance() > 0.0;
    if (wide) output.satisfied = false;
    const double planned_t = intervals_.stopping().student(std::max(output.test + 1, 2),
                                                           std::max(sum.path[d].degrees_of_freedom(), 20.0));
    const double budget =
        std::max(limit_d * limit_d - from_borders, 0.2 * limit_d * limit_d) / (planned_t * planned_t);
    output.path_budget[d] = std::max(budget - sum.foretold[d], kLeastOfValues * budget);
    // Few degrees of freedom may keep an interval wide whose variance is small: it is to shrink all the same.
    if (wide) {
      const double sure = std::clamp(sum.path[d].degrees_of_freedom() / kSure, 0.0, 1.0);
      const double left = output.test < kGenerous ? std::lerp(kLate, kSoon, sure)
                                                  : std::lerp(kGenerousLate, kGenerousSoon, sure);
      output.path_budget[d] =
          std::min(output.path_budget[d], left * (sum.path[d].variance() - sum.foretold[d]));
    }
    const double met = sum.path[d].variance() - sum.foretold[d] - sum.unmet[d];
    if (output.test < kGenerous || met > sum.unmet[d])
      output.growth[d] = growth_to(output.path_budget[d], met, sum.unmet[d]);
  }
}

}  // namespace ifov::sampling
