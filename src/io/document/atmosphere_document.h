#pragma once

#include <optional>

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

struct AtmosphereDocument {
  std::optional<TabulatedAtmosphere> tabulated;
  std::optional<ModelledAtmosphere> modelled;
  SourcePosition position;
};

}  // namespace ifov::io
