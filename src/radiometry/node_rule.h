#pragma once

#include <span>
#include <vector>

#include "radiometry/channel_grid.h"

namespace ifov::radiometry {

/// The nodes of one channel: the channel is cut into parts of equal measure (response x reference radiance), and each
/// part has the one or two Gauss points of that measure. Projection takes a spectrum, as values at the points of the
/// channel's grid, to its values at the nodes (docs/theory/radiometry.md, equations 5 to 9).
class NodeRule {
 public:
  NodeRule(const ChannelGrid& grid, int parts, int order);

  std::size_t node_count() const { return nodes_.size(); }
  double wavelength_um(std::size_t node) const { return nodes_[node].wavelength_um; }
  /// The channel's radiance is the sum of weight x radiance of nodes; weights add up to 1.
  double weight(std::size_t node) const { return nodes_[node].weight; }
  std::span<const double> grid_um() const { return grid_um_; }

  /// Values of a factor at the nodes, never beyond the values within the node's part.
  void project_factor(std::span<const double> at_points, std::span<double> at_nodes) const;
  /// Values of a source: their weighted sum over the channel is the channel's mean. Never negative where the source
  /// is not.
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
    std::vector<double> planck_kernel;  // over the part's Chebyshev points
  };
  struct Part {
    std::size_t first_point, last_point;
    std::size_t first_node, last_node;
    std::vector<double> planck_um;
  };
  void add_part(const ChannelGrid& grid, std::size_t first_point, std::size_t last_point, int order);
  void add_planck_points(const ChannelGrid& grid, Part& part);
  void keep_positive(const Part& part, std::span<double> at_nodes) const;

  std::vector<double> grid_um_;
  std::vector<Node> nodes_;
  std::vector<Part> parts_;
};

}  // namespace ifov::radiometry
