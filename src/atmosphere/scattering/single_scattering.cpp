#include "atmosphere/scattering/single_scattering.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/scattering/beam_integral.h"
#include "atmosphere/scattering/phase_function.h"
#include "atmosphere/scattering/scattering_matrix.h"
#include "atmosphere/scattering/shell_line_of_sight.h"

namespace ifov::atmosphere {

namespace {

/// Adds up the pieces of a path.
class SingleScattering {
 public:
  SingleScattering(const ScatteringColumn& column, double aerosol_polarization, const Propagation& direction,
                   const SunCell& cell = {})
      : column_(column), cosine_(scattering_cosine({-column.sun_mu, 0.0}, direction)) {
    constexpr double kTowardsSun = 1.0 - 1e-10;
    const bool forward = cell.any() && cosine_ > kTowardsSun;
    const Propagation sun{-column.sun_mu, 0.0};
    molecules_ = scatter_unpolarized(sun, direction, rayleigh_matrix(cosine_, column.depolarization));
    // Stokes parameters of aerosol have everywhere the same ratios; only a1 depends on the particles.
    particles_ = scatter_unpolarized(sun, direction, particle_matrix(cosine_, 1.0, aerosol_polarization));
    if (!column.phases) return;
    for (const PhaseFunction& function : column.phases->functions)
      values_.push_back(forward ? function.forward_for(cell.along_zenith_rad, cell.along_azimuth_rad)
                                : function.at(cosine_));
  }

  bool operator()(const PathPiece& piece) {
    const double top = column_.beam_depth[piece.sublayer];
    const double beam = column_.beam_depth[piece.sublayer + 1] - top;
    add(column_.mixtures[column_.mixture_of[piece.sublayer]], piece.depth, piece.true_depth,
        top + beam * piece.near_position, top + beam * piece.far_position);
    return true;
  }
  /// Depths are along the path, those of the sunbeam at both ends from space.
  void add(const ScatteringColumn::Mixture& mixture, double depth, double true_depth, double near_beam,
           double far_beam) {
    if (&mixture != mixture_) enter(mixture);
    const double light = beam_integral(depth, depth_ + near_beam, depth_ + far_beam);
    rayleigh_sum_ += light * mixture.rayleigh;
    aerosol_sum_ += light * mixture.aerosol * a1_;
    pass(depth, true_depth);
  }
  /// Through what is not lit.
  void pass(double depth, double true_depth) {
    depth_ += depth;
    true_depth_ += true_depth;
  }

  PathLight light() const {
    PathLight light;
    light.single = 0.25 / std::numbers::pi * (rayleigh_sum_ * molecules_ + aerosol_sum_ * particles_);
    light.transmittance = std::exp(-true_depth_);
    light.peak_transmittance = std::exp(-depth_);
    return light;
  }

 private:
  void enter(const ScatteringColumn::Mixture& mixture) {
    if (!column_.phases && (mixture_ == nullptr || mixture.asymmetry != mixture_->asymmetry))
      a1_ = aerosol_matrix(cosine_, mixture.asymmetry, 0.0).a1;
    mixture_ = &mixture;
    if (!column_.phases) return;
    const double* share = column_.phases->shares(mixture.layer);
    a1_ = 0.0;
    for (std::size_t f = 0; f < values_.size(); ++f) a1_ += share[f] * values_[f];
  }

  const ScatteringColumn& column_;
  const ScatteringColumn::Mixture* mixture_ = nullptr;
  std::vector<double> values_;  ///< of the column's phase functions
  double cosine_, a1_ = 0.0;    ///< a1: of the aerosol of `mixture_`
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

PathLight single_scattering(const ScatteringColumn& column, double aerosol_polarization,
                            const ShellLineOfSight& line, const SunCell& cell) {
  SingleScattering sum(column, aerosol_polarization, line.direction(), cell);
  const std::vector<double> beam = line.beam_depths(column.layer_depth);
  for (std::size_t p = 0; p < line.pieces().size(); ++p) {
    const ShellLineOfSight::Piece& piece = line.pieces()[p];
    const double depth = piece.slant * column.layer_depth[piece.layer],
                 true_depth = piece.slant * column.layer_true_depth[piece.layer];
    if (piece.lit)
      sum.add(column.mixtures[piece.layer], depth, true_depth, beam[p], beam[p + 1]);
    else
      sum.pass(depth, true_depth);
  }
  return sum.light();
}

}  // namespace ifov::atmosphere
