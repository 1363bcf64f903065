#pragma once

// Monte Carlo of flat layers over ground with direction, which shares no formula with the solver: polarization is carried as the
// mean of the electric field's dyad, molecules are dipoles, and facets reflect fields.

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace ifov::atmosphere::test {

using Vector = std::array<double, 3>;
using Dyad = std::array<std::array<double, 3>, 3>;

inline double inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector towards(double mu, double azimuth) {
  const double s = std::sqrt(std::max(0.0, 1.0 - mu * mu));
  return {s * std::cos(azimuth), s * std::sin(azimuth), mu};
}
inline Dyad sandwich(const Dyad& m, const Dyad& c) {  // m c m^T
  Dyad half{}, all{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) half[i][j] += m[i][k] * c[k][j];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) all[i][j] += half[i][k] * m[j][k];
  return all;
}
inline double trace(const Dyad& c) { return c[0][0] + c[1][1] + c[2][2]; }
inline Dyad across(const Vector& k) {  // 1 - k k
  Dyad d{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) d[i][j] = (i == j ? 1.0 : 0.0) - k[i] * k[j];
  return d;
}
/// I, Q and U about e_theta and e_phi.
inline std::array<double, 3> stokes_of(const Dyad& c, const Vector& k) {
  const double mu = k[2], s = std::hypot(k[0], k[1]);
  const double cp = s > 0.0 ? k[0] / s : 1.0, sp = s > 0.0 ? k[1] / s : 0.0;
  const Vector theta{mu * cp, mu * sp, -s}, phi{-sp, cp, 0.0};
  const auto at = [&](const Vector& a, const Vector& b) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += a[i] * c[i][j] * b[j];
    return sum;
  };
  return {at(theta, theta) + at(phi, phi), at(theta, theta) - at(phi, phi), 2.0 * at(theta, phi)};
}
inline Dyad dyad_of(const std::array<double, 3>& stokes, const Vector& k) {
  const double mu = k[2], s = std::hypot(k[0], k[1]);
  const double cp = s > 0.0 ? k[0] / s : 1.0, sp = s > 0.0 ? k[1] / s : 0.0;
  const Vector theta{mu * cp, mu * sp, -s}, phi{-sp, cp, 0.0};
  Dyad c{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c[i][j] =
          0.5 * ((stokes[0] + stokes[1]) * theta[i] * theta[j] + (stokes[0] - stokes[1]) * phi[i] * phi[j] +
                 stokes[2] * (theta[i] * phi[j] + phi[i] * theta[j]));
  return c;
}

/// What ground makes of light from `in` (propagation, down) that leaves along `out`: radiance for an irradiance of 1.
using GroundOfFields = std::function<Dyad(const Dyad& light, const Vector& in, const Vector& out)>;

struct MonteCarloLayer {
  double rayleigh = 0.0, haze = 0.0, asymmetry = 0.0, absorption = 0.0;
};
struct MonteCarloLight {
  std::array<double, 3> stokes{}, error{};
};

/// Radiance at the top of layers (from the top down) in directions (mu, azimuth), of sunlight of irradiance 1 across itself.
/// Scattering by haze (Henyey and Greenstein) loses all polarization.
inline std::vector<MonteCarloLight> monte_carlo(const std::vector<MonteCarloLayer>& layers, double sun_mu,
                                                const GroundOfFields& ground,
                                                const std::vector<std::array<double, 2>>& views, int photons,
                                                std::uint64_t seed) {
  constexpr double kPi = std::numbers::pi;
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> top{0.0};
  for (const MonteCarloLayer& layer : layers)
    top.push_back(top.back() + layer.rayleigh + layer.haze + layer.absorption);
  const double whole = top.back();
  const auto haze_phase = [](double g, double cosine) {
    return (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
  };
  std::vector<MonteCarloLight> result(views.size());
  for (int n = 0; n < photons; ++n) {
    Vector k = towards(-sun_mu, 0.0);
    Dyad c = across(k);
    for (auto& row : c)
      for (double& value : row) value *= 0.5 * sun_mu;
    double depth = 0.0;
    std::vector<std::array<double, 3>> seen(views.size());
    const auto add = [&](std::size_t v, const Dyad& light, const Vector& direction, double factor) {
      const std::array<double, 3> s = stokes_of(light, direction);
      for (int i = 0; i < 3; ++i) seen[v][i] += factor * s[i];
    };
    for (int event = 0; event < 200; ++event) {
      depth -= std::log(1.0 - uniform(generator)) * -k[2];
      if (depth <= 0.0) break;
      if (depth >= whole) {
        depth = whole;
        for (std::size_t v = 0; v < views.size(); ++v) {
          const Vector o = towards(views[v][0], views[v][1]);
          add(v, ground(c, k, o), o, std::exp(-whole / o[2]));
        }
        const Vector o = towards(std::sqrt(uniform(generator)), 2.0 * kPi * uniform(generator));
        c = ground(c, k, o);
        for (auto& row : c)
          for (double& value : row) value *= kPi;
        k = o;
      } else {
        std::size_t l = 0;
        while (depth >= top[l + 1]) ++l;
        const MonteCarloLayer& layer = layers[l];
        const double extinction = layer.rayleigh + layer.haze + layer.absorption;
        const double pick = uniform(generator) * extinction;
        if (pick < layer.absorption) break;
        const bool dipole = pick < layer.absorption + layer.rayleigh;
        const auto scattered = [&](const Vector& o) {
          Dyad out;
          if (dipole) {
            out = sandwich(across(o), c);
            for (auto& row : out)
              for (double& value : row) value *= 1.5;
          } else {
            out = across(o);
            const double light = 0.5 * trace(c) * haze_phase(layer.asymmetry, inner(k, o));
            for (auto& row : out)
              for (double& value : row) value *= light;
          }
          return out;
        };
        for (std::size_t v = 0; v < views.size(); ++v) {
          const Vector o = towards(views[v][0], views[v][1]);
          add(v, scattered(o), o, std::exp(-depth / o[2]) / (4.0 * kPi * o[2]));
        }
        const Vector o = towards(2.0 * uniform(generator) - 1.0, 2.0 * kPi * uniform(generator));
        c = scattered(o);
        k = o;
      }
      const double weight = trace(c);
      if (weight < 0.02 * sun_mu) {  // roulette
        if (uniform(generator) < 0.5) break;
        for (auto& row : c)
          for (double& value : row) value *= 2.0;
      }
    }
    for (std::size_t v = 0; v < views.size(); ++v)
      for (int i = 0; i < 3; ++i) {
        result[v].stokes[i] += seen[v][i];
        result[v].error[i] += seen[v][i] * seen[v][i];
      }
  }
  for (MonteCarloLight& light : result)
    for (int i = 0; i < 3; ++i) {
      light.stokes[i] /= photons;
      light.error[i] =
          std::sqrt(std::max(0.0, light.error[i] / photons - light.stokes[i] * light.stokes[i]) / photons);
    }
  return result;
}

/// Facets of glass-like index n with Gaussian slopes (variance `slope2` along each axis), reflected once.
inline GroundOfFields facets_of_fields(double n, double slope2) {
  return [n, slope2](const Dyad& light, const Vector& in, const Vector& out) {
    Vector half{out[0] - in[0], out[1] - in[1], out[2] - in[2]};
    const double length = std::sqrt(inner(half, half));
    for (double& value : half) value /= length;
    const double cosine = -inner(in, half), tilt2 = (1.0 - half[2] * half[2]) / (half[2] * half[2]);
    const double density =
        std::exp(-0.5 * tilt2 / slope2) / (2.0 * std::numbers::pi * slope2 * std::pow(half[2], 4));
    const double brdf = density / (4.0 * -in[2] * out[2]);
    const double bent = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
    const double rs = (cosine - n * bent) / (cosine + n * bent),
                 rp = (n * cosine - bent) / (n * cosine + bent);
    Vector s{in[1] * half[2] - in[2] * half[1], in[2] * half[0] - in[0] * half[2],
             in[0] * half[1] - in[1] * half[0]};
    const double ls = std::sqrt(inner(s, s));
    if (!(ls > 1e-9))
      s = {0.0, 1.0, 0.0};
    else
      for (double& value : s) value /= ls;
    const auto p_of = [&](const Vector& k) {
      return Vector{s[1] * k[2] - s[2] * k[1], s[2] * k[0] - s[0] * k[2], s[0] * k[1] - s[1] * k[0]};
    };
    const Vector pi = p_of(in), po = p_of(out);
    Dyad jones{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) jones[i][j] = rs * s[i] * s[j] + rp * po[i] * pi[j];
    Dyad result = sandwich(jones, light);
    for (auto& row : result)
      for (double& value : row) value *= brdf;
    return result;
  };
}

inline GroundOfFields unpolarizing(std::function<double(double in, double out, double azimuth)> brdf) {
  return [brdf = std::move(brdf)](const Dyad& light, const Vector& in, const Vector& out) {
    Dyad result = across(out);
    const double value =
        0.5 * trace(light) * brdf(-in[2], out[2], std::atan2(out[1], out[0]) - std::atan2(in[1], in[0]));
    for (auto& row : result)
      for (double& element : row) element *= value;
    return result;
  };
}

}  // namespace ifov::atmosphere::test
