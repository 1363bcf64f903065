#pragma once

#include <span>
#include <vector>

#include "radiometry/spectrum.h"

namespace ifov::radiometry {
struct Channel;
}
namespace ifov::scene {
struct Scene;
}

namespace ifov::session {

struct ColourGuess;

/// A scene as its spectral nodes are judged by it.
struct SurfacesOfNodes {
  const scene::Scene& scene;
  std::span<const radiometry::Channel> channels;
  std::span<const ColourGuess> colour_guesses;
  bool polarized = false;
  bool modelled_air = false;
};

/// Spectra of all that surfaces make of light, at some angles too, and of what stands before it: nodes have to hold them.
std::vector<radiometry::Spectrum> spectra_of_surfaces(const SurfacesOfNodes& of);
/// Of lamps, each shape once: a street of them has one light.
std::vector<radiometry::Spectrum> spectra_of_lamps(const scene::Scene& scene);

/// Whether any of its materials polarizes light.
bool polarizes(const scene::Scene& scene);

}  // namespace ifov::session
