#pragma once

#include <array>

#include "atmosphere/scattering/phase/propagation.h"

namespace ifov::atmosphere {

/// Scattering matrix of randomly oriented particles in the scattering plane, for (I, Q, U) with Q positive in
/// that plane: [a1 b1 0; b1 a2 0; 0 0 a3]. The mean of a1 over the sphere is 1.
struct ScatteringMatrix {
  double a1 = 1.0, a2 = 1.0, a3 = 1.0, b1 = 0.0;
};

/// Molecules with a depolarization (Hansen and Travis 1974, eq. 2.15): a part (1 - d)/(1 + d/2) scatters like
/// dipoles, the rest isotropically and without polarization.
ScatteringMatrix rayleigh_matrix(double cosine, double depolarization);

/// Aerosol that scatters `a1` in this direction; polarization has the shape of Rayleigh scattering, with the degree
/// `peak_polarization` at 90 degrees (0 to 1), and a2 = a1, a3 = a1 2c/(1 + c^2).
ScatteringMatrix particle_matrix(double cosine, double a1, double peak_polarization);

/// The same with the Henyey-Greenstein function of the asymmetry g.
ScatteringMatrix aerosol_matrix(double cosine, double asymmetry, double peak_polarization);

/// Cosine of the angle between two directions.
double scattering_cosine(const Propagation& from, const Propagation& to);

/// A scattering matrix turned into the meridian planes of the incoming and the outgoing ray (row major), from
/// the geometry itself: the reference for the Fourier modes.
std::array<double, 9> meridian_matrix(const Propagation& from, const Propagation& to,
                                      const ScatteringMatrix& matrix);

/// Its first column: unpolarized light of radiance 1 scattered from one direction into the other.
StokesVector scatter_unpolarized(const Propagation& from, const Propagation& to,
                                 const ScatteringMatrix& matrix);

}  // namespace ifov::atmosphere
