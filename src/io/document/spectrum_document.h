#pragma once

#include <variant>
#include <vector>

#include "io/document/document_values.h"

namespace ifov::io {

/// What a spectrum is beyond the wavelengths it is given for.
enum class OutsideRange {
  error,   ///< a wavelength outside is an input error
  extend,  ///< the end values are repeated
};

/// The same value at every wavelength.
struct ConstantSpectrum {
  double value = 0.0;
};

/// Columns of numbers; the first is the wavelength.
struct CsvSpectrum {
  DocumentFile file;
  double um_per_unit = 1.0;  ///< micrometres per unit of the wavelength column
  int column = 2;            ///< which column holds the values, counted from 1
  double scale = 1.0;        ///< value in SI = number in the file * scale
};

/// One file of the ECOSTRESS (ASTER) library, or a vswir and a tir file that are joined.
struct EcostressSpectrum {
  std::vector<DocumentFile> files;
};

/// Values written in the document: as many as wavelengths, which rise strictly.
struct TableSpectrum {
  std::vector<double> wavelength_um;
  std::vector<double> values;
};

/// A spectrum. Reflectance, emissivity and transmittance are fractions; radiance is in W m-2 sr-1 um-1,
/// irradiance in W m-2 um-1.
struct SpectrumDocument {
  std::variant<ConstantSpectrum, CsvSpectrum, EcostressSpectrum, TableSpectrum> source;
  OutsideRange outside = OutsideRange::error;
  SourcePosition position;
};

}  // namespace ifov::io
