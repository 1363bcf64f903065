#include "atmosphere/gas/term_joining.h"

#include <array>
#include <cmath>
#include <limits>

namespace ifov::atmosphere {
namespace {

/// Lengths of path over the vertical, for all the layers and for a part of them.
constexpr std::array<double, 6> kWholeAirMasses{0.002, 0.02, 0.15, 0.5, 1.5, 4.0};
constexpr std::array<double, 3> kPartAirMasses{0.1, 1.0, 4.0};
constexpr std::size_t kParts = 3;
constexpr std::size_t kPaths = kWholeAirMasses.size() + kParts * kPartAirMasses.size();
using Transmittances = std::array<double, kPaths>;

Transmittances transmittances_of(const std::vector<double>& depth) {
  const std::size_t layers = depth.size();
  double all = 0.0;
  std::array<double, kParts> part{};  // lowest quarter, lower half, upper half
  for (std::size_t l = 0; l < layers; ++l) {
    all += depth[l];
    if (4 * l < layers) part[0] += depth[l];
    part[2 * l < layers ? 1 : 2] += depth[l];
  }
  Transmittances t{};
  std::size_t path = 0;
  for (const double air_mass : kWholeAirMasses) t[path++] = std::exp(-air_mass * all);
  for (const double some : part)
    for (const double air_mass : kPartAirMasses) t[path++] = std::exp(-air_mass * some);
  return t;
}

struct Cluster {
  TermGroup group;
  Transmittances mean{};
  std::size_t partner = 0;  // the later cluster that is cheapest to join
  double cost = std::numeric_limits<double>::infinity();
};

double cost_of(const Cluster& a, const Cluster& b) {
  double difference = 0.0;
  for (std::size_t p = 0; p < kPaths; ++p) {
    const double d = a.mean[p] - b.mean[p];
    difference += d * d;
  }
  return a.group.weight * b.group.weight / (a.group.weight + b.group.weight) * difference;
}

void find_partner(std::vector<Cluster>& clusters, std::size_t i) {
  clusters[i].cost = std::numeric_limits<double>::infinity();
  for (std::size_t j = i + 1; j < clusters.size(); ++j) {
    const double cost = cost_of(clusters[i], clusters[j]);
    if (cost < clusters[i].cost) clusters[i].cost = cost, clusters[i].partner = j;
  }
}

void absorb(Cluster& a, const Cluster& b) {
  const double sum = a.group.weight + b.group.weight;
  for (std::size_t p = 0; p < kPaths; ++p)
    a.mean[p] = (a.group.weight * a.mean[p] + b.group.weight * b.mean[p]) / sum;
  a.group.weight = sum;
  a.group.members.insert(a.group.members.end(), b.group.members.begin(), b.group.members.end());
}

/// After cluster j was taken into i (i < j) and its place closed: partners and costs as they are now.
void refresh(std::vector<Cluster>& clusters, std::size_t i, std::size_t j) {
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    Cluster& cluster = clusters[c];
    if (c == i || cluster.partner == i || cluster.partner == j) {
      find_partner(clusters, c);
      continue;
    }
    if (cluster.partner > j) --cluster.partner;
    if (c >= i) continue;
    const double cost = cost_of(cluster, clusters[i]);
    if (cost < cluster.cost) cluster.cost = cost, cluster.partner = i;
  }
}

}  // namespace

std::vector<TermGroup> joined_terms(const std::vector<double>& weight,
                                    const std::vector<std::vector<double>>& depth, std::size_t most) {
  std::vector<Cluster> clusters(weight.size());
  for (std::size_t j = 0; j < weight.size(); ++j) {
    clusters[j].group = {weight[j], {j}};
    clusters[j].mean = transmittances_of(depth[j]);
  }
  for (std::size_t i = 0; i < clusters.size(); ++i) find_partner(clusters, i);
  while (clusters.size() > most) {
    std::size_t i = 0;
    for (std::size_t c = 1; c < clusters.size(); ++c)
      if (clusters[c].cost < clusters[i].cost) i = c;
    const std::size_t j = clusters[i].partner;
    absorb(clusters[i], clusters[j]);
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(j));
    refresh(clusters, i, j);
  }
  std::vector<TermGroup> groups;
  for (Cluster& cluster : clusters) groups.push_back(std::move(cluster.group));
  return groups;
}

}  // namespace ifov::atmosphere
