#include "atmosphere/scattering/single_scattering.h"

#include <cmath>
#include <numbers>

#include "atmosphere/scattering/beam_integral.h"
#include "atmosphere/scattering/scattering_matrix.h"

namespace ifov::atmosphere {

namespace {

/// Adds up the pieces of a path.
class SingleScattering {
 public:
  SingleScattering(const ScatteringColumn& column, double aerosol_polarization, const Propagation& direction)
      : column_(column), cosine_(scattering_cosine({-column.sun_mu, 0.0}, direction)) {
    const Propagation sun{-column.sun_mu, 0.0};
    molecules_ = scatter_unpolarized(sun, direction, rayleigh_matrix(cosine_, column.depolarization));
    // Stokes parameters of aerosol have everywhere the same ratios; only a1 depends on the asymmetry.
    particles_ = scatter_unpolarized(sun, direction, aerosol_matrix(cosine_, 0.0, aerosol_polarization));
  }

  bool operator()(const PathPiece& piece) {
    const ScatteringColumn::Mixture& mixture = column_.mixtures[column_.mixture_of[piece.sublayer]];
    if (mixture.asymmetry != asymmetry_) {
      asymmetry_ = mixture.asymmetry;
      henyey_greenstein_ = aerosol_matrix(cosine_, asymmetry_, 0.0).a1;
    }
    const double top = column_.beam_depth[piece.sublayer];
    const double beam = column_.beam_depth[piece.sublayer + 1] - top;
    const double light = beam_integral(piece.depth, depth_ + top + beam * piece.near_position,
                                       depth_ + top + beam * piece.far_position);
    rayleigh_sum_ += light * mixture.rayleigh;
    aerosol_sum_ += light * mixture.aerosol * henyey_greenstein_;
    depth_ += piece.depth;
    true_depth_ += piece.true_depth;
    return true;
  }

  PathLight light() const {
    PathLight light;
    light.single = 0.25 / std::numbers::pi * (rayleigh_sum_ * molecules_ + aerosol_sum_ * particles_);
    light.transmittance = std::exp(-true_depth_);
    light.peak_transmittance = std::exp(-depth_);
    return light;
  }

 private:
  const ScatteringColumn& column_;
  double cosine_, asymmetry_ = 0.0, henyey_greenstein_ = 1.0;
  StokesVector molecules_, particles_;
  double rayleigh_sum_ = 0.0, aerosol_sum_ = 0.0, depth_ = 0.0, true_depth_ = 0.0;
};

}  // namespace

PathLight single_scattering(const ScatteringColumn& column, double aerosol_polarization,
                            const Propagation& direction, double observer_km, double length_km) {
  SingleScattering sum(column, aerosol_polarization, direction);
  walk_path(column, observer_km, direction.mu, length_km, sum);
  return sum.light();
}

PathLight single_scattering_sky(const ScatteringColumn& column, double aerosol_polarization,
                                const Propagation& direction, double observer_km) {
  SingleScattering sum(column, aerosol_polarization, direction);
  walk_sky(column, observer_km, direction.mu, sum);
  return sum.light();
}

}  // namespace ifov::atmosphere
