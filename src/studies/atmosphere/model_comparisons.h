#pragma once

#include <string>
#include <vector>

#include "atmosphere/sensor/model_error_table.h"

namespace ifov::studies {

class ReferenceData;

/// One figure of the air by the model and by a program with newer data.
struct ModelComparison {
  enum class Quantity {
    transmittance,  ///< of a path, everything on it
    scattered,      ///< sunlight scattered into a path, as a reflectance
    emitted,        ///< radiance or flux that a path emits, W m-2 sr-1 um-1 or W m-2 um-1
  };
  std::string name;  ///< of the case: a run of the other program
  /// Whether the table of the model's error is made of this case; the others test it.
  bool makes_table = false;
  Quantity quantity = Quantity::transmittance;
  double wavelength_um = 0.0;
  atmosphere::PathContent path;
  double haze_share = 0.0;  ///< of the scattering depth
  double ours = 0.0, reference = 0.0;
  double by_depth = 0.0;  ///< of `stated` what depths make of emission
  double stated = 0.0;    ///< what the model's error is stated to be at most, in the unit of both

  bool covered() const;
};

/// All that the reference data have; what is missing there is left out. `step`: every how many channels of a run
/// whose light is scattered.
std::vector<ModelComparison> model_comparisons(const ReferenceData& reference, int step = 6);

/// As a table of text with a heading, for tools/make_model_error.py.
std::string comparisons_csv(const std::vector<ModelComparison>& comparisons);

}  // namespace ifov::studies
