#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "atmosphere/layer_optics.h"
#include "atmosphere/scattering/phase/phase_function.h"

namespace ifov::test {

/// Sunlight over a round lake in an endless field, both Lambertian, under flat layers: the whole of it, ground and air
/// together, by paths from the sensor that are followed in three dimensions (Woodcock tracking), with light of the Sun added
/// at every event. It shares no formula with the renderer: neither transmittances nor spherical albedo, nor a spread.
struct LakeMonteCarlo {
  std::vector<double> altitude_km, extinction_km, albedo, molecules;  // of layers but for the first
  std::vector<double> sun_depth;                                      // above boundaries, vertical
  const atmosphere::AerosolPhases* phases = nullptr;
  double sun_cosine = 1.0, strongest_km = 0.0, anisotropic = 1.0;
  std::vector<std::vector<double>> angle_share;  // [function][step]: cumulated
  static constexpr int kSteps = 2000;

  LakeMonteCarlo(const std::vector<double>& levels_km, const atmosphere::LayerOptics& layers,
                 double sun_zenith_rad)
      : altitude_km(levels_km), phases(layers.aerosol_phases.get()), sun_cosine(std::cos(sun_zenith_rad)) {
    const std::size_t n = levels_km.size() - 1;
    sun_depth.assign(n + 1, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
      const double scattered = layers.rayleigh_scattering[k] + layers.aerosol_scattering[k];
      const double all = scattered + layers.aerosol_absorption[k] + layers.gas_absorption[k];
      extinction_km.push_back(all / (levels_km[k + 1] - levels_km[k]));
      albedo.push_back(all > 0.0 ? scattered / all : 0.0);
      molecules.push_back(scattered > 0.0 ? layers.rayleigh_scattering[k] / scattered : 1.0);
      strongest_km = std::max(strongest_km, extinction_km.back());
    }
    for (std::size_t k = n; k-- > 0;)
      sun_depth[k] = sun_depth[k + 1] + extinction_km[k] * (levels_km[k + 1] - levels_km[k]);
    anisotropic = (1.0 - layers.depolarization) / (1.0 + 0.5 * layers.depolarization);
    for (const atmosphere::PhaseFunction& function : phases->functions) {
      std::vector<double>& sum = angle_share.emplace_back(1, 0.0);
      for (int k = 0; k < kSteps; ++k) {
        const double a = angle(k), b = angle(k + 1), middle = 0.5 * (a + b);
        sum.push_back(sum.back() + function.at(std::cos(middle)) * (std::cos(a) - std::cos(b)));
      }
      for (double& share : sum) share /= sum.back();
    }
  }
  static double angle(double step) {
    const double u = step / kSteps;
    return std::numbers::pi * u * u;
  }
  double phase(std::size_t layer, double cosine) const {
    double value = molecules[layer] * (0.75 * anisotropic * (1.0 + cosine * cosine) + 1.0 - anisotropic);
    for (std::size_t f = 0; f < phases->functions.size(); ++f)
      if (const double share = phases->shares(layer)[f]; share > 0.0)
        value += (1.0 - molecules[layer]) * share * phases->functions[f].at(cosine);
    return value;
  }

