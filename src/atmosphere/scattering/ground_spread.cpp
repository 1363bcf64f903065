#include "atmosphere/scattering/ground_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/scattering/phase/phase_function.h"
#include "sampling/random.h"

namespace ifov::atmosphere {
namespace {

constexpr double kFirstEdge_km = 0.005, kEdgeRatio = 1.35;
constexpr double kVertical_rad = 0.01;  ///< lines of sight as steep as this spread evenly to all sides
constexpr int kDrawSteps = 1024;        ///< steps of cumulated phase functions, narrow forward
constexpr int kMostEvents = 400;        ///< orders of scattering that are followed
constexpr double kLeastWeight = 0.05;   ///< below it light goes on by chance

struct Direction {
  double x, y, z;
};

/// Turned by a scattering angle, `azimuth_rad` about itself.
Direction turned_by(const Direction& d, double cosine, double azimuth_rad) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double c = sine * std::cos(azimuth_rad), s = sine * std::sin(azimuth_rad);
  const double level = std::hypot(d.x, d.y);
  if (level < 1e-9) return {c, s, std::copysign(cosine, d.z * cosine)};
  return {d.x * cosine + (d.x * d.z * c - d.y * s) / level, d.y * cosine + (d.y * d.z * c + d.x * s) / level,
          d.z * cosine - level * c};
}

/// Cosines of scattering angles of which a phase function has equal shares between.
class CosineDraw {
 public:
  template <class Phase>
  explicit CosineDraw(const Phase& at) {
    angle_.reserve(kDrawSteps + 1);
    cumulated_.reserve(kDrawSteps + 1);
    double sum = 0.0, before = 0.0;
    for (int k = 0; k <= kDrawSteps; ++k) {
      const double u = static_cast<double>(k) / kDrawSteps, angle = std::numbers::pi * u * u * u;
      const double density = at(std::cos(angle)) * std::sin(angle);
      if (k > 0) sum += 0.5 * (density + before) * (angle - angle_.back());
      angle_.push_back(angle);
      cumulated_.push_back(sum);
      before = density;
    }
    for (double& c : cumulated_) c /= sum;
  }
  double cosine(double u) const {
    const auto above = std::upper_bound(cumulated_.begin() + 1, cumulated_.end() - 1, u);
    const std::size_t k = static_cast<std::size_t>(above - cumulated_.begin());
    const double step = cumulated_[k] - cumulated_[k - 1];
    const double share = step > 0.0 ? (u - cumulated_[k - 1]) / step : 0.5;
    return std::cos(angle_[k - 1] + share * (angle_[k] - angle_[k - 1]));
  }

