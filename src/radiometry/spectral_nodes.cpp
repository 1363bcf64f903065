#include "radiometry/spectral_nodes.h"

#include <algorithm>

#include "radiometry/node_search.h"

namespace ifov::radiometry {

SpectralNodes SpectralNodes::build(std::span<const Channel> channels, const Spectrum& solar_irradiance,
                                   std::span<const Spectrum> surfaces, double tolerance) {
  SpectralNodes result;
  for (const Channel& channel : channels) {
    const ChannelGrid grid(channel, solar_irradiance);
    std::vector<std::vector<double>> sampled;
    for (const Spectrum& surface : surfaces)
      if (!surface.is_constant()) sampled.push_back(grid.sampled(surface));
    FoundRule found = find_rule(grid, sampled, tolerance);
    result.worst_error_ = std::max(result.worst_error_, found.worst_error);

    const std::size_t count = found.rule.node_count();
    if (result.runs_.empty() || result.runs_.back().nodes_per_channel != count)
      result.runs_.push_back({result.channel_count(), result.channel_count(), result.node_count(), count});
    ++result.runs_.back().last_channel;
    for (std::size_t node = 0; node < count; ++node) {
      result.weight_.push_back(static_cast<float>(found.rule.weight(node)));
      result.wavelength_um_.push_back(found.rule.wavelength_um(node));
    }
    result.first_node_.push_back(result.weight_.size());
    result.rules_.push_back(std::move(found.rule));
  }
  return result;
}

template <class Project>
void SpectralNodes::for_each_rule(std::span<float> nodes, const Project& project) const {
  std::vector<double> at_points, at_nodes;
  for (std::size_t channel = 0; channel < rules_.size(); ++channel) {
    const NodeRule& rule = rules_[channel];
    at_points.resize(rule.grid_um().size());
    at_nodes.resize(rule.node_count());
    project(rule, at_points, at_nodes);
    std::transform(at_nodes.begin(), at_nodes.end(), nodes.begin() + static_cast<std::ptrdiff_t>(first_node_[channel]),
                   [](double value) { return static_cast<float>(value); });
  }
}

void SpectralNodes::average_surface(const Spectrum& spectrum, std::span<float> nodes) const {
  for_each_rule(nodes, [&](const NodeRule& rule, std::vector<double>& at_points, std::vector<double>& at_nodes) {
    for (std::size_t q = 0; q < at_points.size(); ++q) at_points[q] = spectrum.at(rule.grid_um()[q]);
    rule.project_factor(at_points, at_nodes);
  });
}

void SpectralNodes::average_source(const Spectrum& spectrum, std::span<float> nodes) const {
  const Spectrum* product[] = {&spectrum};
  average_source(product, nodes);
}

void SpectralNodes::average_source(std::span<const Spectrum* const> product, std::span<float> nodes) const {
  for_each_rule(nodes, [&](const NodeRule& rule, std::vector<double>& at_points, std::vector<double>& at_nodes) {
    for (std::size_t q = 0; q < at_points.size(); ++q) {
      at_points[q] = 1.0;
      for (const Spectrum* factor : product) at_points[q] *= factor->at(rule.grid_um()[q]);
    }
    rule.project_source(at_points, at_nodes);
  });
}

void SpectralNodes::planck(double temperature_k, std::span<float> nodes) const {
  for_each_rule(nodes, [&](const NodeRule& rule, std::vector<double>&, std::vector<double>& at_nodes) {
    rule.project_planck(temperature_k, at_nodes);
  });
}

void SpectralNodes::planck(double temperature_k, std::span<double> nodes) const {
  for (std::size_t channel = 0; channel < rules_.size(); ++channel)
    rules_[channel].project_planck(temperature_k,
                                   nodes.subspan(first_node_[channel], rules_[channel].node_count()));
}

void SpectralNodes::planck_channels(double temperature_k, std::span<double> channels) const {
  std::vector<double> nodes(node_count());
  planck(temperature_k, std::span<double>(nodes));
  for (std::size_t channel = 0; channel < rules_.size(); ++channel) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rules_[channel].node_count(); ++i)
      sum += rules_[channel].weight(i) * nodes[first_node_[channel] + i];
    channels[channel] = sum;
  }
}

void SpectralNodes::to_channels(const float* nodes, float* channels) const {
  for (const Run& run : runs_) {
    const float* node = nodes + run.first_node;
    if (run.nodes_per_channel == 1) {
      std::copy(node, node + (run.last_channel - run.first_channel), channels + run.first_channel);
      continue;
    }
    const float* weight = weight_.data() + run.first_node;
    for (std::size_t channel = run.first_channel; channel < run.last_channel; ++channel) {
      float sum = 0.0f;
      for (std::size_t i = 0; i < run.nodes_per_channel; ++i) sum += *weight++ * *node++;
      channels[channel] = sum;
    }
  }
}

}  // namespace ifov::radiometry