  struct Result {
    double radiance, error;
  };
  /// Radiance above the air, `x_km` east of the lake's middle, seen at a zenith angle from the Sun's side's right (azimuth 90
  /// degrees), for sunlight of irradiance 1 across the beam.
  Result seen(double radius_km, double lake, double field, double x_km, double view_zenith_rad, int paths,
              unsigned seed) const {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> draw(0.0, 1.0);
    const double sun_sine = std::sqrt(1.0 - sun_cosine * sun_cosine);
    double sum = 0.0, squares = 0.0;
    for (int n = 0; n < paths; ++n) {
      double dx = 0.0, dy = -std::sin(view_zenith_rad), dz = -std::cos(view_zenith_rad);
      const double top = altitude_km.back() - altitude_km.front();
      double x = x_km, y = top * std::tan(view_zenith_rad), z = altitude_km.back(), weight = 1.0, light = 0.0;
      for (int events = 0; events < 200;) {
        const double length = -std::log(1.0 - draw(engine)) / strongest_km;
        double low = z + length * dz;
        if (low > altitude_km.back()) break;
        if (low <= altitude_km.front()) {
          const double part = (altitude_km.front() - z) / dz;
          x += part * dx, y += part * dy, z = altitude_km.front();
          const double reflectance = std::hypot(x, y) < radius_km ? lake : field;
          weight *= reflectance;
          light += weight * sun_cosine / std::numbers::pi * std::exp(-sun_depth[0] / sun_cosine);
          const double u = draw(engine), about = 2.0 * std::numbers::pi * draw(engine);
          dx = std::sqrt(u) * std::cos(about), dy = std::sqrt(u) * std::sin(about), dz = std::sqrt(1.0 - u);
          ++events;
        } else {
          x += length * dx, y += length * dy, z = low;
          const auto above = std::upper_bound(altitude_km.begin() + 1, altitude_km.end() - 1, z);
          const std::size_t k = static_cast<std::size_t>(above - altitude_km.begin()) - 1;
          if (draw(engine) >= extinction_km[k] / strongest_km) continue;
          weight *= albedo[k];
          const double depth = sun_depth[k + 1] + extinction_km[k] * (altitude_km[k + 1] - z);
          light += weight * phase(k, dx * sun_sine + dz * sun_cosine) / (4.0 * std::numbers::pi) *
                   std::exp(-depth / sun_cosine);
          scatter(k, dx, dy, dz, engine, draw);
          ++events;
        }
        if (weight < 0.02) {
          if (draw(engine) < 0.5) break;
          weight *= 2.0;
        }
      }
      sum += light, squares += light * light;
    }
    const double mean = sum / paths;
    return {mean, std::sqrt(std::max(0.0, squares / paths - mean * mean) / paths)};
  }

 private:
  template <class Draw>
  void scatter(std::size_t layer, double& dx, double& dy, double& dz, std::mt19937_64& engine,
               Draw& draw) const {
    double cosine = 0.0;
    if (draw(engine) < molecules[layer]) {
      const double most = 1.5 * anisotropic + 1.0 - anisotropic;
      do cosine = 2.0 * draw(engine) - 1.0;
      while (draw(engine) * most > 0.75 * anisotropic * (1.0 + cosine * cosine) + 1.0 - anisotropic);
    } else {
      double left = draw(engine);
      std::size_t f = 0;
      while (f + 1 < angle_share.size() && left >= phases->shares(layer)[f])
        left -= phases->shares(layer)[f++];
      const std::vector<double>& share = angle_share[f];
      const double u = draw(engine);
      const auto above = std::upper_bound(share.begin() + 1, share.end() - 1, u);
      const std::size_t k = static_cast<std::size_t>(above - share.begin()) - 1;
      cosine = std::cos(angle(static_cast<double>(k) + draw(engine)));
    }
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)),
                 about = 2.0 * std::numbers::pi * draw(engine);
    // Two directions across.
    const bool steep = std::abs(dz) > 0.9;
    double ax = steep ? 0.0 : -dy, ay = steep ? -dz : dx, az = steep ? dy : 0.0;
    const double norm = std::sqrt(ax * ax + ay * ay + az * az);
    ax /= norm, ay /= norm, az /= norm;
    const double bx = dy * az - dz * ay, by = dz * ax - dx * az, bz = dx * ay - dy * ax;
    const double c = sine * std::cos(about), s = sine * std::sin(about);
    dx = cosine * dx + c * ax + s * bx, dy = cosine * dy + c * ay + s * by,
    dz = cosine * dz + c * az + s * bz;
  }
};

}  // namespace ifov::test
