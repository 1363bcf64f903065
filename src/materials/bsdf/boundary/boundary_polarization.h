#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "materials/bsdf/boundary/boundary_rows.h"

namespace ifov::materials {

/// How the two polarizations of light hang together behind a boundary: r_p conj(r_s) of what it reflects and the same of what it
/// lets through, in shares of power, so that |reflected|^2 <= R_p R_s. Waves that do not interfere add up (Mueller matrices do).
struct CrossShares {
  std::complex<double> reflected, transmitted;
};
/// One face of a pane, for light that comes from outside and from within.
struct PaneCross {
  CrossShares outside, within;
};

/// As bare_face(). From within reflected amplitudes are those from outside with the other sign, and t t' = 1 - r^2 (Stokes's
/// relations, Born and Wolf, section 7.6.1), of which either passage has the half.
PaneCross bare_cross(std::complex<double> index, double cosine);
CrossShares film_cross(const radiometry::FilmStack& stack, double sine);
/// As pane_shares().
CrossShares pane_cross(const PaneCross& front, const PaneCross& back, double passes);

/// Elements of the Mueller matrices of a boundary by angle, as boundary_rows::tabulated() has the shares of unpolarized light. They
/// are told over M_00 of the same rows, which lie closer: degrees of polarization are within 1e-5.
namespace boundary_polarization {

/// What is reflected and let through, of either polarization, and how they hang together.
struct Polarized {
  radiometry::PowerShares power;
  CrossShares cross;
};
using PolarizedShares = std::function<Polarized(double um, double cosine)>;

/// Where the shares have so many rows.
inline std::size_t rows_beside(std::size_t rows) {
  constexpr std::size_t kMost = 129;
  return std::max(rows, std::min(2 * rows - 1, kMost));
}
/// Rows of M_00 = (p + s) / 2, M_01 = (p - s) / 2, M_22 = Re and M_23 = Im of CrossShares, all of what is reflected before those of
/// what is let through (`transmits`).
inline constexpr std::size_t kElements = 4;
std::vector<radiometry::Spectrum> tabulated(const boundary_rows::Source& source, std::size_t rows,
                                            bool transmits, const PolarizedShares& shares);

}  // namespace boundary_polarization

}  // namespace ifov::materials
