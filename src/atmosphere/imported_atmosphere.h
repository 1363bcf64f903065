#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "radiometry/spectral_nodes.h"

namespace ifov::atmosphere {

struct ImportedLight;

/// The light of another code's runs as one sensor's channels see it: the counterpart of SensorAtmosphere,
/// under a uniform sky. A channel of the sensor that is one of the file's (same centre and width) has the
/// file's own values, so that what the bands of a channel have in common is kept; any other integrates them,
/// linear between the file's wavelengths.
class ImportedAtmosphere {
 public:
  struct Inputs {
    std::span<const radiometry::Channel> channels;
    std::span<const radiometry::Spectrum> surfaces;
    radiometry::NodeDemands demands;
  };
  /// Throws InputError, naming the channel, where the runs do not cover one of them.
  ImportedAtmosphere(const ImportedLight& light, const Inputs& inputs);

  const radiometry::SpectralNodes& nodes() const { return nodes_; }
  std::size_t node_count() const { return nodes_.node_count(); }
  bool has_sky() const { return has_sky_; }

  /// By node, as of SensorAtmosphere.
  const std::vector<double>& sun_irradiance() const { return sun_; }
  const std::vector<double>& sky_irradiance() const { return sky_; }
  const std::vector<double>& view_transmittance() const { return view_; }
  const std::vector<double>& view_radiance() const { return path_; }
  const std::vector<double>& diffuse_transmittance() const { return diffuse_transmittance_; }
  const std::vector<double>& spherical_albedo() const { return spherical_albedo_; }

  /// Channels of the sensor that are none of the channel file's, by index; empty for runs of spectra.
  const std::vector<std::size_t>& unmatched_channels() const { return unmatched_; }

 private:
  radiometry::SpectralNodes nodes_;
  std::vector<double> sun_, sky_, view_, path_, diffuse_transmittance_, spherical_albedo_;
  std::vector<std::size_t> unmatched_;
  bool has_sky_ = false;
};

}  // namespace ifov::atmosphere
