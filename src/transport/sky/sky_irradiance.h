#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "math/vec3.h"
#include "radiometry/spectrum_block.h"

namespace ifov::transport {

/// A sky's radiance as a table: zenith angles and azimuths (from the Sun's, 0 to pi) between which it is linear, and the
/// spectra of their directions, [zenith][azimuth].
struct SkyTable {
  const std::vector<double>& zenith_rad;
  const std::vector<double>& azimuth_rad;
  const radiometry::SpectrumBlock& spectra;
  math::Vec3 towards_sun;
};

/// What a sky sends to white Lambertian surfaces that see all of it, by their normal: its radiance times the cosine,
/// integrated over what of the upper hemisphere a surface faces, over pi. Exact for a normal at the zenith; elsewhere linear
/// between normals 3 degrees apart, which is within 0.1 % of a sky's largest.
class SkyIrradiance {
 public:
  explicit SkyIrradiance(const SkyTable& sky);
  ~SkyIrradiance();

  /// The spectra that a normal (unit) lies between. `sky` as above; normals off the zenith are worked out when the first
  /// is asked for, from any thread.
  struct Corners {
    std::array<const float*, 4> spectrum;
    std::array<float, 4> weight;
  };
  Corners at(math::Vec3 normal, const SkyTable& sky) const;

 private:
  struct Tilted;
  radiometry::SpectrumBlock level_;
  std::unique_ptr<Tilted> tilted_;
};

}  // namespace ifov::transport
