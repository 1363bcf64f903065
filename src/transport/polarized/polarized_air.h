#pragma once

#include "transport/path_record.h"
#include "transport/polarized/stokes_rows.h"

namespace ifov::transport {

class SpectralScene;

/// As ViewAtmosphere, of light and its polarization: transmittance takes from all of it alike, and the path adds its own light.
class PolarizedAir {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  explicit PolarizedAir(const SpectralScene& scene) : scene_(scene) {}

  /// `light` is about a frame of the direction towards the sensor, and stays so.
  void apply(const PathRecord::Path& path, const radiometry::PolarizationFrame& frame,
             const StokesRows& light) const {
    see_through(path, light);
    add_path(path, frame, light);
  }
  /// The first part of it: what the air leaves of light that comes from the far end.
  void see_through(const PathRecord::Path& path, const StokesRows& light) const;

 private:
  void add_path(const PathRecord::Path& path, const radiometry::PolarizationFrame& frame,
                const StokesRows& light) const;
  /// Whether the light is the sky's, which holds the air already.
  bool is_sky(const PathRecord::Path& path) const;

  const SpectralScene& scene_;
};

}  // namespace ifov::transport
