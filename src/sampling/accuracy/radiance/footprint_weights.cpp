#include "sampling/accuracy/radiance/footprint_weights.h"

#include <algorithm>

#include "sampling/accuracy/radiance/radiance_rounds.h"
#include "sampling/accuracy/radiance/strata.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/pixel_footprint.h"

namespace ifov::sampling {

void weigh_by_footprint(const Stratum& stratum, const KeptValues& kept, const PixelFootprint& footprint,
                        Point2 centre, std::span<const int> columns, std::span<const std::size_t> own,
                        const StratumMoments& moments, WeighedMoments& out) {
  const std::size_t n = own.size();
  out.share = 1.0;
  out.freedom = 0.0;
  out.weighing = 1.0;
  out.variance.resize(columns.size());
  for (const std::size_t c : own) out.variance[c] = 0.0;
  struct Replicate {
    double weight = 0.0, squares = 0.0;
    std::size_t count = 0;
  };
  std::vector<double> weights, densities;
  std::vector<Replicate> replicates(stratum.rounds.size() * RadianceRounds::kReplicates);
  double total = 0.0, squares = 0.0;
  for (std::size_t round = 0; round < stratum.rounds.size(); ++round) {
    const double count = stratum.rounds[round].count();
    for (const std::size_t end = weights.size() + static_cast<std::size_t>(count); weights.size() < end;) {
      const std::size_t k = stratum.samples[weights.size()];
      densities.push_back(footprint.density(kept.x[k].x - centre.x, kept.x[k].y - centre.y));
      const double w = densities.back() * count;
      Replicate& replicate = replicates[round * RadianceRounds::kReplicates + kept.replicates[k]];
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
  constexpr double kWeighs = 0.1;
  const double least = kWeighs * *std::max_element(densities.begin(), densities.end());
  out.weighing = static_cast<double>(
      std::count_if(densities.begin(), densities.end(), [&](double density) { return density >= least; }));

  const std::size_t stride = kept.values.size() / kept.x.size();
  std::vector<double> sums(replicates.size() * n, 0.0);
  std::size_t i = 0;
  for (std::size_t round = 0; round < stratum.rounds.size(); ++round)
    for (const std::size_t end = i + static_cast<std::size_t>(stratum.rounds[round].count()); i < end; ++i) {
      const std::size_t sample = stratum.samples[i];
      const float* value = &kept.values[sample * stride];
      double* sum = &sums[(round * RadianceRounds::kReplicates + kept.replicates[sample]) * n];
      for (std::size_t k = 0; k < n; ++k) sum[k] += weights[i] * value[columns[own[k]]];
    }
  for (std::size_t k = 0; k < n; ++k) {
    double sum = 0.0;
    for (std::size_t r = 0; r < replicates.size(); ++r) sum += sums[r * n + k];
    out.mean[own[k]] = sum / total;
  }

  constexpr double kFreedom = RadianceRounds::kReplicates - 1.0;
  for (std::size_t round = 0; round < stratum.rounds.size(); ++round) {
    const std::span<const Replicate> of_round(&replicates[round * RadianceRounds::kReplicates],
                                              RadianceRounds::kReplicates);
    double weight = 0.0, own_squares = 0.0;
    for (const Replicate& replicate : of_round) weight += replicate.weight, own_squares += replicate.squares;
    // Sequences of a few values stratify nothing, and a round without all of them cannot tell.
    constexpr std::size_t kFewest = 4;
    if (std::any_of(of_round.begin(), of_round.end(),
                    [](const Replicate& r) { return r.count < kFewest || r.weight == 0.0; })) {
      for (const std::size_t c : own) out.variance[c] += moments.variance[c] * own_squares / (total * total);
      continue;
    }
    out.freedom = kFreedom;
    for (std::size_t k = 0; k < n; ++k) {
      const double* sum = &sums[round * RadianceRounds::kReplicates * n + k];
      double all = 0.0, apart = 0.0;
      for (std::uint32_t r = 0; r < RadianceRounds::kReplicates; ++r) all += sum[r * n];
      for (std::uint32_t r = 0; r < RadianceRounds::kReplicates; ++r) {
        const double difference = (sum[r * n] - all / weight * of_round[r].weight) / total;
        apart += difference * difference;
      }
      out.variance[own[k]] += RadianceRounds::kReplicates / kFreedom * apart;
    }
  }
}

}  // namespace ifov::sampling
