// Radiance in rounds: moments weighed into pixels, looks at the intervals, plans for more values.
#include <algorithm>
#include <cmath>

#include "sampling/accuracy/tile_work.h"

namespace ifov::sampling {

namespace {

/// A pilot round draws about this many values per pixel, and at least a few per stratum.
constexpr double kPilot = 16.0, kFewest = 4.0;
/// Planned rounds aim a little beyond the limit, because variances are estimates.
constexpr double kMargin = 1.15;
/// After a pilot, a stratum grows at most this many times, until two rounds have told how its variance falls.
constexpr double kFirstGrowth = 12.0;
/// Later rounds grow at most this many times: the finer the grid, the faster texture gets exact.
constexpr double kGrowth = 2.5;
/// From here on replicated nets cost less than jittered values: early where paths make the variance and not
/// texture.
constexpr double kManyPaths = 320.0, kManyValues = 16384.0;
/// A pixel's model is given up when what contradicts it may make this share of the allowed variance.
constexpr double kDoubt = 0.05;
/// The first round in clutter takes this share of what the lattice predicts, within these bounds.
constexpr double kFirstShare = 0.6, kFewestClutter = 36.0, kMostFirstClutter = 400.0;
/// What rounds of n values in clutter are planned by: their variance falls as n to minus this, between borders (3/2)
/// and paths (1). A round holds at most this many times the values of those before it.
constexpr double kClutterFall = 1.35, kClutterGrowth = 6.0;
/// First look in clutter: its values are as many as the prediction says, and its interval is as good as later ones.
constexpr int kClutterLook = 2;

}  // namespace

void TileWork::estimate() {
  const LeafIntegrator integrator(tracer_, *problem_.footprint, problem_.tile);
  // Pixels of a box footprint are independent of each other: they are finished in groups, so that few values
  // are in memory at a time. A wider footprint ties them together.
  const int sources = lattice_.domain().count();
  const int group = integrator.unit_box() ? std::max<int>(64, 81920 / ledger_.field().stride()) : sources;
  for (int first = 0; first < sources; first += group) {
    const bool ready = group >= sources && radiance_ != nullptr;  // by tighten_borders, of all pixels
    if (!ready) {
      radiance_ = std::make_unique<Radiance>(tracer_, prober_, ledger_, table_, *spread_, lattice_values_,
                                             faults_, problem_.seed, !integrator.unit_box());
      radiance_->add_pixels(first, std::min(sources, first + group), integrator);
    }
    std::vector<std::uint8_t> touched(outputs_.size(), 0);
    for (const Radiance::PlainPixel& pixel : radiance_->plain_pixels()) touched[pixel.output] = 1;
    for (const Radiance::Pixel& pixel : radiance_->pixels())
      for (int o : pixel.model.outputs) touched[o] = 1;
    std::vector<int> outputs;
    for (std::size_t o = 0; o < touched.size(); ++o)
      if (touched[o]) outputs.push_back(static_cast<int>(o));
    for (std::size_t p = 0; p < radiance_->pixels().size(); ++p) recall_values(p);
    steering_.assign(problem_.drivers.begin(), problem_.drivers.end());
    do {
      while (plan_round(integrator, outputs)) radiance_->trace();
    } while (steer_by_more(integrator, outputs));
    finish(integrator, outputs);
    if (problem_.keep_memory) remember_values();
  }
}

/// Drivers stand for all columns. Where they are satisfied and another column is not, it steers as well. Leaves the sums
/// of all columns behind.
bool TileWork::steer_by_more(const LeafIntegrator& integrator, const std::vector<int>& outputs) {
  const std::size_t n = static_cast<std::size_t>(columns_);
  if (steering_ != all_columns_) gather(integrator, all_columns_, outputs);  // else plan_round just did
  if (steering_.size() == n) return false;
  std::vector<double> limit(n);
  std::vector<int> more;
  for (int o : outputs) {
    if (outputs_[o].look >= outputs_[o].last_look) continue;
    const OutputSums::Row sum = sums_[o];
    if (!sum.paths_vary(n)) continue;
    problem_.tolerance->limits(sums_.means(o), limit);
    double worst = 1.0 + 1e-6;
    int column = -1;
    for (std::size_t c = 0; c < n; ++c) {
      const double ratio = half_width(sum, c, outputs_[o].look) / limit[c];
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

/// Nets grow by doubling, at most fourfold between looks: their error falls faster than that of independent
/// values, by which `wanted` is reckoned.
std::uint32_t TileWork::net_size(const Radiance::Stratum& stratum, double wanted, double room) {
  constexpr double kGain = 8.0;  // about what nets save
  constexpr double kFirst =
      64.0;  // few values may have met something rare that says too much of the variance
  const double most =
      std::max(4.0, (room + static_cast<double>(stratum.count())) / Radiance::kStratumReplicates);
  std::uint32_t size = std::max(4u, stratum.nets.size);
  const double target = stratum.nets.size == 0
                            ? std::min(kFirst, wanted / kGain / Radiance::kStratumReplicates)
                            : std::min(4.0 * size, wanted / Radiance::kStratumReplicates);
  while (size < target && 2.0 * size <= most) size *= 2;
  return size;
}

double TileWork::first_clutter(const Radiance::Pixel& pixel) const {
  return std::clamp(kFirstShare * predicted_[pixel.source], kFewestClutter, kMostFirstClutter);
}

/// Values of the next round where `wanted` independent ones would do; 0 where there are enough.
double TileWork::next_clutter(const Radiance::Pixel& pixel, double wanted) const {
  const double have = pixel.clutter_count();
  if (wanted <= have) return 0.0;
  const double next = have * std::pow(wanted / have - 1.0, 1.0 / kClutterFall);
  return std::clamp(next, 0.3 * have, kClutterGrowth * have);
}

/// Whether values have met what the traced model does not know, to an extent that matters. The rest of it, which
/// no value has met, is then likely to matter as well.
bool TileWork::doubtful(const Radiance::Pixel& pixel) const {
  if (pixel.cluttered) return false;
  const PixelModel& model = pixel.model;
  const auto allowed = contrast_.allowed(pixel.source);
  for (std::size_t s = 0; s < pixel.strata.size(); ++s) {
    const Radiance::Stratum& stratum = pixel.strata[s];
    if (stratum.strays == 0.0) continue;
    double weight = 0.0;
    for (std::size_t o = 0; o < model.outputs.size(); ++o) weight = std::max(weight, model.weight_of(s, o));
    const double share = weight / std::max(static_cast<double>(stratum.count()), stratum.strays);
    for (std::size_t d = 0; d < problem_.drivers.size(); ++d) {
      const int c = problem_.drivers[d];
      const double square = stratum.stray_sum[c] * stratum.stray_sum[c] + stratum.stray_squares[c];
      if (share * share * square > kDoubt * allowed[d] * allowed[d]) return true;
    }
  }
  return false;
}

/// Looks at the intervals so far and plans values where they are too wide; false when nothing is left to do.
bool TileWork::plan_round(const LeafIntegrator& integrator, const std::vector<int>& outputs) {
  const std::size_t n = steering_.size();
  bool cluttered_start = false;
  for (std::size_t p = 0; p < radiance_->pixels().size(); ++p) {
    const Radiance::Pixel& pixel = radiance_->pixels()[p];
    if (options_.clutter_switch && doubtful(pixel)) {
      radiance_->turn_to_clutter(p);
      recall_values(p);
    }
    if (pixel.cluttered && pixel.rounds.empty() && !pixel.model.outputs.empty()) {
      radiance_->plan_clutter(p, first_clutter(pixel));
      for (int o : pixel.model.outputs) outputs_[o].look = std::max(outputs_[o].look, kClutterLook);
      cluttered_start = true;
    }
  }
  if (cluttered_start) return true;
  gather(integrator, steering_, outputs);

  std::vector<double> mean(static_cast<std::size_t>(columns_)), limit(mean.size());
  for (int o : outputs) {
    Output& output = outputs_[o];
    if (output.satisfied) continue;
    const OutputSums::Row sum = sums_[o];
    output.satisfied = true;
    if (!sum.paths_vary(n)) continue;  // no value would make it better
    for (std::size_t d = 0; d < n; ++d) mean[steering_[d]] = sum.mean[d];
    problem_.tolerance->limits(mean, limit);
    output.path_budget.assign(n, 0.0);
    for (std::size_t d = 0; d < n; ++d) {
      const double limit_d = limit[steering_[d]];
      const double from_borders = stopping_.normal() * stopping_.normal() * sum.geometry[d];
      const bool wide = half_width(sum, d, output.look) > limit_d && sum.path[d].variance() > 0.0;
      if (wide) output.satisfied = false;
      const double planned_t =
          stopping_.student(std::max(output.look + 1, 2), std::max(sum.path[d].degrees_of_freedom(), 20.0));
      output.path_budget[d] =
          std::max(limit_d * limit_d - from_borders, 0.2 * limit_d * limit_d) / (planned_t * planned_t);
      // Few degrees of freedom may keep an interval wide whose variance is small: more values still.
      if (wide) output.path_budget[d] = std::min(output.path_budget[d], 0.7 * sum.path[d].variance());
    }
  }

  bool any = false;
  std::vector<std::uint8_t> looked(outputs_.size(), 0);
  StratumMoments moments;
  std::vector<ClutterRound::Moment> clutter;
  std::vector<double> deviation(n);
  for (std::size_t p = 0; p < radiance_->pixels().size(); ++p) {
    const Radiance::Pixel& pixel = radiance_->pixels()[p];
    const PixelModel& model = pixel.model;
    const std::uint32_t spent = ledger_.spent(pixel.source);
    if (spent >= options_.max_samples_per_pixel) continue;
    if (std::all_of(model.outputs.begin(), model.outputs.end(), [&](int o) { return outputs_[o].satisfied; }))
      continue;
    const double room = options_.max_samples_per_pixel - spent;
    const std::size_t strata = pixel.cluttered ? 1 : model.labels.size();
    for (std::size_t s = 0; s < strata; ++s) {
      if (!pixel.cluttered)
        radiance_->moments(pixel, s, steering_, moments);
      else
        radiance_->clutter(pixel, nullptr, {}, steering_, clutter);
      const double count =
          pixel.cluttered ? pixel.clutter_count() : static_cast<double>(pixel.strata[s].count());
      for (std::size_t d = 0; d < n; ++d) {
        const double unseen = radiance_->unseen(pixel, s, steering_[d]);
        deviation[d] = pixel.cluttered ? std::sqrt((clutter[d].variance + unseen) * count)
                                       : std::sqrt(moments.variance[d] + unseen * std::max(1.0, count));
      }
      double wanted = 0.0;
      for (std::size_t o = 0; o < model.outputs.size(); ++o) {
        const Output& output = outputs_[model.outputs[o]];
        if (output.satisfied || output.look >= output.last_look) continue;
        const OutputSums::Row sum = sums_[model.outputs[o]];
        const double weight =
            pixel.cluttered ? integrator.whole_weight(pixel.source, model.outputs[o]) : model.weight_of(s, o);
        for (std::size_t d = 0; d < n; ++d)
          wanted = std::max(wanted,
                            sum.gain[d] * weight * deviation[d] * sum.deviation[d] / output.path_budget[d]);
      }
      if (pixel.cluttered) {
        const double more = std::min(next_clutter(pixel, wanted), room);
        if (more <= 0.0) continue;
        radiance_->plan_clutter(p, more);
      } else {
        const Radiance::Stratum& stratum = pixel.strata[s];
        const double have = count;
        if (wanted <= std::max(1.0, have)) continue;
        const bool paths_differ = radiance_->paths_differ(stratum, steering_, moments);
        if (integrator.unit_box() &&
            (stratum.nets.size > 0 || (have > 0.0 && wanted > (paths_differ ? kManyPaths : kManyValues)))) {
          const std::uint32_t size = net_size(stratum, wanted, room);
          if (size == stratum.nets.size) continue;
          radiance_->plan_stratum_nets(p, s, size);
          any = true;
          for (int o : model.outputs) looked[o] = 1;
          continue;
        }
        if (stratum.rounds.size() >= 2)
          wanted = std::min(radiance_->with_trend(pixel, s, steering_, wanted), kGrowth * have);
        else if (have > 0.0)
          wanted = std::min(wanted, kFirstGrowth * have);
        double more = kMargin * wanted - have;
        if (have == 0.0) more = std::min(std::max(more, kFewest), std::max(kFewest, kPilot * model.area[s]));
        radiance_->plan(p, s, std::min(std::max(more, kFewest), room));
      }
      any = true;
      for (int o : model.outputs) looked[o] = 1;
    }
  }
  for (std::size_t o = 0; o < looked.size(); ++o)
    if (looked[o] && !outputs_[o].satisfied) ++outputs_[o].look;
  return any;
}

}  // namespace ifov::sampling
