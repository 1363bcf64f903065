#pragma once

#include <string>
#include <vector>

#include "io/spectra/csv_spectrum.h"
#include "io/tables/text_table.h"
#include "radiometry/spectrum.h"

namespace ifov::io {

/// Rows of a spectrum as they are read, each with the line it stands on.
class SpectrumRows {
 public:
  /// Takes over a wavelength in the file's unit; fails on one that is not above 0.
  void add(const TextFile& file, int line, const Field& wavelength_field, double wavelength, double value,
           WavelengthUnit unit);

  bool empty() const { return wavelength_um_.empty(); }
  std::size_t size() const { return wavelength_um_.size(); }
  double first_um() const { return wavelength_um_.front(); }
  double last_um() const { return wavelength_um_.back(); }

  /// The spectrum in ascending order; fails where rows neither ascend nor descend throughout.
  radiometry::Spectrum spectrum(const TextFile& file, radiometry::OutsideRange outside, std::string name);

 private:
  std::vector<double> wavelength_um_, values_;
  std::vector<int> lines_;
};

double to_um(double wavelength, WavelengthUnit unit);

}  // namespace ifov::io
