#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

namespace ifov::test {

/// Sunlight that molecules (without depolarization, unpolarized) and haze (Henyey and Greenstein's phase function) scatter in shells
/// about a round Earth with black ground, by
/// paths that are followed backwards from the observer through three dimensions; light of the Sun is added at every event, as
/// far as the Earth lets it through. Rays are not refracted. It shares no formula with the solver: no flat layer, no expansion
/// of the phase function, no order of scattering.
///
/// The observer's place on the ground is at (0, 0, radius), the Sun in the half plane of negative x.
class SphericalMonteCarlo {
 public:
  using Vector = std::array<double, 3>;

  /// Altitudes rising, n + 1, and vertical scattering depths of the n layers. A huge radius makes the layers flat.
  SphericalMonteCarlo(const std::vector<double>& altitude_km, const std::vector<double>& depth,
                      double sun_zenith_rad, double radius_km = 6371.0)
      : sun_{-std::sin(sun_zenith_rad), 0.0, std::cos(sun_zenith_rad)} {
    for (const double altitude : altitude_km) radius_.push_back(radius_km + altitude);
    for (std::size_t k = 0; k < depth.size(); ++k)
      extinction_.push_back(depth[k] / (altitude_km[k + 1] - altitude_km[k]));
    haze_share_.assign(depth.size(), 0.0);
    albedo_.assign(depth.size(), 1.0);
  }

  /// Haze beside the molecules: scattering depths of the layers, and its asymmetry.
  void add_haze(const std::vector<double>& depth, double asymmetry) {
    asymmetry_ = asymmetry;
    for (std::size_t k = 0; k < depth.size(); ++k) {
      const double haze = depth[k] / (radius_[k + 1] - radius_[k]);
      extinction_[k] += haze;
      haze_share_[k] = extinction_[k] > 0.0 ? haze / extinction_[k] : 0.0;
    }
  }

  /// Gas, or what haze absorbs: absorption depths of the layers. After haze.
  void add_absorption(const std::vector<double>& depth) {
    for (std::size_t k = 0; k < depth.size(); ++k) {
      const double taken = depth[k] / (radius_[k + 1] - radius_[k]), all = extinction_[k] + taken;
      if (all > 0.0) albedo_[k] *= extinction_[k] / all;
      extinction_[k] = all;
    }
  }

  /// Means and their standard errors, of all light and of light scattered once; for sunlight of irradiance 1 across the beam. And
  /// of what the air scatters of light of ground whose radiance is 1 in every direction.
  struct Light {
    double all, error, once;
    double of_ground, of_ground_error;
  };
  /// Radiance that comes down to the ground, in light that propagates to this azimuth (0: as sunlight does).
  Light sky(double zenith_rad, double azimuth_rad, std::uint64_t paths, unsigned seed) const {
    const Vector look = away(zenith_rad, azimuth_rad + std::numbers::pi);
    return mean(ground(), look, paths, seed);
  }
  /// Radiance that leaves the air, or meets a sensor in it, along a line from the ground, which the line leaves at this zenith angle;
  /// or from something black and small above the ground.
  Light above(double zenith_rad, double azimuth_rad, std::uint64_t paths, unsigned seed,
              double sensor_km = std::numeric_limits<double>::infinity(), double surface_km = 0.0) const {
    const Vector up = away(zenith_rad, azimuth_rad), surface{0.0, 0.0, radius_.front() + surface_km};
    const double along = surface[2] * up[2], top = std::min(radius_.back(), radius_.front() + sensor_km);
    const double length =
        (1.0 - 1e-12) * (-along + std::sqrt(along * along + top * top - surface[2] * surface[2]));
    return mean(moved(surface, up, length), Vector{-up[0], -up[1], -up[2]}, paths, seed, 1.0,
                surface_km > 0.0 ? length : std::numeric_limits<double>::infinity());
  }
  /// Irradiance on level ground.
  Light flux(std::uint64_t paths, unsigned seed) const { return mean(ground(), std::nullopt, paths, seed); }
  /// Irradiance from below on a level surface at the top of the air, above the observer's place.
  Light flux_up(std::uint64_t paths, unsigned seed) const {
    return mean({0.0, 0.0, radius_.back() * (1.0 - 1e-12)}, std::nullopt, paths, seed, -1.0);
  }

