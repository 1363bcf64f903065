#pragma once

#include <vector>

namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// The brightest of a scene: what emits (transport::EmitterChoice), and the Sun in mirrors, panes and gloss.
struct Outshining {
  double contrast =
      1.0;  ///< how many times as bright as white in the scene's light, and as what is warm; 1: nothing is
  std::vector<double> radiance;  ///< by channel, W m-2 sr-1 um-1, at most
};

Outshining outshining(const transport::SpectralScene& scene);

}  // namespace ifov::render
