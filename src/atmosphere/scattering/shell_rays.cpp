#include "atmosphere/scattering/shell_rays.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/scattering/scattering_column.h"
#include "atmosphere/spherical_shells.h"
#include "math/angle.h"

namespace ifov::atmosphere {
namespace {

/// Sunbeams are known that far beyond the angles of the Sun, in steps of so much.
constexpr double kBeyond_rad = 9.0 * math::kDegree, kBeamStep_rad = 0.25 * math::kDegree,
                 kFineStep_rad = 0.1 * math::kDegree;

/// Aerosol that scatters more than a quarter of all of it, within these bounds, lies between no two altitudes at which light is kept, but
/// in one layer: what the round Earth takes from light above haze, low over the horizon, it does not take from light within.
constexpr double kThickestStep = 0.5, kThinnestStep = 0.12, kSteps = 4.0;
/// Finely: a sixth of all of it, and not more nor less than this.
constexpr double kFinestStep = 0.03, kCoarsestFineStep = 0.15, kFineSteps = 6.0;
/// Nor does the upper edge of haze on the ground lie between two, where light changes fast: it scatters so much more below than above.
/// Nor does any edge of haze and clouds aloft that scatter more than so little by layer, finely much less; nor a boundary so near
/// above a lower edge.
constexpr double kThinnestHaze = 0.02, kEdge = 0.25, kThinnestAloft = 0.002, kThinnestLayer = 1e-4,
                 kSkin = 0.2;
/// Distance between altitudes at which the light is kept.
double spacing_of_altitudes_km(double height_km) {
  return height_km < 6.0    ? 1.4
         : height_km < 15.0 ? 2.8
         : height_km < 30.0 ? 4.8
         : height_km < 60.0 ? 7.5
                            : 18.0;
}

}  // namespace

void ShellOrders::add_suns(double mu, int azimuths, Ray& ray) const {
  const double sine = std::sqrt(1.0 - mu * mu);
  for (const double angle : angle_rad_)
    for (int a = 0; a < azimuths; ++a) {
      const double sun = std::cos(angle);
      const double along =
          mu * sun + sine * std::sin(angle) * std::cos((a + 0.5) * std::numbers::pi / azimuths);
      for (const End& end : ray.ends) {
        const double here =
            std::clamp((end.radius_start * sun + end.length * along) * end.inverse_radius, -1.0, 1.0);
        const double level = std::sqrt(std::max(1e-12, 1.0 - here * here));
        const double sun_rad = std::acos(here);
        const auto after = std::upper_bound(angle_rad_.begin() + 1, angle_rad_.end() - 1, sun_rad);
        const double share = std::clamp((sun_rad - after[-1]) / (after[0] - after[-1]), 0.0, 0.99999);
        ray.sun_rad.push_back(static_cast<float>(sun_rad));
        ray.place.push_back(static_cast<float>(static_cast<double>(after - angle_rad_.begin() - 1) + share));
        ray.sunward.push_back(static_cast<float>((along - here * end.mu) / level));
      }
    }
}

void ShellOrders::choose_altitudes(bool finely) {
  const std::vector<double>& boundary = column_.layer_altitude_km;
  altitude_km_ = {boundary.back()};
  const auto aerosol = [&](std::size_t layer) {
    const ScatteringColumn::Mixture& mixture = column_.mixtures[layer];
    return column_.layer_depth[layer] * mixture.aerosol * (1.0 - mixture.peak);
  };
  const auto density = [&](std::size_t layer) {
    return aerosol(layer) / (boundary[layer] - boundary[layer + 1]);
  };
  double all = 0.0;
  for (std::size_t b = 0; b + 1 < boundary.size(); ++b) all += aerosol(b);
  const double thickest = finely ? std::clamp(all / kFineSteps, kFinestStep, kCoarsestFineStep)
                                 : std::clamp(all / kSteps, kThinnestStep, kThickestStep);
  const auto differ = [&](std::size_t b) {
    const double above = density(b - 1), below = density(b);
    return std::max(aerosol(b - 1), aerosol(b)) > (finely ? kThinnestLayer : kThinnestAloft) &&
           std::min(above, below) < kEdge * std::max(above, below);
  };
  double scattered = 0.0;  // since the last altitude
  double above_edge = kSkin;
  bool on_ground = true;
  for (std::size_t b = boundary.size() - 1; b-- > 0;) {
    scattered += aerosol(b);
    const bool haze_ends =
        b > 0 && on_ground && scattered > kThinnestHaze && density(b - 1) < kEdge * density(b);
    const bool starts = b > 0 && differ(b) && density(b) < density(b - 1);
    const bool edge =
        haze_ends || (b > 0 && differ(b)) || (!finely && above_edge < kSkin && aerosol(b) > 0.0);
    above_edge = starts ? 0.0 : above_edge + aerosol(b);
    on_ground = on_ground && !haze_ends && b > 0 && kEdge * density(b - 1) <= density(b);
    if (b == 0 || scattered > thickest || edge ||
        boundary[b] >= altitude_km_.back() + spacing_of_altitudes_km(altitude_km_.back() - boundary.back())) {
      altitude_km_.push_back(boundary[b]);
      scattered = 0.0;
    }
  }
}

void ShellOrders::tabulate_beams(bool finely) {
  const std::vector<double>&boundary = column_.layer_altitude_km, &depth = column_.layer_depth;
  beam_angles_ = angle_rad_.size();
  if (geometry_.sun_turns) {
    beam_first_rad_ = std::max(0.0, angle_rad_.front() - kBeyond_rad);
    beam_step_rad_ = finely ? kFineStep_rad : kBeamStep_rad;
    beam_angles_ =
        2 + static_cast<std::size_t>((angle_rad_.back() + kBeyond_rad - beam_first_rad_) / beam_step_rad_);
  }
  const double ground = kEarthRadius_km + boundary.back();
  std::vector<double> chord(boundary.size());
  for (std::size_t b = 0; b < boundary.size(); ++b)
    for (std::size_t k = 0; k < beam_angles_; ++k) {
      const double angle = geometry_.sun_turns ? beam_first_rad_ + static_cast<double>(k) * beam_step_rad_
                                               : angle_rad_[k],
                   mu = std::cos(angle), radius = kEarthRadius_km + boundary[b],
                   nearest = radius * std::sin(angle);
      double sum = 0.0;
      if (mu < 0.0 && nearest < ground) {
        beam_.push_back(0.0);
        continue;
      }
      for (std::size_t i = 0; i < boundary.size(); ++i)
        chord[i] = half_chord_km(kEarthRadius_km + boundary[i], nearest);
      for (std::size_t i = 0; i < (mu < 0.0 ? depth.size() : b); ++i) {
        const double crossings = mu < 0.0 && i >= b ? 2.0 : 1.0;
        sum += crossings * (chord[i] - chord[i + 1]) * depth[i] / (boundary[i] - boundary[i + 1]);
      }
      beam_.push_back(std::exp(-sum));
    }
}

ShellOrders::End ShellOrders::end(double altitude_km, std::size_t layer, double length, double start,
                                  double mu) const {
  const std::vector<double>& boundary = column_.layer_altitude_km;
  End end;
  end.length = length;
  end.radius_start = start;
  end.inverse_radius = geometry_.spherical
                           ? 1.0 / std::sqrt(start * start + length * (length + 2.0 * start * mu))
                           : 1.0 / start;
  end.mu = geometry_.spherical ? (start * mu + length) * end.inverse_radius : mu;
  end.level = std::sqrt(std::max(0.0, 1.0 - end.mu * end.mu));
  end.layer = layer;
  end.below = std::clamp((boundary[layer] - altitude_km) / (boundary[layer] - boundary[layer + 1]), 0.0, 1.0);
  const auto above = std::upper_bound(altitude_km_.begin() + 1, altitude_km_.end() - 1, altitude_km);
  end.low = static_cast<std::size_t>(above - altitude_km_.begin()) - 1;
  end.high_share = std::clamp(
      (altitude_km - altitude_km_[end.low]) / (altitude_km_[end.low + 1] - altitude_km_[end.low]), 0.0, 1.0);
  return end;
}

/// Down to the ground, or past the point nearest to it and up again; or up to the top.
ShellOrders::Ray ShellOrders::ray(double altitude_km, double mu, double longest_km) const {
  const std::vector<double>& boundary = column_.layer_altitude_km;
  const double start = kEarthRadius_km + altitude_km, ground = kEarthRadius_km + boundary.back();
  const double nearest = start * std::sqrt(1.0 - mu * mu);
  const auto half = [&](double altitude) { return half_chord_km(kEarthRadius_km + altitude, nearest); };
  Ray ray;
  ray.pieces.reserve(boundary.size());
  ray.ends.reserve(boundary.size() + 1);
  double walked = 0.0, last_km = altitude_km;
  const auto add = [&](std::size_t layer, double to_km, double length) {
    if (!(length > walked)) return;
    const double thickness = boundary[layer] - boundary[layer + 1];
    const int parts = std::max(1, static_cast<int>(std::ceil((length - walked) / longest_km)));
    if (ray.ends.empty()) ray.ends.push_back(end(altitude_km, layer, 0.0, start, mu));
    const double from = walked;
    const ScatteringColumn::Mixture& mixture = column_.mixtures[layer];
    for (int part = 1; part <= parts; ++part) {
      const double at = part == parts ? length : from + (length - from) * part / parts;
      const double z = part == parts ? to_km
                       : geometry_.spherical
                           ? std::sqrt(start * start + at * (at + 2.0 * start * mu)) - kEarthRadius_km
                           : altitude_km + at * mu;
      ray.pieces.push_back({mixture.rayleigh, mixture.aerosol * (1.0 - mixture.peak), mixture.first,
                            LinearSource::over(column_.layer_depth[layer] * (at - walked) / thickness)});
      ray.ends.push_back(end(z, layer, at, start, mu));
      walked = at;
    }
    last_km = to_km;
  };
  // The boundary at or above the place.
  const auto found =
      std::lower_bound(boundary.begin(), boundary.end(), altitude_km, std::greater<>()) - boundary.begin();
  std::ptrdiff_t k = found;
  if (mu < 0.0) {
    const bool meets_ground = !geometry_.spherical || nearest <= ground;
    const double nearest_km = meets_ground ? boundary.back() : nearest - kEarthRadius_km;
    for (; k + 1 < static_cast<std::ptrdiff_t>(boundary.size()) && last_km > nearest_km; ++k) {
      const double to = std::max(nearest_km, boundary[static_cast<std::size_t>(k) + 1]);
      add(static_cast<std::size_t>(k), to,
          geometry_.spherical ? -start * mu - half(to) : (altitude_km - to) / -mu);
    }
    if (meets_ground) return ray;
    --k;  // the layer that holds the nearest point
    for (; k >= 0; --k)
      add(static_cast<std::size_t>(k), boundary[static_cast<std::size_t>(k)],
          -start * mu + half(boundary[static_cast<std::size_t>(k)]));
    return ray;
  }
  for (--k; k >= 0; --k) {
    const double to = boundary[static_cast<std::size_t>(k)];
    add(static_cast<std::size_t>(k), to,
        geometry_.spherical ? length_to_shell_km(altitude_km, mu, to) : (to - altitude_km) / mu);
  }
  return ray;
}

}  // namespace ifov::atmosphere
