#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "atmosphere/scattering/scattering_options.h"
#include "atmosphere/sensor/atmosphere_error.h"
#include "atmosphere/sensor/directions/line_of_sight_grid.h"
#include "atmosphere/sensor/directions/sky_directions.h"
#include "atmosphere/sensor/kept_solutions.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "radiometry/spectral_nodes.h"

namespace ifov::radiometry {
struct StokesVector;
}

namespace ifov::atmosphere {

class AtmosphereColumn;
class DirectionalGround;
struct DirectionalLight;
struct ChannelLights;

/// The atmosphere as one sensor's channels see it: spectral nodes, and what the air does to light in each of
/// them. A node stands for those parts of a channel (bins of the band model and their absorption terms) that
/// the air absorbs alike, so that absorption on the way down and on the way up stay correlated: within a node
/// Beer's law holds along any path. Radiances are for black ground; what the ground adds follows from the
/// groundlit quantities, which are for a ground of radiance 1 in every direction
/// (docs/theory/atmosphere_sensor.md).
class SensorAtmosphere {
 public:
  struct Inputs {
    std::span<const radiometry::Channel> channels;
    radiometry::Spectrum solar_irradiance;  ///< above the air, at the date's distance, W m-2 um-1
    std::span<const radiometry::Spectrum> surfaces;
    radiometry::NodeDemands demands;
    SensorGeometry geometry;
    std::optional<SkyDirections> sky = {};  ///< none: the standard ones
    ScatteringOptions scattering;
    int threads = 0;
    std::optional<LineOfSightGrid> lines_of_sight =
        {};                         ///< none: that of the geometry holds for all surfaces
    KeptSolutions* kept = nullptr;  ///< solutions from before, if any
    /// Whether Q and U of sky and path are kept beside I; needs scattering.polarized.
    bool polarized = false;
    /// Whether errors() are wanted, and the reflectance of the ground around the scene, which they depend on.
    bool with_errors = false;
    radiometry::Spectrum ground = radiometry::Spectrum::constant(0.0);
    /// Ground around the scene that reflects by direction; null: it is Lambertian, and whoever uses the tables couples it.
    std::shared_ptr<const DirectionalGround> directional = {};
    /// Told how many solutions of how many are there, one call at a time; may throw to end it.
    std::function<void(std::size_t, std::size_t)> progress = {};
  };
  /// Throws InputError where a channel leaves the atmosphere's tables, std::invalid_argument where polarized
  /// light is asked of a scalar solver.
  SensorAtmosphere(const AtmosphereColumn& column, const Inputs& inputs);

  const radiometry::SpectralNodes& nodes() const { return nodes_; }
  std::size_t node_count() const { return nodes_.node_count(); }
  const SensorGeometry& geometry() const { return geometry_; }
  const SkyDirections& sky_directions() const { return directions_; }
  const LineOfSightGrid& lines_of_sight() const { return lines_of_sight_; }

  /// By node. Irradiances in W m-2 um-1, radiances in W m-2 sr-1 um-1.
  const std::vector<double>& sun_irradiance() const { return sun_; }  ///< direct, on a surface that faces it
  const std::vector<double>& view_transmittance() const { return view_transmittance_; }  ///< direct
  const std::vector<double>& view_radiance() const {
    return view_radiance_;
  }  ///< scattered sunlight and emission
  const std::vector<double>& diffuse_transmittance() const {
    return diffuse_transmittance_;
  }  ///< groundlit, to the sensor
  const std::vector<double>& spherical_albedo() const { return spherical_albedo_; }
  const std::vector<double>& sky_irradiance() const { return sky_irradiance_; }  ///< on a level surface
  /// The same along one of lines_of_sight().lines(), by node.
  struct LightAlongLine {
    std::span<const double> transmittance, radiance, diffuse_transmittance;
  };
  LightAlongLine line_of_sight(std::size_t line) const;
  /// Irradiances at one of lines_of_sight().height().known(), by node: direct as sun_irradiance, of the sky as
  /// sky_irradiance.
  std::span<const double> sun_at_height(std::size_t height) const { return row(sun_at_height_, height); }
  std::span<const double> sky_at_height(std::size_t height) const { return row(sky_at_height_, height); }

  /// Radiance from a direction of the table: [zenith][azimuth][node], and the groundlit sky [zenith][node].
  double sky(std::size_t zenith, std::size_t azimuth, std::size_t node) const {
    return sky_[(zenith * directions_.azimuth_rad.size() + azimuth) * node_count() + node];
  }
  double groundlit_sky(std::size_t zenith, std::size_t node) const {
    return groundlit_[zenith * node_count() + node];
  }

