#include "atmosphere/gas/term_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "atmosphere/gas/band_model.h"

namespace ifov::atmosphere {
namespace {

/// Lengths of path, over the vertical, at which joined terms shall still transmit as before.
constexpr std::array<double, 6> kAirMasses{0.002, 0.02, 0.15, 0.5, 1.5, 4.0};

struct Joint {
  double weight = 0.0;
  std::array<double, kAirMasses.size()> transmittance{};  // weighted means
  std::vector<std::size_t> members;
};

double joining_cost(const Joint& a, const Joint& b) {
  double difference = 0.0;
  for (std::size_t s = 0; s < kAirMasses.size(); ++s) {
    const double d = a.transmittance[s] - b.transmittance[s];
    difference += d * d;
  }
  return a.weight * b.weight / (a.weight + b.weight) * difference;
}

void join(Joint& a, const Joint& b) {
  const double sum = a.weight + b.weight;
  for (std::size_t s = 0; s < kAirMasses.size(); ++s)
    a.transmittance[s] = (a.weight * a.transmittance[s] + b.weight * b.transmittance[s]) / sum;
  a.weight = sum;
  a.members.insert(a.members.end(), b.members.begin(), b.members.end());
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Neighbours in the order of their depth joined, always the pair that changes transmittance least.
std::vector<Joint> joined(const AbsorptionSet& set, std::size_t most) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t j = 0; j < set.terms(); ++j) order.emplace_back(sum_of(set.depth[j]), j);
  std::sort(order.begin(), order.end());
  std::vector<Joint> joints;
  for (const auto& [depth, j] : order) {
    Joint joint{set.weight[j], {}, {j}};
    for (std::size_t s = 0; s < kAirMasses.size(); ++s)
      joint.transmittance[s] = std::exp(-kAirMasses[s] * depth);
    joints.push_back(std::move(joint));
  }
  while (joints.size() > most) {
    std::size_t best = 0;
    double least = joining_cost(joints[0], joints[1]);
    for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
      const double cost = joining_cost(joints[i], joints[i + 1]);
      if (cost < least) least = cost, best = i;
    }
    join(joints[best], joints[best + 1]);
    joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(best) + 1);
  }
  return joints;
}

AbsorptionSet grey(const std::vector<double>& depth) { return {{1.0}, {depth}}; }

AbsorptionSet terms_of(const ActiveBand& active, const std::vector<GasAmounts>& layers, double column,
                       int terms) {
  const double x = active.coefficient * column;
  const double exponent = std::pow(x, active.a);
  std::vector<double> depth(layers.size());
  for (std::size_t l = 0; l < layers.size(); ++l) depth[l] = active.coefficient * layers[l].band[active.band];
  const auto times = [&](double factor) {
    std::vector<double> scaled = depth;
    for (double& d : scaled) d *= factor;
    return scaled;
  };
  if (1.0 - std::exp(-exponent) < kGreyAbsorption) return grey(times(x > 0.0 ? exponent / x : 0.0));
  const AbsorptionTerms& fit = absorption_terms(active.a, terms);
  AbsorptionSet set{fit.weight, {}};
  for (const double k : fit.k) set.depth.push_back(times(k));
  return set;
}

}  // namespace

AbsorptionSet overlapped(const AbsorptionSet& first, const AbsorptionSet& second, int most_terms) {
  AbsorptionSet product;
  for (std::size_t i = 0; i < first.terms(); ++i)
    for (std::size_t j = 0; j < second.terms(); ++j) {
      product.weight.push_back(first.weight[i] * second.weight[j]);
      product.depth.push_back(first.depth[i]);
      for (std::size_t l = 0; l < product.depth.back().size(); ++l)
        product.depth.back()[l] += second.depth[j][l];
    }
  if (product.terms() <= static_cast<std::size_t>(most_terms)) return product;
  AbsorptionSet reduced;
  for (const Joint& joint : joined(product, static_cast<std::size_t>(most_terms))) {
    std::vector<double> mean(product.depth[0].size());
    for (const std::size_t member : joint.members)
      for (std::size_t l = 0; l < mean.size(); ++l)
        mean[l] += product.weight[member] / joint.weight * product.depth[member][l];
    reduced.weight.push_back(joint.weight);
    reduced.depth.push_back(std::move(mean));
  }
  return reduced;
}

AbsorptionSet line_absorption(double wavenumber_cm1, const std::vector<GasAmounts>& layers, GasModel model,
                              int terms, int most_terms) {
  struct Contribution {
    double exponent = 0.0;
    AbsorptionSet set;
  };
  std::vector<Contribution> gases;
  for (const ActiveBand& active : active_bands(wavenumber_cm1, model)) {
    double column = 0.0;
    for (const GasAmounts& layer : layers) column += layer.band[active.band];
    gases.push_back(
        {std::pow(active.coefficient * column, active.a), terms_of(active, layers, column, terms)});
  }
  std::stable_sort(gases.begin(), gases.end(),
                   [](const Contribution& a, const Contribution& b) { return a.exponent > b.exponent; });
  AbsorptionSet total = grey(std::vector<double>(layers.size(), 0.0));
  for (const Contribution& gas : gases) total = overlapped(total, gas.set, most_terms);
  return total;
}

}  // namespace ifov::atmosphere
