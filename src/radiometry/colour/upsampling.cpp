#include "radiometry/colour/upsampling.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ifov::radiometry {
namespace {

constexpr double kFirst_um = 0.38, kLast_um = 0.78;

using Three = std::array<double, 3>;

double sigmoid(double x) { return 0.5 + 0.5 * x / std::sqrt(1.0 + x * x); }
/// x of a value within (0, 1).
double inverse_sigmoid(double value) { return (value - 0.5) / std::sqrt(value * (1.0 - value)); }

struct Evaluated {
  Three rgb{};
  std::array<Three, 3> by_coefficient{};  ///< [colour][coefficient]
};

Evaluated evaluated(const Three& c) {
  const auto& weights = srgb_weights();
  Evaluated e;
  for (std::size_t k = 0; k < kColourPoints; ++k) {
    const double t = static_cast<double>(k) / (kColourPoints - 1);
    const double x = (c[0] * t + c[1]) * t + c[2], root = std::sqrt(1.0 + x * x);
    const double value = 0.5 + 0.5 * x / root, slope = 0.5 / (root * root * root);
    for (std::size_t p = 0; p < 3; ++p) {
      e.rgb[p] += weights[p][k] * value;
      const double s = weights[p][k] * slope;
      e.by_coefficient[p][0] += s * t * t;
      e.by_coefficient[p][1] += s * t;
      e.by_coefficient[p][2] += s;
    }
  }
  return e;
}

double squares(const Three& rgb, const Three& target) {
  double sum = 0.0;
  for (std::size_t p = 0; p < 3; ++p) sum += (rgb[p] - target[p]) * (rgb[p] - target[p]);
  return sum;
}

/// Solves a symmetric positive definite system by Cholesky's decomposition.
Three solved(const std::array<Three, 3>& a, Three b) {
  std::array<Three, 3> l{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / l[j][j];
    }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= l[i][k] * b[k];
    b[i] /= l[i][i];
  }
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = i + 1; k < 3; ++k) b[i] -= l[k][i] * b[k];
    b[i] /= l[i][i];
  }
  return b;
}

/// Levenberg's and Marquardt's steps (damping in proportion to the diagonal) from `c` towards a colour; what is left of squares.
double approach(Three& c, const Three& target) {
  constexpr int kMost = 60;
  constexpr double kEnough = 1e-18;
  Evaluated e = evaluated(c);
  double left = squares(e.rgb, target), damping = 1e-6;
  for (int step = 0; step < kMost && left > kEnough; ++step) {
    std::array<Three, 3> normal{};
    Three gradient{};
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t i = 0; i < 3; ++i) {
        gradient[i] += e.by_coefficient[p][i] * (target[p] - e.rgb[p]);
        for (std::size_t j = 0; j < 3; ++j) normal[i][j] += e.by_coefficient[p][i] * e.by_coefficient[p][j];
      }
    for (std::size_t i = 0; i < 3; ++i) normal[i][i] *= 1.0 + damping;
    const Three change = solved(normal, gradient);
    const Three next{c[0] + change[0], c[1] + change[1], c[2] + change[2]};
    const Evaluated there = evaluated(next);
    const double after = squares(there.rgb, target);
    if (after < left) {
      c = next, e = there, left = after;
      damping = std::max(1e-12, 0.1 * damping);
    } else {
      damping *= 10.0;
      if (damping > 1e12) break;
    }
  }
  return left;
}

}  // namespace

double ColourSpectrum::at(double um) const {
  if (is_grey) return grey;
  const double t = (std::clamp(um, kFirst_um, kLast_um) - kFirst_um) / (kLast_um - kFirst_um);
  return sigmoid((c[0] * t + c[1]) * t + c[2]);
}

Spectrum ColourSpectrum::spectrum(std::string name) const {
  if (is_grey) return Spectrum::constant(grey).with_name(std::move(name));
  const std::span<const double> um = colour_wavelengths_um();
  std::vector<double> values;
  for (const double at_um : um) values.push_back(at(at_um));
  return {{um.begin(), um.end()}, std::move(values), OutsideRange::extend, std::move(name)};
}

ColourSpectrum upsampled(const LinearRgb& asked) {
  LinearRgb rgb = asked;
  for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
  ColourSpectrum result;
  const auto [least, most] = std::minmax_element(rgb.begin(), rgb.end());
  if (*most - *least < 1e-9) {
    result.is_grey = true;
    result.grey = rgb[1];
    return result;
  }
  const double luminance = std::clamp(tristimulus_of(rgb)[1], 1e-4, 1.0 - 1e-4);
  Three c{0.0, 0.0, inverse_sigmoid(luminance)};
  constexpr int kStations = 8;
  for (int station = 1; station <= kStations; ++station) {
    const double share = static_cast<double>(station) / kStations;
    Three target{};
    for (std::size_t p = 0; p < 3; ++p) target[p] = luminance + share * (rgb[p] - luminance);
    approach(c, target);
  }
  result.c = c;
  result.difference = colour_difference(evaluated(c).rgb, rgb);
  return result;
}

}  // namespace ifov::radiometry
