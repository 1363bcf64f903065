#pragma once

#include <array>

#include "radiometry/spectrum_block.h"
#include "transport/parts/light_part.h"
#include "transport/polarized/polarized_air.h"
#include "transport/polarized/polarized_path_light.h"
#include "transport/view_atmosphere.h"

namespace ifov::transport {

/// As LightInParts, with the polarization of light: every part has a Stokes vector, and they add up to that of the whole. An
/// object serves one thread.
class PolarizedLightInParts : PolarizedPathLight {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  explicit PolarizedLightInParts(const SpectralScene& scene);

  /// Of the parts of radiance, in the order of LightPart, and the share that the air leaves of them; in nodes.
  struct AtSensor {
    std::array<StokesRows, kRadianceParts> radiance;
    float* transmittance;
  };
  /// Of path k, about a frame of the direction towards the sensor; the caller's until the next call.
  const AtSensor& at_sensor(const PathRecord& record, std::size_t k,
                            const radiometry::PolarizationFrame& frame);

 private:
  void add(const PathRecord& record, const PathRecord::Path& path,
           const radiometry::PolarizationFrame& frame);
  void add_seen_sky(const PathRecord& record, const PathRecord::Path& path,
                    const radiometry::PolarizationFrame& frame);
  /// Begins `out_` at a vertex anew, without light.
  void clear_out(const Directions& directions);
  void add_out(LightPart part, const radiometry::PolarizationFrame& frame);
  void add_rows(LightPart part, const StokesRows& light);
  const StokesRows& rows(LightPart part) const { return parts_.radiance[static_cast<std::size_t>(part)]; }

  ViewAtmosphere air_;
  PolarizedAir polarized_air_;
  radiometry::SpectrumBlock spectra_of_parts_, surroundings_;
  AtSensor parts_;
};

}  // namespace ifov::transport
