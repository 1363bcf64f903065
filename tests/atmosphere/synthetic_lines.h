#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "atmosphere/gas/gas_spectra.h"

namespace ifov::atmosphere::test {

/// Real part of the complex error function w(x + iy), y > 0: Weideman, SIAM J. Numer. Anal. 31 (1994) 1497-1518, with 32 terms;
/// far from 0 its leading term, y / (sqrt(pi) (x^2 + y^2)), 1e-4 off at most.
inline double faddeeva_real(double x, double y) {
  if (x * x + y * y > 1e4) return y / (std::sqrt(std::numbers::pi) * (x * x + y * y));
  constexpr int kTerms = 32, kHalf = 2 * kTerms;
  static const double length = std::sqrt(kTerms / std::numbers::sqrt2);
  static const std::array<double, kTerms> coefficient = [] {
    std::array<double, kTerms> a{};
    for (int k = -kHalf + 1; k < kHalf; ++k) {
      const double theta = k * std::numbers::pi / kHalf, t = length * std::tan(0.5 * theta);
      for (int n = 1; n <= kTerms; ++n)
        a[static_cast<std::size_t>(n - 1)] +=
            std::exp(-t * t) * (length * length + t * t) * std::cos(n * theta) / (2.0 * kHalf);
    }
    return a;
  }();
  const std::complex<double> iz(-y, x), below = length - iz, ratio = (length + iz) / below;
  std::complex<double> sum = 0.0;
  for (std::size_t n = kTerms; n > 0; --n) sum = sum * ratio + coefficient[n - 1];
  return (2.0 * sum / (below * below) + 1.0 / (std::sqrt(std::numbers::pi) * below)).real();
}

/// Voigt profile, 1/cm-1; half-widths at half maximum of its Gaussian and its Lorentzian.
inline double voigt(double from_centre_cm1, double doppler_cm1, double lorentz_cm1) {
  const double scale = std::sqrt(std::numbers::ln2) / doppler_cm1;
  return scale / std::sqrt(std::numbers::pi) *
         faddeeva_real(from_centre_cm1 * scale, std::max(1e-9, lorentz_cm1 * scale));
}

struct Line {
  double centre_cm1, strength_cm;  ///< cm per molecule at 296 K
  double width_cm1;                ///< half-width for broadening by air of 1013.25 hPa at 296 K
  double exponent = 0.7;           ///< of the width's temperature dependence
  double lower_cm1 = 0.0;          ///< energy of the lower state
};

/// Cross section of lines in a state, cm2 per molecule; a linear molecule's partition sum.
inline double cross_section(const std::vector<Line>& lines, double wavenumber_cm1, double pressure_hPa,
                            double temperature_K, double mass_u) {
  constexpr double kRadiation = 1.4387769, kReach_cm1 = 25.0;
  double sum = 0.0;
  for (const Line& line : lines) {
    const double away = wavenumber_cm1 - line.centre_cm1;
    if (std::abs(away) > kReach_cm1) continue;
    const double strength = line.strength_cm * (296.0 / temperature_K) *
                            std::exp(-kRadiation * line.lower_cm1 * (1.0 / temperature_K - 1.0 / 296.0));
    const double doppler = 3.581163e-7 * line.centre_cm1 * std::sqrt(temperature_K / mass_u);
    const double lorentz =
        line.width_cm1 * pressure_hPa / 1013.25 * std::pow(296.0 / temperature_K, line.exponent);
    sum += strength * voigt(away, doppler, lorentz);
  }
  return sum;
}

inline GasSpectra spectra_of(Gas gas, const std::vector<Line>& lines, double mass_u, double from_cm1,
                             double to_cm1, double step_cm1, StateGrid states) {
  GasSpectra spectra{{gas}, {}, std::move(states), {}};
  const int points = 1 + static_cast<int>(std::lround((to_cm1 - from_cm1) / step_cm1));
  for (int i = 0; i < points; ++i) spectra.wavenumber_cm1.push_back(from_cm1 + i * step_cm1);
  for (const double p : spectra.states.pressure_hPa())
    for (const double t : spectra.states.temperature_K()) {
      std::vector<float>& row = spectra.log_k.emplace_back();
      for (const double nu : spectra.wavenumber_cm1)
        row.push_back(log_cross_section(cross_section(lines, nu, p, t, mass_u)));
    }
  return spectra;
}

/// Even numbers of 0 to 1, the same everywhere.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

/// Lines as those of water vapour about 2.4 um: strengths over three powers of ten.
inline std::vector<Line> random_lines(std::size_t count, double from_cm1, double to_cm1, std::uint64_t seed,
                                      double strongest_cm = 1e-21) {
  Draws draw(seed);
  std::vector<Line> lines;
  for (std::size_t k = 0; k < count; ++k) {
    const double centre = from_cm1 + (to_cm1 - from_cm1) * draw();
    const double strength = strongest_cm * std::pow(10.0, -3.0 * draw());
    const double width = 0.05 + 0.05 * draw(), exponent = 0.5 + 0.3 * draw();
    lines.push_back({centre, strength, width, exponent, 1500.0 * draw()});
  }
  return lines;
}

}  // namespace ifov::atmosphere::test
