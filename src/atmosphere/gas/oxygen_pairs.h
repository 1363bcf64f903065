#pragma once

namespace ifov::atmosphere {

/// What pairs of oxygen molecules that meet absorb, which neither does alone: nine bands from 343 to 1065 nm
/// (Greenblatt, Orlando, Burkholder and Ravishankara, Absorption measurements of oxygen between 330 and 1140
/// nm, J. Geophys. Res. 95 (1990) 18577-18582, at 296 K) and the one at 1.27 um, where nitrogen is a partner,
/// too (Mate, Lugez, Fraser and Lafferty, Absolute intensities for the O2 1.27 um continuum absorption, J.
/// Geophys. Res. 104 (1999) 30585-30590). Bands are Gaussian; their strengths hardly depend on temperature
/// (Thalman and Volkamer, Phys. Chem. Chem. Phys. 15 (2013) 15371-15381).
///
/// Depth for 1 km of oxygen of 1 amagat in air; it goes with the square of the density.
double oxygen_pair_depth(double wavenumber_cm1);

}  // namespace ifov::atmosphere
