#include "sampling/accuracy/radiance/stratum_moments.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/radiance_nets.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/radiance/strata.h"

namespace ifov::sampling {

namespace {

/// Weight, in degrees of freedom, of the variance borrowed from the tile beside `own` degrees of a stratum's own: what
/// single values differ by on the scale of the lattice, which is far more than they do within a fine grid's cells.
double borrowed(double own) { return 8.0 / (1.0 + own * own / 64.0); }

/// So many blocks of the lattice tell how values of a label differ. Where they are fewer, other labels tell the rest, which
/// may be of another kind (a narrow penumbra beside level ground): then all that its own values differ by counts.
constexpr double kTelling = 8.0;

/// A label that no vertex of a pixel has may look otherwise there than at all vertices that have it: these may stand at like
/// places of a pattern. The variance that they show counts so many times.
constexpr double kElsewhere = 9.0;

/// Values that stand in no block count where with them values differ so many times as much (in variance); a single one of them is then most of
/// what is known of that, like a block that holds most of the variance.
constexpr double kAlone = 4.0, kAloneFreedom = 3.0;
/// What rounding alone does not make values differ by, in parts of their squared mean.
constexpr double kDiffer = 1e-9;

}  // namespace

StratumEstimates::StratumEstimates(const Lattice& lattice, const LatticeValues& values,
                                   const LabelTable& table, const LabelSpread& spread)
    : lattice_(lattice), values_(values), table_(table), spread_(spread), level_(table.columns(), 0.0) {
  double count = 0.0;
  for (std::uint32_t label = 0; label < table.size(); ++label) {
    if (table.count(label) == 0) continue;
    count += table.count(label);
    for (std::size_t c = 0; c < level_.size(); ++c)
      level_[c] += table.count(label) / count * (std::abs(table.mean(label)[c]) - level_[c]);
  }
}

double StratumEstimates::told(const Stratum& stratum) const {
  return spread_.constant(stratum.label) ? 1.0 : std::min(1.0, spread_.blocks(stratum.label) / kTelling);
}

/// No less than what values of a label may differ by of which the lattice tells too little.
void StratumEstimates::widen_untold(const Stratum& stratum, std::span<const int> columns,
                                    std::span<double> variance) const {
  const double told = this->told(stratum);
  if (!doubts_ || told >= 1.0 || stratum.foretold()) return;
  const auto known = learnt_.find(stratum.label);
  const double seen = std::max(1.0, static_cast<double>(table_.count(stratum.label))) - 1.0,
               share = (1.0 - told) * std::max(0.0, 1.0 - seen / kTelling);
  const double* mean = table_.mean(stratum.label);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const int column = columns[c];
    const double whole = std::max(std::abs(mean[column]), level_[column]);
    variance[c] =
        std::max(variance[c], known != learnt_.end() ? known->second[column] : share * whole * whole);
  }
}

bool StratumEstimates::paths_differ(const Stratum& stratum, std::span<const int> columns,
                                    const StratumMoments& moments) {
  constexpr double kMost = 0.5;
  if (stratum.twins == 0.0) return false;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (stratum.twin_squares[columns[c]] / stratum.twins > kMost * moments.variance[c] &&
        moments.variance[c] > 0.0)
      return true;
  return false;
}

double StratumEstimates::with_trend(const Stratum& stratum, std::span<const int> steering_channels,
                                    double count) {
  const BlockSums* const round = &stratum.rounds.back() - 1;  // the last two
  if (round[0].blocks() == 0.0 || round[1].blocks() == 0.0) return count;
  const double growth = round[1].blocks() / round[0].blocks();
  double slowest = 1.0;
  for (int column : steering_channels) {
    const double variance[2] = {round[0].squares(column) / round[0].blocks(),
                                round[1].squares(column) / round[1].blocks()};
    if (variance[1] == 0.0) continue;
    const double fall =
        growth > 1.5 && variance[0] > 0.0 ? std::log(variance[0] / variance[1]) / std::log(growth) : 0.0;
    slowest = std::min(slowest, std::clamp(fall, 0.0, 1.0));
  }
  const double have = static_cast<double>(stratum.count());
  return count <= have ? count : have * std::pow(count / have, 1.0 / (1.0 + slowest));
}

void StratumEstimates::moments(const SourcePixel& pixel, std::size_t s, std::span<const int> columns,
                               StratumMoments& out) const {
  const Stratum& stratum = pixel.strata[s];
  const std::size_t n = columns.size();
  out.mean.assign(n, 0.0);
  out.variance.assign(n, 0.0);
  out.share = 1.0;
  if (stratum.nets.size > 0) RadianceNets::moments(stratum.nets, columns, out);
  if (stratum.nets.size == 0 || !out.sampled) {
    out.sampled = stratum.count() > 0;
    if (out.sampled)
      of_values(stratum, columns, out);
    else
      of_lattice(pixel, stratum, columns, out);
  }
  if (stratum.foretold())
    for (std::size_t c = 0; c < n; ++c) out.mean[c] += stratum.control.mean[columns[c]];
}

