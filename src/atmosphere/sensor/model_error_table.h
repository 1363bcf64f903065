#pragma once

#include <span>
#include <vector>

namespace ifov::atmosphere {

/// How far the model itself may be off within a range of wavelengths: what nobody's numerics can mend
/// (docs/theory/atmosphere_model_error.md; data/atmosphere/model_error.txt, whose sections are rows of these).
struct ModelErrorRow {
  double first_um = 0.0, last_um = 0.0;
  double missing = 0.0;    ///< optical depth of what the model lacks, per vertical path through all air
  double wet = 0.0;        ///< the same per g cm-2 of water vapour
  double gas = 0.0;        ///< of the optical depth that the gases have, relative
  double molecules = 0.0;  ///< of sunlight that molecules scatter into the path, relative
  double haze = 0.0;       ///< of the aerosol's depth and of what it scatters, relative
  double emitted = 0.0;    ///< of what the air emits, relative, beside what depths make of it
  double floor = 0.0;      ///< of scattered sunlight at least, as a reflectance
};

/// What a path leads through.
struct PathContent {
  double air_mass = 0.0;     ///< vertical columns of all air
  double water_g_cm2 = 0.0;  ///< vapour
  double gas_depth = 0.0;    ///< of all gases, by the model
  double haze_depth = 0.0;   ///< of the aerosol
};

class ModelErrorTable {
 public:
  /// Rows in the order of wavelength; InputError where they overlap or are not numbers that can be.
  explicit ModelErrorTable(std::vector<ModelErrorRow> rows);
  /// That of data/atmosphere.
  static const ModelErrorTable& built_in();

  /// Beyond the table: its first or last row. Between two rows: the one before.
  const ModelErrorRow& at(double wavelength_um) const;
  /// How far the optical depth of a path may be off.
  double of_depth(double wavelength_um, const PathContent& path) const;
  /// Relative, of sunlight scattered into a path in air whose aerosol has `haze_share` of the scattering depth.
  double of_scattered(double wavelength_um, double haze_share) const;

 private:
  std::vector<ModelErrorRow> rows_;
};

/// Emission of a path whose levels have these Planck radiances, seen from the first through depths that rise from 0.
double emission_of_levels(std::span<const double> planck, std::span<const double> depth);

}  // namespace ifov::atmosphere
