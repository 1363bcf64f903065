#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiometry/channel.h"
#include "radiometry/node_demands.h"
#include "radiometry/spectrum.h"

namespace ifov::radiometry {

struct ChannelGrid;
struct FoundRule;
class NodeRule;

/// The spectral columns that paths carry. Each channel has one or a few nodes; light that meets several
/// surfaces is multiplied node by node, and the nodes of a channel are then added with weights. There are as
/// few of them as keep each channel within a tolerance of full integration, for sunlight reflected by up to
/// three of the given surfaces and for thermal emission of 200 to 1000 K, direct or after one or two
/// reflections (NodeDemands).
///
/// Nodes are Gauss points of the measure (response x source) over a part of the channel; a spectrum enters
/// them by its least-squares line in a variable along which the given surfaces vary most. So one reflection
/// of sunlight is exact with any number of nodes, and two nodes are exact for products of three spectra that
/// are linear in that variable (docs/theory/radiometry.md).
class SpectralNodes {
 public:
  /// `solar_irradiance`: W m-2 um-1 at the top of the scene, Spectrum() without a Sun. `surfaces`:
  /// reflectances and transmittances, 0 to 1. `sky_radiance`: of a uniform sky, W m-2 sr-1 um-1; may be null. A spectrum that does not cover a channel, and says that this is
  /// an error, throws InputError.
  static SpectralNodes build(std::span<const Channel> channels, const Spectrum& solar_irradiance,
                             std::span<const Spectrum> surfaces, const NodeDemands& demands = {},
                             const Spectrum* sky_radiance = nullptr);

  /// The same for channels as points of the caller's own.
  static SpectralNodes build(std::span<const ChannelGrid> channels, std::span<const Spectrum> surfaces,
                             const NodeDemands& demands = {});
  SpectralNodes();
  SpectralNodes(SpectralNodes&&) noexcept;
  SpectralNodes& operator=(SpectralNodes&&) noexcept;
  ~SpectralNodes();

  std::size_t node_count() const { return weight_.size(); }
  std::size_t channel_count() const { return channel_error_.size(); }
  /// Nodes [first_node(c), first_node(c + 1)) belong to channel c.
  std::size_t first_node(std::size_t channel) const { return first_node_[channel]; }
  double node_wavelength_um(std::size_t node) const { return wavelength_um_[node]; }
  double node_weight(std::size_t node) const { return weight_[node]; }
  /// Largest relative error seen in the checks at construction.
  double worst_error() const { return worst_error_; }
  double worst_error(std::size_t channel) const { return channel_error_[channel]; }

  /// A factor of light (reflectance, transmittance): within [0, 1] where the spectrum is. Spans:
  /// node_count().
  void average_surface(const Spectrum& spectrum, std::span<float> nodes) const;
  /// A source of light (radiance, irradiance), or a product of spectra that acts as one (irradiance times
  /// transmittance). The weighted sum over a channel's nodes is the channel's mean, exactly.
  void average_source(const Spectrum& spectrum, std::span<float> nodes) const;
  void average_source(std::span<const Spectrum* const> product, std::span<float> nodes) const;
  /// The same for values at the points of one channel. Spans: nodes of the channel.
  void average_factor(std::size_t channel, std::span<const double> at_points, std::span<double> nodes) const;
  /// What light passes between surfaces and the sensor, as NodeRule::project_seen.
  void average_seen(std::size_t channel, std::span<const double> at_points, std::span<double> nodes) const;
  void average_source(std::size_t channel, std::span<const double> at_points, std::span<double> nodes) const;
  /// Radiance of a blackbody in each node, W m-2 sr-1 um-1.
  void planck(double temperature_k, std::span<float> nodes) const;
  void planck(double temperature_k, std::span<double> nodes) const;
  /// The same by channel: the mean of Planck's law over the response. Span: channel_count().
  void planck_channels(double temperature_k, std::span<double> channels) const;

  /// Weighted sums of nodes: from node_count() to channel_count() numbers, which may stand in the same place.
  void to_channels(const float* nodes, float* channels) const;

 private:
  template <class Project>
  void for_each_rule(std::span<float> nodes, const Project& project) const;

  static constexpr std::size_t kLanes = 8;
  /// Eight channels, summed side by side: `depth` rows of eight weights and eight node numbers.
  struct Slice {
    std::size_t first_entry, depth;
  };
  void add(FoundRule found);
  void arrange_sums();

  std::vector<NodeRule> rules_;  // by channel
  std::vector<std::size_t> first_node_{0};
  std::vector<float> weight_;
  std::vector<double> wavelength_um_;
  std::vector<Slice> slices_;  // empty where every channel has one node
  std::vector<float> slice_weight_;
  std::vector<std::int32_t> slice_node_;
  double worst_error_ = 0.0;
  std::vector<double> channel_error_;
};

}  // namespace ifov::radiometry
