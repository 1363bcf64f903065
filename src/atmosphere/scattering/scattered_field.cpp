#include "atmosphere/scattering/scattered_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/spherical_functions.h"

namespace ifov::atmosphere {

namespace {

constexpr int kComponents = 3;

}  // namespace

FluxProfile::Fluxes FluxProfile::at(double z_km) const {
  const std::size_t last = altitude_km.size() - 1;
  const std::size_t below = std::clamp<std::size_t>(
      static_cast<std::size_t>(
          std::lower_bound(altitude_km.begin(), altitude_km.end(), z_km, std::greater<>()) -
          altitude_km.begin()),
      1, last);
  const double height = altitude_km[below - 1] - altitude_km[below];
  const double share = std::clamp((z_km - altitude_km[below]) / height, 0.0, 1.0);
  const auto mix = [&](const std::vector<double>& flux) {
    return flux[below] + share * (flux[below - 1] - flux[below]);
  };
  return {mix(direct_down), mix(diffuse_down), mix(up)};
}

SlantSource::SlantSource(const ScatteredField& field, double mu) : field_(&field), mu_(mu) {
  const ColumnPhase& phase = field.solved().phase;
  const std::size_t n = phase.sublayers;
  source_.assign(field.modes().size() * kComponents * 2 * n, 0.0);
  double* to = source_.data();
  for (const ModeMoments& moments : field.modes()) {
    const SphericalFunctions f = spherical_functions(moments.mode, moments.terms, mu);
    double *si = to, *sq = to + 2 * n, *su = to + 4 * n;
    to += kComponents * 2 * n;
    for (int l = moments.mode; l < moments.terms; ++l) {
      const double p = f.p[l - moments.mode], r = f.r[l - moments.mode], t = f.t[l - moments.mode];
      const double *beta = phase.at(phase.beta, l), *gamma = phase.at(phase.gamma, l);
      const double *alpha = phase.at(phase.alpha, l), *zeta = phase.at(phase.zeta, l);
      const double* i = moments.at(l, 0);
      const double* q = moments.components > 1 ? moments.at(l, 1) : nullptr;
      const double* u = moments.components > 2 ? moments.at(l, 2) : nullptr;
      for (std::size_t s = 0; s < n; ++s) {
        for (std::size_t end = 0; end < 2; ++end) {
          const std::size_t level = s + end, at = 2 * s + end;
          if (q == nullptr) {
            si[at] += p * beta[s] * i[level];
            continue;
          }
          const double si_l = beta[s] * i[level] + gamma[s] * q[level];
          const double sq_l = gamma[s] * i[level] + alpha[s] * q[level];
          const double su_l = u != nullptr ? zeta[s] * u[level] : 0.0;
          si[at] += p * si_l;
          sq[at] += r * sq_l + t * su_l;
          su[at] += t * sq_l + r * su_l;
        }
      }
    }
  }
}

/// Adds up the pieces of a path. Q and U of light exactly along the vertical are about the azimuth asked for.
class SlantSource::Sum {
 public:
  Sum(const SlantSource& source, double azimuth_rad)
      : values_(source.source_.data()), sublayers_(source.field_->solved().phase.sublayers) {
    for (const ModeMoments& moments : source.field_->modes()) {
      turn_.push_back({std::cos(moments.mode * azimuth_rad), std::sin(moments.mode * azimuth_rad)});
    }
  }

  bool operator()(const PathPiece& piece) {
    const LinearSource step = LinearSource::over(piece.depth);
    // The source at the piece's two ends, weighted, is one weighting of it at the sublayer's two ends.
    const double bottom = transmission_ * (step.near * piece.near_position + step.far * piece.far_position);
    const double top = transmission_ * (step.near + step.far) - bottom;
    const std::size_t n = sublayers_;
    const double* at = values_ + 2 * piece.sublayer;
    for (const auto& [c, s] : turn_) {
      multiple_.i += c * (top * at[0] + bottom * at[1]);
      multiple_.q += c * (top * at[2 * n] + bottom * at[2 * n + 1]);
      multiple_.u += s * (top * at[4 * n] + bottom * at[4 * n + 1]);
      at += kComponents * 2 * n;
    }
    transmission_ *= step.transmission;
    return transmission_ > 0.0;
  }
  const StokesVector& multiple() const { return multiple_; }

 private:
  const double* values_;
  std::size_t sublayers_;
  std::vector<std::array<double, 2>> turn_;  ///< cos and sin of mode times azimuth
  double transmission_ = 1.0;
  StokesVector multiple_;
};

PathLight SlantSource::path(double azimuth_rad, double observer_km, double length_km) const {
  const SolvedColumn& solved = field_->solved();
  PathLight light = single_scattering(solved.column, solved.aerosol_polarization, {mu_, azimuth_rad},
                                      observer_km, length_km);
  if (!field_->sunlit()) light.single = {};
  Sum sum(*this, azimuth_rad);
  walk_path(solved.column, observer_km, mu_, length_km, sum);
  light.multiple = sum.multiple();
  return light;
}

PathLight SlantSource::sky(double azimuth_rad, double observer_km) const {
  const SolvedColumn& solved = field_->solved();
  PathLight light =
      single_scattering_sky(solved.column, solved.aerosol_polarization, {mu_, azimuth_rad}, observer_km);
  if (!field_->sunlit()) light.single = {};
  Sum sum(*this, azimuth_rad);
  walk_sky(solved.column, observer_km, mu_, sum);
  light.multiple = sum.multiple();
  return light;
}

}  // namespace ifov::atmosphere
