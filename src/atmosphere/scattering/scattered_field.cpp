#include "atmosphere/scattering/scattered_field.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/mode_operator.h"
#include "atmosphere/scattering/phase/spherical_functions.h"
#include "atmosphere/scattering/round_earth_light.h"
#include "atmosphere/scattering/shell_line_of_sight.h"

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

namespace {

std::vector<double> source_of(const std::vector<ModeMoments>& modes, const ColumnPhase& phase, double mu) {
  const std::size_t n = phase.sublayers;
  std::vector<double> source(modes.size() * kComponents * 2 * n, 0.0);
  double* to = source.data();
  for (const ModeMoments& moments : modes) {
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
      for (std::size_t end = 0; end < 2; ++end) {
        const double* __restrict i_at = i + end;
        double* __restrict si_at = si + end * n;
        if (q == nullptr) {
          for (std::size_t s = 0; s < n; ++s) si_at[s] += p * beta[s] * i_at[s];
          continue;
        }
        const double* __restrict q_at = q + end;
        double* __restrict sq_at = sq + end * n, * __restrict su_at = su + end * n;
        for (std::size_t s = 0; s < n; ++s) {
          const double si_l = beta[s] * i_at[s] + gamma[s] * q_at[s];
          const double sq_l = gamma[s] * i_at[s] + alpha[s] * q_at[s];
          const double su_l = u != nullptr ? zeta[s] * u[s + end] : 0.0;
          si_at[s] += p * si_l;
          sq_at[s] += r * sq_l + t * su_l;
          su_at[s] += t * sq_l + r * su_l;
        }
      }
    }
  }
  return source;
}

}  // namespace

SlantSource::SlantSource(const ScatteredField& field, double mu)
    : field_(&field), mu_(mu), source_(source_of(field.modes(), field.solved().phase, mu)) {
  const SolvedColumn& solved = field.solved();
  if (!field.sunlit()) return;
  const std::size_t ends = 2 * solved.phase.sublayers;
  for (std::size_t k = 0; k < solved.brighter.size(); ++k) {
    brighter_.push_back(source_of(solved.brighter[k], solved.phase, mu));
    const std::vector<double>& own = solved.round_earth->own_over(k);
    for (std::size_t i = 0; i < brighter_.back().size(); ++i)
      brighter_.back()[i] *= own[i % ends < ends / 2 ? i % ends : i % ends - ends / 2 + 1];
  }
}

/// Adds up the pieces of a path. Q and U of light exactly along the vertical are about the azimuth asked for.
class SlantSource::Sum {
 public:
  Sum(const SlantSource& source, double azimuth_rad, bool varies = false)
      : ends_(2 * source.field_->solved().phase.sublayers),
        at_azimuth_(at(azimuth_rad, source.field_->modes(), source.source_)) {
    if (!varies) return;
    for (std::size_t k = 0; k < source.brighter_.size(); ++k)
      brighter_.push_back(at(azimuth_rad, source.field_->solved().brighter[k], source.brighter_[k]));
  }

  bool operator()(const PathPiece& piece) {
    return add(piece.sublayer, piece.depth, piece.near_position, piece.far_position, {}, {});
  }
  /// At the piece's ends the source, times a factor, and something besides.
  struct Varied {
    double factor = 1.0, besides = 0.0;
    RoundEarthLight::Between suns = {};
  };
  bool add(std::size_t sublayer, double depth, double near_position, double far_position,
           const Varied& near_end, const Varied& far_end) {
    const LinearSource step = LinearSource::over(depth);
    besides_ += transmission_ * (step.near * besides(sublayer, near_position, near_end) +
                                 step.far * besides(sublayer, far_position, far_end));
    // The source at the piece's two ends, weighted, is one weighting of it at the sublayer's two ends.
    const double near = step.near * near_end.factor, far = step.far * far_end.factor;
    if (brighter_.empty()) {
      const double bottom = transmission_ * (near * near_position + far * far_position);
      take(at_azimuth_, sublayer, transmission_ * (near + far) - bottom, bottom);
    } else {
      take_end(sublayer, transmission_ * near, near_position, near_end.suns);
      take_end(sublayer, transmission_ * far, far_position, far_end.suns);
    }
    transmission_ *= step.transmission;
    return transmission_ > 0.0;
  }
  /// What is besides has the polarization of the rest.
  StokesVector multiple() const {
    return multiple_.i > 0.0 ? (1.0 + besides_ / multiple_.i) * multiple_ : multiple_;
  }

