#include "sampling/accuracy/clutter_choice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sampling/accuracy/allowed_errors.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/borders/clutter.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/steering_columns.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/output_state.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/radiance_clutter.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/tile_recall.h"

namespace ifov::sampling {

namespace {

/// A pixel's model is given up when what contradicts it may make this share of the allowed variance.
constexpr double kDoubt = 0.05;
/// The first round in clutter takes this share of what the lattice predicts, within these bounds.
constexpr double kFirstShare = 0.6, kFewestClutter = 36.0, kMostFirstClutter = 400.0;
/// Where no more values than this are predicted, and no more pairs of labels meet, gaps between them are looked for first.
constexpr double kFewValues = 150.0;
constexpr std::size_t kFewPairs = 3;
/// Where the mean of so many values of a label is as good as the pixel asks, these differ by little beside borders.
constexpr double kEven = 4.0;
/// First look in clutter: its values are as many as the prediction says, and its interval is as good as later ones.
constexpr int kClutterTest = 2;

}  // namespace

ClutterChoice::ClutterChoice(const Lattice& lattice, const LatticeValues& values, const Contrast& contrast,
                             const TileRecall& recall, const SteeringColumns& steering)
    : lattice_(lattice),
      values_(values),
      contrast_(contrast),
      recall_(recall),
      steering_(steering),
      predicted_(static_cast<std::size_t>(lattice.domain().count()), 0.0f) {}

std::vector<std::uint8_t> ClutterChoice::choose(const AllowedErrors& errors, const LabelSpread& spread,
                                                TracedPixels& pixels) {
  std::vector<std::uint8_t> overlooking(pixels.size(), 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    if (values_.only[p] != LatticeValues::kMixed) continue;
    const std::uint32_t* labels = &values_.labels[lattice_.first_vertex(p)];
    double crossings = 0.0, squares = 0.0;
    bool even = true;
    const auto allowed = contrast_.allowed(p);
    const auto is_even = [&](std::uint32_t label) {
      for (std::size_t d = 0; d < allowed.size(); ++d)
        if (spread.local(label, steering_.list()[d]) > kEven * allowed[d] * allowed[d]) return false;
      return true;
    };
    pairs.clear();
    const auto compare = [&](std::uint32_t a, std::uint32_t b) {
      if (a == b) return;
      const double contrast = contrast_(static_cast<std::uint32_t>(p), a, b);
      crossings += 1.0;
      squares += contrast * contrast;
      const std::pair<std::uint32_t, std::uint32_t> pair = std::minmax(a, b);
      if (pairs.size() <= kFewPairs && std::find(pairs.begin(), pairs.end(), pair) == pairs.end())
        pairs.push_back(pair);
    };
    for (int j = 0; j <= k; ++j, labels += row)
      for (int i = 0; i <= k; ++i) {
        even = even && is_even(labels[i]);
        if (i < k) compare(labels[i], labels[i + 1]);
        if (j < k) compare(labels[i], labels[i + row]);
      }
    // In allowed standard errors of this pixel, which counts only in part in each output.
    const double whole =
        pixels.allowed_variance(static_cast<std::uint32_t>(p)) / errors.geometry_share(p, spread);
    const double contrast = std::sqrt(squares / (crossings * whole)),
                 border_px = crossings / crossings_per_length(k);
    const double strata = stratified_cost(contrast, border_px);
    if (kTracingCostPerCrossing * crossings >
        std::max(recall_.clutter_to_come(p, strata), kFewestStratified)) {
      if (strata <= kFewValues && pairs.size() <= kFewPairs &&
          !pixels.abandoned(static_cast<std::uint32_t>(p)))
        overlooking[p] = 1;
      else
        pixels.abandon(static_cast<std::uint32_t>(p));
    }
    predicted_[p] = static_cast<float>(strata);
    const TracingBudget& may_cost = even ? kOfBorders : kOfValues;
    const double budget = may_cost.part * stratified_cost(contrast, std::max(border_px, kLeastBorder_px));
    pixels.limit_budget(static_cast<std::uint32_t>(p), std::max(budget, may_cost.fewest));
  }
  return overlooking;
}

void ClutterChoice::expect(int pixel, std::uint32_t label, TracedPixels& pixels) {
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  const std::uint32_t* labels = &values_.labels[lattice_.first_vertex(pixel)];
  double contrast = 0.0;
  for (int j = 0; j <= k; ++j, labels += row)
    for (int i = 0; i <= k; ++i)
      contrast = std::max(contrast, contrast_(static_cast<std::uint32_t>(pixel), label, labels[i]));
  const double allowed = std::sqrt(pixels.allowed_variance(static_cast<std::uint32_t>(pixel)));
  const double strata = stratified_cost(contrast / allowed, kLeastBorder_px);
  predicted_[pixel] = std::max(predicted_[pixel], static_cast<float>(strata));
}

double ClutterChoice::first_round(const SourcePixel& pixel) const {
  return std::clamp(kFirstShare * predicted_[pixel.source], kFewestClutter, kMostFirstClutter);
}

/// Whether values have met what the traced model does not know, to an extent that matters. The rest of it, which
/// no value has met, is then likely to matter as well.
bool ClutterChoice::doubtful(const SourcePixel& pixel) const {
  if (pixel.cluttered) return false;
  const PixelModel& model = pixel.model;
  const auto allowed = contrast_.allowed(pixel.source);
  for (std::size_t s = 0; s < pixel.strata.size(); ++s) {
    const Stratum& stratum = pixel.strata[s];
    if (stratum.strays == 0.0) continue;
    double weight = 0.0;
    for (std::size_t o = 0; o < model.slots(); ++o)
      weight = std::max(weight, model.weight[s * model.slots() + o]);
    const double share = weight / std::max(static_cast<double>(stratum.count()), stratum.strays);
    for (std::size_t d = 0; d < allowed.size(); ++d) {
      const int c = steering_.list()[d];
      const double square = stratum.stray_sum[c] * stratum.stray_sum[c] + stratum.stray_squares[c];
      if (share * share * square > kDoubt * allowed[d] * allowed[d]) return true;
    }
  }
  return false;
}

bool ClutterChoice::begin_rounds(bool doubt, Radiance& radiance, std::vector<OutputState>& outputs) const {
  bool any = false;
  for (std::size_t p = 0; p < radiance.pixels().others().size(); ++p) {
    const SourcePixel& pixel = radiance.pixels().others()[p];
    if (doubt && doubtful(pixel)) {
      radiance.pixels().turn_to_clutter(p);
      recall_.recall_values(radiance, p, outputs);
    }
    if (pixel.cluttered && pixel.rounds.empty() && !pixel.model.outputs.empty()) {
      radiance.clutter().plan(p, first_round(pixel));
      for (int o : pixel.model.outputs) outputs[o].test = std::max(outputs[o].test, kClutterTest);
      any = true;
    }
  }
  return any;
}

}  // namespace ifov::sampling