  /// Whether it was asked for; the next three are then there. Emission of air is unpolarized, and circular
  /// polarization 0.
  bool polarized() const { return polarization_.has_value(); }
  /// As sky() and groundlit_sky(), about the meridional_frame of light from that direction; azimuths count
  /// counterclockwise from the Sun's, seen from above, and have -u on the other side.
  radiometry::StokesVector sky_stokes(std::size_t zenith, std::size_t azimuth, std::size_t node) const;
  radiometry::StokesVector groundlit_sky_stokes(std::size_t zenith, std::size_t node) const;
  /// Q and U of LightAlongLine::radiance and Q of LightAlongLine::diffuse_transmittance (its U is 0), by node, about the
  /// meridional_frame of light that goes towards the sensor; u for a line on the counterclockwise side.
  struct LineOfSightPolarization {
    std::span<const double> q, u, diffuse_q;
  };
  LineOfSightPolarization line_of_sight_polarization(std::size_t line) const;

  /// Irradiances of the level at the sensor's altitude by node, where the geometry wants them.
  struct LevelFluxes {
    std::vector<double> sun;       ///< direct, on a surface that faces the Sun
    std::vector<double> down, up;  ///< of all else, over black and cold ground
    /// Of the light that leaves level ground alike in every direction, the share that goes up through the level and that comes
    /// down through it.
    std::vector<double> ground_up, ground_down;
  };
  const LevelFluxes& level_fluxes() const { return level_fluxes_; }
  /// By channel, over its response alone and not as light of this Sun is weighed within nodes; where level fluxes are wanted.
  struct ChannelMeans {
    std::vector<double> diffuse_transmittance, spherical_albedo;
  };
  const ChannelMeans& channel_means() const { return channel_means_; }

  /// Null where the ground is Lambertian.
  const DirectionalLight* directional() const { return directional_.get(); }
  /// How far each channel may be off because of how all this is computed; empty where it was not asked for.
  const std::vector<AtmosphereErrors>& errors() const { return errors_; }

 private:
  void build_nodes(const Inputs& inputs, const std::vector<ChannelLights>& channels);
  void add_scattering(std::size_t channel, const ChannelLights& lights);
  void add_emission(std::size_t channel, const ChannelLights& lights);
  /// Adds a source's values at the points of a channel to a row over all nodes.
  void add_source(std::size_t channel, const std::vector<double>& at_points, double* row) const;
  void add_lines_of_sight(std::size_t channel, const ChannelLights& lights);
  AtmosphereError line_of_sight_error(std::size_t channel, const ChannelLights& lights,
                                      const radiometry::Spectrum& ground) const;
  /// The reflectance that errors are told for: of ground that reflects by direction at least what leaves it of this Sun and sky.
  radiometry::Spectrum ground_in_errors(std::size_t channel, const radiometry::Spectrum& even) const;
  void normalise_sky();
  void add_fluxes(std::size_t channel, const ChannelLights& lights);
  void add_polarization(std::size_t channel, const ChannelLights& lights);
  void add_directional(std::size_t channel, const ChannelLights& lights);
  void make_room_for_directional(const DirectionalGround& ground, bool polarized);
  /// Shapes become radiances, and ground and air exchange light.
  void couple_directional();
  /// Makes light that interpolation left too polarized wholly polarized.
  void bound_polarization();
  struct Polarization {
    std::vector<double> sky_q, sky_u, groundlit_q;  // as sky_, groundlit_
    std::vector<double> path_q, path_u, diffuse_q;  // [line][node]
  };
  std::span<const double> row(const std::vector<double>& rows, std::size_t k) const {
    return std::span(rows).subspan(k * node_count(), node_count());
  }

  SensorGeometry geometry_;
  SkyDirections directions_;
  radiometry::SpectralNodes nodes_;
  std::vector<double> sun_, view_transmittance_, view_radiance_, diffuse_transmittance_, spherical_albedo_,
      sky_irradiance_, sky_, groundlit_;
  std::vector<AtmosphereErrors> errors_;
  LineOfSightGrid lines_of_sight_;
  std::vector<double> line_of_sight_transmittance_, line_of_sight_radiance_,
      line_of_sight_diffuse_;                          // [line][node]
  std::vector<double> sun_at_height_, sky_at_height_;  // [height][node]
  std::optional<Polarization> polarization_;
  LevelFluxes level_fluxes_;
  ChannelMeans channel_means_;
  std::shared_ptr<DirectionalLight> directional_;
};

}  // namespace ifov::atmosphere
