#pragma once

#include <optional>

namespace ifov::sensor {

/// Carriers that wander sideways between where light frees them and where an element's field takes them. A density of carriers that
/// goes along x as cos 2 pi f x falls, where no field is, as if they lived for L(f), 1 / L(f)^2 = 1 / L^2 + (2 pi f)^2; lengths in
/// pixels. Either
/// - light comes from behind and is absorbed there, at the end of a layer of thickness t without a field (whose back takes no carriers), and
///   the share cosh(t / L) / cosh(t / L(f)) is left: sech 2 pi f t where they live long; or
/// - light comes from the front, through a depth d whose field takes carriers straight, into what has no field and no end: with
///   a the absorption coefficient, 1 - exp(-a d) / (1 + a L(f)) over the same at f = 0.
struct CarrierDiffusion {
  double field_free_px = 0.0;       ///< t; 0: light comes from the front
  std::optional<double> length_px;  ///< L; none: endless, of light from behind alone
  double depletion_px = 0.0;        ///< d
  double absorption_per_px = 0.0;   ///< a

  double mtf(double cycles_px) const;
  /// Share of carriers that stay where they are, of light from the front: the modulation at the highest frequencies.
  double staying() const;
  /// Beyond which less than 1e-7 of the carriers get, and the variance along an axis.
  double reach_px() const;
  double variance_px2() const;
};

}  // namespace ifov::sensor
