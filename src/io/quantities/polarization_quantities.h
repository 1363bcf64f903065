#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// Of sensors that tell the Stokes vector ("stokes": true): I, Q, U and V by channel about the focal plane's axes, in the radiance unit.
extern const Quantity kStokes, kStokesStandardError, kStokesHalfWidth;
/// Degree of linear polarization by channel, its standard error, the half-width of its interval, and by how much it is likely to be too high.
extern const Quantity kDolp, kDolpStandardError, kDolpHalfWidth, kDolpBias;
/// Angle of linear polarization by channel, degrees, and its standard error.
extern const Quantity kAop, kAopStandardError;

/// A pixel's light in one channel with standard errors; of errors that are not known 0.
struct StokesEstimate {
  double i = 0.0, q = 0.0, u = 0.0, i_error = 0.0, q_error = 0.0, u_error = 0.0;

  /// sqrt(Q^2 + U^2) / I; 0 of no light.
  double dolp() const;
  /// At most, whatever the correlations of I, Q and U, which are of the same paths: a sum's standard error is no larger than its
  /// parts' together.
  double dolp_error() const;
  /// What noise adds to the degree: p - sqrt(p^2 - s^2), and p below s, the standard error of Q and U over I (Wardle and
  /// Kronberg 1974, Astrophys. J. 194; Simmons and Stewart 1985, Astron. Astrophys. 142).
  double dolp_bias() const;
  /// 1/2 atan2(U, Q), degrees from the image's x towards its upward direction, 0 to 180; its error likewise at most, with what is left of
  /// Q and U without noise (as dolp_bias() has it), and that of an angle that may be any (180 / sqrt(12)) where nothing is.
  double aop_deg() const;
  double aop_error_deg() const;
};

}  // namespace ifov::io::quantities