 private:
  std::vector<double> angle_, cumulated_;
};

double henyey_greenstein(double g, double u) {
  if (std::abs(g) < 1e-4) return 1.0 - 2.0 * u;
  const double t = (1.0 - g * g) / (1.0 + g - 2.0 * g * u);
  return std::clamp((1.0 + g * g - t * t) / (2.0 * g), -1.0, 1.0);
}

/// Of 3/4 (1 + c^2): the real root of c^3 + 3 c = 4 (1 - 2 u).
double rayleigh_cosine(double u) {
  const double q = 2.0 * (1.0 - 2.0 * u), root = std::cbrt(q + std::sqrt(q * q + 1.0));
  return std::clamp(root - 1.0 / root, -1.0, 1.0);
}

/// A column by optical depth from the top down.
class SpreadColumn {
 public:
  SpreadColumn(const std::vector<double>& altitude_km, const LayerOptics& layers) : layers_(layers) {
    const std::size_t n = layers.layers();
    for (std::size_t k = n + 1; k-- > 0;) {
      altitude_.push_back(altitude_km[k]);
      if (k == n) {
        depth_.push_back(0.0);
        continue;
      }
      const double rayleigh = layers.rayleigh_scattering[k], aerosol = layers.aerosol_scattering[k];
      const double all = rayleigh + aerosol + layers.aerosol_absorption[k] + layers.gas_absorption[k];
      depth_.push_back(depth_.back() + all);
      albedo_.push_back(all > 0.0 ? (rayleigh + aerosol) / all : 0.0);
      molecules_.push_back(rayleigh + aerosol > 0.0 ? rayleigh / (rayleigh + aerosol) : 1.0);
      layer_.push_back(k);
    }
    anisotropic_ = (1.0 - layers.depolarization) / (1.0 + 0.5 * layers.depolarization);
    if (layers.aerosol_phases)
      for (const PhaseFunction& function : layers.aerosol_phases->functions)
        draws_.emplace_back([&](double cosine) { return function.at(cosine); });
  }
  double depth() const { return depth_.back(); }
  double ground_km() const { return altitude_.back(); }
  double depth_at(double altitude_km) const {
    if (altitude_km >= altitude_.front()) return 0.0;
    std::size_t k = 1;
    while (k + 1 < altitude_.size() && altitude_[k] > altitude_km) ++k;
    const double share = (altitude_[k - 1] - altitude_km) / (altitude_[k - 1] - altitude_[k]);
    return depth_[k - 1] + std::clamp(share, 0.0, 1.0) * (depth_[k] - depth_[k - 1]);
  }
  struct Place {
    std::size_t layer;  ///< from the top
    double altitude_km;
  };
  Place place(double depth) const {
    const auto above = std::upper_bound(depth_.begin() + 1, depth_.end() - 1, depth);
    const std::size_t k = static_cast<std::size_t>(above - depth_.begin()) - 1;
    const double step = depth_[k + 1] - depth_[k];
    const double share = step > 0.0 ? std::clamp((depth - depth_[k]) / step, 0.0, 1.0) : 0.5;
    return {k, altitude_[k] + share * (altitude_[k + 1] - altitude_[k])};
  }
  double albedo(std::size_t layer) const { return albedo_[layer]; }
  /// Cosine of a scattering angle, from two random numbers.
  double cosine(std::size_t layer, double kind, double u) const {
    if (kind < molecules_[layer]) {
      kind /= molecules_[layer];
      return kind < anisotropic_ ? rayleigh_cosine(u) : 1.0 - 2.0 * u;
    }
    const std::size_t own = layer_[layer];
    if (draws_.empty()) return henyey_greenstein(layers_.aerosol_asymmetry[own], u);
    double left = (kind - molecules_[layer]) / (1.0 - molecules_[layer]);
    const double* share = layers_.aerosol_phases->shares(own);
    std::size_t f = 0;
    while (f + 1 < draws_.size() && left >= share[f]) left -= share[f++];
    return draws_[f].cosine(u);
  }

 private:
  const LayerOptics& layers_;
  std::vector<double> altitude_, depth_;  // of boundaries, from the top
  std::vector<double> albedo_, molecules_;
  std::vector<std::size_t> layer_;
  std::vector<CosineDraw> draws_;
  double anisotropic_ = 1.0;
};

/// Fraction of x + k phi_d: an additive recurrence that fills the cube evenly (Roberts 2018).
double even(std::size_t k, double step, double offset) {
  const double value = offset + static_cast<double>(k + 1) * step;
  return value - std::floor(value);
}

}  // namespace

const std::array<double, GroundSpread::kRings>& GroundSpread::inner_edges_km() {
  static const std::array<double, kRings> edges = [] {
    std::array<double, kRings> all{};
    double edge = kFirstEdge_km;
    for (std::size_t k = 1; k < kRings; ++k, edge *= kEdgeRatio) all[k] = edge;
    return all;
  }();
  return edges;
}