 private:
  struct Piece {
    std::size_t layer;
    double length;
  };
  struct Line {
    std::vector<Piece> pieces;
    bool ground = false;
    double depth = 0.0;
  };
  using Draw = std::uniform_real_distribution<double>;

  Vector ground() const { return {0.0, 0.0, radius_.front()}; }
  static double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector moved(const Vector& from, const Vector& along, double length) {
    return {from[0] + length * along[0], from[1] + length * along[1], from[2] + length * along[2]};
  }
  static Vector away(double zenith_rad, double azimuth_rad) {
    return {std::sin(zenith_rad) * std::cos(azimuth_rad), std::sin(zenith_rad) * std::sin(azimuth_rad),
            std::cos(zenith_rad)};
  }

  /// What a ray crosses until it leaves the air, meets the ground or has gone so far.
  void trace(const Vector& from, const Vector& along, Line& line,
             double most_km = std::numeric_limits<double>::infinity()) const {
    line.pieces.clear();
    line.ground = false;
    line.depth = 0.0;
    const double start = dot(from, from), b = dot(from, along), distance = std::sqrt(start);
    const std::size_t layers = extinction_.size();
    constexpr double kOnShell = 1e-7, kNone = std::numeric_limits<double>::infinity();
    std::size_t k = 0;
    while (k + 1 < layers && distance >= radius_[k + 1]) ++k;
    if (b < 0.0 && std::abs(distance - radius_[k]) < kOnShell) {
      line.ground = k == 0;
      if (line.ground) return;
      --k;
    } else if (b >= 0.0 && std::abs(distance - radius_[k + 1]) < kOnShell && ++k >= layers) {
      return;
    }
    for (double walked = 0.0;;) {
      const double inner = b * b - start + radius_[k] * radius_[k],
                   outer = b * b - start + radius_[k + 1] * radius_[k + 1];
      double down = inner > 0.0 ? -b - std::sqrt(inner) : kNone;
      if (!(down > walked + 1e-9)) down = kNone;
      const double up = std::max(walked, -b + std::sqrt(std::max(0.0, outer))),
                   next = std::min({down, up, most_km});
      line.pieces.push_back({k, next - walked});
      line.depth += extinction_[k] * (next - walked);
      walked = next;
      if (walked >= most_km) return;
      if (down < up) {
        line.ground = k == 0;
        if (line.ground) return;
        --k;
      } else if (++k >= layers) {
        return;
      }
    }
  }

  static Vector turned(const Vector& about, double cosine, double azimuth) {
    const Vector other = std::abs(about[2]) < 0.9 ? Vector{0.0, 0.0, 1.0} : Vector{1.0, 0.0, 0.0};
    Vector side{other[1] * about[2] - other[2] * about[1], other[2] * about[0] - other[0] * about[2],
                other[0] * about[1] - other[1] * about[0]};
    const double norm = std::sqrt(dot(side, side));
    for (double& x : side) x /= norm;
    const Vector third{about[1] * side[2] - about[2] * side[1], about[2] * side[0] - about[0] * side[2],
                       about[0] * side[1] - about[1] * side[0]};
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), c = sine * std::cos(azimuth),
                 s = sine * std::sin(azimuth);
    Vector result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = cosine * about[i] + c * side[i] + s * third[i];
    const double length = std::sqrt(dot(result, result));
    for (double& x : result) x /= length;
    return result;
  }

