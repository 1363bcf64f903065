#pragma once

#include <span>
#include <vector>

#include "radiometry/spectrum_block.h"

namespace ifov::math {
struct Ray;
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

 private:
  const transport::SpectralScene& scene_;
  radiometry::SpectrumBlock work_, by_angle_;
  std::vector<double> share_;
  std::vector<float> channels_;
};

}  // namespace ifov::render
