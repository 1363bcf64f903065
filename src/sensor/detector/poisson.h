#pragma once

namespace ifov::sensor {

/// From this mean on, numbers of independent events are taken from the normal quantile, below it from the distribution itself.
inline constexpr double kManyEvents = 100.0;

/// The number of independent events of a mean that belongs to a uniform variable, and to the normal one that has the same
/// probability: by inversion, or by noisy_count() rounded.
double poisson(double mean, double uniform, double normal);

/// A number of many independent events of a mean, and a normal error of a variance, together: of a normal variable of mean 0 and
/// variance 1, by the Cornish-Fisher expansion up to the fourth cumulant (Abramowitz and Stegun 1964, 26.2.49). The cumulants of the
/// sum are mean, mean + variance, mean, mean.
double noisy_count(double mean, double variance, double normal);

}  // namespace ifov::sensor