  /// Of Henyey and Greenstein's phase function (their equation 2), inverted.
  double haze_cosine(double draw) const {
    const double g = asymmetry_, ratio = (1.0 - g * g) / (1.0 - g + 2.0 * g * draw);
    return std::clamp((1.0 + g * g - ratio * ratio) / (2.0 * g), -1.0, 1.0);
  }
  double haze_phase(double cosine) const {
    const double g = asymmetry_;
    return (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
  }

  /// Of molecules, by Cardano's formula.
  static double scattering_cosine(double draw) {
    const double q = 4.0 * (2.0 * draw - 1.0), root = std::cbrt(0.5 * (q + std::sqrt(q * q + 4.0)));
    return std::clamp(root - 1.0 / root, -1.0, 1.0);
  }

  /// `look`: none for an irradiance. Scattering along the first ray is forced, and its place is stratified.
  Light mean(const Vector& from, const std::optional<Vector>& look, std::uint64_t paths, unsigned seed,
             double upwards = 1.0, double first_km = std::numeric_limits<double>::infinity()) const {
    constexpr std::uint64_t kBatch = 1000;
    constexpr int kMostEvents = 100;
    constexpr double kWeak = 1e-3;
    std::mt19937_64 engine(seed);
    Draw draw(0.0, 1.0);
    Line line, sunbeam;
    const std::uint64_t batches = std::max<std::uint64_t>(2, paths / kBatch);
    double sum = 0.0, squares = 0.0, first = 0.0, ground_sum = 0.0, ground_squares = 0.0;
    for (std::uint64_t batch = 0; batch < batches; ++batch) {
      double light = 0.0, of_ground = 0.0;
      for (std::uint64_t path = 0; path < kBatch; ++path) {
        Vector at = from, along = look ? *look : Vector{};
        double weight = 1.0;
        if (!look) {
          along = turned({0.0, 0.0, upwards}, std::sqrt(draw(engine)), 2.0 * std::numbers::pi * draw(engine));
          weight = std::numbers::pi;
        }
        for (int event = 0; event < kMostEvents; ++event) {
          trace(at, along, line, event == 0 ? first_km : std::numeric_limits<double>::infinity());
          if (event > 0 && line.ground) of_ground += weight * std::exp(-line.depth);
          const double scattered = -std::expm1(-line.depth);
          if (!(scattered > 0.0)) break;
          weight *= scattered;
          double place = draw(engine);
          if (event == 0) place = (static_cast<double>(path) + place) / static_cast<double>(kBatch);
          double left = -std::log1p(-place * scattered), length = 0.0,
                 haze = haze_share_[line.pieces.back().layer], albedo = albedo_[line.pieces.back().layer];
          for (const Piece& piece : line.pieces) {
            const double depth = extinction_[piece.layer] * piece.length;
            if (left <= depth) {
              length += left / extinction_[piece.layer];
              haze = haze_share_[piece.layer], albedo = albedo_[piece.layer];
              break;
            }
            left -= depth;
            length += piece.length;
          }
          weight *= albedo;
          at = moved(at, along, length);
          trace(at, sun_, sunbeam);
          if (!sunbeam.ground) {
            const double cosine = dot(along, sun_);
            const double phase = (1.0 - haze) * 0.75 * (1.0 + cosine * cosine) +
                                 (haze > 0.0 ? haze * haze_phase(cosine) : 0.0);
            const double arrives = weight * phase / (4.0 * std::numbers::pi) * std::exp(-sunbeam.depth);
            light += arrives;
            if (event == 0) first += arrives;
          }
          const bool by_haze = haze > 0.0 && draw(engine) < haze;
          const double number = draw(engine),
                       turn = by_haze ? haze_cosine(number) : scattering_cosine(number);
          along = turned(along, turn, 2.0 * std::numbers::pi * draw(engine));
          if (weight < kWeak) {
            if (draw(engine) < 0.5) break;
            weight *= 2.0;
          }
        }
      }
      light /= static_cast<double>(kBatch);
      sum += light;
      squares += light * light;
      of_ground /= static_cast<double>(kBatch);
      ground_sum += of_ground;
      ground_squares += of_ground * of_ground;
    }
    const double count = static_cast<double>(batches);
    const auto error = [&](double all, double all_squares) {
      return std::sqrt(std::max(0.0, all_squares / count - all / count * all / count) / (count - 1.0));
    };
    return {sum / count, error(sum, squares), first / (count * static_cast<double>(kBatch)),
            ground_sum / count, error(ground_sum, ground_squares)};
  }

  std::vector<double> radius_, extinction_, haze_share_,
      albedo_;  // haze's share of what scatters; what scatters of extinction
  double asymmetry_ = 0.0;
  Vector sun_;
};

}  // namespace ifov::test
