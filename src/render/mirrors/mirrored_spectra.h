#pragma once

#include <span>
#include <vector>

#include "radiometry/spectrum_block.h"
#include "transport/polarized/stokes_rows.h"

namespace ifov::math {
struct Ray;
}
namespace ifov::radiometry {
struct PolarizationFrame;
}
namespace ifov::scene {
struct ResolvedSurface;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// Light that a mirror sends to the sensor, by channel. An object serves one thread.
class MirroredSpectra {
 public:
  explicit MirroredSpectra(const transport::SpectralScene& scene);

  /// `light`: radiance in nodes that meets a surface at a height; its mirror parts reflect it, and the air takes its
  /// share on the way back along `seen`, a ray from the sensor. By channel, until the next call.
  std::span<const float> channels(const scene::ResolvedSurface& surface, double height_m,
                                  const math::Ray& seen, const float* light);
  /// The same of unpolarized light as Stokes vectors in nodes, about `frame` of the direction towards the sensor; of a scene that is
  /// polarized().
  transport::StokesRows polarized(const scene::ResolvedSurface& surface, double height_m,
                                  const math::Ray& seen, const float* light,
                                  const radiometry::PolarizationFrame& frame);

 private:
  /// What the air leaves of light on its way to the sensor, by node.
  void find_transmittance(double height_m, const math::Ray& seen);

  const transport::SpectralScene& scene_;
  radiometry::SpectrumBlock work_, by_angle_;
  radiometry::SpectrumBlock stokes_, matrix_;
  std::vector<double> share_, transmittance_;
  std::vector<float> channels_;
};

}  // namespace ifov::render
