#include "sampling/accuracy/output_intervals.h"

#include <algorithm>
#include <cmath>

#include "core/call_scope.h"
#include "sampling/accuracy/abundance_sums.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/radiance/clutter_sums.h"
#include "sampling/accuracy/radiance/footprint_weights.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/radiance_clutter.h"
#include "sampling/accuracy/radiance/sequence_gains.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/accuracy/radiance/unseen_values.h"
#include "sampling/accuracy/weights/leaf_integrator.h"
#include "sampling/footprint_groups.h"
#include "sampling/tile.h"

namespace ifov::sampling {

namespace {

/// Of one value of a region, with what of it is foretold.
double value_variance(const SourcePixel& pixel, const std::vector<StratumMoments>& moments,
                      std::size_t region, std::size_t c, int column) {
  const Stratum& stratum = pixel.strata[region];
  return moments[region].variance[c] + (stratum.foretold() ? stratum.control.spread[column] : 0.0);
}

}  // namespace

/// The columns that are asked, and by group their positions and themselves.
struct OutputIntervals::Asked {
  std::span<const int> columns;
  std::vector<std::vector<std::size_t>> positions;
  std::vector<std::vector<int>> columns_of;
};

/// A traced pixel, one of its outputs, and the group that some of the asked columns are of.
struct OutputIntervals::Traced {
  const SourcePixel& pixel;
  const std::vector<StratumMoments>& moments;  ///< by region
  std::size_t output, group;
  std::span<const int> columns;      ///< all that are asked
  std::span<const std::size_t> own;  ///< positions of the group's
};

/// The label that most of an output's variance comes from: of the stratum that has most of it.
struct OutputIntervals::Leading {
  std::uint32_t label;
  double variance;
};

OutputIntervals::OutputIntervals(const Tolerance& tolerance, const LaterLight* later, const LabelTable& table,
                                 const Field& field, int outputs, const ColumnFootprints& footprints)
    : limits_(tolerance, later),
      by_material_(tolerance.by_material()),
      field_(field),
      table_(table),
      footprints_(footprints),
      stopping_(tolerance.confidence()),
      states_(static_cast<std::size_t>(outputs)),
      // Values that weigh unlike are kept, and their paths' replicates tell a variance.
      sums_(states_.size(), !footprints.whole_pixel()),
      clutter_(std::make_unique<ClutterSums>()),
      first_held_(states_.size(), 0),
      held_count_(states_.size(), 0) {}

OutputIntervals::~OutputIntervals() = default;

void OutputIntervals::gather(const Radiance& radiance, const LeafIntegrator& integrator,
                             std::span<const int> columns, std::span<const int> outputs) {
  const std::size_t n = columns.size();
  sums_.clear(outputs, n);
  leading_.assign(states_.size(), {kNoLabel, 0.0});
  std::vector<StratumMoments> moments;
  WeighedMoments weighed;
  Asked asked{columns, footprints_.positions(columns), {}};
  const auto& by_group = asked.positions;
  asked.columns_of.resize(by_group.size());
  for (std::size_t g = 0; g < by_group.size(); ++g)
    for (const std::size_t c : by_group[g]) asked.columns_of[g].push_back(columns[c]);
  for (const PlainPixel& pixel : radiance.pixels().plain()) {
    const OutputSums::Row sum = sums_[pixel.output];
    for (std::size_t c = 0; c < n; ++c) sum.mean[c] += pixel.weight * table_.mean(pixel.label)[columns[c]];
  }
  for (const SourcePixel& pixel : radiance.pixels().others()) {
    stop_if_cancelled();
    const PixelModel& model = pixel.model;
    if (model.outputs.empty()) continue;
    if (pixel.cluttered) {
      add_clutter(radiance, integrator, pixel, asked);
      continue;
    }
    const std::size_t regions = model.labels.size();
    moments.resize(std::max(moments.size(), regions));
    for (std::size_t r = 0; r < regions; ++r) radiance.estimates().moments(pixel, r, columns, moments[r]);
    for (std::size_t o = 0; o < model.outputs.size(); ++o)
      for (std::size_t g = 0; g < by_group.size(); ++g)
        add_traced(radiance, integrator, {pixel, moments, o, g, columns, by_group[g]}, weighed);
  }
  settle_paths(outputs, n);
  if (by_material_) find_materials(radiance, integrator, outputs);
}

void OutputIntervals::find_materials(const Radiance& radiance, const LeafIntegrator& integrator,
                                     std::span<const int> outputs) {
  held_ = abundances_of(radiance, integrator, table_, field_, outputs, states_.size(), stopping_.normal());
  std::fill(held_count_.begin(), held_count_.end(), 0);
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const std::size_t output = held_[k].pixel;
    if (held_count_[output]++ == 0) first_held_[output] = k;
  }
}

