#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/scattering/ground/ground_shape.h"

namespace ifov::atmosphere {

class DirectionalGround;

/// Azimuthal modes of a ground's BRDF at one wavelength: from light that comes down in the directions of quadrature nodes, and
/// from the sunbeam, to light that goes up in `out` directions. Ground that differs on both sides of the plane of incidence, or by
/// absolute azimuth, counts by its mean over the mirror image and over the azimuths of diffuse light: modes here are those of light
/// that is the same on both sides of the Sun's plane.
class GroundModes {
 public:
  /// `in`: Gauss's nodes of the hemisphere that light comes from; `modes` of them at most. `sun_mu` <= 0: no sunbeam.
  GroundModes(const DirectionalGround& ground, double wavelength_um, const GaussNodes& in, double sun_mu,
              int modes, bool polarized);

  /// Directions in which light leaves: 48 nodes, for it changes fast with angle near the horizon.
  const GaussNodes& out() const { return out_; }
  int modes() const { return modes_; }
  int components() const { return components_; }

  /// Light that leaves of a sunbeam of irradiance 1 across itself (sun_mu > 0).
  GroundLight of_beam(int mode) const;
  /// Light that leaves of `down`, [component][node of `in`].
  GroundLight of_diffuse(int mode, std::span<const double> down) const;
  /// Exitance of mode 0.
  double exitance(const GroundLight& light) const;
  /// All numbers that say what the ground does.
  const std::vector<double>& numbers() const { return diffuse_; }
  const std::vector<double>& beam_numbers() const { return beam_; }

 private:
  std::size_t at(int mode, std::size_t out, std::size_t in, int row, int column) const {
    return ((((static_cast<std::size_t>(mode) * out_.position.size() + out) * in_.position.size() + in) *
                 static_cast<std::size_t>(components_) +
             static_cast<std::size_t>(row)) *
                static_cast<std::size_t>(components_) +
            static_cast<std::size_t>(column));
  }
  GaussNodes in_, out_;
  double sun_mu_;
  int modes_, components_;
  std::vector<double> diffuse_;  ///< [mode][out][in][row][column]
  std::vector<double> beam_;     ///< [mode][row][out]
};

}  // namespace ifov::atmosphere
