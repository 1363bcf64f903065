#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace ifov::materials {

class Bsdf;

/// What two models side by side are off from a third that they stand in for, of light from 20, 50 and 75 deg and at the worst of
/// some wavelengths of its spectra.
struct LevelError {
  /// Of the directional-hemispherical reflectance (or transmittance), as a share of it.
  double reflectance = 0.0;
  /// Integral of |difference of BSDF| x cosine over directions, as a share of the same: light that leaves in another direction.
  double direction = 0.0;
};

/// (1 - share) low + share high against `exact`, over 32 x 32 directions (one of a delta) that the latter draws. All three are of one
/// model.
LevelError level_error(const Bsdf& low, const Bsdf& high, double share, const Bsdf& exact);

/// Values of a parameter at which a model is made; between them two neighbours stand side by side, weighed linearly.
struct ParameterLevels {
  std::vector<double> values;  ///< rising
  LevelError worst;            ///< between any two of them
};

/// What levels may be off.
inline constexpr LevelError kLevelTolerance{1e-3, 1e-3};
/// What they may be off where there is no room for more of them: half-widths do not hold it.
inline constexpr LevelError kLevelLimit{5e-3, 5e-3};

/// Levels among the values that occur (`values`: one or more, rising, without repetition), first and last among them: the one in the
/// middle between two levels is added, where the error there is largest first, until it is everywhere within kLevelTolerance or there
/// are `most`. `make` gives the models of a value: one for each of several settings of whatever else changes them.
ParameterLevels place_levels(std::span<const double> values, std::size_t most,
                             const std::function<std::vector<std::shared_ptr<const Bsdf>>(double)>& make);

}  // namespace ifov::materials