void OutputIntervals::limits(int output, std::span<const double> mean, std::span<double> limit) {
  const auto of = static_cast<std::size_t>(output);
  limits_.of(of, held_.data() + first_held_[of], held_count_[of], mean, limit);
}

/// What a cluttered pixel adds to its outputs.
void OutputIntervals::add_clutter(const Radiance& radiance, const LeafIntegrator& integrator,
                                  const SourcePixel& pixel, const Asked& asked) {
  const PixelModel& model = pixel.model;
  const double count = pixel.clutter_count();
  const bool by_groups = model.groups > 1;
  std::vector<ClutterRound::Moment> moments;
  if (by_groups) clutter_->take(pixel, integrator, asked.columns, asked.positions);
  for (std::size_t o = 0; o < model.outputs.size(); ++o) {
    const OutputSums::Row sum = sums_[model.outputs[o]];
    for (std::size_t g = 0; g < asked.positions.size(); ++g) {
      const double w = integrator.whole_weight(pixel.source, model.outputs[o], g);
      if (asked.positions[g].empty() || (w == 0.0 && by_groups)) continue;
      if (!by_groups)
        RadianceClutter::moments(pixel, integrator.unit_box() ? nullptr : &integrator.footprint(g),
                                 integrator.centre(model.outputs[o], g), asked.columns_of[g], moments);
      for (std::size_t k = 0; k < asked.positions[g].size(); ++k) {
        const std::size_t c = asked.positions[g][k];
        const ClutterRound::Moment found = by_groups ? clutter_->of(o).moment(c) : moments[k];
        sum.mean[c] += w * found.mean;
        const double missed = radiance.unseen().variance(pixel, 0, asked.columns[c]);
        sum.add_path(c, w * w * found.variance, found.freedom);
        sum.add_path(c, w * w * missed, INFINITY);
        sum.unmet[c] += w * w * missed;
        sum.deviation[c] += w * std::sqrt(found.variance * count);
        sum.deviation_unmet[c] += w * std::sqrt((found.variance + missed) * count);
      }
    }
  }
}

void OutputIntervals::settle_paths(std::span<const int> outputs, std::size_t columns) {
  for (std::size_t c = 0; c < columns; ++c) {
    SequenceGains gains;
    for (int o : outputs) gains.add(leading_[o].label, sums_[o].own_gain(c), sums_[o].values(c));
    gains.settle();
    for (int o : outputs) {
      const OutputSums::Row sum = sums_[o];
      sum.settle_path(c, gains.moderated(leading_[o].label, sum.own_gain(c), sum.values(c)));
    }
  }
}

