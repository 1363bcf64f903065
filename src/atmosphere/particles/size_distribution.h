#pragma once

#include <functional>
#include <limits>
#include <vector>

namespace ifov::atmosphere {

/// Radii of many spheres, and how many have each (in any unit).
struct SizeDistribution {
  std::vector<double> radius_um, number;
  /// ln of the numbers per ln r at a radius, and from where to where; null where the spheres above are all that there are.
  std::function<double(double)> log_number = {};
  double least_um = 0.0, most_um = 0.0;
  /// Where all spheres of the distribution are not in its range: their number, in the unit of `number`; 0: they are.
  double of_all = 0.0;

  /// Ratio of the sums of r^3 and r^2, and Hansen and Travis's (1974, eq. 2.54) variance about it.
  double effective_radius_um() const;
  double effective_variance() const;
  /// Of all spheres of the distribution the share within its range.
  double share_within() const;
  /// The same spheres by as many radii as light of this wavelength asks for: what a sphere does goes up and down with its size
  /// parameter x over some tenths. Steps of x are 0.05 where more than 1e-4 of the most scattering is, if so many terms of Mie's series
  /// do, and else as fine as they allow, finest where most of the scattering is.
  SizeDistribution resolved(double wavelength_um, double most_terms = 1e6) const;
};

struct RadiusRange {
  double least_um = 0.0, most_um = std::numeric_limits<double>::infinity();
};

/// Numbers that are normal in ln r: median radius and geometric standard deviation (above 1), within a range.
SizeDistribution lognormal(double median_um, double deviation, RadiusRange range = {});
/// Numbers per radius as r^alpha exp(-(alpha / gamma) (r / mode)^gamma) (Deirmendjian 1969), alpha and gamma above 0.
SizeDistribution modified_gamma(double mode_um, double alpha, double gamma);
/// That with gamma = 1 which has this effective radius and variance, 0 to 1/3 without the ends (Hansen and Travis 1974, eq. 2.56).
SizeDistribution gamma_by_effective_radius(double effective_um, double variance);

}  // namespace ifov::atmosphere
