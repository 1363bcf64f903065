// Means and variances of strata from jittered values, and where those are few, from the lattice and the tile.
#include <algorithm>
#include <cmath>

#include "sampling/accuracy/radiance.h"

namespace ifov::sampling {

namespace {

/// Weight, in degrees of freedom, of the variance borrowed from the tile beside `own` degrees of a stratum's own: what
/// single values differ by on the scale of the lattice, which is far more than they do within a fine grid's cells.
double borrowed(double own) { return 8.0 / (1.0 + own * own / 64.0); }

/// So many blocks of the lattice tell how values of a label differ. Where they are fewer, other labels tell the rest, which
/// may be of another kind (a narrow penumbra beside level ground): then all that its own values differ by counts.
constexpr double kTelling = 8.0;

/// What n values have not met is rarer than x / n but for a share exp(-x) of cases. As a standard error, in units of
/// 1 / n, with room for what lies farther off than one deviation.
constexpr double kUnseen = 2.5;
/// The same where rays have met something in the pixel on a material that no value has met yet: that it is there is known.
constexpr double kKnownUnseen = 6.0;
/// Values far from the rest are taken to be one more than were met: else those strata would stop soonest that
/// happened to meet few of them, and would be wrong all the same way.
constexpr double kRareValues = 1.0, kManyValues = 8.0;

/// A label that no vertex of a pixel has may look otherwise there than at all vertices that have it: these may stand at like
/// places of a pattern. The variance that they show counts so many times.
constexpr double kElsewhere = 9.0;

}  // namespace

/// Whether looks, probes or seeds have met a material in a cluttered pixel that none of its values has met.
bool Radiance::knows_more_than_values(const Pixel& pixel) const {
  for (const Prober::Met& met : prober_.met(pixel.source)) {
    const std::uint32_t material = ledger_.field().material_of(table_.label(met.label));
    const bool has_value =
        std::any_of(pixel.rounds.begin(), pixel.rounds.end(), [&](const ClutterRound& round) {
          return std::any_of(round.materials().begin(), round.materials().end(),
                             [&](const auto& entry) { return entry.first == material; });
        });
    if (!has_value) return true;
  }
  return false;
}

double Radiance::unseen(const Pixel& pixel, std::size_t s, int column) const {
  const Stratum& stratum = pixel.strata[s];
  if (stratum.deviation.empty()) return 0.0;
  double seen = 0.0, count = pixel.cluttered ? pixel.clutter_count() : static_cast<double>(stratum.count());
  if (pixel.cluttered && !pixel.rounds.empty()) seen = pixel.rounds.back().spread(column);
  if (!pixel.cluttered && !stratum.rounds.empty()) seen = stratum.rounds.back().spread(column);
  double nearby =
      static_cast<double>(stratum.deviation[column]) * static_cast<double>(stratum.deviation[column]);
  // Strata of few values have borrowed from the tile in moments(); what many agree on may still not be all.
  const bool many = !pixel.cluttered && count >= kManyValues && spread_.blocks(stratum.label) >= kManyValues;
  if (many) nearby = std::max(nearby, spread_.local(stratum.label, column));
  const double hidden = std::max(0.0, nearby - seen);
  if (faults_.zero_variance_single_samples && count < 2.0) return 0.0;
  count = std::max(1.0, count);
  const double rare = many ? kRareValues * spread_.rare(stratum.label, column) : 0.0;
  double squared = std::min(kUnseen * kUnseen, 1.0 + count);
  if (pixel.cluttered) {
    const double missed =
        hidden > 0.0 && !pixel.rounds.empty() && knows_more_than_values(pixel) ? kKnownUnseen : kUnseen;
    squared = missed * missed;
  }
  return std::max(squared * hidden, rare) / (count * count);
}

bool Radiance::paths_differ(const Stratum& stratum, std::span<const int> columns,
                            const StratumMoments& moments) const {
  constexpr double kMost = 0.5;
  if (stratum.twins == 0.0) return false;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (stratum.twin_squares[columns[c]] / stratum.twins > kMost * moments.variance[c] &&
        moments.variance[c] > 0.0)
      return true;
  return false;
}

double Radiance::with_trend(const Pixel& pixel, std::size_t s, std::span<const int> drivers,
                            double count) const {
  const Stratum& stratum = pixel.strata[s];
  const BlockSums* const round = &stratum.rounds.back() - 1;  // the last two
  if (round[0].blocks() == 0.0 || round[1].blocks() == 0.0) return count;
  const double growth = round[1].blocks() / round[0].blocks();
  double slowest = 1.0;
  for (int column : drivers) {
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

void Radiance::moments(const Pixel& pixel, std::size_t s, std::span<const int> columns,
                       StratumMoments& out) const {
  const Stratum& stratum = pixel.strata[s];
  const std::uint32_t label = stratum.label;
  const std::size_t n = columns.size();
  out.mean.assign(n, 0.0);
  out.variance.assign(n, 0.0);
  out.share = 1.0;
  if (stratum.nets.size > 0) {
    net_moments(stratum.nets, columns, out);
    if (out.sampled) return;
  }
  out.sampled = stratum.count() > 0;

  if (out.sampled) {
    // Rounds of more values stand on finer grids, where texture makes less variance: they weigh by the squares of
    // their numbers of values, which is right for texture and costs little where paths make the variance.
    double squares = 0.0, cubes = 0.0, blocks = 0.0;
    for (const BlockSums& round : stratum.rounds) {
      squares += round.count() * round.count();
      cubes += round.count() * round.count() * round.count();
    }
    out.share = cubes / (squares * squares);
    std::vector<double> weighted(n, 0.0);
    const double told = faults_.other_labels_spread ? 1.0 : std::min(1.0, spread_.blocks(label) / kTelling);
    for (const BlockSums& round : stratum.rounds) {
      const double count = round.count();
      if (count == 0.0) continue;
      blocks += round.blocks();
      const double lent = borrowed(round.blocks());
      for (std::size_t c = 0; c < n; ++c) {
        const int column = columns[c];
        out.mean[c] += count * count / squares * round.mean(column);
        const double local = spread_.local(label, column);
        const double whole = count > 1.0 ? round.spread(column) * count / (count - 1.0) : 0.0;
        const double lent_variance = told * local + (1.0 - told) * std::max(local, whole);
        const double one = (round.squares(column) + lent * lent_variance) / (round.blocks() + lent);
        const double part = count * count * count / cubes * one;
        out.variance[c] += part;
        weighted[c] += part * part / (round.freedom(column) + lent);
      }
    }
    out.freedom = blocks + borrowed(blocks);
    for (std::size_t c = 0; c < n; ++c)
      if (weighted[c] > 0.0)
        out.freedom = std::min(out.freedom, out.variance[c] * out.variance[c] / weighted[c]);
    if (faults_.zero_variance_single_samples && blocks == 0.0)
      std::fill(out.variance.begin(), out.variance.end(), 0.0);
    return;
  }

  if (spread_.constant(label)) {
    for (std::size_t c = 0; c < n; ++c) out.mean[c] = table_.mean(label)[columns[c]];
    out.freedom = 2.0;
    return;
  }

  const Lattice& lattice = tracer_.lattice();
  const int k = lattice.cells_per_pixel(), row = lattice.columns() + 1;
  const int x = pixel.source % lattice.domain().width() * k, y = pixel.source / lattice.domain().width() * k;
  double weight = 0.0, count = 0.0;
  std::vector<double> squares(n, 0.0);
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i) {
      const std::size_t v = static_cast<std::size_t>(y + j) * row + x + i;
      if (lattice_.labels[v] != label) continue;
      const double w = (i == 0 || i == k ? 0.5 : 1.0) * (j == 0 || j == k ? 0.5 : 1.0);
      weight += w;
      count += 1.0;
      for (std::size_t c = 0; c < n; ++c) {
        const double value = lattice_.value(v)[columns[c]], old = out.mean[c];
        out.mean[c] += w / weight * (value - old);
        squares[c] += w * (value - old) * (value - out.mean[c]);
      }
    }
  for (std::size_t c = 0; c < n; ++c) {
    if (count == 0.0) out.mean[c] = table_.mean(label)[columns[c]];
    const double own = count > 1.0 ? squares[c] / weight * count / (count - 1.0)
                                   : (count == 0.0 ? kElsewhere : 1.0) * spread_.total(label, columns[c]);
    out.variance[c] = std::max(own, spread_.local(label, columns[c]));
  }
  out.freedom = std::max(2.0, count - 1.0);
  if (faults_.zero_variance_single_samples && count < 2.0)
    std::fill(out.variance.begin(), out.variance.end(), 0.0);
}

void Radiance::weigh(const Pixel& pixel, std::size_t s, const PixelFootprint& footprint, Point2 centre,
                     std::span<const int> columns, const StratumMoments& moments, WeighedMoments& out) const {
  const Stratum& stratum = pixel.strata[s];
  const std::size_t n = columns.size();
  out.share = 1.0;
  out.freedom = 0.0;
  out.variance.assign(n, 0.0);
  struct Replicate {
    double weight = 0.0, squares = 0.0;
    std::size_t count = 0;
  };
  std::vector<double> weights;
  std::vector<Replicate> replicates(stratum.rounds.size() * kRoundReplicates);
  double total = 0.0, squares = 0.0;
  for (std::size_t round = 0; round < stratum.rounds.size(); ++round) {
    const double count = stratum.rounds[round].count();
    for (const std::size_t end = weights.size() + static_cast<std::size_t>(count); weights.size() < end;) {
      const std::size_t k = stratum.samples[weights.size()];
      const double w = footprint.density(x_[k].x - centre.x, x_[k].y - centre.y) * count;
      Replicate& replicate = replicates[round * kRoundReplicates + replicates_[k]];
      replicate.weight += w;
      replicate.squares += w * w;
      ++replicate.count;
      weights.push_back(w);
      total += w;
      squares += w * w;
    }
  }
  if (total == 0.0) return;
  out.share = squares / (total * total);

  std::vector<double> sums(replicates.size() * n, 0.0);
  std::size_t i = 0;
  for (std::size_t round = 0; round < stratum.rounds.size(); ++round)
    for (const std::size_t end = i + static_cast<std::size_t>(stratum.rounds[round].count()); i < end; ++i) {
      const std::size_t k = stratum.samples[i];
      const float* value = &values_[k * stride_];
      double* sum = &sums[(round * kRoundReplicates + replicates_[k]) * n];
      for (std::size_t c = 0; c < n; ++c) sum[c] += weights[i] * value[columns[c]];
    }
  for (std::size_t c = 0; c < n; ++c) {
    double sum = 0.0;
    for (std::size_t r = 0; r < replicates.size(); ++r) sum += sums[r * n + c];
    out.mean[c] = sum / total;
  }

  constexpr double kFreedom = kRoundReplicates - 1.0;
  for (std::size_t round = 0; round < stratum.rounds.size(); ++round) {
    const std::span<const Replicate> own(&replicates[round * kRoundReplicates], kRoundReplicates);
    double weight = 0.0, own_squares = 0.0;
    for (const Replicate& replicate : own) weight += replicate.weight, own_squares += replicate.squares;
    // Sequences of a few values stratify nothing, and a round without all of them cannot tell.
    constexpr std::size_t kFewest = 4;
    if (std::any_of(own.begin(), own.end(),
                    [](const Replicate& r) { return r.count < kFewest || r.weight == 0.0; })) {
      for (std::size_t c = 0; c < n; ++c)
        out.variance[c] += moments.variance[c] * own_squares / (total * total);
      continue;
    }
    out.freedom = kFreedom;
    for (std::size_t c = 0; c < n; ++c) {
      const double* sum = &sums[round * kRoundReplicates * n + c];
      double all = 0.0, apart = 0.0;
      for (std::uint32_t r = 0; r < kRoundReplicates; ++r) all += sum[r * n];
      for (std::uint32_t r = 0; r < kRoundReplicates; ++r) {
        const double difference = (sum[r * n] - all / weight * own[r].weight) / total;
        apart += difference * difference;
      }
      out.variance[c] += kRoundReplicates / kFreedom * apart;
    }
  }
}

}  // namespace ifov::sampling
