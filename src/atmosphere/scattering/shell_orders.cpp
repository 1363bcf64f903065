#include "atmosphere/scattering/shell_orders.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/scattering_column.h"
#include "atmosphere/spherical_shells.h"
#include "math/angle.h"

namespace ifov::atmosphere {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDark = 1e-36;  // as dark as a float may be
constexpr int kMostOrders = 30;
constexpr double kTolerance = 2e-3;
/// Sunbeams are known that far beyond the angles of the Sun, in steps of so much.
constexpr double kBeyond_rad = 9.0 * math::kDegree, kBeamStep_rad = 0.25 * math::kDegree;

/// Distance between altitudes at which the light is kept.
double spacing_km(double height_km) {
  return height_km < 6.0    ? 1.4
         : height_km < 15.0 ? 2.8
         : height_km < 30.0 ? 4.8
         : height_km < 60.0 ? 7.5
                            : 18.0;
}

}  // namespace

/// A place on a ray: between boundaries `layer` and `layer` + 1 of layers, and between altitudes `low` and `low` + 1.
struct ShellOrders::End {
  double length = 0.0, radius_start = 0.0, inverse_radius = 0.0;
  std::size_t layer = 0, low = 0;
  double below = 0.0;       ///< share of boundary `layer` + 1
  double high_share = 0.0;  ///< share of altitude `low` + 1
};
struct ShellOrders::Piece {
  double molecules, rest;  ///< albedos
  double first, second;    ///< 3 and 5 times the aerosol's moments
  LinearSource step;
  /// The aerosol's phase function, of Legendre's P_1 and P_2 of the scattering angle's cosine.
  double aerosol(double p1, double p2) const { return (1.0 + first * p1 + second * p2) * 0.25 / kPi; }
};
/// Pieces from the observer on, and their ends.
struct ShellOrders::Ray {
  std::vector<Piece> pieces;
  std::vector<End> ends;
  std::vector<float> sun_rad;  ///< [angle][azimuth][end]: zenith angle of the Sun
};

ShellOrders::ShellOrders(const ScatteringColumn& column, const Geometry& geometry,
                         std::span<const double> sun_zenith_rad, std::size_t own, const Fineness& fineness)
    : column_(column), geometry_(geometry), angle_rad_(sun_zenith_rad.begin(), sun_zenith_rad.end()) {
  choose_altitudes();
  tabulate_beams();
  const GaussNodes nodes = gauss_nodes(fineness.nodes);
  const std::size_t altitudes = altitude_km_.size(), angles = angle_rad_.size(),
                    count = nodes.position.size();
  std::vector<Ray> rays;  // [altitude][node][up, down]
  for (const double altitude : altitude_km_)
    for (const double mu : nodes.position)
      for (const double side : {1.0, -1.0}) {
        rays.push_back(ray(altitude, side * mu, fineness.longest_km));
        if (geometry.sun_turns) add_suns(side * mu, fineness.azimuths, rays.back());
      }

  std::vector<double> sum(altitudes * angles, 0.0), flux(altitudes, 0.0), last_mean, last_log,
      mean(sum.size()), radiance(angles);
  for (int order = 1;; ++order) {
    std::fill(mean.begin(), mean.end(), 0.0);
    std::vector<double> added(altitudes, 0.0);
    for (std::size_t r = 0; r < rays.size(); ++r) {
      const std::size_t z = r / (2 * count), j = r / 2 % count;
      const bool looks_up = r % 2 == 0;
      const double mu = looks_up ? nodes.position[j] : -nodes.position[j];
      if (geometry.sun_turns)
        add_turning(rays[r], mu, fineness.azimuths, order == 1 ? nullptr : last_log.data(), radiance);
      else
        add_still(rays[r], mu, order == 1 ? nullptr : last_mean.data(), radiance);
      for (std::size_t k = 0; k < angles; ++k) mean[z * angles + k] += 0.5 * nodes.weight[j] * radiance[k];
      if (looks_up) added[z] += 2.0 * kPi * nodes.weight[j] * mu * radiance[own];
    }
    // The orders become geometric: the last one stands for all that follow.
    const double largest = *std::max_element(mean.begin(), mean.end());
    double share = 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i)
      if (sum[i] > 0.0) share = std::max(share, mean[i] / sum[i]);
    const double before = last_mean.empty() ? 0.0 : *std::max_element(last_mean.begin(), last_mean.end());
    const double ratio = before > 0.0 ? std::min(0.97, largest / before) : 0.0;
    const bool last = order == kMostOrders || (order > 1 && share < kTolerance) || !(largest > kDark);
    const double factor = last ? 1.0 / (1.0 - ratio) : 1.0;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * mean[i];
    for (std::size_t z = 0; z < altitudes; ++z) flux[z] += factor * added[z];
    if (last) break;
    last_mean = mean;
    last_log.clear();
    if (geometry.sun_turns)
      for (const double value : mean) last_log.push_back(std::log(std::max(value, kDark)));
  }
  for (const double value : sum) log_mean_.push_back(std::log(std::max(value, kDark)));
  for (const double value : flux) log_flux_.push_back(std::log(std::max(value, kDark)));
}

