#include "atmosphere/scattering/single_scattering.h"

#include <cmath>
#include <numbers>

#include "atmosphere/scattering/beam_integral.h"
#include "atmosphere/scattering/scattering_matrix.h"

namespace ifov::atmosphere {

PathLight single_scattering(const ScatteringColumn& column, double aerosol_polarization,
                            const Propagation& direction, double observer_km, double length_km) {
  const Propagation sun{-column.sun_mu, 0.0};
  const double cosine = scattering_cosine(sun, direction);
  const Stokes molecules =
      scatter_unpolarized(sun, direction, rayleigh_matrix(cosine, column.depolarization));
  // Stokes parameters of aerosol have everywhere the same ratios; only a1 depends on the asymmetry.
  const Stokes particles =
      scatter_unpolarized(sun, direction, aerosol_matrix(cosine, 0.0, aerosol_polarization));
  double asymmetry = 0.0, henyey_greenstein = 1.0, rayleigh_sum = 0.0, aerosol_sum = 0.0, depth = 0.0,
         true_depth = 0.0;
  walk_path(column, observer_km, direction.mu, length_km, [&](const PathPiece& piece) {
    const ScatteringColumn::Mixture& mixture = column.mixtures[column.mixture_of[piece.sublayer]];
    if (mixture.asymmetry != asymmetry) {
      asymmetry = mixture.asymmetry;
      henyey_greenstein = aerosol_matrix(cosine, asymmetry, 0.0).a1;
    }
    const double top = column.beam_depth[piece.sublayer];
    const double beam = column.beam_depth[piece.sublayer + 1] - top;
    const double light = beam_integral(piece.depth, depth + top + beam * piece.near_position,
                                       depth + top + beam * piece.far_position);
    rayleigh_sum += light * mixture.rayleigh;
    aerosol_sum += light * mixture.aerosol * henyey_greenstein;
    depth += piece.depth;
    true_depth += piece.true_depth;
    return true;
  });
  PathLight light;
  light.single = 1.0 / (4.0 * std::numbers::pi) * (rayleigh_sum * molecules + aerosol_sum * particles);
  light.transmittance = std::exp(-true_depth);
  light.peak_transmittance = std::exp(-depth);
  return light;
}

}  // namespace ifov::atmosphere
