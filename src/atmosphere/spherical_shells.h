#pragma once

#include <cmath>

namespace ifov::atmosphere {

inline constexpr double kEarthRadius_km = 6371.0;

/// Length in km of a straight ray from an altitude up to a shell above it, about a round Earth; mu >= 0 is
/// the cosine of its zenith angle where it starts. Not refracted.
inline double length_to_shell_km(double from_km, double mu, double shell_km) {
  const double start = kEarthRadius_km + from_km, rise = shell_km - from_km;
  const double difference = rise * (start + kEarthRadius_km + shell_km);  // of the squared radii
  return difference > 0.0 ? difference / (std::sqrt(difference + start * mu * start * mu) + start * mu) : 0.0;
}

/// Half the length in km of a straight line within a shell (a radius, km), where its point nearest to the Earth's centre lies at the
/// radius `nearest_km`; 0 outside. Between two shells a line is as long as the difference of theirs.
inline double half_chord_km(double shell_km, double nearest_km) {
  const double squares = (shell_km - nearest_km) * (shell_km + nearest_km);
  return squares > 0.0 ? std::sqrt(squares) : 0.0;
}

}  // namespace ifov::atmosphere
