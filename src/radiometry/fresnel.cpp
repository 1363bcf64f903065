#include "radiometry/fresnel.h"

#include <algorithm>
#include <cmath>

namespace ifov::radiometry {
namespace {

using Complex = std::complex<double>;

/// n times the cosine of the refracted ray, of the root that fades away from the surface.
Complex refracted(Complex index, double cosine) {
  const double sine_squared = std::max(0.0, 1.0 - cosine * cosine);
  const Complex root = std::sqrt(index * index - sine_squared);
  return root.imag() < 0.0 ? -root : root;
}

}  // namespace

FresnelAmplitudes fresnel_reflection_amplitudes(Complex index, double cosine) {
  if (index == 1.0) return {0.0, 0.0};  // no surface, also at grazing incidence
  const Complex beyond = refracted(index, cosine), square = index * index;
  return {(square * cosine - beyond) / (square * cosine + beyond), (cosine - beyond) / (cosine + beyond)};
}

MuellerMatrix fresnel_reflection(Complex index, double cosine) {
  const FresnelAmplitudes r = fresnel_reflection_amplitudes(index, cosine);
  const double p = std::norm(r.p), s = std::norm(r.s), sum = 0.5 * (p + s), difference = 0.5 * (p - s);
  const Complex both = r.p * std::conj(r.s);
  return MuellerMatrix({sum, difference, 0, 0,           //
                        difference, sum, 0, 0,           //
                        0, 0, both.real(), both.imag(),  //
                        0, 0, -both.imag(), both.real()});
}

MuellerMatrix fresnel_transmission(double index, double cosine) {
  const double sine_squared = std::max(0.0, 1.0 - cosine * cosine), left = index * index - sine_squared;
  if (!(left > 0.0) || !(cosine > 0.0)) return MuellerMatrix::diagonal(0.0, 0.0, 0.0, 0.0);
  const double beyond = std::sqrt(left), square = index * index;
  const double p = 2.0 * index * cosine / (square * cosine + beyond), s = 2.0 * cosine / (cosine + beyond);
  const double flux = beyond / cosine;
  const double sum = 0.5 * flux * (p * p + s * s), difference = 0.5 * flux * (p * p - s * s),
               both = flux * p * s;
  return MuellerMatrix({sum, difference, 0, 0, difference, sum, 0, 0, 0, 0, both, 0, 0, 0, 0, both});
}

}  // namespace ifov::radiometry
