#include "radiometry/node_rule.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "radiometry/planck.h"

namespace ifov::radiometry {
namespace {

double sum_of_products(std::span<const double> a, const double* b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// The largest share s <= 1 for which mean + s (value - mean) stays within [low, high].
double allowed_share(double value, double mean, double low, double high) {
  if (value > high) return value > mean ? std::max(0.0, (high - mean) / (value - mean)) : 0.0;
  if (value < low) return value < mean ? std::max(0.0, (mean - low) / (mean - value)) : 0.0;
  return 1.0;
}

}  // namespace

NodeRule::NodeRule(const ChannelGrid& grid, int parts, int order) : grid_um_(grid.wavelength_um) {
  double total = 0.0;
  for (std::size_t q = 0; q < grid.size(); ++q) total += grid.response[q] * grid.reference[q];
  double sum = 0.0;
  std::size_t first = 0;
  for (std::size_t q = 0; q < grid.size(); ++q) {
    sum += grid.response[q] * grid.reference[q];
    const double goal = total * static_cast<double>(parts_.size() + 1) / parts;
    const bool last = q + 1 == grid.size();
    if (last || (sum >= goal && q + 1 - first >= 2)) {
      add_part(grid, first, q + 1, order);
      first = q + 1;
    }
  }
  double weights = 0.0;
  for (const Node& node : nodes_) weights += node.weight;
  for (Node& node : nodes_) node.weight /= weights;
}

void NodeRule::add_part(const ChannelGrid& grid, std::size_t first_point, std::size_t last_point, int order) {
  const std::size_t count = last_point - first_point;
  const double* x = grid.wavelength_um.data() + first_point;
  const double* reference = grid.reference.data() + first_point;
  std::vector<double> measure(count);
  for (std::size_t q = 0; q < count; ++q) measure[q] = grid.response[first_point + q] * reference[q];
  const double total = std::accumulate(measure.begin(), measure.end(), 0.0);

  const double mean = sum_of_products(measure, x) / total;
  double variance = 0.0, third = 0.0;
  for (std::size_t q = 0; q < count; ++q) variance += measure[q] / total * (x[q] - mean) * (x[q] - mean);
  const double deviation = std::sqrt(variance);
  if (order == 2 && !(deviation > 0.0)) order = 1;
  std::vector<double> t(count, 0.0);
  if (order == 2)
    for (std::size_t q = 0; q < count; ++q) {
      t[q] = (x[q] - mean) / deviation;
      third += measure[q] / total * t[q] * t[q] * t[q];
    }

  // Gauss points of a measure with mean 0 and variance 1: the roots of t^2 - (third moment) t - 1.
  std::vector<double> abscissa{0.0}, share{1.0};
  if (order == 2) {
    const double root = std::sqrt(third * third + 4.0);
    abscissa = {0.5 * (third - root), 0.5 * (third + root)};
    share = {abscissa[1] / root, -abscissa[0] / root};
  }

  Part part{first_point, last_point, nodes_.size(), nodes_.size() + abscissa.size(), {}};
  for (std::size_t i = 0; i < abscissa.size(); ++i) {
    Node node;
    node.wavelength_um = mean + abscissa[i] * deviation;
    node.measure = share[i] * total;
    node.factor_kernel.resize(count);
    for (std::size_t q = 0; q < count; ++q)
      node.factor_kernel[q] = measure[q] / total * (1.0 + abscissa[i] * t[q]);
    nodes_.push_back(std::move(node));
  }

  // A radiance of 1 everywhere is to be 1 in every node, so a node weighs its measure x (1 / reference).
  std::vector<double> inverse(count), at_nodes(nodes_.size());
  for (std::size_t q = 0; q < count; ++q) inverse[q] = 1.0 / reference[q];
  double plain = 0.0, least = 1.0;
  for (std::size_t i = part.first_node; i < part.last_node; ++i) {
    at_nodes[i] = sum_of_products(nodes_[i].factor_kernel, inverse.data());
    plain += nodes_[i].measure / total * at_nodes[i];
  }
  for (std::size_t i = part.first_node; i < part.last_node; ++i)
    least = std::min(least, allowed_share(at_nodes[i], plain, 0.05 * plain, 1e300));
  for (std::size_t i = part.first_node; i < part.last_node; ++i) {
    Node& node = nodes_[i];
    const double inverse_reference = plain + least * (at_nodes[i] - plain);
    node.weight = node.measure * inverse_reference;
    node.source_kernel.resize(count);
    for (std::size_t q = 0; q < count; ++q)
      node.source_kernel[q] = node.factor_kernel[q] * inverse[q] / inverse_reference;
  }
  add_planck_points(grid, part);
  parts_.push_back(std::move(part));
}

void NodeRule::add_planck_points(const ChannelGrid& grid, Part& part) {
  const std::size_t count = part.last_point - part.first_point;
  const double* x = grid.wavelength_um.data() + part.first_point;
  const double first = x[0], last = x[count - 1];
  // Planck's law changes by this many powers of e across the part at 200 K; its interpolation converges
  // faster than exponentially beyond a quarter of that number of points.
  const double powers = 14387.77 / 200.0 * (1.0 / first - 1.0 / last);
  const std::size_t points = 8 + static_cast<std::size_t>(powers);
  if (2 * points >= count) {
    part.planck_um.assign(x, x + count);
    for (std::size_t i = part.first_node; i < part.last_node; ++i) nodes_[i].planck_kernel = nodes_[i].source_kernel;
    return;
  }
  std::vector<double> barycentric(points);
  for (std::size_t k = 0; k < points; ++k) {
    const double angle = std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(points);
    part.planck_um.push_back(0.5 * (first + last) - 0.5 * (last - first) * std::cos(angle));
    barycentric[k] = (k % 2 == 0 ? 1.0 : -1.0) * std::sin(angle);
  }
  for (std::size_t i = part.first_node; i < part.last_node; ++i) nodes_[i].planck_kernel.assign(points, 0.0);
  std::vector<double> basis(points);
  for (std::size_t q = 0; q < count; ++q) {
    double sum = 0.0;
    for (std::size_t k = 0; k < points; ++k) {
      const double distance = x[q] - part.planck_um[k];
      basis[k] = barycentric[k] / (distance == 0.0 ? 1e-300 : distance);
      sum += basis[k];
    }
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      for (std::size_t k = 0; k < points; ++k)
        nodes_[i].planck_kernel[k] += nodes_[i].source_kernel[q] * basis[k] / sum;
  }
}

void NodeRule::project_factor(std::span<const double> at_points, std::span<double> at_nodes) const {
  for (const Part& part : parts_) {
    const double* values = at_points.data() + part.first_point;
    const auto [low, high] = std::minmax_element(values, at_points.data() + part.last_point);
    double mean = 0.0, total = 0.0, share = 1.0;
    for (std::size_t i = part.first_node; i < part.last_node; ++i) {
      at_nodes[i] = sum_of_products(nodes_[i].factor_kernel, values);
      mean += nodes_[i].measure * at_nodes[i];
      total += nodes_[i].measure;
    }
    mean /= total;
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      share = std::min(share, allowed_share(at_nodes[i], mean, *low, *high));
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      at_nodes[i] = std::clamp(mean + share * (at_nodes[i] - mean), *low, *high);
  }
}

void NodeRule::project_source(std::span<const double> at_points, std::span<double> at_nodes) const {
  for (const Part& part : parts_) {
    const double* values = at_points.data() + part.first_point;
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      at_nodes[i] = sum_of_products(nodes_[i].source_kernel, values);
    if (std::all_of(values, at_points.data() + part.last_point, [](double v) { return v >= 0.0; }))
      keep_positive(part, at_nodes);
  }
}

void NodeRule::project_planck(double temperature_k, std::span<double> at_nodes) const {
  std::vector<double> values;
  for (const Part& part : parts_) {
    values.clear();
    for (const double wavelength : part.planck_um) values.push_back(planck_w_m2_sr_um(wavelength, temperature_k));
    for (std::size_t i = part.first_node; i < part.last_node; ++i)
      at_nodes[i] = sum_of_products(nodes_[i].planck_kernel, values.data());
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
