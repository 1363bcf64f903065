#include "io/spectra/spectrum_rows.h"

#include <algorithm>

#include "core/error.h"

namespace ifov::io {

double to_um(double wavelength, WavelengthUnit unit) {
  switch (unit) {
    case WavelengthUnit::nanometres: return wavelength * 1e-3;
    case WavelengthUnit::wavenumber_per_cm: return 1e4 / wavelength;
    case WavelengthUnit::micrometres: break;
  }
  return wavelength;
}

void SpectrumRows::add(const TextFile& file, int line, const Field& wavelength_field, double wavelength,
                       double value, WavelengthUnit unit) {
  if (!(wavelength > 0.0))
    file.fail(line, wavelength_field.column,
              format("found a wavelength of {:g}; expected one above 0", wavelength));
  wavelength_um_.push_back(to_um(wavelength, unit));
  values_.push_back(value);
  lines_.push_back(line);
}

radiometry::Spectrum SpectrumRows::spectrum(const TextFile& file, radiometry::OutsideRange outside,
                                            std::string name) {
  if (size() > 1 && wavelength_um_[1] < wavelength_um_[0]) {
    std::reverse(wavelength_um_.begin(), wavelength_um_.end());
    std::reverse(values_.begin(), values_.end());
    std::reverse(lines_.begin(), lines_.end());
  }
  for (std::size_t i = 1; i < size(); ++i)
    if (wavelength_um_[i] <= wavelength_um_[i - 1])
      file.fail(std::max(lines_[i - 1], lines_[i]), 0,
                wavelength_um_[i] == wavelength_um_[i - 1]
                    ? "found a wavelength twice; expected each once"
                    : "found a wavelength out of order; expected rows that ascend or descend throughout");
  return radiometry::Spectrum(std::move(wavelength_um_), std::move(values_), outside, std::move(name));
}

}  // namespace ifov::io
