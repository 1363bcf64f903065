#pragma once

/// The Earth of WGS 72, which two-line elements are fitted with; lengths in its radii, times in minutes.
namespace ifov::geodesy::wgs72 {

inline constexpr double kRadius_km = 6378.135;
/// sqrt(GM) = 60 / sqrt(radius^3 / 398600.8 km3 s-2)
inline constexpr double kSqrtGm = 0.07436691613317342;
inline constexpr double kJ2 = 0.001082616, kJ3 = -0.00000253881, kJ4 = -0.00000165597;

}  // namespace ifov::geodesy::wgs72
