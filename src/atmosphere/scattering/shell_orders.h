#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ifov::atmosphere {

class ScatteringColumn;

/// Orders of scattering in shells about a round Earth with black ground (or in flat layers), of which the mean radiance over
/// all directions is kept, at altitudes and heights of the Sun: about the axis from the Earth's centre to the Sun all places of
/// one height of the Sun are alike. Molecules scatter sunlight by Rayleigh's phase function, aerosol (with delta-M scaled
/// depths) by the first three terms of its own, and all further orders by the first of them and aerosol by the first two. For ratios between the two geometries.
class ShellOrders {
 public:
  struct Geometry {
    bool spherical = true;  ///< of the rays; sunlight always comes through shells
    bool sun_turns = true;  ///< along rays; else the Sun is as high all along each
  };
  struct Fineness {
    int nodes = 6;            ///< Gauss nodes of the zenith angle in each hemisphere
    int azimuths = 3;         ///< on one side of the Sun's plane
    double longest_km = 1e9;  ///< pieces of rays
    bool dusk = false;        ///< where haze and clouds begin and end, within them, and in the Sun's angle
  };
  /// Zenith angles of the Sun rise. Fluxes are told for angle `own`.
  ShellOrders(const ScatteringColumn& column, const Geometry& geometry,
              std::span<const double> sun_zenith_rad, std::size_t own, const Fineness& fineness);

  /// From the ground up, km: some of the column's boundaries of layers.
  const std::vector<double>& altitude_km() const { return altitude_km_; }
  /// Of sunlight of irradiance 1 across the beam: logarithm of the mean radiance of light scattered at least once,
  /// [altitude][angle], and of the flux down, [altitude].
  const std::vector<double>& log_mean() const { return log_mean_; }
  const std::vector<double>& log_flux() const { return log_flux_; }
  /// Where light comes from: means of the radiance times the cosine of its direction with the vertical and with the horizontal
  /// towards the Sun, over the mean radiance, [altitude][angle].
  const std::vector<double>& up() const { return up_; }
  const std::vector<double>& sunward() const { return sunward_; }

 private:
  struct End;
  struct Piece;
  struct Ray;
  struct Light;
  struct Arriving;
  void choose_altitudes(bool finely);
  void tabulate_beams(bool finely);
  Ray ray(double altitude_km, double mu, double longest_km) const;
  End end(double altitude_km, std::size_t layer, double length, double start, double mu) const;
  void add_suns(double mu, int azimuths, Ray& ray) const;
  void add_still(const Ray& ray, double mu, int azimuths, const Light* before, Arriving& arriving) const;
  void add_turning(const Ray& ray, double mu, int azimuths, const Light* before, Arriving& arriving) const;

  const ScatteringColumn& column_;
  Geometry geometry_;
  std::vector<double> angle_rad_;
  std::vector<double> altitude_km_, log_mean_, log_flux_, up_, sunward_;
  double beam_first_rad_ = 0.0, beam_step_rad_ = 1.0;
  std::size_t beam_angles_ = 1;
  std::vector<double> beam_;  ///< [boundary of layers, top down][angle]: transmittance of the sunbeam
};

}  // namespace ifov::atmosphere
