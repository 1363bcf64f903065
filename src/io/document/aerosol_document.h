#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atmosphere/particles/aerosol_description.h"
#include "atmosphere/particles/particle_layer.h"
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

/// A retrieval of AERONET's inversions, by its files.
struct AeronetDocument {
  DocumentFile file;
  std::optional<DocumentFile> phase_functions;
  std::string time;  ///< "2019-08-15T21:46:45Z"; empty: the files' only retrieval
  SourcePosition position;
};

/// Haze of the document's own, in numbers.
struct OwnHazeDocument {
  std::optional<double> optical_depth;     ///< vertical, of extinction ...
  std::optional<AeronetDocument> aeronet;  ///< or all optics by a file
  double wavelength_um = 0.55;             ///< ... at this wavelength
  std::optional<double> angstrom;
  std::optional<SpectrumDocument> single_scattering_albedo, asymmetry;
  std::optional<DocumentFile> phase_function;
  std::optional<MieDocument> mie;
  std::optional<std::string> kind;         ///< one of the types of the tables ...
  std::optional<double> humidity_percent;  ///< ... at this relative humidity
  /// Above mean sea level; absent: from the ground, to the end of the air.
  std::optional<double> base_km, top_km;
  std::optional<double> scale_height_km;  ///< absent: uniform between base and top; without a top 2 km
  std::vector<atmosphere::ParticleLayer::Height> heights;  ///< in place of these
  SourcePosition position;
};

/// Haze and dust: of the tables, or of the document's own in their place.
struct AerosolDocument {
  atmosphere::AerosolDescription tables;  ///< its `own` is empty
  std::optional<OwnHazeDocument> own;
  std::vector<OwnHazeDocument> mixture;  ///< several of one's own; `own` is then none
  bool has_own() const { return own || !mixture.empty(); }
  SourcePosition position;
};

}  // namespace ifov::io
