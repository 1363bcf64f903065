#pragma once

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/scattering_options.h"

namespace ifov::atmosphere {

/// A column computed with more care than the one that is judged by it: every layer halved, 8 terms of each
/// gas joined to twice as many, half as many zenith angles more, half the sublayers' depth and a tenth of the
/// tolerance.
class FinerAtmosphere {
 public:
  explicit FinerAtmosphere(const AtmosphereColumn& judged);

  const AtmosphereColumn& column() const { return column_; }
  /// Layers of the judged column cut into those of this one: gas in proportion to what this one has of it at
  /// that wavenumber, everything else as it is there.
  LayerOptics cut(const LayerOptics& layers, double wavenumber_cm1) const;

  static ScatteringOptions finer(ScatteringOptions options);

 private:
  const AtmosphereColumn& judged_;
  AtmosphereColumn column_;
};

}  // namespace ifov::atmosphere
