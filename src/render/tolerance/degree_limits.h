#pragma once

namespace ifov::render {

/// Half-widths of I and of Q and U, over I, that keep the half-width of the degree of linear polarization p within `error`
/// whichever way I, Q and U err (degree_half_width()). As I counts by p alone it may be looser than Q and U, at most tenfold.
struct DegreeLimits {
  double i = 0.0, qu = 0.0;
};
DegreeLimits degree_limits(double degree, double error);

/// How far p = sqrt(Q^2 + U^2) / I = P / I may be off where I, Q and U are within their half-widths dI, dQ and dU:
///   |P - P'| <= hypot(dQ, dU)  and  p - p' = ((P - P') - p' (I - I')) / I,  so that  h = (hypot(dQ, dU) + p dI) / (I - dI).
/// At most 1, which it is where I may be 0.
double degree_half_width(double i, double q, double u, double i_half_width, double q_half_width,
                         double u_half_width);

}  // namespace ifov::render
