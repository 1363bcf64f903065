#pragma once

#include <optional>
#include <string>

#include "atmosphere/particles/aerosol_description.h"
#include "io/document/spectrum_document.h"

namespace ifov::io {

/// An index of refraction n + ik: of the built-in table, or spectra.
struct IndexDocument {
  std::string name;  ///< of the table; empty: n and k
  std::optional<SpectrumDocument> n, k;
};

/// Spheres: lognormal by radius and deviation, or a gamma distribution by effective radius and variance.
struct MieDocument {
  std::optional<double> radius_um, deviation;
  std::optional<double> effective_radius_um, effective_variance;
  IndexDocument index;
  SourcePosition position;
};

/// Haze of the document's own, in numbers.
struct OwnHazeDocument {
  double optical_depth = 0.0;   ///< vertical, of extinction ...
  double wavelength_um = 0.55;  ///< ... at this wavelength
  std::optional<double> angstrom;
  std::optional<SpectrumDocument> single_scattering_albedo, asymmetry;
  std::optional<DocumentFile> phase_function;
  std::optional<MieDocument> mie;
  /// Above mean sea level; absent: from the ground, to the end of the air.
  std::optional<double> base_km, top_km;
  std::optional<double> scale_height_km;  ///< absent: uniform between base and top; without a top 2 km
};

/// Haze and dust: of the tables, or of the document's own in their place.
struct AerosolDocument {
  atmosphere::AerosolDescription tables;  ///< its `own` is empty
  std::optional<OwnHazeDocument> own;
  SourcePosition position;
};

}  // namespace ifov::io
