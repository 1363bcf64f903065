#include "materials/bsdf/boundary/boundary_polarization.h"

#include <algorithm>
#include <cmath>

namespace ifov::materials {
namespace {

using Complex = std::complex<double>;

/// Of this power, with the phase of `amplitudes`.
Complex cross_of(double power_p, double power_s, Complex amplitudes) {
  const double size = std::abs(amplitudes);
  return size > 0.0 ? std::sqrt(std::max(0.0, power_p * power_s)) / size * amplitudes : Complex(0.0);
}

}  // namespace

PaneCross bare_cross(Complex index, double cosine) {
  const radiometry::FresnelAmplitudes r = radiometry::fresnel_reflection_amplitudes(index, cosine);
  const Complex both = (1.0 - r.p * r.p) * std::conj(1.0 - r.s * r.s);
  const CrossShares one{r.p * std::conj(r.s),
                        cross_of(1.0 - std::norm(r.p), 1.0 - std::norm(r.s), std::sqrt(both))};
  return {one, one};
}

CrossShares film_cross(const radiometry::FilmStack& stack, double sine) {
  const radiometry::PowerShares power = radiometry::film_shares(stack, sine);
  const radiometry::FresnelAmplitudes r = radiometry::film_reflection_amplitudes(stack, sine),
                                      t = radiometry::film_transmission_amplitudes(stack, sine);
  return {cross_of(power.reflected_p, power.reflected_s, r.p * std::conj(r.s)),
          cross_of(power.transmitted_p, power.transmitted_s, t.p * std::conj(t.s))};
}

CrossShares pane_cross(const PaneCross& front, const PaneCross& back, double passes) {
  const Complex to_and_fro = 1.0 - front.within.reflected * back.within.reflected * passes * passes;
  const Complex sum = std::abs(to_and_fro) > 1e-12 ? 1.0 / to_and_fro : Complex(0.0);
  return {front.outside.reflected + front.outside.transmitted * back.within.reflected *
                                        front.within.transmitted * passes * passes * sum,
          front.outside.transmitted * back.within.transmitted * passes * sum};
}

namespace boundary_polarization {

std::vector<radiometry::Spectrum> tabulated(const boundary_rows::Source& source, std::size_t rows,
                                            bool transmits, const PolarizedShares& shares) {
  const auto write = [](double p, double s, Complex cross, double* values) {
    values[0] = 0.5 * (p + s), values[1] = 0.5 * (p - s);
    values[2] = cross.real(), values[3] = cross.imag();
  };
  return boundary_rows::tabulated(
      source, rows, kElements * (transmits ? 2 : 1), [&](double um, double cosine, double* values) {
        const Polarized at = shares(um, cosine);
        write(at.power.reflected_p, at.power.reflected_s, at.cross.reflected, values);
        if (transmits)
          write(at.power.transmitted_p, at.power.transmitted_s, at.cross.transmitted, values + kElements);
      });
}

}  // namespace boundary_polarization

}  // namespace ifov::materials
