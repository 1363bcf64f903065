#pragma once

namespace ifov::sensor {

/// The order of a Zernike polynomial by Noll's number j = 1, 2, … (Noll 1976, Zernike polynomials and atmospheric turbulence, Journal
/// of the Optical Society of America 66, 207-211): radial degree n, azimuthal order m; even j go with cos, odd ones with sin.
struct ZernikeOrder {
  int n = 0, m = 0;
  bool sine = false;
};
ZernikeOrder noll_order(int j);

/// The polynomial at a place of the unit disc, of mean square 1 over the disc; angles run from x to y.
double zernike(int j, double x, double y);

}  // namespace ifov::sensor
