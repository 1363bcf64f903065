#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
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

/// A file of the USGS library; `wavelengths` stand in one of their own from version 7 on.
struct UsgsSpectrum {
  DocumentFile file;
  std::optional<DocumentFile> wavelengths;
};

/// A file of an ASD field spectrometer.
struct AsdSpectrum {
  DocumentFile file;
};

/// One spectrum of an ENVI spectral library, by its name or by a number that counts from 1.
struct SliSpectrum {
  DocumentFile file;
  std::variant<int, std::string> which = 1;
  double scale = 1.0;
};

/// One curve of a DIRSIG emissivity file, by a number that counts from 1.
struct EmsSpectrum {
  DocumentFile file;
  int curve = 1;
};

/// A curve of the embedded spectral library; parse_document has checked that it exists.
struct LibrarySource {
  std::string material;
  std::size_t curve = 0;  ///< its position in the material
};

/// Values written in the document: as many as wavelengths, which rise strictly.
struct TableSpectrum {
  std::vector<double> wavelength_um;
  std::vector<double> values;
};

/// What a spectrum is of. Samples of spectral libraries give the first three; `fraction` is any other number
/// from 0 to 1, `number` any number without a unit, such as a refractive index.
enum class SpectrumOf { reflectance, emissivity, transmittance, fraction, number, radiance, irradiance };

struct SpectrumDocument;

/// A visible-to-shortwave and a thermal spectrum of the same sample, as one.
struct JoinedSpectrum {
  std::vector<SpectrumDocument> parts;  ///< two, in either order
};

/// A spectrum. Reflectance, emissivity and transmittance are fractions; radiance is in W m-2 sr-1 um-1, irradiance in W m-2 um-1.
struct SpectrumDocument {
  std::variant<ConstantSpectrum, CsvSpectrum, EcostressSpectrum, UsgsSpectrum, AsdSpectrum, SliSpectrum,
               EmsSpectrum, LibrarySource, JoinedSpectrum, TableSpectrum>
      source;
  SpectrumOf quantity = SpectrumOf::fraction;
  std::optional<std::array<double, 2>> range_um;  ///< only this part of the file
  OutsideRange outside = OutsideRange::error;
  SourcePosition position;
};

}  // namespace ifov::io
