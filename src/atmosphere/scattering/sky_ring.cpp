#include "atmosphere/scattering/sky_ring.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/beam_integral.h"
#include "atmosphere/scattering/phase_function.h"
#include "atmosphere/scattering/scattering_matrix.h"
#include "atmosphere/scattering/spherical_functions.h"

namespace ifov::atmosphere {
namespace {

/// The walk from the observer into space, and what does not depend on the azimuth along it.
class Walk {
 public:
  /// What of the source at the top and the bottom of each sublayer arrives.
  std::vector<double> top, bottom;
  /// Sunlight on the way, times what molecules scatter of it, aerosol by each phase function, and, where there are
  /// none, aerosol of one asymmetry.
  double rayleigh = 0.0;
  struct Aerosol {
    double asymmetry, light;
  };
  std::vector<Aerosol> aerosol;
  std::vector<double> by_function;

  explicit Walk(const ScatteringColumn& column)
      : top(column.sublayers(), 0.0), bottom(column.sublayers(), 0.0), column_(column) {
    if (column.phases) by_function.assign(column.phases->functions.size(), 0.0);
  }

  bool operator()(const PathPiece& piece) {
    const LinearSource step = LinearSource::over(piece.depth);
    bottom[piece.sublayer] =
        transmission_ * (step.near * piece.near_position + step.far * piece.far_position);
    top[piece.sublayer] = transmission_ * (step.near + step.far) - bottom[piece.sublayer];
    transmission_ *= step.transmission;

    const double beam_top = column_.beam_depth[piece.sublayer];
    const double beam = column_.beam_depth[piece.sublayer + 1] - beam_top;
    const double light = beam_integral(piece.depth, depth_ + beam_top + beam * piece.near_position,
                                       depth_ + beam_top + beam * piece.far_position);
    depth_ += piece.depth;
    const ScatteringColumn::Mixture& mixture = column_.mixtures[column_.mixture_of[piece.sublayer]];
    rayleigh += light * mixture.rayleigh;
    if (column_.phases) {
      const double* share = column_.phases->shares(mixture.layer);
      for (std::size_t f = 0; f < by_function.size(); ++f)
        by_function[f] += light * mixture.aerosol * share[f];
      return true;
    }
    if (aerosol.empty() || aerosol.back().asymmetry != mixture.asymmetry)
      aerosol.push_back({mixture.asymmetry, 0.0});
    aerosol.back().light += light * mixture.aerosol;
    return true;
  }