/// What a traced pixel adds to an output, in the columns of a group.
void OutputIntervals::add_traced(const Radiance& radiance, const LeafIntegrator& integrator, const Traced& of,
                                 WeighedMoments& weighed) {
  const SourcePixel& pixel = of.pixel;
  const PixelModel& model = pixel.model;
  const std::vector<StratumMoments>& moments = of.moments;
  const OutputSums::Row sum = sums_[model.outputs[of.output]];
  for (std::size_t r = 0; r < model.labels.size(); ++r) {
    const double w = model.weight_of(r, of.output, of.group);
    if (w == 0.0) continue;
    weighed.mean = moments[r].mean;
    weighed.share = moments[r].share;
    weighed.freedom = 0.0;
    const double count = static_cast<double>(pixel.strata[r].count());
    weighed.weighing = count;
    // What is foretold is weighed apart from the values' rests.
    const StratumControl& control = pixel.strata[r].control;
    const bool by_place = !control.weighed_mean.empty();
    const std::size_t row = of.output * static_cast<std::size_t>(table_.columns());
    for (const std::size_t c : of.own)
      if (by_place) weighed.mean[c] -= control.mean[of.columns[c]];
    if (moments[r].sampled && !integrator.unit_box())
      radiance.weigh(pixel.strata[r], integrator.footprint(of.group),
                     integrator.centre(model.outputs[of.output], of.group), of.columns, of.own, moments[r],
                     weighed);
    // Values that hardly weigh have met nothing for this output.
    const double fewer = count > 0.0 ? count / weighed.weighing : 1.0;
    double whole = 0.0;
    for (const std::size_t c : of.own) {
      const std::size_t column = static_cast<std::size_t>(of.columns[c]);
      if (by_place) weighed.mean[c] += static_cast<double>(control.weighed_mean[row + column]);
      sum.mean[c] += w * weighed.mean[c];
      const double apart = w * w * moments[r].variance[c] * weighed.share;
      whole += apart;
      if (weighed.freedom > 0.0) {
        sum.path[c].add(apart, moments[r].freedom);
        sum.replicated[c].add(w * w * weighed.variance[c], weighed.freedom);
      } else {
        sum.add_path(c, apart, moments[r].freedom);
      }
      if (pixel.strata[r].foretold()) {
        const double variance = w * w *
                                (by_place ? static_cast<double>(control.weighed_variance[row + column])
                                          : control.variance[column]);
        sum.add_path(c, variance,
                     by_place ? static_cast<double>(control.weighed_freedom[of.output]) : control.freedom);
        sum.foretold[c] += variance;
      }
      const double missed = fewer * fewer * radiance.unseen().variance(pixel, r, of.columns[c]);
      sum.add_path(c, w * w * missed, INFINITY);
      sum.unmet[c] += w * w * missed;
      sum.deviation[c] += w * std::sqrt(moments[r].variance[c]);
      sum.deviation_unmet[c] += w * std::sqrt(moments[r].variance[c] + missed * std::max(1.0, count));
    }
    Leading& leading = leading_[model.outputs[of.output]];
    if (whole > leading.variance) leading = {model.labels[r], whole};
  }
  for (std::size_t b = 0; b < model.borders.size(); ++b) {
    const std::size_t in = model.region_of(model.borders[b].inner),
                      out = model.region_of(model.borders[b].outer);
    const double variance = model.border_variance_of(b, of.output, of.group);
    for (const std::size_t c : of.own) {
      const double step = moments[in].mean[c] - moments[out].mean[c];
      sum.geometry[c] += variance * (step * step + value_variance(pixel, moments, in, c, of.columns[c]) +
                                     value_variance(pixel, moments, out, c, of.columns[c]));
    }
  }
  for (std::size_t l = 0; l < model.loose.size(); ++l) {
    const double w = model.loose_weight_of(l, of.output, of.group);
    for (const std::size_t c : of.own) {
      double low = INFINITY, high = -INFINITY, within = 0.0;
      for (std::uint32_t corner : model.loose[l].corner) {
        const std::size_t region = model.region_of(corner);
        const StratumMoments& m = moments[region];
        low = std::min(low, m.mean[c]);
        high = std::max(high, m.mean[c]);
        within = std::max(within, value_variance(pixel, moments, region, c, of.columns[c]));
      }
      sum.geometry[c] += w * w * ((high - low) * (high - low) / 12.0 + within);
    }
  }
}

double OutputIntervals::half_width(int output, std::size_t column) {
  const OutputSums::Row sum = sums_[output];
  const double path = sum.path[column].variance();
  const double t =
      path > 0.0 ? stopping_.student(states_[output].test, sum.path[column].degrees_of_freedom()) : 0.0;
  return std::sqrt(stopping_.normal() * stopping_.normal() * sum.geometry[column] + t * t * path);
}

}  // namespace ifov::sampling