/// Mean over the azimuth of what arrives, by the Sun's angle, where the Sun is as high all along the ray. `mean`: of the order
/// before, [altitude][angle]; none: sunlight.
void ShellOrders::add_still(const Ray& ray, double mu, const double* mean,
                            std::vector<double>& radiance) const {
  const std::size_t angles = angle_rad_.size();
  for (std::size_t k = 0; k < angles; ++k) {
    // Mean of Rayleigh's phase function over the azimuth.
    const double sun = std::cos(angle_rad_[k]);
    const double phase =
        0.75 * (1.0 + mu * mu * sun * sun + 0.5 * (1.0 - mu * mu) * (1.0 - sun * sun)) / (4.0 * kPi);
    // Means of Legendre's polynomials over the azimuth (addition theorem).
    const double p1 = mu * sun, p2 = 0.25 * (3.0 * mu * mu - 1.0) * (3.0 * sun * sun - 1.0);
    const auto light = [&](const End& end) {
      const double* low =
          mean == nullptr ? beam_.data() + end.layer * angles + k : mean + end.low * angles + k;
      const double share = mean == nullptr ? end.below : end.high_share;
      return (1.0 - share) * low[0] + share * low[angles];
    };
    double transmission = 1.0, sum = 0.0;
    double near = ray.ends.empty() ? 0.0 : light(ray.ends.front());
    for (std::size_t p = 0; p < ray.pieces.size(); ++p) {
      const Piece& piece = ray.pieces[p];
      const double far = light(ray.ends[p + 1]);
      const double scatters = mean == nullptr ? piece.molecules * phase + piece.rest * piece.aerosol(p1, p2)
                                              : piece.molecules + piece.rest;
      // The light at a boundary is that of the layer entered: layers' ends are shared.
      sum += transmission * scatters * (piece.step.near * near + piece.step.far * far);
      transmission *= piece.step.transmission;
      near = far;
    }
    radiance[k] = sum;
  }
}

