#pragma once

#include "transport/path_record.h"

namespace ifov::transport {

class SpectralScene;

/// What the air between a sensor and what its rays meet makes of the light of their paths.
class ViewAtmosphere {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  explicit ViewAtmosphere(const SpectralScene& scene) : scene_(scene) {}

  /// Turns radiance at the far end of the first segment, in nodes (stride() floats), into radiance at the sensor. What
  /// comes from the sky of an atmosphere is left as it is: it holds the air already.
  void apply(const PathRecord::Path& path, float* radiance) const;
  /// The same of light in two parts, of which the first gets what the air adds; the second may be null.
  void apply(const PathRecord::Path& path, float* first, float* second) const;
  /// What it leaves of light of the far end, in nodes: 1 where it stands before nothing, as before the sky itself.
  void transmittance(const PathRecord::Path& path, float* share) const;
  /// Takes as much from light in nodes.
  void dim(const PathRecord::Path& path, float* radiance) const;

 private:
  const SpectralScene& scene_;
};

}  // namespace ifov::transport
