#pragma once

#include <vector>

namespace ifov::atmosphere {

/// Integral over altitude from `first` to `last` (km, within the levels) of a density given at rising levels:
/// exponential between two that are both positive, else linear. Unit: that of the density times km.
double column_integral(const std::vector<double>& altitude_km, const std::vector<double>& density,
                       double first, double last);

/// The same of density times temperature's function: of `density` times `factor(T)` with T linear between
/// levels, by three-point Gauss quadrature in every interval.
double column_integral(const std::vector<double>& altitude_km, const std::vector<double>& density,
                       const std::vector<double>& temperature_K, double (*factor)(double), double first,
                       double last);

/// The density itself at an altitude, interpolated as the integral does.
double density_at(const std::vector<double>& altitude_km, const std::vector<double>& density,
                  double altitude);

}  // namespace ifov::atmosphere
