#pragma once

/// Slopes of density exp(-s^2) / sqrt pi, and those of them that a slanting view sees.
namespace ifov::materials::gaussian_slopes {

/// Share of the slopes below `slope`.
double share(double slope);
double quantile(double share);

/// A view of this cosine and sine (to any common factor) sees a slope s along its slant as cosine - s sine, up to s = cosine / sine.
/// The whole of it: 1/2 cosine (1 + erf a) + sine exp(-a^2) / (2 sqrt pi), a = cosine / sine.
double seen(double cosine, double sine);
/// Share of what is seen that slopes below `slope` make.
double seen_share(double cosine, double sine, double slope);
double seen_quantile(double cosine, double sine, double share);

}  // namespace ifov::materials::gaussian_slopes
