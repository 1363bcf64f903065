#pragma once

#include <optional>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "io/document/spectrum_document.h"

namespace ifov::io {

/// Between the scene and the camera (transmittance, path radiance) and between the Sun and the scene.
/// What is absent changes nothing.
struct TabulatedAtmosphere {
  std::optional<SpectrumDocument> transmittance;
  std::optional<SpectrumDocument> path_radiance;
  std::optional<SpectrumDocument> sun_transmittance;
};

/// An atmosphere computed from its state.
struct ModelledAtmosphere {
  atmosphere::AtmosphereDescription description;
  std::optional<double> sensor_altitude_km;  ///< above mean sea level; absent: a frame camera's own, else above the air
};

/// What another code computed.
struct ImportedDocument {
  std::vector<DocumentFile> files;
  std::vector<double> albedos;              ///< of the grounds of the runs, in their order; empty: as the files say
  std::vector<DocumentFile> uvspec_inputs;  ///< empty, or one for each file
  SourcePosition position;
};

struct AtmosphereDocument {
  std::optional<TabulatedAtmosphere> tabulated;
  std::optional<ModelledAtmosphere> modelled;
  std::optional<ImportedDocument> imported;
  SourcePosition position;
};

}  // namespace ifov::io
