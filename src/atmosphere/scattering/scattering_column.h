#pragma once

#include <cstddef>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "atmosphere/layer_optics.h"
#include "atmosphere/scattering/scattering_options.h"

namespace ifov::atmosphere {

/// Lowest Sun that a column about a round Earth is solved for: at 8 degrees below the horizon what the air scatters is dark.
inline constexpr double kLowestSun_rad = 98.0 / 180.0 * std::numbers::pi;

/// A column of layers cut into sublayers, from the top down, with the depth of the sunbeam at every boundary.
///
/// Depths marked `true` are those of LayerOptics. All others are delta-M scaled (Wiscombe 1977): the part
/// f, moment 2 nodes of the aerosol's phase function (g^(2 nodes) of a Henyey-Greenstein function), counts as not scattered at all.
class ScatteringColumn {
 public:
  /// Sun zenith angle, the same over every boundary; below 90 degrees where layers are flat, kLowestSun_rad else. Throws
  /// std::invalid_argument where sizes differ, altitudes do not rise or the Sun is lower. `parts`: into how many sublayers each
  /// layer is cut, from the ground up; empty: as the options say.
  ScatteringColumn(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                   const ScatteringOptions& options, std::span<const int> parts = {});

  /// The layers alone, for single_scattering() along lines of sight: no sublayers, and no sunbeam.
  static ScatteringColumn of_layers(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                                    const ScatteringOptions& options);

  /// What a layer scatters, as fractions of its scaled extinction: single-scattering albedos.
  struct Mixture {
    double rayleigh = 0.0;
    double aerosol = 0.0;  ///< before the forward peak is taken away
    double asymmetry = 0.0;
    double peak = 0.0;      ///< f
    std::size_t layer = 0;  ///< from the ground up: of `phases`
    /// Moments of the aerosol's phase function without its peak (mean cosine, mean of P_2).
    double first = 0.0, second = 0.0;
  };

  std::size_t sublayers() const { return depth.size(); }
  double top_km() const { return altitude_km.front(); }
  double ground_km() const { return altitude_km.back(); }

  bool spherical = true;  ///< sunbeams and skies go through shells
  double sun_mu = 1.0;
  double depolarization = 0.0;
  std::shared_ptr<const AerosolPhases> phases;  ///< as in LayerOptics
  std::vector<Mixture> mixtures;                ///< of the layers, top down
  std::vector<double> altitude_km;              ///< [sublayers + 1], falling
  std::vector<double> beam_depth;               ///< [sublayers + 1] along the sunbeam from space
  std::vector<double> true_beam_depth;          ///< [sublayers + 1]
  std::vector<double> depth;                    ///< [sublayers] vertical
  std::vector<double> true_depth;               ///< [sublayers] vertical
  std::vector<std::size_t> mixture_of;          ///< [sublayers]
  /// Of the layers themselves, from the top down: boundaries [layers + 1] and vertical depths.
  std::vector<double> layer_altitude_km, layer_depth, layer_true_depth;

 private:
  enum class Detail { kLayers, kSublayers };
  ScatteringColumn(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                   const ScatteringOptions& options, std::span<const int> parts, Detail detail);
  void add_beams(const Levels& levels, const std::vector<double>& scaled, const std::vector<double>& whole);
  void beam_lengths(double level_km, std::vector<double>& lengths, std::size_t first) const;
};

}  // namespace ifov::atmosphere
