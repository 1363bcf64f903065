#include "radiometry/node_rule.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "radiometry/planck.h"

namespace ifov::radiometry {
namespace {

double sum_of_products(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::vector<double> gathered(std::span<const double> values, const std::vector<std::uint32_t>& points) {
  std::vector<double> result(points.size());
  std::transform(points.begin(), points.end(), result.begin(), [&](std::uint32_t q) { return values[q]; });
  return result;
}

/// Gauss points (in standard deviations from the mean) and weights of a measure, and the variable in these
/// units.
struct GaussRule {
  std::vector<double> abscissa{0.0}, share{1.0}, t;
};

GaussRule gauss_rule(const std::vector<double>& share_of_measure, const ChannelPart& part) {
  GaussRule rule;
  rule.t.assign(part.points.size(), 0.0);
  if (part.order == 1) return rule;
  const double mean = sum_of_products(share_of_measure, part.variable);
  double variance = 0.0, third = 0.0;
  for (std::size_t q = 0; q < rule.t.size(); ++q) {
    rule.t[q] = part.variable[q] - mean;
    variance += share_of_measure[q] * rule.t[q] * rule.t[q];
  }
  if (!(variance > 0.0)) {
    rule.t.assign(part.points.size(), 0.0);
    return rule;
  }
  for (std::size_t q = 0; q < rule.t.size(); ++q) {
    rule.t[q] /= std::sqrt(variance);
    third += share_of_measure[q] * rule.t[q] * rule.t[q] * rule.t[q];
  }
  // The roots of the second orthogonal polynomial, t^2 - (third moment) t - 1.
  const double root = std::sqrt(third * third + 4.0);
  rule.abscissa = {0.5 * (third - root), 0.5 * (third + root)};
  rule.share = {rule.abscissa[1] / root, -rule.abscissa[0] / root};
  return rule;
}

/// The largest share s <= 1 for which mean + s (value - mean) stays within [low, high].
double allowed_share(double value, double mean, double low, double high) {
  if (value > high) return value > mean ? std::max(0.0, (high - mean) / (value - mean)) : 0.0;
  if (value < low) return value < mean ? std::max(0.0, (mean - low) / (mean - value)) : 0.0;
  return 1.0;
}

}  // namespace

NodeRule::NodeRule(const ChannelGrid& grid, std::span<const ChannelPart> parts)
    : grid_um_(grid.wavelength_um), inverse_seen_(grid.size()) {
  std::transform(grid.bright.begin(), grid.bright.end(), grid.reference.begin(), inverse_seen_.begin(),
                 std::divides<>());
  for (const ChannelPart& part : parts) add_part(grid, part);
  double weights = 0.0;
  for (const Node& node : nodes_) weights += node.weight;
  for (Node& node : nodes_) node.weight /= weights;
}

void NodeRule::add_part(const ChannelGrid& grid, const ChannelPart& part) {
  const std::size_t count = part.points.size();
  const std::vector<double> reference = gathered(grid.reference, part.points);
  std::vector<double> measure = gathered(grid.response, part.points), inverse(count);
  for (std::size_t q = 0; q < count; ++q) {
    measure[q] *= reference[q];
    inverse[q] = 1.0 / reference[q];
  }
  const double total = std::accumulate(measure.begin(), measure.end(), 0.0);
  for (double& value : measure) value /= total;
  const GaussRule gauss = gauss_rule(measure, part);

  const std::size_t first_node = nodes_.size();
  for (std::size_t i = 0; i < gauss.abscissa.size(); ++i) {
    Node node;
    node.measure = gauss.share[i] * total;
    node.factor_kernel.resize(count);
    for (std::size_t q = 0; q < count; ++q)
      node.factor_kernel[q] = measure[q] * (1.0 + gauss.abscissa[i] * gauss.t[q]);
    nodes_.push_back(std::move(node));
  }
  parts_.push_back({part.points, first_node, nodes_.size()});

  // A radiance of 1 everywhere is to be 1 in every node, so a node weighs its measure x (1 / reference).
  const double plain = sum_of_products(measure, inverse);
  double least = 1.0;
  std::vector<double> inverse_reference;
  for (std::size_t i = first_node; i < nodes_.size(); ++i) {
    inverse_reference.push_back(sum_of_products(nodes_[i].factor_kernel, inverse));
    least = std::min(least, allowed_share(inverse_reference.back(), plain, 0.05 * plain, 1e300));
  }
  for (std::size_t i = first_node; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    const double at_node = plain + least * (inverse_reference[i - first_node] - plain);
    node.weight = node.measure * at_node;
    node.source_kernel.resize(count);
    for (std::size_t q = 0; q < count; ++q)
      node.source_kernel[q] = node.factor_kernel[q] * inverse[q] / at_node;
  }
  std::vector<double> wavelengths(nodes_.size());
  project_factor(grid.wavelength_um, wavelengths);
  for (std::size_t i = first_node; i < nodes_.size(); ++i) nodes_[i].wavelength_um = wavelengths[i];
}

void NodeRule::choose_planck_points() {
  const double first = grid_um_.front(), last = grid_um_.back();
  // Planck's law changes by this many powers of e across the channel at 200 K; its interpolation converges
  // faster than exponentially beyond a quarter of that number of points.
  const double powers = 14387.77 / 200.0 * (1.0 / first - 1.0 / last);
  const std::size_t points = std::min(8 + static_cast<std::size_t>(powers), grid_um_.size());
  // Planck's law is singular at wavelength 0, which the largest ellipse of Bernstein about the channel runs through: the
  // interpolation's error falls as the inverse power `points` of the sum of its semi-axes (Trefethen 2013, theorem 8.2).
  constexpr double kLeastFall = 18.0;  // powers of e
  const double root = std::sqrt(last / first);
  const bool converges = static_cast<double>(points) * std::log((root + 1.0) / (root - 1.0)) > kLeastFall;
  const bool on_grid = 2 * points >= grid_um_.size() || !converges;
  std::vector<double> barycentric(points);
  if (on_grid) {
    planck_um_ = grid_um_;
  } else {
    for (std::size_t k = 0; k < points; ++k) {
      const double angle = std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(points);
      planck_um_.push_back(0.5 * (first + last) - 0.5 * (last - first) * std::cos(angle));
      barycentric[k] = (k % 2 == 0 ? 1.0 : -1.0) * std::sin(angle);
    }
  }
  std::vector<double> basis(points);
  for (const Part& part : parts_) {
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      nodes_[i].planck_kernel.assign(planck_um_.size(), 0.0);
    for (std::size_t q = 0; q < part.points.size(); ++q) {
      if (on_grid) {
        for (std::size_t i = part.first_node; i < part.last_node; ++i)
          nodes_[i].planck_kernel[part.points[q]] = nodes_[i].source_kernel[q];
        continue;
      }
      double sum = 0.0;
      for (std::size_t k = 0; k < points; ++k) {
        const double distance = grid_um_[part.points[q]] - planck_um_[k];
        basis[k] = barycentric[k] / (distance == 0.0 ? 1e-300 : distance);
        sum += basis[k];
      }
      for (std::size_t i = part.first_node; i < part.last_node; ++i)
        for (std::size_t k = 0; k < points; ++k)
          nodes_[i].planck_kernel[k] += nodes_[i].source_kernel[q] * basis[k] / sum;
    }
  }
}

void NodeRule::project_factor(std::span<const double> at_points, std::span<double> at_nodes) const {
  for (const Part& part : parts_) {
    double low = at_points[part.points.front()], high = low;
    // One or two nodes; sums of both side by side, since each waits for its last addition.
    const double* first = nodes_[part.first_node].factor_kernel.data();
    const double* second = nodes_[part.last_node - 1].factor_kernel.data();
    double at_first = 0.0, at_second = 0.0;
    for (std::size_t q = 0; q < part.points.size(); ++q) {
      const double value = at_points[part.points[q]];
      low = std::min(low, value);
      high = std::max(high, value);
      at_first += first[q] * value;
      at_second += second[q] * value;
    }
    at_nodes[part.first_node] = at_first;
    at_nodes[part.last_node - 1] = at_second;
    double mean = 0.0, total = 0.0, share = 1.0;
    for (std::size_t i = part.first_node; i < part.last_node; ++i) {
      mean += nodes_[i].measure * at_nodes[i];
      total += nodes_[i].measure;
    }
    mean /= total;
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      share = std::min(share, allowed_share(at_nodes[i], mean, low, high));
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      at_nodes[i] = std::clamp(mean + share * (at_nodes[i] - mean), low, high);
  }
}

void NodeRule::project_seen(std::span<const double> at_points, std::span<double> at_nodes) const {
  std::vector<double> weighted(at_points.size()), inverse(at_nodes.size());
  std::transform(at_points.begin(), at_points.end(), inverse_seen_.begin(), weighted.begin(),
                 std::multiplies<>());
  project_factor(weighted, at_nodes);
  project_factor(inverse_seen_, inverse);
  std::transform(at_nodes.begin(), at_nodes.end(), inverse.begin(), at_nodes.begin(), std::divides<>());
}

void NodeRule::project_source(std::span<const double> at_points, std::span<double> at_nodes) const {
  for (const Part& part : parts_) {
    const std::vector<double> values = gathered(at_points, part.points);
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      at_nodes[i] = sum_of_products(nodes_[i].source_kernel, values);
    if (std::all_of(values.begin(), values.end(), [](double v) { return v >= 0.0; }))
      keep_positive(part, at_nodes);
  }
}

void NodeRule::project_planck(double temperature_k, std::span<double> at_nodes) const {
  std::vector<double> values(planck_um_.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = planck_w_m2_sr_um(planck_um_[k], temperature_k);
  for (const Part& part : parts_) {
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      at_nodes[i] = sum_of_products(nodes_[i].planck_kernel, values);
    keep_positive(part, at_nodes);
  }
}

void NodeRule::keep_positive(const Part& part, std::span<double> at_nodes) const {
  double mean = 0.0, total = 0.0, share = 1.0;
  for (std::size_t i = part.first_node; i < part.last_node; ++i) {
    mean += nodes_[i].weight * at_nodes[i];
    total += nodes_[i].weight;
  }
  mean = std::max(mean / total, 0.0);
  for (std::size_t i = part.first_node; i < part.last_node; ++i)
    share = std::min(share, allowed_share(at_nodes[i], mean, 0.0, 1e300));
  if (share == 1.0) return;
  for (std::size_t i = part.first_node; i < part.last_node; ++i)
    at_nodes[i] = std::max(0.0, mean + share * (at_nodes[i] - mean));
}

}  // namespace ifov::radiometry
