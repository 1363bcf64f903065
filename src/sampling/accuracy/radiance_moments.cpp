// Means and variances of strata from jittered values, and where those are few, from the lattice and the tile.
#include <algorithm>
#include <cmath>

#include "sampling/accuracy/radiance.h"

namespace ifov::sampling {

namespace {

/// Weight, in degrees of freedom, of the variance borrowed from the tile beside `own` degrees of a stratum's own: what
/// single values differ by on the scale of the lattice, which is far more than they do within a fine grid's cells.
double borrowed(double own) { return 8.0 / (1.0 + own * own / 64.0); }

}  // namespace

Radiance::Block Radiance::block_at(const Stratum& stratum, std::size_t b) const {
  const std::size_t begin = stratum.block_starts[b];
  const std::size_t end =
      b + 1 < stratum.block_starts.size() ? stratum.block_starts[b + 1] : stratum.samples.size();
  Block block;
  block.count = std::min<std::size_t>(end - begin, 4);
  block.full = stratum.full_block[b] != 0;
  for (std::size_t i = 0; i < block.count; ++i)
    block.value[i] = &values_[stratum.samples[begin + i] * stride_];
  return block;
}

Radiance::Round Radiance::round_of(const Stratum& stratum, std::size_t r) const {
  const auto sample = [&](std::size_t block) {
    return block < stratum.block_starts.size() ? stratum.block_starts[block] : stratum.samples.size();
  };
  const std::size_t first = stratum.round_starts[r];
  const std::size_t last =
      r + 1 < stratum.round_starts.size() ? stratum.round_starts[r + 1] : stratum.block_starts.size();
  return {first, last, sample(first), sample(last)};
}

/// One degree of freedom about the variance of a value: of four quarters what a plane does not explain, of
/// fewer values half the square of a difference.
double Radiance::block_square(const Block& block, int k) {
  const float* const* v = block.value;
  if (!block.full) {
    const double difference = static_cast<double>(v[0][k]) - v[1][k];
    return 0.5 * difference * difference;
  }
  const double twist = (static_cast<double>(v[0][k]) - v[1][k]) - (static_cast<double>(v[2][k]) - v[3][k]);
  return 0.25 * twist * twist;
}

bool Radiance::paths_differ(const Stratum& stratum, std::span<const int> columns,
                            const StratumMoments& moments) const {
  constexpr double kMost = 0.5;
  if (stratum.twins == 0.0) return false;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (stratum.twin_squares[columns[c]] / stratum.twins > kMost * moments.variance[c] && moments.variance[c] > 0.0)
      return true;
  return false;
}

double Radiance::with_trend(const Pixel& pixel, std::size_t s, std::span<const int> drivers,
                            double count) const {
  const Stratum& stratum = pixel.strata[s];
  const std::size_t rounds = stratum.round_starts.size();
  const std::size_t first[3] = {stratum.round_starts[rounds - 2], stratum.round_starts[rounds - 1],
                                stratum.block_starts.size()};
  if (first[0] == first[1] || first[1] == first[2]) return count;
  const double growth = static_cast<double>(first[2] - first[1]) / static_cast<double>(first[1] - first[0]);
  double slowest = 1.0;
  for (int column : drivers) {
    double variance[2] = {0.0, 0.0};
    for (int r = 0; r < 2; ++r) {
      double blocks = 0.0;
      for (std::size_t b = first[r]; b < first[r + 1]; ++b) {
        const Block block = block_at(stratum, b);
        if (block.count < 2) continue;
        variance[r] += block_square(block, column);
        blocks += 1.0;
      }
      variance[r] /= std::max(1.0, blocks);
    }
    if (variance[1] == 0.0) continue;
    const double fall =
        growth > 1.5 && variance[0] > 0.0 ? std::log(variance[0] / variance[1]) / std::log(growth) : 0.0;
    slowest = std::min(slowest, std::clamp(fall, 0.0, 1.0));
  }
  const double have = static_cast<double>(stratum.samples.size());
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
  out.sampled = !stratum.samples.empty();

  if (out.sampled) {
    // Rounds of more values stand on finer grids, where texture makes less variance: they weigh by the squares of
    // their numbers of values, which is right for texture and costs little where paths make the variance.
    double squares = 0.0, cubes = 0.0, blocks = 0.0;
    for (std::size_t r = 0; r < stratum.round_starts.size(); ++r) {
      const double count = static_cast<double>(round_of(stratum, r).count());
      squares += count * count;
      cubes += count * count * count;
    }
    out.share = cubes / (squares * squares);
    std::vector<double> round_variance(n), fourth(n), weighted(n, 0.0);
    for (std::size_t r = 0; r < stratum.round_starts.size(); ++r) {
      const Round round = round_of(stratum, r);
      if (round.count() == 0) continue;
      const double count = static_cast<double>(round.count());
      for (std::size_t i = round.first_sample; i < round.last_sample; ++i)
        for (std::size_t c = 0; c < n; ++c)
          out.mean[c] += count / squares * values_[stratum.samples[i] * stride_ + columns[c]];
      std::fill(round_variance.begin(), round_variance.end(), 0.0);
      std::fill(fourth.begin(), fourth.end(), 0.0);
      double pairs = 0.0;
      for (std::size_t b = round.first_block; b < round.last_block; ++b) {
        const Block block = block_at(stratum, b);
        if (block.count < 2) continue;
        for (std::size_t c = 0; c < n; ++c) {
          const double square = block_square(block, columns[c]);
          round_variance[c] += square;
          fourth[c] += square * square;
        }
        pairs += 1.0;
      }
      blocks += pairs;
      const double lent = borrowed(pairs);
      // Where a few blocks hold most of the variance (a shadow's edge within the label), few degrees of freedom
      // are behind it: a square with one degree has a third of its own square's expectation as its squared
      // expectation.
      for (std::size_t c = 0; c < n; ++c) {
        double freedom = pairs;
        if (fourth[c] > 0.0) freedom = std::min(freedom, 3.0 * round_variance[c] * round_variance[c] / fourth[c]);
        const double one =
            (round_variance[c] + lent * spread_.local(label, columns[c])) / (pairs + lent);
        const double part = count * count * count / cubes * one;
        out.variance[c] += part;
        weighted[c] += part * part / (freedom + lent);
      }
    }
    out.freedom = blocks + borrowed(blocks);
    for (std::size_t c = 0; c < n; ++c)
      if (weighted[c] > 0.0) out.freedom = std::min(out.freedom, out.variance[c] * out.variance[c] / weighted[c]);
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
        const double value = lattice_.values[v * stride_ + columns[c]], old = out.mean[c];
        out.mean[c] += w / weight * (value - old);
        squares[c] += w * (value - old) * (value - out.mean[c]);
      }
    }
  for (std::size_t c = 0; c < n; ++c) {
    if (count == 0.0) out.mean[c] = table_.mean(label)[columns[c]];
    const double own =
        count > 1.0 ? squares[c] / weight * count / (count - 1.0) : spread_.total(label, columns[c]);
    out.variance[c] = std::max(own, spread_.local(label, columns[c]));
  }
  out.freedom = std::max(2.0, count - 1.0);
  if (faults_.zero_variance_single_samples && count < 2.0)
    std::fill(out.variance.begin(), out.variance.end(), 0.0);
}

double Radiance::weigh(const Pixel& pixel, std::size_t s, const PixelFootprint& footprint, Point2 centre,
                       std::span<const int> columns, std::vector<double>& mean) const {
  const Stratum& stratum = pixel.strata[s];
  double sum = 0.0, squares = 0.0;
  std::vector<double> weights;
  for (std::size_t r = 0; r < stratum.round_starts.size(); ++r) {
    const Round round = round_of(stratum, r);
    for (std::size_t k = round.first_sample; k < round.last_sample; ++k) {
      const Point2 at = x_[stratum.samples[k]];
      const double w = footprint.density(at.x - centre.x, at.y - centre.y) * static_cast<double>(round.count());
      weights.push_back(w);
      sum += w;
      squares += w * w;
    }
  }
  if (sum == 0.0) return 1.0;
  std::fill(mean.begin(), mean.end(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t c = 0; c < columns.size(); ++c)
      mean[c] += weights[i] / sum * values_[stratum.samples[i] * stride_ + columns[c]];
  return squares / (sum * sum);
}

}  // namespace ifov::sampling