 private:
  const ScatteringColumn& column_;
  double transmission_ = 1.0, depth_ = 0.0;
};

/// Light of one azimuthal mode: its source summed along the walk.
double mode_light(const ModeMoments& moments, const ColumnPhase& phase, const Walk& walk, double mu) {
  const SphericalFunctions f = spherical_functions(moments.mode, moments.terms, mu);
  const std::size_t n = phase.sublayers;
  std::vector<double> sum(n, 0.0);
  const auto arriving = [&](const double* at, std::size_t s) {
    return walk.top[s] * at[s] + walk.bottom[s] * at[s + 1];
  };
  for (int l = moments.mode; l < moments.terms; ++l) {
    const double p = f.p[l - moments.mode];
    const double *beta = phase.at(phase.beta, l), *i = moments.at(l, 0);
    for (std::size_t s = 0; s < n; ++s) sum[s] += p * beta[s] * arriving(i, s);
    if (moments.components == 1) continue;
    const double *gamma = phase.at(phase.gamma, l), *q = moments.at(l, 1);
    for (std::size_t s = 0; s < n; ++s) sum[s] += p * gamma[s] * arriving(q, s);
  }
  return std::accumulate(sum.begin(), sum.end(), 0.0);
}

/// Q and U of one azimuthal mode, likewise.
struct ModePolarization {
  double q = 0.0, u = 0.0;
};
ModePolarization mode_polarization(const ModeMoments& moments, const ColumnPhase& phase, const Walk& walk,
                                   double mu) {
  ModePolarization sum;
  if (moments.components == 1) return sum;
  const SphericalFunctions f = spherical_functions(moments.mode, moments.terms, mu);
  const auto arriving = [&](const double* at, std::size_t s) {
    return walk.top[s] * at[s] + walk.bottom[s] * at[s + 1];
  };
  for (int l = moments.mode; l < moments.terms; ++l) {
    const double r = f.r[l - moments.mode], t = f.t[l - moments.mode];
    const double *gamma = phase.at(phase.gamma, l), *alpha = phase.at(phase.alpha, l),
                 *zeta = phase.at(phase.zeta, l);
    const double *i = moments.at(l, 0), *q = moments.at(l, 1);
    const double* u = moments.components > 2 ? moments.at(l, 2) : nullptr;
    double along = 0.0, aside = 0.0;
    for (std::size_t s = 0; s < phase.sublayers; ++s) {
      along += gamma[s] * arriving(i, s) + alpha[s] * arriving(q, s);
      if (u != nullptr) aside += zeta[s] * arriving(u, s);
    }
    sum.q += r * along + t * aside;
    sum.u += t * along + r * aside;
  }
  return sum;
}

Walk walk_of(const ScatteredField& field, double mu, double observer_km) {
  const SolvedColumn& solved = field.solved();
  Walk walk(solved.column);
  walk_sky(solved.column, observer_km, mu, walk);
  return walk;
}

/// What is scattered once along the walk; only a1 and b1 of it are told.
ScatteringMatrix scattered_once(const SolvedColumn& solved, const Walk& walk, double cosine,
                                const SunCell& cell) {
  constexpr double kTowardsSun = 1.0 - 1e-10;
  const bool forward = cell.any() && cosine > kTowardsSun;
  const ScatteringMatrix molecules = rayleigh_matrix(cosine, solved.column.depolarization);
  ScatteringMatrix light{walk.rayleigh * molecules.a1, 0.0, 0.0, walk.rayleigh * molecules.b1};
  for (const Walk::Aerosol& part : walk.aerosol) {
    const ScatteringMatrix particles = aerosol_matrix(cosine, part.asymmetry, solved.aerosol_polarization);
    light.a1 += part.light * particles.a1;
    light.b1 += part.light * particles.b1;
  }
  for (std::size_t f = 0; f < walk.by_function.size(); ++f) {
    const PhaseFunction& function = solved.column.phases->functions[f];
    const double a1 =
        forward ? function.forward_for(cell.along_zenith_rad, cell.along_azimuth_rad) : function.at(cosine);
    const ScatteringMatrix particles = particle_matrix(cosine, a1, solved.aerosol_polarization);
    light.a1 += walk.by_function[f] * particles.a1;
    light.b1 += walk.by_function[f] * particles.b1;
  }
  light.a1 *= 0.25 / std::numbers::pi;
  light.b1 *= 0.25 / std::numbers::pi;
  return light;
}

}  // namespace

std::vector<double> sky_ring(const ScatteredField& field, double mu, std::span<const double> azimuth_rad,
                             double observer_km, const SunCell& cell) {
  const SolvedColumn& solved = field.solved();
  const Walk walk = walk_of(field, mu, observer_km);
  std::vector<double> radiance(azimuth_rad.size(), 0.0);
  if (field.sunlit())
    for (std::size_t a = 0; a < azimuth_rad.size(); ++a) {
      const double cosine = scattering_cosine({-solved.column.sun_mu, 0.0}, {mu, azimuth_rad[a]});
      radiance[a] = scattered_once(solved, walk, cosine, cell).a1;
    }
  for (const ModeMoments& moments : field.modes()) {
    const double light = mode_light(moments, solved.phase, walk, mu);
    for (std::size_t a = 0; a < azimuth_rad.size(); ++a)
      radiance[a] += light * std::cos(moments.mode * azimuth_rad[a]);
  }
  return radiance;
}

std::vector<StokesVector> sky_ring_stokes(const ScatteredField& field, double mu,
                                          std::span<const double> azimuth_rad, double observer_km,
                                          const SunCell& cell) {
  const SolvedColumn& solved = field.solved();
  const Walk walk = walk_of(field, mu, observer_km);
  const Propagation sunlight{-solved.column.sun_mu, 0.0};
  std::vector<StokesVector> light(azimuth_rad.size());
  if (field.sunlit())
    for (std::size_t a = 0; a < azimuth_rad.size(); ++a) {
      const Propagation direction{mu, azimuth_rad[a]};
      light[a] = scatter_unpolarized(
          sunlight, direction, scattered_once(solved, walk, scattering_cosine(sunlight, direction), cell));
    }
  for (const ModeMoments& moments : field.modes()) {
    const double i = mode_light(moments, solved.phase, walk, mu);
    const ModePolarization polarization = mode_polarization(moments, solved.phase, walk, mu);
    for (std::size_t a = 0; a < azimuth_rad.size(); ++a) {
      const double c = std::cos(moments.mode * azimuth_rad[a]), s = std::sin(moments.mode * azimuth_rad[a]);
      light[a] += {c * i, c * polarization.q, s * polarization.u, 0.0};
    }
  }
  return light;
}

}  // namespace ifov::atmosphere
