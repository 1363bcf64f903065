#include "sampling/accuracy/radiance/unseen_values.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/edges/probing.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/radiance/standout_values.h"
#include "sampling/accuracy/radiance/strata.h"

namespace ifov::sampling {

namespace {

/// What n values have not met is rarer than x / n but for a share exp(-x) of cases. As a standard error, in units of
/// 1 / n, with room for what lies farther off than one deviation.
constexpr double kUnseen = 3.4;
/// The same where rays have met something in the pixel on a material that no value has met yet: that it is there is known.
constexpr double kKnownUnseen = 6.9;
/// Values far from the rest are taken to be one more than were met: else those strata would stop soonest that
/// happened to meet few of them, and would be wrong all the same way.
constexpr double kRareValues = 1.3, kManyValues = 8.0;
/// A far value that one of the vertices in a pixel and those around it has met makes the square of what they differ by at least this
/// part of its own.
constexpr double kThereabouts = 256.0;
/// What is known to be there, and farther from the mean than any of n values: its 95 % interval is that of the 3.4 / n at which n
/// values meet none in one of thirty cases.
constexpr double kKnownFar = 1.72;
/// Of labels that are uneven, values as rare as one of so many are known.
constexpr double kRarest = 16.0;

/// Whether a cluttered pixel has values on no other materials than another.
bool is_of(const SourcePixel& pixel, const SourcePixel& other) {
  const auto has = [&](std::uint32_t material) {
    return std::any_of(other.rounds.begin(), other.rounds.end(), [&](const ClutterRound& round) {
      return std::any_of(round.materials().begin(), round.materials().end(),
                         [&](const auto& entry) { return entry.first == material; });
    });
  };
  return std::all_of(pixel.rounds.begin(), pixel.rounds.end(), [&](const ClutterRound& round) {
    return std::all_of(round.materials().begin(), round.materials().end(),
                       [&](const auto& entry) { return has(entry.first); });
  });
}

}  // namespace

/// Whether random rays, probes or pilot rays have met a material in a cluttered pixel that none of its values has met.
bool UnseenValues::knows_more_than_values(const SourcePixel& pixel) const {
  for (const Prober::Met& met : prober_.met(pixel.source)) {
    const std::uint32_t material = field_.material_of(table_.label(met.label));
    const bool has_value =
        std::any_of(pixel.rounds.begin(), pixel.rounds.end(), [&](const ClutterRound& round) {
          return std::any_of(round.materials().begin(), round.materials().end(),
                             [&](const auto& entry) { return entry.first == material; });
        });
    if (!has_value) return true;
  }
  return false;
}

double UnseenValues::mean_of(std::uint32_t label, int column) const { return table_.mean(label)[column]; }

const UnseenValues::Range& UnseenValues::range_of(std::uint32_t of) const {
  const auto where = [this](std::uint32_t label) {
    return std::pair{field_.material_of(table_.label(label)), field_.object_of(table_.label(label))};
  };
  const auto [known, fresh] = ranges_.try_emplace(where(of));
  Range& range = known->second;
  if (!fresh) return range;
  range.low.assign(table_.columns(), INFINITY);
  range.high.assign(table_.columns(), -INFINITY);
  for (std::uint32_t label = 0; label < spread_.labels(); ++label) {
    if (table_.count(label) == 0 || where(label) != known->first) continue;
    for (std::size_t c = 0; c < table_.columns(); ++c) {
      range.low[c] = std::min(range.low[c], spread_.lowest(label, static_cast<int>(c)));
      range.high[c] = std::max(range.high[c], table_.mean(label)[c]);
    }
  }
  return range;
}

double UnseenValues::farthest_of(std::uint32_t label, int column, double mean) const {
  const double distance = table_.mean(label)[column] - mean, square = distance * distance;
  if (!field_.uneven(table_.label(label))) return square;
  // The rarer of two values that would make the label's mean and variance.
  const double all = square + spread_.total(label, column),
               rarer = all < kRarest * square ? all * all / square : kRarest * all;
  const Range& range = range_of(label);
  const double low = mean - range.low[static_cast<std::size_t>(column)],
               high = range.high[static_cast<std::size_t>(column)] - mean,
               beyond = std::max({low, high, 0.0});
  return std::max(rarer, beyond * beyond);
}

double UnseenValues::known_farther(const SourcePixel& pixel, int column) const {
  if (pixel.rounds.empty()) return 0.0;
  double met = 0.0, mean = 0.0;
  for (const ClutterRound& round : pixel.rounds) {
    const double count = static_cast<double>(round.count());
    met += round.spread(column) * count;
    mean += round.moment(column).mean * count / pixel.clutter_count();
  }
  const Stratum& stratum = pixel.strata.front();
  double farthest = stratum.strays > 0.0 ? stratum.stray_squares[column] / stratum.strays : 0.0;
  for (const Prober::Met& ray : prober_.met(pixel.source))
    farthest = std::max(farthest, farthest_of(ray.label, column, mean));
  farthest = std::max(
      farthest, standouts_.farthest_square(pixel.source, column, mean, pixel.clutter_count() / kKnownFar));
  return farthest > met ? farthest : 0.0;
}

double UnseenValues::rare_beside(const SourcePixel& pixel, const Stratum& stratum, int column,
                                 double count) const {
  // Rests of what maps foretell are no values like those of pixels where nothing is foretold.
  if (stratum.foretold()) return 0.0;
  double farthest = 0.0, own = 0.0, blocks = 0.0;
  const auto rare_in = [&](const BlockSums& round) {
    return round.blocks() >= kManyValues ? round.rare(column) : 0.0;
  };
  const auto add = [&](const BlockSums& round) { own += round.squares(column), blocks += round.blocks(); };
  for (const SourcePixel* other : pixel.beside) {
    // What contradicted the model there may be here, too.
    for (const Stratum& like : other->strata)
      if (like.strays > 0.0) farthest = std::max(farthest, like.stray_squares[column] / like.strays);
    if (other->cluttered != pixel.cluttered) continue;
    double found = 0.0;
    for (const ClutterRound& round : other->rounds) found = std::max(found, rare_in(round.sums()));
    for (const Stratum& like : other->strata)
      if (!pixel.cluttered && like.label == stratum.label)
        for (const BlockSums& round : like.rounds) found = std::max(found, rare_in(round));
    if (found > farthest && (!pixel.cluttered || is_of(*other, pixel))) farthest = found;
  }
  for (const BlockSums& round : stratum.rounds) add(round);
  for (const ClutterRound& round : pixel.rounds) add(round.sums());
  // One such value more would make a variance of farthest / count.
  return blocks > 0.0 ? std::max(0.0, farthest - count * own / blocks) : 0.0;
}

double UnseenValues::variance(const SourcePixel& pixel, std::size_t s, int column) const {
  const Stratum& stratum = pixel.strata[s];
  if (stratum.deviation.empty()) return 0.0;
  double seen = 0.0, count = pixel.cluttered ? pixel.clutter_count() : static_cast<double>(stratum.count());
  if (pixel.cluttered && !pixel.rounds.empty()) seen = pixel.rounds.back().spread(column);
  if (!pixel.cluttered && !stratum.rounds.empty()) seen = stratum.rounds.back().spread(column);
  const double deviation2 =
      static_cast<double>(stratum.deviation[column]) * static_cast<double>(stratum.deviation[column]);
  double nearby = deviation2;
  const LabelSpread& spread = spread_.rest_if(stratum.foretold());
  // Strata of few values have borrowed from the tile in moments(); what many agree on may still not be all.
  const bool many = !pixel.cluttered && count >= kManyValues && spread.blocks(stratum.label) >= kManyValues;
  if (many) nearby = std::max(nearby, spread.local(stratum.label, column));
  const double hidden = std::max(0.0, nearby - seen);
  count = std::max(1.0, count);
  double rare = many ? kRareValues * spread.rare(stratum.label, column) : 0.0;
  // Where none of the many vertices thereabouts has met any, the pixel is like the rest of the tile, in which n values differ
  // from their label's mean by as much.
  if (rare > kThereabouts * deviation2) rare = std::min(rare, count * spread.local(stratum.label, column));
  if (many || (pixel.cluttered && count >= kManyValues))
    rare = std::max(rare, rare_beside(pixel, stratum, column, count));
  if (pixel.cluttered) rare = std::max(rare, kKnownFar * kKnownFar * known_farther(pixel, column));
  double squared = std::min(kUnseen * kUnseen, 1.0 + count);
  if (pixel.cluttered) {
    const double missed =
        hidden > 0.0 && !pixel.rounds.empty() && knows_more_than_values(pixel) ? kKnownUnseen : kUnseen;
    squared = missed * missed;
  }
  return std::max(squared * hidden, rare) / (count * count);
}

}  // namespace ifov::sampling
