#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "atmosphere/sensor/sensor_atmosphere.h"
#include "math/vec3.h"
#include "radiometry/spectrum_block.h"
#include "transport/sky/sky_sampler.h"

namespace ifov::transport {

/// The sky's radiance by direction, in spectral nodes: linear in zenith angle and azimuth between the directions of the
/// atmosphere's table, symmetric about the Sun's plane.
class SkyDome {
 public:
  /// `ground_radiance`: of the ground around the scene, by node, whose light the air scatters back.
  SkyDome(const atmosphere::SensorAtmosphere& atmosphere, math::Vec3 towards_sun,
          const std::vector<double>& ground_radiance);

  /// The rows that a direction (unit, at or above the horizon) lies between.
  struct Corners {
    std::array<const float*, 4> row;
    std::array<float, 4> weight;
  };
  Corners at(math::Vec3 direction) const;

  /// Directions that are drawn as bright as they are, all nodes alike.
  const SkySampler& sampler() const { return sampler_; }

 private:
  void make_sampler(std::size_t nodes);
  const float* row(std::size_t zenith, std::size_t azimuth) const {
    return rows_.row(zenith * azimuth_rad_.size() + azimuth);
  }
  math::Vec3 towards_sun_;
  std::vector<double> zenith_rad_, azimuth_rad_;
  radiometry::SpectrumBlock rows_;
  SkySampler sampler_;
};

}  // namespace ifov::transport