/// The same with the Sun's height at each place, by azimuths. `log_mean`: logarithms.
void ShellOrders::add_turning(const Ray& ray, double mu, int azimuths, const double* log_mean,
                              std::vector<double>& radiance) const {
  const std::size_t angles = angle_rad_.size(), ends = ray.ends.size();
  const double step = angles > 1 ? angle_rad_[1] - angle_rad_[0] : 1.0;
  const double sine = std::sqrt(1.0 - mu * mu), most = static_cast<double>(angles - 1) - 1e-9;
  const double beam_most = static_cast<double>(beam_angles_ - 1) - 1e-9;
  for (std::size_t k = 0; k < angles; ++k) {
    radiance[k] = 0.0;
    for (int a = 0; a < azimuths; ++a) {
      const float* sun = ray.sun_rad.data() + (k * static_cast<std::size_t>(azimuths) + a) * ends;
      const auto light = [&](std::size_t e) {
        const End& end = ray.ends[e];
        if (log_mean == nullptr) {
          const double place = std::clamp((sun[e] - beam_first_rad_) / beam_step_rad_, 0.0, beam_most);
          const std::size_t at = static_cast<std::size_t>(place);
          const double share = place - static_cast<double>(at);
          const double *above = beam_.data() + end.layer * beam_angles_ + at, *below = above + beam_angles_;
          return (1.0 - end.below) * ((1.0 - share) * above[0] + share * above[1]) +
                 end.below * ((1.0 - share) * below[0] + share * below[1]);
        }
        const double place = std::clamp((sun[e] - angle_rad_[0]) / step, 0.0, most);
        const std::size_t at = static_cast<std::size_t>(place);
        const double share = place - static_cast<double>(at);
        const double *low = log_mean + end.low * angles + at, *high = low + angles;
        const double at_end = (1.0 - end.high_share) * ((1.0 - share) * low[0] + share * low[1]) +
                              end.high_share * ((1.0 - share) * high[0] + share * high[1]);
        return static_cast<double>(std::exp(static_cast<float>(at_end)));  // twice as fast, and good to 1e-5
      };
      const double along = mu * std::cos(angle_rad_[k]) +
                           sine * std::sin(angle_rad_[k]) * std::cos((a + 0.5) * kPi / azimuths);
      const double phase = 0.75 * (1.0 + along * along) / (4.0 * kPi), p2 = 1.5 * along * along - 0.5;
      double transmission = 1.0, sum = 0.0, near = ends == 0 ? 0.0 : light(0);
      for (std::size_t p = 0; p < ray.pieces.size(); ++p) {
        const Piece& piece = ray.pieces[p];
        const double far = light(p + 1);
        const double scatters = log_mean == nullptr
                                    ? piece.molecules * phase + piece.rest * piece.aerosol(along, p2)
                                    : piece.molecules + piece.rest;
        sum += transmission * scatters * (piece.step.near * near + piece.step.far * far);
        transmission *= piece.step.transmission;
        near = far;
      }
      radiance[k] += sum / azimuths;
    }
  }
}

void ShellOrders::add_suns(double mu, int azimuths, Ray& ray) const {
  const double sine = std::sqrt(1.0 - mu * mu);
  for (const double angle : angle_rad_)
    for (int a = 0; a < azimuths; ++a) {
      const double sun = std::cos(angle);
      const double along = mu * sun + sine * std::sin(angle) * std::cos((a + 0.5) * kPi / azimuths);
      for (const End& end : ray.ends)
        ray.sun_rad.push_back(static_cast<float>(std::acos(
            std::clamp((end.radius_start * sun + end.length * along) * end.inverse_radius, -1.0, 1.0))));
    }
}

void ShellOrders::choose_altitudes() {
  const std::vector<double>& boundary = column_.layer_altitude_km;
  altitude_km_ = {boundary.back()};
  for (std::size_t b = boundary.size() - 1; b-- > 0;)
    if (b == 0 || boundary[b] >= altitude_km_.back() + spacing_km(altitude_km_.back() - boundary.back()))
      altitude_km_.push_back(boundary[b]);
}

void ShellOrders::tabulate_beams() {
  const std::vector<double>&boundary = column_.layer_altitude_km, &depth = column_.layer_depth;
  beam_angles_ = angle_rad_.size();
  beam_first_rad_ = angle_rad_.front();
  beam_step_rad_ = beam_angles_ > 1 ? angle_rad_[1] - angle_rad_[0] : 0.0;
  if (geometry_.sun_turns) {
    beam_first_rad_ = std::max(0.0, angle_rad_.front() - kBeyond_rad);
    beam_step_rad_ = kBeamStep_rad;
    beam_angles_ =
        2 + static_cast<std::size_t>((angle_rad_.back() + kBeyond_rad - beam_first_rad_) / beam_step_rad_);
  }
  const double ground = kEarthRadius_km + boundary.back();
  std::vector<double> chord(boundary.size());
  for (std::size_t b = 0; b < boundary.size(); ++b)
    for (std::size_t k = 0; k < beam_angles_; ++k) {
      const double angle = beam_first_rad_ + static_cast<double>(k) * beam_step_rad_, mu = std::cos(angle),
                   radius = kEarthRadius_km + boundary[b], nearest = radius * std::sin(angle);
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
      ray.pieces.push_back({mixture.rayleigh, mixture.aerosol * (1.0 - mixture.peak), 3.0 * mixture.first,
                            5.0 * mixture.second,
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
