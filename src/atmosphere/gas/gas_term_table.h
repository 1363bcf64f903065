#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {

/// Where between the pressures and the temperatures of a table a state of the air lies: ln k is linear in ln p and in 1/T,
/// and beyond the first and the last of them as it is there.
class StateGrid {
 public:
  StateGrid() = default;
  /// Rising, at least one of each, above 0; hPa and K.
  StateGrid(std::vector<double> pressure_hPa, std::vector<double> temperature_K);

  const std::vector<double>& pressure_hPa() const { return pressure_hPa_; }
  const std::vector<double>& temperature_K() const { return temperature_K_; }
  /// Of pressures times temperatures; temperatures follow each other.
  std::size_t states() const { return pressure_hPa_.size() * temperature_K_.size(); }

  struct Place {
    std::size_t state[4];  ///< around, some of them with weight 0
    double weight[4];      ///< sum 1
  };
  Place place(double pressure_hPa, double temperature_K) const;
  /// Whether a state lies within, but for 1 % of the pressure and 1 K; pressures below the first are within where that is
  /// kThin_hPa or less, where lines are as narrow as they get.
  bool holds(double pressure_hPa, double temperature_K) const;
  static constexpr double kThin_hPa = 10.0;

 private:
  std::vector<double> pressure_hPa_, temperature_K_, log_pressure_, inverse_temperature_;
};

/// A gas of a table of terms.
struct TermGas {
  Gas gas = Gas::h2o;
  /// Broadening by the gas itself over that by air: a share x of the air broadens as the pressure times 1 + (this - 1) x.
  double self_broadening = 1.0;
  /// The cross sections hold what of this gas is absorbed continuously, too: the built-in continuum of it stays out.
  bool holds_continuum = false;
  /// By what share of itself the depth of this gas by these cross sections may be off, as whoever made them says.
  std::optional<double> depth_error = {};
};

/// Terms of a spectral bin: the mean transmittance of the bin through a path is the sum of
/// weight exp(-sum over gases and path of cross section times molecules per cm2). A term has one weight, and of every gas a cross
/// section for every state of the grid.
struct TermBin {
  std::vector<double> weight;             ///< sum 1; none: no gas absorbs here
  std::vector<std::vector<float>> log_k;  ///< [gas][state * terms + term], ln cm2 per molecule
  double error = 0.0;                     ///< largest of transmittance, as whoever made the terms found it

  std::size_t terms() const { return weight.size(); }
  /// cm2 per molecule of the terms of a gas at a place of the grid.
  std::vector<double> cross_sections(std::size_t gas, const StateGrid::Place& place) const;
};

/// k below this stands for none, cm2 per molecule.
inline constexpr double kNoAbsorption_cm2 = 1e-37;
/// Its logarithm, or that of a larger k.
float log_cross_section(double k_cm2);

/// Absorption of gases by spectral bins of a width of their own, side by side from first_cm1 on.
struct GasTermTable {
  std::string name;    ///< as messages call it
  std::string source;  ///< of the spectra that the terms were made of, in words
  double first_cm1 = 0.0, step_cm1 = 1.0;
  StateGrid states;
  std::vector<TermGas> gases;
  std::vector<TermBin> bins;

  double edge_cm1(std::size_t bin) const { return first_cm1 + step_cm1 * static_cast<double>(bin); }
  double last_cm1() const { return edge_cm1(bins.size()); }
  double centre_cm1(std::size_t bin) const { return first_cm1 + step_cm1 * (static_cast<double>(bin) + 0.5); }
  /// The bin that a wavenumber lies in; none at and beyond the ends.
  std::optional<std::size_t> bin_at(double wavenumber_cm1) const;
  /// Whether every gas says what its depth may be off by.
  bool depth_errors_known() const;
};

/// What a layer holds of one gas, and the state at which it absorbs: means weighted with its molecules.
struct LayerGas {
  double molecules_cm2 = 0.0;
  double pressure_hPa = 0.0;  ///< with what the gas itself broadens
  double temperature_K = 0.0;
};
std::vector<LayerGas> layer_gas(const Profile& profile, const TermGas& gas,
                                const std::vector<double>& altitude_km);

/// Of the gas above the ground the share that lies at states the grid does not hold; with where the most of it is.
struct OutsideGrid {
  double share = 0.0, altitude_km = 0.0, pressure_hPa = 0.0, temperature_K = 0.0;
};
OutsideGrid outside(const StateGrid& states, std::span<const LayerGas> layers,
                    const std::vector<double>& altitude_km);

}  // namespace ifov::atmosphere
