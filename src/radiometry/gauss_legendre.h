#pragma once

#include <array>

namespace ifov::radiometry {

/// Gauss-Legendre quadrature of 4 points on [0, 1]: exact for polynomials up to degree 7.
struct GaussPoint {
  double position, weight;
};
inline constexpr std::array<GaussPoint, 4> kGauss4{{{0.069431844202973712388, 0.17392742256872692869},
                                                    {0.33000947820757186760, 0.32607257743127307131},
                                                    {0.66999052179242813240, 0.32607257743127307131},
                                                    {0.93056815579702628761, 0.17392742256872692869}}};

/// The same with 2 points: exact up to degree 3.
inline constexpr std::array<GaussPoint, 2> kGauss2{
    {{0.21132486540518711775, 0.5}, {0.78867513459481288225, 0.5}}};

}  // namespace ifov::radiometry