void StratumEstimates::of_values(const Stratum& stratum, std::span<const int> columns,
                                 StratumMoments& out) const {
  const std::uint32_t label = stratum.label;
  const std::size_t n = columns.size();
  // Rounds of n values stand on finer grids the more they are, where texture makes less variance: they weigh by n^(3/2), between n^2,
  // which is right for texture, and n, which is where paths make the variance.
  const auto weight_of = [](const BlockSums& round) { return round.count() * std::sqrt(round.count()); };
  double weights = 0.0, squares = 0.0, blocks = 0.0, lent_freedom = 0.0;
  for (const BlockSums& round : stratum.rounds) {
    weights += weight_of(round);
    squares += round.count() * round.count();
  }
  out.share = squares / (weights * weights);
  std::vector<double> weighted(n, 0.0);
  const LabelSpread& spread = spread_.rest_if(stratum.foretold());
  const double told = std::min(1.0, spread.blocks(label) / kTelling);
  for (const BlockSums& round : stratum.rounds) {
    const double count = round.count();
    if (count == 0.0) continue;
    blocks += round.blocks();
    const double lent = borrowed(round.blocks());
    // What values differ by among themselves is no better known than by so many.
    const double sure = told * lent + (1.0 - told) * std::clamp(count - 1.0 - round.blocks(), 0.0, lent);
    lent_freedom += sure;
    for (std::size_t c = 0; c < n; ++c) {
      const int column = columns[c];
      out.mean[c] += weight_of(round) / weights * round.mean(column);
      const double local = spread.local(label, column);
      const double whole = count > 1.0 ? round.spread(column) * count / (count - 1.0) : 0.0;
      const double lent_variance = told * local + (1.0 - told) * std::max(local, whole);
      const double squares_told = round.squares(column) + lent * lent_variance,
                   told_by = round.blocks() + lent;
      double one = squares_told / told_by, freedom = round.freedom(column) + sure;
      // A far value that happens to stand in no block is no less of what values differ by, nor are two in one row of a block, which
      // no plane's rest shows.
      double all = (squares_told + round.squares_alone(column)) / (told_by + round.alone());
      if (round.squares(column) == 0.0 && whole > kDiffer * round.mean(column) * round.mean(column))
        all = std::max(all, whole);
      if (all > kAlone * one && alone_tell()) one = all, freedom = std::min(freedom, kAloneFreedom);
      const double part = count * count / squares * one;
      out.variance[c] += part;
      weighted[c] += part * part / std::max(1.0, freedom);
    }
  }
  out.freedom = std::max(1.0, blocks + std::min(borrowed(blocks), lent_freedom));
  for (std::size_t c = 0; c < n; ++c)
    if (weighted[c] > 0.0 && table_.decides(columns[c]))
      out.freedom = std::min(out.freedom, out.variance[c] * out.variance[c] / weighted[c]);
}

void StratumEstimates::of_lattice(const SourcePixel& pixel, const Stratum& stratum,
                                  std::span<const int> columns, StratumMoments& out) const {
  const std::size_t n = columns.size();
  const std::uint32_t label = stratum.label;
  const bool foretold = stratum.foretold();
  const LabelSpread& spread = spread_.rest_if(foretold);
  if (spread_.constant(label)) {
    for (std::size_t c = 0; c < n; ++c) out.mean[c] = table_.mean(label)[columns[c]];
    out.freedom = 2.0;
    return;
  }

  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  const int x = pixel.source % lattice_.domain().width() * k,
            y = pixel.source / lattice_.domain().width() * k;
  double weight = 0.0, count = 0.0;
  std::vector<double> squares(n, 0.0);
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i) {
      const std::size_t v = static_cast<std::size_t>(y + j) * row + x + i;
      if (values_.labels[v] != label) continue;
      const double w = (i == 0 || i == k ? 0.5 : 1.0) * (j == 0 || j == k ? 0.5 : 1.0);
      weight += w;
      count += 1.0;
      for (std::size_t c = 0; c < n; ++c) {
        const double value = values_.value_or_rest(v, foretold)[columns[c]], old = out.mean[c];
        out.mean[c] += w / weight * (value - old);
        squares[c] += w * (value - old) * (value - out.mean[c]);
      }
    }
  for (std::size_t c = 0; c < n; ++c) {
    // Rests are fitted to a mean of 0.
    if (count == 0.0 && !foretold) out.mean[c] = table_.mean(label)[columns[c]];
    const double own = count > 1.0 ? squares[c] / weight * count / (count - 1.0)
                                   : (count == 0.0 ? kElsewhere : 1.0) * spread.total(label, columns[c]);
    out.variance[c] = std::max(own, spread.local(label, columns[c]));
  }
  widen_untold(stratum, columns, out.variance);
  out.freedom = std::max(2.0, count - 1.0);
}

}  // namespace ifov::sampling
