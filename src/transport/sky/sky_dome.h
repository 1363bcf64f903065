#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "math/vec3.h"
#include "radiometry/spectrum_block.h"
#include "transport/sky/sky_irradiance.h"
#include "transport/sky/sky_sampler.h"

namespace ifov::radiometry {
struct PolarizationFrame;
struct StokesVector;
}  // namespace ifov::radiometry
namespace ifov::atmosphere {
class SensorAtmosphere;
}

namespace ifov::transport {

struct GroundAround;

/// The sky's radiance by direction, in spectral nodes: linear in zenith angle and azimuth between the directions of the
/// atmosphere's table, between which it keeps its integrals (kept_integrals.h), symmetric about the Sun's plane; with
/// polarization, of a table with a quarter of its steps (sky_refinement.h).
class SkyDome {
 public:
  /// `ground`: around the scene, whose light the air scatters back. `polarized`: Q and U are kept, where the atmosphere has them.
  SkyDome(const atmosphere::SensorAtmosphere& atmosphere, math::Vec3 towards_sun, const GroundAround& ground,
          bool polarized = true);

  /// The spectra that a direction (unit, at or above the horizon) lies between.
  struct Corners {
    std::array<const float*, 4> spectrum;
    std::array<float, 4> weight;
  };
  Corners at(math::Vec3 direction) const;

  /// Whether the atmosphere's tables are: stokes() is then there.
  bool polarized() const { return q_.rows() > 0; }
  /// The same radiance with its polarization, by node; returns the frame that it is about, the meridional one
  /// of light from there. Light of the table's directions is interpolated in frames carried to this one, so
  /// that the zenith is a direction like others.
  radiometry::PolarizationFrame stokes(math::Vec3 direction, std::span<radiometry::StokesVector> nodes) const;

  /// The same by rows of spectra, about a frame of light from there (its direction is -direction): Q is the sum of
  /// cosine q + sine side u, U of cosine side u - sine q, over the corners at().
  struct PolarizedCorners {
    std::array<const float*, 4> q{}, u{};
    std::array<float, 4> cosine{}, sine{};  ///< of twice the angles, times the corners' weights
    float side = 1.0f;
  };
  PolarizedCorners polarization(const Corners& corners, math::Vec3 direction,
                                const radiometry::PolarizationFrame& frame) const;

  /// What a surface takes from it by its normal (unit).
  SkyIrradiance::Corners irradiance(math::Vec3 normal) const;

  /// Directions that are drawn as bright as they are, all nodes alike.
  const SkySampler& sampler() const { return sampler_; }

 private:
  void make_sampler(std::size_t nodes);
  void refine(const atmosphere::SensorAtmosphere& atmosphere, const GroundAround& ground);
  void keep_integrals();
  void scale_to(const std::vector<double>& level);
  const float* spectrum(std::size_t zenith, std::size_t azimuth) const {
    return spectra_.row(zenith * azimuth_rad_.size() + azimuth);
  }
  math::Vec3 towards_sun_;
  std::vector<double> zenith_rad_, azimuth_rad_;
  radiometry::SpectrumBlock spectra_;
  radiometry::SpectrumBlock q_, u_;  // as spectra_, of counterclockwise azimuths; empty where not asked for
  SkySampler sampler_;
  std::unique_ptr<const SkyIrradiance> irradiance_;
};

}  // namespace ifov::transport
