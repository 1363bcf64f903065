#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiometry/channel_grid.h"

namespace ifov::radiometry {

/// A set of points of a channel's grid, not always neighbours, that one or two nodes stand for. With two
/// nodes, spectra enter as linear functions of `variable`.
struct ChannelPart {
  std::vector<std::uint32_t> points;
  std::vector<double> variable;  ///< by point; used where order is 2
  int order = 1;                 ///< nodes: 1 or 2
};

/// The nodes of one channel: the Gauss points of the measure (response x reference radiance) of each of its
/// parts. Projection takes a spectrum, as values at the points of the channel's grid, to its values at the
/// nodes (docs/theory/radiometry.md, equations 6 to 10).
class NodeRule {
 public:
  /// The parts hold every point of the grid once; of fewer points it is a rule for these, whose weights add up to 1.
  NodeRule(const ChannelGrid& grid, std::span<const ChannelPart> parts);
  /// Before project_planck: rules that are tried and dropped do without.
  void choose_planck_points();

  std::size_t node_count() const { return nodes_.size(); }
  /// Mean wavelength of what the node stands for.
  double wavelength_um(std::size_t node) const { return nodes_[node].wavelength_um; }
  /// The channel's radiance is the sum of weight x radiance of nodes; weights add up to 1.
  double weight(std::size_t node) const { return nodes_[node].weight; }
  std::span<const double> grid_um() const { return grid_um_; }

  /// Values of a factor at the nodes, never beyond the values within the node's part.
  void project_factor(std::span<const double> at_points, std::span<double> at_nodes) const;
  /// The same for what light passes between surfaces and the sensor, such as the grid's `seen`. The measure holds that
  /// already: the values are weighted so that they and a source of the grid's brightness give what is seen of it.
  void project_seen(std::span<const double> at_points, std::span<double> at_nodes) const;
  /// Values of a source: their weighted sum over the channel is the channel's mean. Never negative where the
  /// source is not.
  void project_source(std::span<const double> at_points, std::span<double> at_nodes) const;
  /// The same for Planck's law, which needs few points because it is smooth.
  void project_planck(double temperature_k, std::span<double> at_nodes) const;

 private:
  struct Node {
    double wavelength_um = 0.0;
    double weight = 1.0;
    double measure = 1.0;
    std::vector<double> factor_kernel;  // over the points of the part
    std::vector<double> source_kernel;
    std::vector<double> planck_kernel;  // over planck_um_
  };
  struct Part {
    std::vector<std::uint32_t> points;
    std::size_t first_node, last_node;
  };
  void add_part(const ChannelGrid& grid, const ChannelPart& part);
  void keep_positive(const Part& part, std::span<double> at_nodes) const;

  std::vector<double> grid_um_;
  std::vector<double> inverse_seen_;
  std::vector<Node> nodes_;
  std::vector<Part> parts_;
  std::vector<double> planck_um_;
};

}  // namespace ifov::radiometry