GroundSpread::GroundSpread(const std::vector<double>& altitude_km, const LayerOptics& layers,
                           const Sight& sight, std::size_t photons, std::uint64_t seed)
    : shares_(kRings * kSectors, 0.0) {
  const SpreadColumn column(altitude_km, layers);
  const bool even_all_around = sight.from_ground || sight.zenith_rad < kVertical_rad;
  const double sensor_depth = column.depth_at(sight.sensor_km);
  // The generalized golden ratio of three dimensions.
  constexpr double kPhi = 1.2207440846057596;
  const double steps[3] = {1.0 / kPhi, 1.0 / (kPhi * kPhi), 1.0 / (kPhi * kPhi * kPhi)};
  const std::array<double, kRings>& edges = inner_edges_km();
  double sum = 0.0, squares = 0.0;
  for (std::size_t n = 0; n < photons; ++n) {
    const std::uint64_t key = sampling::hash(seed, static_cast<std::uint64_t>(n));
    std::uint64_t drawn = 0;
    const auto draw = [&] { return sampling::unit_double(sampling::extend(key, drawn++)); };
    const double first = even(n, steps[0], 0.5), second = even(n, steps[1], 0.5),
                 third = even(n, steps[2], 0.5);
    // x is towards the sensor, z up. It starts where the line of sight meets the ground, for any altitude of the sensor.
    Direction d{-std::sin(sight.zenith_rad), 0.0, -std::cos(sight.zenith_rad)};
    double tau = sensor_depth, x = 0.0, y = 0.0, altitude = 0.0;
    if (sight.from_ground) {
      const double cosine = std::sqrt(std::max(third, 1e-12)), sine = std::sqrt(1.0 - cosine * cosine);
      d = {sine, 0.0, cosine};
      tau = column.depth(), altitude = column.ground_km();
    } else {
      altitude = std::max(sight.sensor_km, column.ground_km());
      x = (altitude - column.ground_km()) * std::tan(sight.zenith_rad);
    }
    // The first event stands between sensor and ground in any case, and weighs as much as is stopped there.
    const double way = (sight.from_ground ? column.depth() : column.depth() - sensor_depth) / std::abs(d.z);
    const double stopped = -std::expm1(-way);
    double weight = stopped, length = -std::log1p(-first * stopped);
    bool landed = false;
    for (int event = 0; event < kMostEvents; ++event) {
      tau -= length * d.z;
      if (event > 0 && tau >= column.depth()) {
        const double flat = (altitude - column.ground_km()) / std::max(1e-9, -d.z);
        x += flat * d.x, y += flat * d.y;
        landed = true;
        break;
      }
      if (event > 0 && tau <= 0.0) break;
      tau = std::clamp(tau, 0.0, column.depth());
      const SpreadColumn::Place place = column.place(tau);
      const double flat = (place.altitude_km - altitude) / (std::abs(d.z) > 1e-9 ? d.z : 1e-9);
      x += flat * d.x, y += flat * d.y;
      altitude = place.altitude_km;
      weight *= column.albedo(place.layer);
      if (!(weight > 0.0)) break;
      if (weight < kLeastWeight * stopped) {
        if (draw() >= 0.5) break;
        weight *= 2.0;
      }
      const double kind = draw(), u = event == 0 && !sight.from_ground ? third : draw();
      const double about = 2.0 * std::numbers::pi * (event == 0 ? second : draw());
      d = turned_by(d, column.cosine(place.layer, kind, u), about);
      length = -std::log1p(-draw());
    }
    if (!landed) continue;
    sum += weight;
    squares += weight * weight;
    const double distance = std::hypot(x, y);
    const std::size_t ring =
        static_cast<std::size_t>(std::upper_bound(edges.begin() + 1, edges.end(), distance) - edges.begin()) -
        1;
    double* sectors = shares_.data() + ring * kSectors;
    if (even_all_around) {
      for (std::size_t s = 0; s < kSectors; ++s) sectors[s] += weight / kSectors;
      continue;
    }
    // The air is the same on both sides of the plane of sight.
    const double turn = std::abs(std::atan2(y, x)) * kSectors / (2.0 * std::numbers::pi);
    const std::size_t sector = static_cast<std::size_t>(turn + 0.5) % kSectors;
    sectors[sector] += 0.5 * weight;
    sectors[(kSectors - sector) % kSectors] += 0.5 * weight;
  }
  const double n = static_cast<double>(photons);
  transmittance_ = sum / n;
  standard_error_ = std::sqrt(std::max(0.0, squares / n - transmittance_ * transmittance_) / n);
  if (squares > 0.0) effective_photons_ = sum * sum / squares;
  if (sum > 0.0)
    for (double& share : shares_) share /= sum;
}

double GroundSpread::within(double distance_km) const {
  const std::array<double, kRings>& edges = inner_edges_km();
  double sum = 0.0;
  for (std::size_t k = 0; k < kRings && distance_km > edges[k]; ++k) {
    double ring = 0.0;
    for (std::size_t s = 0; s < kSectors; ++s) ring += shares_[k * kSectors + s];
    double part = 1.0;
    if (k == 0)
      part = std::min(1.0, distance_km / edges[1]);
    else if (k + 1 < kRings)
      part = std::min(1.0, std::log(distance_km / edges[k]) / std::log(edges[k + 1] / edges[k]));
    sum += part * ring;
  }
  return sum;
}

}  // namespace ifov::atmosphere
