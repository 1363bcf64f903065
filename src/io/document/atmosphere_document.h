#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atmosphere/column/atmosphere_description.h"
#include "io/document/cloud_document.h"
#include "io/document/spectrum_document.h"

namespace ifov::io {

/// Between scene and camera (transmittance, path radiance), Sun and scene. What is absent changes nothing.
struct TabulatedAtmosphere {
  std::optional<SpectrumDocument> transmittance, path_radiance, sun_transmittance;
};

/// DIRSIG's SimpleAtm: a Sun of 5800 K as bright as on a clear day, a sky that only glows, and clear air.
struct SimpleAtmosphere {
  double sky_temperature_k = 0.0;
};

/// DIRSIG's UniformAtm: the same light at all wavelengths, and clear air.
struct UniformAtmosphere {
  double direct_w_m2_um = 0.0;   ///< across the beam, at the ground
  double diffuse_w_m2_um = 0.0;  ///< of the sky, on level ground
};

/// DIRSIG's FourCurveAtm: light at the ground, and air that is the same all along a path.
struct FourCurveAtmosphere {
  SpectrumDocument direct, diffuse;               ///< irradiance across the beam; of the sky on level ground
  SpectrumDocument transmittance, path_radiance;  ///< of each `length_m`
  double length_m = 1.0;
  double distance_m = 0.0;  ///< from the scene to the camera
};

/// An atmosphere computed from its state.
struct ModelledAtmosphere {
  atmosphere::AtmosphereDescription description;          ///< but for its aerosol
  std::shared_ptr<const struct AerosolDocument> aerosol;  ///< null: that of no key
  std::vector<CloudDocument> clouds;                      ///< beside the aerosol
  std::optional<DocumentFile> gas_model;                  ///< terms in place of the built-in bands
  /// Above mean sea level; absent: a frame camera's own, else above the air.
  std::optional<double> sensor_altitude_km;
  bool adjacency = true;                ///< the scene's own ground lights the air; false: surroundings alone
  std::string interval = "with model";  ///< intervals hold how far the model is from the air; or "numerical"
};

/// What another code computed.
struct ImportedDocument {
  std::vector<DocumentFile> files;
  std::vector<double> albedos;  ///< of the grounds of the runs, in their order; empty: as the files say
  std::vector<DocumentFile> uvspec_inputs;  ///< empty, or one for each file
  SourcePosition position;
};

struct AtmosphereDocument {
  std::optional<TabulatedAtmosphere> tabulated;
  std::optional<SimpleAtmosphere> simple;
  std::optional<UniformAtmosphere> uniform;
  std::optional<FourCurveAtmosphere> four_curve;
  std::optional<ModelledAtmosphere> modelled;
  std::optional<ImportedDocument> imported;
  /// What makes the sky, by its key; empty: the light's own 'sky'.
  std::string sky_maker() const {
    return modelled ? "profile" : simple ? "simple" : uniform ? "uniform" : four_curve ? "four_curve" : "";
  }
  SourcePosition position;
};

}  // namespace ifov::io
