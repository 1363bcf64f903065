#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "atmosphere/survey/atmosphere_effects.h"
#include "radiometry/channel.h"
#include "radiometry/spectrum.h"

namespace ifov::atmosphere {

class AtmosphereColumn;
class DirectionalGround;
struct GasTermTable;
struct SensorGeometry;

struct SurveyControl {
  std::size_t most_nodes = 8;  ///< of a channel; 1 for narrow steps
  /// Of AtmosphereEffects::OverGround: reflectance, 0 to 1, and how the ground reflects by direction; null: it is Lambertian.
  radiometry::Spectrum ground = radiometry::Spectrum::constant(0.0);
  std::shared_ptr<const DirectionalGround> directional = {};
  int threads = 0;  ///< 0: all cores
  /// Told between parts of the work how many channels are done; may throw to end it.
  std::function<void(std::size_t)> progress = {};
};

/// Of each channel. InputError as BinOptics.
std::vector<AtmosphereEffects> survey_effects(const AtmosphereColumn& column,
                                              std::span<const radiometry::Channel> channels,
                                              const radiometry::Spectrum& solar_irradiance,
                                              const SensorGeometry& geometry,
                                              const SurveyControl& control = {});

/// Rectangular channels side by side, as wide as the band model resolves (20 cm-1), or a multiple of it where
/// there would be more than `most`; from short to long wavelengths. With a table of terms (which the
/// range must meet; may be null) its bins, or some of them together, as far as it reaches.
std::vector<radiometry::Channel> resolved_steps(double first_um, double last_um,
                                                const GasTermTable* terms = nullptr, std::size_t most = 1500);

}  // namespace ifov::atmosphere
