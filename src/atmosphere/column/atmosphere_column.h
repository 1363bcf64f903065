#pragma once

#include <memory>
#include <string>
#include <vector>

#include "atmosphere/column/atmosphere_description.h"
#include "atmosphere/gas/gas_amounts.h"
#include "atmosphere/gas/term_overlap.h"
#include "atmosphere/layer_optics.h"
#include "atmosphere/particles/aerosol_column.h"
#include "atmosphere/profile/built_profile.h"

namespace ifov::atmosphere {

class ColumnTerms;

/// How absorption is split into terms and the air into layers.
struct ColumnOptions {
  int terms = 5;       ///< of each gas: 3, 5 or 8
  int most_terms = 8;  ///< of all gases together
  /// At least, where air glows (kFirstThermal_um): what a term leaves out of a clear window's absorption is
  /// missing in its light.
  int warm_terms = 8, most_warm_terms = 16;
  /// Where there shall be a level besides the usual ones, such as at the sensor.
  std::vector<double> extra_altitudes_km = {};
};

/// The layers at one wavenumber. Lines are resolved to 20 cm-1, or to the bins of a table of terms; within that the terms are
/// what varies.
struct ColumnOptics {
  double wavenumber_cm1 = 0.0;
  double wavelength_um = 0.0;
  AbsorptionSet lines;
  std::vector<double> continuum;  ///< vertical absorption depth of each layer, the same in every term
  LayerOptics scattering;         ///< everything but gas_absorption
  double terms_error = 0.0;  ///< of transmittance: what terms of a table are off by, as it says; 0 of bands

  std::size_t terms() const { return lines.terms(); }
  double weight(std::size_t term) const { return lines.weight[term]; }
  /// The layers as the solvers take them, lines and continua together.
  LayerOptics term(std::size_t term) const;
};

/// An atmosphere of horizontal layers: from a description to the optical depths of its layers at any
/// wavenumber. Immutable; at() may be called from several threads.
class AtmosphereColumn {
 public:
  /// InputError for what a description cannot mean.
  explicit AtmosphereColumn(const AtmosphereDescription& description, const ColumnOptions& options = {});

  const AtmosphereDescription& description() const { return description_; }
  const Profile& profile() const { return built_.profile; }
  const Levels& levels() const { return levels_; }
  const AerosolColumn& aerosol() const { return aerosol_; }
  /// What had to be changed in what was asked for, in words for the user.
  const std::vector<std::string>& remarks() const { return built_.remarks; }

  /// Terms in place of bands, as their table has them and as the layers; null where there are none.
  const GasTermTable* gas_terms() const { return description_.gas_terms.get(); }
  const ColumnTerms* terms() const { return terms_.get(); }
  /// At a wavenumber of 200 to 50000 cm-1 (0.2 to 50 um); InputError outside. In the bin of a table of terms that it lies in,
  /// where there is one.
  ColumnOptics at(double wavenumber_cm1) const;

 private:
  AtmosphereDescription description_;
  ColumnOptions options_;
  BuiltProfile built_;
  AerosolColumn aerosol_;
  Levels levels_;
  std::vector<GasAmounts> gases_;                 // of each layer
  std::shared_ptr<const ColumnTerms> terms_;      // null without
  std::vector<double> air_molecules_cm2_;         // of each layer
  std::vector<std::vector<double>> aerosol_550_;  // [layer][region]
};

/// Altitudes of the levels over a ground: 0.05, 0.1, 0.25, 0.5, 0.75 km ... above it, every half km to 5 km,
/// every km to 20 km and coarser to 100 km, and at `extra` altitudes (InputError outside the air) but for those within
/// a millimetre of another. Thin near
/// the ground, because in opaque bands the sky is the air of the first metres.
std::vector<double> level_altitudes_km(double ground_km, const std::vector<double>& extra = {});

}  // namespace ifov::atmosphere