 private:
  std::vector<double> at(double azimuth_rad, const std::vector<ModeMoments>& modes,
                         const std::vector<double>& source) const {
    std::vector<double> sum(kComponents * ends_, 0.0);
    const double* from = source.data();
    for (const ModeMoments& moments : modes) {
      const double c = std::cos(moments.mode * azimuth_rad), s = std::sin(moments.mode * azimuth_rad);
      add_scaled(2 * ends_, c, from, sum.data());
      add_scaled(ends_, s, from + 2 * ends_, sum.data() + 2 * ends_);
      from += kComponents * ends_;
    }
    return sum;
  }
  void take(const std::vector<double>& source, std::size_t sublayer, double top, double bottom) {
    const double *at = source.data() + sublayer, *below = at + ends_ / 2;
    multiple_.i += top * at[0] + bottom * below[0];
    multiple_.q += top * at[ends_] + bottom * below[ends_];
    multiple_.u += top * at[2 * ends_] + bottom * below[2 * ends_];
  }
  void take_end(std::size_t sublayer, double light, double position, const RoundEarthLight::Between& suns) {
    const auto part = [&](const std::vector<double>& source, double share) {
      take(source, sublayer, share * light * (1.0 - position), share * light * position);
    };
    part(at_azimuth_, 1.0 - suns.weight);
    if (!(suns.weight > 0.0)) return;
    part(brighter_[suns.first], suns.weight * (1.0 - suns.next));
    part(suns.first + 1 < brighter_.size() ? brighter_[suns.first + 1] : at_azimuth_,
         suns.weight * suns.next);
  }
  /// At most half of what the source is: it comes from a simpler problem.
  double besides(std::size_t sublayer, double position, const Varied& end) const {
    const double *at = at_azimuth_.data() + sublayer, *below = at + ends_ / 2;
    const double most = 0.5 * end.factor * std::abs(at[0] + position * (below[0] - at[0]));
    return std::clamp(end.besides, -most, most);
  }
  std::size_t ends_;
  std::vector<double> at_azimuth_;             ///< [component][top, bottom][sublayer]
  std::vector<std::vector<double>> brighter_;  ///< the same over columns of brighter places
  double transmission_ = 1.0, besides_ = 0.0;
  StokesVector multiple_;
};

namespace {

/// How much of the direction that haze keeps about a round Earth is counted: clouds and crystals send so much on forwards that two
/// terms of their pattern are no measure of the rest.
double directed_share(double asymmetry) {
  constexpr double kAll = 0.65, kNone = 0.78;
  return std::clamp((kNone - asymmetry) / (kNone - kAll), 0.0, 1.0);
}

}  // namespace

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

PathLight SlantSource::line_of_sight(double azimuth_rad, double sensor_km, double surface_km) const {
  return through_shells(azimuth_rad, surface_km, sensor_km, {});
}

PathLight SlantSource::sky(double azimuth_rad, double observer_km, const SunCell& cell) const {
  return through_shells(azimuth_rad, observer_km, field_->solved().column.top_km(), cell);
}

PathLight SlantSource::through_shells(double azimuth_rad, double lower_km, double upper_km,
                                      const SunCell& cell) const {
  const SolvedColumn& solved = field_->solved();
  const ScatteringColumn& column = solved.column;
  const Propagation direction{mu_, azimuth_rad};
  const ShellLineOfSight::Ends ends{lower_km, upper_km};
  PathLight light = single_scattering(
      column, solved.aerosol_polarization,
      ShellLineOfSight(column.layer_altitude_km, column.spherical, column.sun_mu, direction, ends), cell);
  if (!field_->sunlit()) light.single = {};
  const ShellLineOfSight line(column.altitude_km, column.spherical, column.sun_mu, direction, ends, false);
  const bool varies = field_->sunlit() && solved.round_earth != nullptr;
  // Of the end of the last piece, where the next one begins.
  struct Place {
    double boundary = -1.0;  ///< number and position within
    RoundEarthLight::Change change = {};
    double sunward = 0.0;
    RoundEarthLight::Between suns = {};
  };
  Place place;
  const auto at = [&](std::size_t sublayer, double position, std::size_t end) -> Sum::Varied {
    if (!varies) return {};
    const double boundary = static_cast<double>(sublayer) + position, from_mu = line.from_mu()[end];
    const bool known = boundary == place.boundary && (position == 0.0 || position == 1.0);
    if (!known) {
      const double sun_mu = line.sun_mu()[end];
      place.boundary = boundary;
      place.change = solved.round_earth->change(sublayer, position, sun_mu);
      place.sunward =
          (line.scattering_cosine() - sun_mu * from_mu) / std::sqrt(std::max(1e-12, 1.0 - sun_mu * sun_mu));
      if (!brighter_.empty())
        place.suns = solved.round_earth->between_suns(sublayer, position, sun_mu, place.change);
    }
    const ScatteringColumn::Mixture& mixture = column.mixtures[column.mixture_of[sublayer]];
    const double pattern =
        3.0 * mixture.first * directed_share(mixture.first) * mixture.aerosol * (1.0 - mixture.peak);
    return {place.change.ratio, pattern * (place.change.up * from_mu + place.change.sunward * place.sunward),
            place.suns};
  };
  Sum sum(*this, azimuth_rad, varies);
  for (std::size_t p = 0; p < line.pieces().size(); ++p) {
    const ShellLineOfSight::Piece& piece = line.pieces()[p];
    const Sum::Varied near = at(piece.layer, piece.near_position, p),
                      far = at(piece.layer, piece.far_position, p + 1);
    if (!sum.add(piece.layer, piece.slant * column.depth[piece.layer], piece.near_position,
                 piece.far_position, near, far))
      break;
  }
  light.multiple = sum.multiple();
  return light;
}

}  // namespace ifov::atmosphere
