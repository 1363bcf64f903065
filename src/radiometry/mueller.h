#pragma once

#include <array>
#include <complex>
#include <cstddef>

#include "radiometry/stokes.h"

namespace ifov::radiometry {

/// A linear change of the fields along two axes: (E_x, E_y) after = [xx xy; yx yy] (E_x, E_y) before.
struct JonesMatrix {
  std::complex<double> xx = 1.0, xy = 0.0, yx = 0.0, yy = 1.0;
};

/// What turns one StokesVector into another: after = M before, rows and columns in the order I, Q, U, V. Each
/// side is about a frame of its own. Signs as StokesVector says.
class MuellerMatrix {
 public:
  /// Nothing changes.
  MuellerMatrix() : MuellerMatrix(diagonal(1.0, 1.0, 1.0, 1.0)) {}
  /// Row by row.
  explicit MuellerMatrix(const std::array<double, 16>& values) : values_(values) {}

  static MuellerMatrix diagonal(double i, double q, double u, double v);
  /// Of a change of the fields that depolarizes nothing: M_ij = tr(sigma_i J sigma_j J*) / 2 with Pauli's
  /// matrices in the order of the coherency matrix of StokesVector (Cloude 1986, Optik 75, 26).
  static MuellerMatrix of_fields(const JonesMatrix& fields);

  /// The same light about a frame whose x is turned by this angle towards y:
  ///   Q' = Q cos 2a + U sin 2a,   U' = -Q sin 2a + U cos 2a.
  static MuellerMatrix turned_frame(double angle_rad) {
    return turned_frame(std::cos(angle_rad), std::sin(angle_rad));
  }
  /// By the cosine and sine of the angle, or both times anything but 0.
  static MuellerMatrix turned_frame(double cosine, double sine);

  /// Lets through a share `most` of light that swings along an axis at this angle from x, and `least` of what
  /// swings across it; both 0 to 1.
  static MuellerMatrix linear_diattenuator(double most, double least, double axis_rad);
  /// The ideal one: half of unpolarized light.
  static MuellerMatrix linear_polarizer(double axis_rad) { return linear_diattenuator(1.0, 0.0, axis_rad); }
  /// The field along an axis at this angle from x falls behind the field across it by this phase: a quarter
  /// wave (pi / 2) along x turns U into V = -U.
  static MuellerMatrix linear_retarder(double retardance_rad, double axis_rad);
  /// Leaves these shares of Q and U, and of V; can be where 2 |linear| <= 1 + circular and circular <= 1.
  static MuellerMatrix depolarizer(double linear, double circular) {
    return diagonal(1.0, linear, linear, circular);
  }

  double operator()(std::size_t row, std::size_t column) const { return values_[4 * row + column]; }
  friend StokesVector operator*(const MuellerMatrix& m, const StokesVector& s);
  /// First b, then a.
  friend MuellerMatrix operator*(const MuellerMatrix& a, const MuellerMatrix& b);
  friend MuellerMatrix operator*(double factor, const MuellerMatrix& m);
  friend MuellerMatrix operator+(const MuellerMatrix& a, const MuellerMatrix& b);
  MuellerMatrix transposed() const;
  /// Of the same thing met by light the other way, where its fields obey reciprocity: D M^T D with
  /// D = diag(1, 1, -1, 1), both frames keeping their x and turning their y with the direction.
  MuellerMatrix reversed() const;

 private:
  std::array<double, 16> values_;
};

}  // namespace ifov::radiometry
